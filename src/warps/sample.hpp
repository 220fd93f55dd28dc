#pragma once

#include "albedo/core/direction.hpp"
#include "albedo/core/lobe.hpp"
#include "core/lobe_axis.hpp"

namespace albedo {

/// What a warp makes of a point of the unit square.
template <class T>
struct Sample {
  DirectionPair<T> pair;
  T weight;  ///< cosθ_V |∂V/∂(u, v)|, so that w = f · weight
};

/// Whether the integrand is symmetric about the plane of incidence, so that half a turn is enough.
inline bool mirror_symmetric(const Lobe& lobe, const Direction& l) {
  const auto [narrow, wide] = lobe.widths();
  return narrow == wide || l.sin_theta == 0 || l.sin_phi == 0 || l.cos_phi == 0;
}

template <class T>
UnitVector<T> broadcast(const UnitVector<Scalar<T>>& a) {
  return {T(a.x), T(a.y), T(a.z)};
}

}  // namespace albedo
