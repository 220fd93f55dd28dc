#pragma once

#include "albedo/core/number.hpp"

namespace albedo {

/// A direction above the surface, in the surface's frame: N = z, azimuth from the x axis (the axis of α_x, m_x, n_u,
/// c_x).
///
/// The cosine and the sine of the polar angle are both kept, so that neither grazing nor normal incidence loses digits.
struct Direction {
  double cos_theta = 1;
  double sin_theta = 0;
  double cos_phi = 1;
  double sin_phi = 0;

  /// From angles in degrees; exact at multiples of 90°.
  /// @throws ParameterError unless 0 ≤ theta ≤ 90 and phi is finite.
  static Direction from_degrees(double theta, double phi = 0);

  /// From cosθ and the azimuth in degrees.
  /// @throws ParameterError unless 0 ≤ cos_theta ≤ 1 and phi is finite.
  static Direction from_cosine(double cos_theta, double phi = 0);

  [[nodiscard]] double theta_degrees() const;
};

/// A Direction's components in the number type of a computation, normalised in that type.
template <class T>
struct UnitVector {
  T x, y, z;
};

/// cosθ and sinθ in type T. The smaller one is taken as given and the other follows, so that they are normalised in T's
/// own precision.
template <class T>
void polar_angle(const Direction& direction, T& cos_theta, T& sin_theta) {
  using std::sqrt;
  cos_theta = T(direction.cos_theta);
  sin_theta = T(direction.sin_theta);
  if (direction.cos_theta < direction.sin_theta) {
    sin_theta = sqrt((1 - cos_theta) * (1 + cos_theta));
  } else {
    cos_theta = sqrt((1 - sin_theta) * (1 + sin_theta));
  }
}

/// The azimuth's cosine and sine in type T, normalised like the polar angle's.
template <class T>
void azimuth(const Direction& direction, T& cos_phi, T& sin_phi) {
  using std::abs;
  using std::sqrt;
  cos_phi = T(direction.cos_phi);
  sin_phi = T(direction.sin_phi);
  if (std::abs(direction.cos_phi) < std::abs(direction.sin_phi)) {
    const T s = sqrt((1 - cos_phi) * (1 + cos_phi));
    sin_phi = direction.sin_phi < 0 ? T(-s) : s;
  } else {
    const T c = sqrt((1 - sin_phi) * (1 + sin_phi));
    cos_phi = direction.cos_phi < 0 ? T(-c) : c;
  }
}

template <class T>
UnitVector<T> unit_vector(const Direction& direction) {
  T c, s, cp, sp;
  polar_angle(direction, c, s);
  azimuth(direction, cp, sp);
  return {s * cp, s * sp, c};
}

/// What a reflectance formula may depend on: the invariants of a pair of directions L (light) and V (viewer), H their
/// half vector.
///
/// A warp fills them from its own coordinates and never by subtracting nearly equal numbers, so that tanθ_H keeps its
/// digits at roughness 1e-4 and cosθ_V keeps them at the horizon.
template <class T>
struct DirectionPair {
  T cos_theta_l;  ///< N·L
  T cos_theta_v;  ///< N·V
  T l_x, l_y;     ///< tangential components of L
  T v_x, v_y;     ///< tangential components of V
  T cos_theta_d;  ///< L·H = V·H = |L+V|/2
  T cos_theta_h;  ///< N·H
  T slope_x;      ///< H_x/H_z: the slopes of the facet that mirrors L into V, tan²θ_H = slope_x² + slope_y²
  T slope_y;      ///< H_y/H_z
  T axis_gap;     ///< 1 − A·V, where A is the lobe's axis: the mirror direction R unless the model says otherwise
};

/// tan²θ_H
template <class T>
T tan2_theta_h(const DirectionPair<T>& d) {
  return square(d.slope_x) + square(d.slope_y);
}

/// The same pair with L and V exchanged, for reciprocity; the gap is that of the mirror direction, which is symmetric.
template <class T>
DirectionPair<T> exchanged(const DirectionPair<T>& d) {
  return {d.cos_theta_v, d.cos_theta_l, d.v_x,     d.v_y,     d.l_x,     d.l_y,
          d.cos_theta_d, d.cos_theta_h, d.slope_x, d.slope_y, d.axis_gap};
}

/// 1 − A·V = |A − V|²/2 for unit vectors: small gaps keep their digits.
template <class T>
T gap(const UnitVector<T>& a, const UnitVector<T>& v) {
  return (square(a.x - v.x) + square(a.y - v.y) + square(a.z - v.z)) / 2;
}

/// The pair of L and V from their components; `axis` is the lobe's axis A.
template <class T>
DirectionPair<T> direction_pair(const UnitVector<T>& l, const UnitVector<T>& v, const UnitVector<T>& axis) {
  const UnitVector<T> sum{l.x + v.x, l.y + v.y, l.z + v.z};
  const T length = sqrt(square(sum.x) + square(sum.y) + square(sum.z));
  return {l.z, v.z, l.x, l.y, v.x, v.y, length / 2, sum.z / length, sum.x / sum.z, sum.y / sum.z, gap(axis, v)};
}

}  // namespace albedo
