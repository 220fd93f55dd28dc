#pragma once

#include "albedo/core/direction.hpp"

namespace albedo {

/// The V-cavity geometry factor G = min(1, 2 (N·H)(N·V)/(V·H), 2 (N·H)(N·L)/(L·H))   [Neumann 1999, eq. 10]
template <class T>
T v_cavity(const DirectionPair<T>& d) {
  return min(T(1), T(2 * d.cos_theta_h * min(d.cos_theta_l, d.cos_theta_v) / d.cos_theta_d));
}

/// √(z² + (α_x x)² + (α_y y)²), the length of a direction stretched by GGX's roughness: Λ = (stretched/z − 1)/2 [Heitz
/// 2014, eqs. 72, 86]
template <class T>
T stretched_length(const T& x, const T& y, const T& z, double alpha_x, double alpha_y) {
  return sqrt(square(z) + square(T(T(alpha_x) * x)) + square(T(T(alpha_y) * y)));
}

enum class SmithMasking { correlated, separable };

/// GGX's Smith masking over its denominator, G₂(L,V)/(4 N·L N·V), without dividing by a cosine:
///  - correlated: 1/(2(N·V s_L + N·L s_V))   from G₂ = 1/(1 + Λ(L) + Λ(V))   [Heitz 2014, eq. 99]
///  - separable:  1/((N·L + s_L)(N·V + s_V)) from G₂ = 1/((1 + Λ(L))(1 + Λ(V)))   [Heitz 2014, eq. 98]
/// with s the stretched length of L and V.
template <class T>
T ggx_visibility(const DirectionPair<T>& d, double alpha_x, double alpha_y, SmithMasking masking) {
  const T s_l = stretched_length(d.l_x, d.l_y, d.cos_theta_l, alpha_x, alpha_y);
  const T s_v = stretched_length(d.v_x, d.v_y, d.cos_theta_v, alpha_x, alpha_y);
  if (masking == SmithMasking::correlated) return 1 / (2 * (d.cos_theta_v * s_l + d.cos_theta_l * s_v));
  return 1 / ((d.cos_theta_l + s_l) * (d.cos_theta_v + s_v));
}

}  // namespace albedo
