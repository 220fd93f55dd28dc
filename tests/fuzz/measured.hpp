/// @file
/// The readers of measured materials: what is accepted answers with a number wherever it is asked.
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include "albedo/core/direction.hpp"
#include "albedo/core/errors.hpp"
#include "albedo/models/measured.hpp"
#include "fuzz/files.hpp"
#include "fuzz/fuzz.hpp"

namespace albedo::fuzz {

inline void read_measured_file(std::string_view bytes) {
  static const Directory directory;
  const std::string path = directory.write("measured", bytes);
  for (const bool negative_as_zero : {false, true}) {
    accepts<FormatError>([&] {
      const auto table = read_measured(path, negative_as_zero ? 2 : 0, negative_as_zero);
      for (const double theta_l : {0.0, 37.0, 89.999}) {
        for (const double theta_v : {0.0, 37.0, 90.0}) {
          for (const double phi : {0.0, 100.0, 180.0, 275.0}) {
            const auto l = unit_vector<double>(Direction::from_degrees(theta_l));
            const auto v = unit_vector<double>(Direction::from_degrees(theta_v, phi));
            const auto pair = direction_pair(l, v, UnitVector<double>{-l.x, -l.y, l.z});
            const double value = table->evaluate(pair);
            require(!std::isnan(value), "a material that isn't a number");
          }
        }
      }
    });
  }
}

}  // namespace albedo::fuzz
