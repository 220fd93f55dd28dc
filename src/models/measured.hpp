#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "albedo/models/measured.hpp"

namespace albedo {

/// A file's bytes, and what to say where they are wrong.
struct MeasuredFile {
  std::string path;
  std::vector<unsigned char> bytes;

  [[noreturn]] void refuse(const std::string& why) const;
};

inline constexpr std::size_t tensor_magic_size = 12;
inline constexpr const char* tensor_magic = "tensor_file";  // with its 0

std::shared_ptr<const MeasuredTable> read_rgl(const MeasuredFile& file, int channel, bool negative_as_zero);
std::shared_ptr<const MeasuredTable> read_merl(const MeasuredFile& file, int channel);

/// A place between two entries of a table.
struct Between {
  std::size_t index;  // of the first of the two
  double share;       // of the second
};

/// The place x in [0, 1] among `count` entries at 0, 1/(count − 1), …, 1.
Between between(double x, std::size_t count);

/// θ_H and the half vector's azimuth from that of L, in (−π, π].
struct HalfAngles {
  double theta, phi;
};
HalfAngles half_angles(const DirectionPair<double>& pair);

/// The polar angle of L.
double theta_of_light(const DirectionPair<double>& pair);

}  // namespace albedo
