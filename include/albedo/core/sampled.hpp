#pragma once

#include <limits>

#include "albedo/core/direction.hpp"

namespace albedo {

/// A direction V that a lobe's own sampling has drawn for a given L.
template <class T>
struct Sampled {
  DirectionPair<T> pair;  ///< of L and V, with what the sampler knows without cancellation; V may be below the horizon
  T density;              ///< with which such a V is drawn [1/sr]; ∫ density dω_V = 1 over the whole sphere

  [[nodiscard]] UnitVector<T> viewer() const { return {pair.v_x, pair.v_y, pair.cos_theta_v}; }

  /// What a lobe without a sampler gives.
  static Sampled none() {
    const T nan(std::numeric_limits<Scalar<T>>::quiet_NaN());
    return {{nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan}, nan};
  }
};

}  // namespace albedo
