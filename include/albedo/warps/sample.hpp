#pragma once

#include "albedo/core/direction.hpp"
#include "albedo/core/lobe.hpp"

namespace albedo {

/// What a warp makes of a point of the unit square.
template <class T>
struct Sample {
  DirectionPair<T> pair;
  T weight;  ///< cosθ_V |∂V/∂(u, v)|, so that w = f · weight
};

/// The axis A of a mirror lobe, of unit length; the normal where a lobe's weights leave nothing of L.
template <class T>
UnitVector<T> lobe_axis(const Lobe& lobe, const UnitVector<T>& l) {
  const UnitVector<T> a{T(lobe.axis_x) * l.x, T(lobe.axis_y) * l.y, T(lobe.axis_z) * l.z};
  const T length = sqrt(square(a.x) + square(a.y) + square(a.z));
  if (!(length > T(0))) return {T(0), T(0), T(1)};
  return {a.x / length, a.y / length, a.z / length};
}

/// Whether the integrand is symmetric about the plane of incidence, so that half a turn is enough.
inline bool mirror_symmetric(const Lobe& lobe, const Direction& l) {
  return lobe.width_x == lobe.width_y || l.sin_theta == 0 || l.sin_phi == 0 || l.cos_phi == 0;
}

template <class T>
UnitVector<T> broadcast(const UnitVector<Scalar<T>>& a) {
  return {T(a.x), T(a.y), T(a.z)};
}

}  // namespace albedo
