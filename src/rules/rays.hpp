#pragma once

#include <vector>

#include "core/integrand.hpp"

namespace albedo {

/// A grid's values ray after ray: w[j * count_u + i] belongs to (u[i], v[j]).
class Rays {
 public:
  void evaluate(const Integrand<double>& integrand, int panel, const double* u, int count_u, const double* v,
                int count_v, double* w) {
    const auto width = static_cast<std::size_t>(count_u), height = static_cast<std::size_t>(count_v);
    side_by_side_.resize(width * height);
    integrand.grid(panel, u, count_u, v, count_v, side_by_side_.data());
    for (std::size_t j = 0; j < height; ++j) {
      for (std::size_t i = 0; i < width; ++i) *w++ = side_by_side_[i * height + j];
    }
  }

 private:
  std::vector<double> side_by_side_;
};

}  // namespace albedo
