#include "models/measured.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "albedo/core/errors.hpp"

namespace albedo {
namespace {

MeasuredFile read(const std::string& path) {
  constexpr std::uintmax_t most = std::uintmax_t{1} << 31;
  MeasuredFile file{path, {}};
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    file.refuse(std::filesystem::exists(path, error) ? "is not a file" : "does not exist");
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) file.refuse("can't be read");
  if (size > most) file.refuse("is larger than 2 GiB");
  file.bytes.resize(static_cast<std::size_t>(size));
  std::ifstream stream(path, std::ios::binary);
  stream.read(reinterpret_cast<char*>(file.bytes.data()), static_cast<std::streamsize>(size));
  if (!stream || stream.gcount() != static_cast<std::streamsize>(size)) file.refuse("can't be read");
  return file;
}

}  // namespace

void MeasuredFile::refuse(const std::string& why) const { throw FormatError("measured: file '" + path + "' " + why); }

Between between(double x, std::size_t count) {
  const double place = x * static_cast<double>(count - 1);
  const double first = std::clamp(std::floor(place), 0.0, static_cast<double>(count - 2));
  return {static_cast<std::size_t>(first), place - first};
}

HalfAngles half_angles(const DirectionPair<double>& pair) {
  const double planar_l = std::hypot(pair.l_x, pair.l_y);
  const double x = planar_l > 0 ? pair.l_x / planar_l : 1, y = planar_l > 0 ? pair.l_y / planar_l : 0;
  return {std::atan(std::hypot(pair.slope_x, pair.slope_y)),
          std::atan2(x * pair.slope_y - y * pair.slope_x, x * pair.slope_x + y * pair.slope_y)};
}

double theta_of_light(const DirectionPair<double>& pair) {
  return std::atan2(std::hypot(pair.l_x, pair.l_y), pair.cos_theta_l);
}

std::shared_ptr<const MeasuredTable> read_measured(const std::string& path, int channel, bool negative_as_zero) {
  const MeasuredFile file = read(path);
  if (file.bytes.empty()) file.refuse("is empty");
  const std::size_t begin = std::min(file.bytes.size(), tensor_magic_size);
  const bool is_tensor = std::memcmp(file.bytes.data(), tensor_magic, begin) == 0;
  return is_tensor ? read_rgl(file, channel, negative_as_zero) : read_merl(file, channel);
}

void Measured::load() {
  if (file.empty()) throw ParameterError("measured: file is not given and must be the path of a .bsdf or .binary file");
  table = read_measured(file, static_cast<int>(channel), negative == Negative::zero);
}

}  // namespace albedo
