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

/// The area of GGX's facets as seen from K = (x, y, z), ∫ D (H·K)₊ dω_H = N·K (1 + Λ(K))
template <class T>
T ggx_area(const T& x, const T& y, const T& z, double alpha_x, double alpha_y) {
  return (z + stretched_length(x, y, z, alpha_x, alpha_y)) / 2;
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

/// The area of Beckmann's facets as seen from K = (x, y, z), ∫ D (H·K)₊ dω_H = N·K (1 + Λ(K))
template <class T>
T beckmann_area(const T& x, const T& y, const T& z, double alpha_x, double alpha_y) {
  return z + beckmann_shadow(x, y, z, alpha_x, alpha_y);
}

}  // namespace albedo
