#pragma once

#include "albedo/core/direction.hpp"
#include "albedo/core/lobe.hpp"

namespace albedo {

/// A lobe's axis A, of unit length; the normal where a lobe's weights leave nothing of L.
template <class T>
UnitVector<T> lobe_axis(const Lobe& lobe, const UnitVector<T>& l) {
  const auto [x, y, z] = lobe.axis();
  const UnitVector<T> a{T(x) * l.x, T(y) * l.y, T(z) * l.z};
  const T length = sqrt(square(a.x) + square(a.y) + square(a.z));
  if (!(length > T(0))) return {T(0), T(0), T(1)};
  return {a.x / length, a.y / length, a.z / length};
}

}  // namespace albedo
