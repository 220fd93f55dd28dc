#pragma once

#include "albedo/core/direction.hpp"

namespace albedo {

/// The exponent of an anisotropic Gaussian of slopes: (tan²θ_H)(cos²φ_H/α_x² + sin²φ_H/α_y²).
template <class T>
T scaled_slope2(const DirectionPair<T>& d, double alpha_x, double alpha_y) {
  const Scalar<T> per_x = 1 / Scalar<T>(alpha_x), per_y = 1 / Scalar<T>(alpha_y);
  return square(T(d.slope_x * per_x)) + square(T(d.slope_y * per_y));
}

/// Beckmann's distribution, height-field normalised (∫D cosθ_h dω_h = 1): exp(−tan²…)/(π α_x α_y cos⁴θ_H)   [Kurt 2010,
/// eq. 5]
template <class T>
T beckmann(const DirectionPair<T>& d, double alpha_x, double alpha_y) {
  return exp(-scaled_slope2(d, alpha_x, alpha_y)) / (pi<T> * T(alpha_x) * T(alpha_y) * square(square(d.cos_theta_h)));
}

/// GGX (Trowbridge–Reitz), height-field normalised: 1/(π α_x α_y cos⁴θ_H (1 + tan²…)²)   [Walter et al. 2007, eq. 33;
/// Heitz 2014]
template <class T>
T ggx_distribution(const DirectionPair<T>& d, double alpha_x, double alpha_y) {
  const T t = square(d.cos_theta_h) * (1 + scaled_slope2(d, alpha_x, alpha_y));
  return 1 / (pi<T> * T(alpha_x) * T(alpha_y) * square(t));
}

/// (N·H)^n. Written with tan²θ_H so that exponents of a million keep their digits.
template <class T>
T cos_theta_h_power(const DirectionPair<T>& d, double n) {
  return exp(T(-n / 2) * log1p(tan2_theta_h(d)));
}

/// (A·V)₊^n around a mirror lobe's axis; 0 behind it, for n = 0 too.
template <class T>
T axis_power(const DirectionPair<T>& d, double n) {
  return select(d.axis_gap < T(1), T(exp(T(n) * log1p(-d.axis_gap))), T(0));
}

}  // namespace albedo
