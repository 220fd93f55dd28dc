#pragma once

#include "albedo/core/direction.hpp"
#include "albedo/core/special.hpp"

namespace albedo {

/// The V-cavity geometry factor G = min(1, 2 (N·H)(N·V)/(V·H), 2 (N·H)(N·L)/(L·H))   [Neumann 1999, eq. 10]
template <class T>
T v_cavity(const DirectionPair<T>& d) {
  return min(T(1), T(2 * d.cos_theta_h * min(d.cos_theta_l, d.cos_theta_v) / d.cos_theta_d));
}

/// The share of V-cavities' facets that L sees, G₁ = min(1, 2 (N·H)(N·L)/(L·H)), of which v_cavity() is the smaller one
template <class T>
T v_cavity_masking(const DirectionPair<T>& d) {
  return min(T(1), T(2 * d.cos_theta_h * d.cos_theta_l / d.cos_theta_d));
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

/// GGX's G₁(L) = 1/(1 + Λ(L)) = 2 N·L/(N·L + s_L)   [Heitz 2014, eqs. 43, 72]
template <class T>
T ggx_masking(const DirectionPair<T>& d, double alpha_x, double alpha_y) {
  return 2 * d.cos_theta_l / (d.cos_theta_l + stretched_length(d.l_x, d.l_y, d.cos_theta_l, alpha_x, alpha_y));
}

/// z Λ for Beckmann's slopes, Λ = (erf(a) − 1)/2 + e^(−a²)/(2a√π) with a = z/s, s = √((α_x x)² + (α_y y)²) [Heitz 2014,
/// eqs. 66, 80]; written as s e^(−a²) (1/√π − a e^(a²) erfc(a))/2, which needs no division by a cosine and no
/// difference of error functions.
template <class T>
T beckmann_shadow(const T& x, const T& y, const T& z, double alpha_x, double alpha_y) {
  const T s = sqrt(square(T(T(alpha_x) * x)) + square(T(T(alpha_y) * y)));
  const T a = min(T(z / s), T(12.0));  // beyond, z Λ < 1e-60 z
  return s * exp(-square(a)) * (1 / sqrt(pi<T>) - a * scaled_erfc(a)) / 2;
}

/// Beckmann's G₁(L) = 1/(1 + Λ(L))   [Heitz 2014, eqs. 43, 66]
template <class T>
T beckmann_masking(const DirectionPair<T>& d, double alpha_x, double alpha_y) {
  return d.cos_theta_l / (d.cos_theta_l + beckmann_shadow(d.l_x, d.l_y, d.cos_theta_l, alpha_x, alpha_y));
}

/// Beckmann's Smith masking over its denominator, G₂(L,V)/(4 N·L N·V), without dividing by a cosine: with e = z Λ,
///  - correlated: 1/(4(N·L N·V + N·V e_L + N·L e_V))   from G₂ = 1/(1 + Λ(L) + Λ(V))   [Heitz 2014, eq. 99]
///  - separable:  1/(4(N·L + e_L)(N·V + e_V))          from G₂ = 1/((1 + Λ(L))(1 + Λ(V)))   [Heitz 2014, eq. 98]
template <class T>
T beckmann_visibility(const DirectionPair<T>& d, double alpha_x, double alpha_y, SmithMasking masking) {
  const T e_l = beckmann_shadow(d.l_x, d.l_y, d.cos_theta_l, alpha_x, alpha_y);
  const T e_v = beckmann_shadow(d.v_x, d.v_y, d.cos_theta_v, alpha_x, alpha_y);
  if (masking == SmithMasking::correlated) {
    return 1 / (4 * (d.cos_theta_l * d.cos_theta_v + d.cos_theta_v * e_l + d.cos_theta_l * e_v));
  }
  return 1 / (4 * (d.cos_theta_l + e_l) * (d.cos_theta_v + e_v));
}

}  // namespace albedo
