#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

/// Small synthetic files in the formats of measured materials.
namespace albedo::test {

/// What an RGL file of width × height tables holds, as functions of places in the unit square.
struct RglContent {
  using Function = std::function<double(double x, double y)>;

  std::vector<double> thetas{0, std::numbers::pi / 2};
  std::size_t width = 9, height = 7;
  std::size_t azimuths = 1;
  Function ndf = [](double, double) { return 1.0; };
  Function sigma = ndf;
  Function vndf = ndf;
  std::function<double(std::size_t slice, int channel, double x, double y)> rgb = [](std::size_t, int, double, double) {
    return 1.0;
  };
  std::string rgb_name = "rgb";
  unsigned char jacobian = 1;
};

class Bytes {
 public:
  template <class Number>
  void number(Number value) {
    const std::size_t at = data.size();
    data.resize(at + sizeof value);
    std::memcpy(data.data() + at, &value, sizeof value);
  }
  std::string data{};
};

inline std::string rgl_bytes(const RglContent& content) {
  struct Field {
    std::string name;
    std::uint8_t type;
    std::vector<std::uint64_t> shape;
    std::string data;
  };
  const auto table = [&](const RglContent::Function& of) {
    Bytes bytes;
    for (std::size_t j = 0; j < content.height; ++j) {
      for (std::size_t i = 0; i < content.width; ++i) {
        bytes.number(static_cast<float>(of(static_cast<double>(i) / static_cast<double>(content.width - 1),
                                           static_cast<double>(j) / static_cast<double>(content.height - 1))));
      }
    }
    return bytes.data;
  };
  Bytes thetas, azimuths, vndf, rgb, jacobian;
  for (const double theta : content.thetas) thetas.number(static_cast<float>(theta));
  for (std::size_t i = 0; i < content.azimuths; ++i) {
    azimuths.number(static_cast<float>(i));
    for (std::size_t k = 0; k < content.thetas.size(); ++k) {
      vndf.data += table(content.vndf);
      for (int channel = 0; channel < 3; ++channel) {
        rgb.data += table([&](double x, double y) { return content.rgb(k, channel, x, y); });
      }
    }
  }
  jacobian.number(content.jacobian);
  constexpr std::uint8_t float32 = 10, uint8 = 1;
  const std::uint64_t w = content.width, h = content.height, n = content.thetas.size(), p = content.azimuths;
  const std::vector<Field> fields{
      {"theta_i", float32, {n}, thetas.data},       {"phi_i", float32, {p}, azimuths.data},
      {"ndf", float32, {h, w}, table(content.ndf)}, {"sigma", float32, {h, w}, table(content.sigma)},
      {"vndf", float32, {p, n, h, w}, vndf.data},   {content.rgb_name, float32, {p, n, 3, h, w}, rgb.data},
      {"jacobian", uint8, {1}, jacobian.data}};
  std::uint64_t offset = 12 + 2 + 4;
  for (const Field& field : fields) offset += 2 + field.name.size() + 2 + 1 + 8 + 8 * field.shape.size();
  Bytes file;
  file.data.assign("tensor_file\0", 12);
  file.number(std::uint8_t{1}), file.number(std::uint8_t{0});
  file.number(static_cast<std::uint32_t>(fields.size()));
  for (const Field& field : fields) {
    file.number(static_cast<std::uint16_t>(field.name.size()));
    file.data += field.name;
    file.number(static_cast<std::uint16_t>(field.shape.size()));
    file.number(field.type);
    file.number(offset);
    for (const std::uint64_t length : field.shape) file.number(length);
    offset += field.data.size();
  }
  for (const Field& field : fields) file.data += field.data;
  return file.data;
}

inline std::string merl_bytes(const std::array<std::int32_t, 3>& counts,
                              const std::function<double(int channel, int h, int d, int p)>& entry) {
  Bytes file;
  for (const std::int32_t count : counts) file.number(count);
  for (int channel = 0; channel < 3; ++channel) {
    for (int h = 0; h < counts[0]; ++h) {
      for (int d = 0; d < counts[1]; ++d) {
        for (int p = 0; p < counts[2]; ++p) file.number(entry(channel, h, d, p));
      }
    }
  }
  return file.data;
}

/// A file that is gone when this is.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& bytes)
      : path_(std::filesystem::temp_directory_path() /
              ("albedo_" + std::to_string(std::hash<std::string>{}(bytes)) + name)) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace albedo::test
