/// @file
/// What is compared: materials × angles × target errors.
#pragma once

#include <vector>

#include "peers/plane.hpp"

namespace albedo::peers {

struct Battery {
  std::vector<Material> materials;
  std::vector<double> thetas;   ///< of L, in degrees
  std::vector<double> targets;  ///< relative errors
};

inline Battery whole_battery() {
  return {{{"ward", "m", 0.01},
           {"ward", "m", 0.1},
           {"ward", "m", 0.3},
           {"ward", "m", 1},
           {"cook_torrance", "m", 0.1},
           {"cook_torrance", "m", 0.3},
           {"ashikhmin_shirley", "n", 10},
           {"ashikhmin_shirley", "n", 1000},
           {"phong", "n", 20},
           {"phong", "n", 1000},
           {"ggx", "alpha", 0.1},
           {"ggx", "alpha", 0.5}},
          {0, 30, 60, 80, 85, 89, 89.9},
          {1e-4, 1e-6, 1e-8, 1e-10}};
}

/// One material a model, three angles.
inline Battery quick_battery() {
  return {{{"ward", "m", 0.1},
           {"cook_torrance", "m", 0.3},
           {"ashikhmin_shirley", "n", 1000},
           {"phong", "n", 20},
           {"ggx", "alpha", 0.1}},
          {0, 60, 89},
          {1e-4, 1e-6, 1e-8, 1e-10}};
}

}  // namespace albedo::peers
