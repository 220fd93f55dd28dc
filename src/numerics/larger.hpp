#pragma once

#include <cmath>

namespace albedo {

/// Raises `largest` to the candidate; NaN, of either, stays.
inline void keep_larger(double& largest, double candidate) {
  if (!std::isnan(largest) && !(candidate <= largest)) largest = candidate;
}

}  // namespace albedo
