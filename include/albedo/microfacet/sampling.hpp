#pragma once

#include "albedo/core/sampled.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/masking.hpp"

/// The samplers that models share: V from two numbers u, v in (0, 1), and the density of any given V. None of them has
/// a branch, so that they run on blocks.
namespace albedo {

// --- around the normal: cosine-weighted, for diffuse lobes ---

/// cosθ_V/π, 0 below the horizon.
template <class T>
T cosine_density(const UnitVector<T>& v) {
  return max(v.z, T(0)) / pi<T>;
}

/// sin²θ_V = u, φ_V = 2πv.
template <class T>
Sampled<T> sample_cosine(const UnitVector<T>& l, const T& u, const T& v) {
  using std::cos;
  using std::sin;
  const T sine = sqrt(u), phi = 2 * pi<T> * v;
  const UnitVector<T> viewer{sine * cos(phi), sine * sin(phi), sqrt(T(1 - u))};
  const UnitVector<T> mirror{-l.x, -l.y, l.z};
  return {direction_pair(l, viewer, mirror), cosine_density(viewer)};
}

// --- around an axis A: (n+1)/(2π) (A·V)₊^n ---

/// A = (a_x L_x, a_y L_y, a_z L_z) normalised, the normal where that is zero; (−1, −1, 1) is the mirror direction.
template <class T>
UnitVector<T> sampling_axis(const UnitVector<T>& l, double a_x, double a_y, double a_z) {
  const UnitVector<T> a{T(a_x) * l.x, T(a_y) * l.y, T(a_z) * l.z};
  const T length = sqrt(square(a.x) + square(a.y) + square(a.z));
  const auto exists = length > T(0);
  const T inverse = 1 / select(exists, length, T(1));
  return {a.x * inverse, a.y * inverse, select(exists, T(a.z * inverse), T(1))};
}

/// The density of V for 1 − A·V.
template <class T>
T axis_density(const T& axis_gap, double n) {
  return select(axis_gap < T(1), T(T(n + 1) / (2 * pi<T>)*exp(T(n) * log1p(-min(axis_gap, T(1))))), T(0));
}
template <class T>
T axis_density(const UnitVector<T>& axis, double n, const UnitVector<T>& v) {
  return axis_density(gap(axis, v), n);
}

/// A·V = (1 − u)^(1/(n+1)), at azimuth 2πv about A.
template <class T>
Sampled<T> sample_axis(const UnitVector<T>& l, const UnitVector<T>& axis, double n, const T& u, const T& v) {
  using std::cos;
  using std::sin;
  const T gap_v = -expm1(T(log1p(-u) / T(n + 1)));
  const T cosine = 1 - gap_v, sine = sqrt(T(gap_v * (2 - gap_v)));
  const T planar = sqrt(square(axis.x) + square(axis.y));
  const auto tilted = planar > T(0);
  const T inverse = 1 / select(tilted, planar, T(1));
  const T cos_a = select(tilted, T(axis.x * inverse), T(1)), sin_a = axis.y * inverse;
  const T phi = 2 * pi<T> * v;
  const T up = sine * cos(phi), side = sine * sin(phi);
  const UnitVector<T> viewer{axis.x * cosine - axis.z * cos_a * up - sin_a * side,
                             axis.y * cosine - axis.z * sin_a * up + cos_a * side, axis.z * cosine + planar * up};
  DirectionPair<T> pair = direction_pair(l, viewer, axis);
  pair.axis_gap = gap_v;
  return {pair, axis_density(gap_v, n)};
}

// --- around half vectors: V = 2(L·H)H − L, density p_H(H)/(4 |L·H|) ---

/// The pair of L and the V that a facet of the given slopes mirrors it into. V − R, with R the mirror direction, and
/// cosθ_V follow from the slopes without cancellation; L·H may be negative, V is below the horizon then.
template <class T>
DirectionPair<T> reflected(const UnitVector<T>& l, const T& slope_x, const T& slope_y) {
  const T tan2 = square(slope_x) + square(slope_y);
  const T cos2 = 1 / (1 + tan2);
  const T cos_h = sqrt(cos2);
  const T along = l.x * slope_x + l.y * slope_y;
  const T facing = l.z + along;  // L·H / N·H
  const T d_x = 2 * cos2 * facing * slope_x, d_y = 2 * cos2 * facing * slope_y;
  const T d_z = 2 * cos2 * (along - l.z * tan2);
  const T cos_v = cos2 * (l.z * (1 - tan2) + 2 * along);
  return {l.z,
          cos_v,
          l.x,
          l.y,
          d_x - l.x,
          d_y - l.y,
          T(abs(T(cos_h * facing))),
          cos_h,
          slope_x,
          slope_y,
          (square(d_x) + square(d_y) + square(d_z)) / 2};
}

/// The pair of L and any V, of which slopes, N·H and |L·H| are asked: H is the one of the two half vectors ±(L + V)
/// that is above the surface.
template <class T>
DirectionPair<T> half_vector_pair(const UnitVector<T>& l, const UnitVector<T>& v) {
  DirectionPair<T> pair = direction_pair(l, v, UnitVector<T>{-l.x, -l.y, l.z});
  pair.cos_theta_h = abs(pair.cos_theta_h);
  return pair;
}

/// Beckmann's half vectors, p_H = D cosθ_H: exp(−tan²θ_H(…))/(4π α_x α_y L·H cos³θ_H)   [Walter 2005, eq. 9; Kurt et
/// al. 2010, eq. 20]
template <class T>
T beckmann_density(const DirectionPair<T>& d, double alpha_x, double alpha_y) {
  return beckmann(d, alpha_x, alpha_y) * d.cos_theta_h / (4 * d.cos_theta_d);
}

/// [Walter 2005, eqs. 6–8; Kurt et al. 2010, eqs. 16–19] with 1 − u for u, so that u = 0 is H = N. Their arctangents in
/// the right quadrant are (cosφ_H, sinφ_H) ∝ (α_x cos2πv, α_y sin2πv), which makes the slopes √(−ln(1−u)) times that.
template <class T>
Sampled<T> sample_beckmann(const UnitVector<T>& l, double alpha_x, double alpha_y, const T& u, const T& v) {
  using std::cos;
  using std::sin;
  const T r = sqrt(-log1p(-u)), phi = 2 * pi<T> * v;
  const DirectionPair<T> pair = reflected(l, T(T(alpha_x) * r * cos(phi)), T(T(alpha_y) * r * sin(phi)));
  return {pair, beckmann_density(pair, alpha_x, alpha_y)};
}

/// p_H = √((n_u+1)(n_v+1))/(2π) (N·H)^(n_u cos²φ_H + n_v sin²φ_H)   [Ashikhmin & Shirley 2000, eqs. 5, 18]
template <class T>
T power_density(const DirectionPair<T>& d, double n_u, double n_v) {
  const T tan2 = max(tan2_theta_h(d), T(1e-30));
  const T exponent = (T(n_u) * square(d.slope_x) + T(n_v) * square(d.slope_y)) / tan2;
  return T(std::sqrt((n_u + 1) * (n_v + 1))) / (8 * pi<T>)*exp(-exponent * log1p(tan2) / 2) / d.cos_theta_d;
}

/// [Ashikhmin & Shirley 2000, eqs. 17, 19, 20], all four quadrants at once: (cosφ_H, sinφ_H) = (cos2πv/√(n_u+1),
/// sin2πv/√(n_v+1))/ρ, whose eq. 20 is cosθ_H = (1 − u)^(ρ²).
template <class T>
Sampled<T> sample_power(const UnitVector<T>& l, double n_u, double n_v, const T& u, const T& v) {
  using std::cos;
  using std::sin;
  const T phi = 2 * pi<T> * v;
  const T x = cos(phi) / sqrt(T(n_u + 1)), y = sin(phi) / sqrt(T(n_v + 1));
  const T rho2 = square(x) + square(y);
  const T per_rho = sqrt(expm1(T(-2 * rho2 * log1p(-u))) / rho2);  // tanθ_H/ρ
  const DirectionPair<T> pair = reflected(l, T(x * per_rho), T(y * per_rho));
  return {pair, power_density(pair, n_u, n_v)};
}

/// GGX's half vectors, p_H = D cosθ_H.
template <class T>
T ggx_density(const DirectionPair<T>& d, double alpha_x, double alpha_y) {
  return ggx_distribution(d, alpha_x, alpha_y) * d.cos_theta_h / (4 * d.cos_theta_d);
}

/// tan²θ_H(cos²φ_H/α_x² + sin²φ_H/α_y²) = u/(1 − u)   [Walter et al. 2007, eqs. 35, 36]
template <class T>
Sampled<T> sample_ggx(const UnitVector<T>& l, double alpha_x, double alpha_y, const T& u, const T& v) {
  using std::cos;
  using std::sin;
  const T r = sqrt(u / (1 - u)), phi = 2 * pi<T> * v;
  const DirectionPair<T> pair = reflected(l, T(T(alpha_x) * r * cos(phi)), T(T(alpha_y) * r * sin(phi)));
  return {pair, ggx_density(pair, alpha_x, alpha_y)};
}

/// GGX's visible half vectors, p_H = G₁(L) (L·H)₊ D/(N·L): the density of V is D/(2(N·L + s_L)), s_L the stretched
/// length of L   [Heitz 2018]
template <class T>
T ggx_visible_density(const DirectionPair<T>& d, double alpha_x, double alpha_y) {
  const T s_l = stretched_length(d.l_x, d.l_y, d.cos_theta_l, alpha_x, alpha_y);
  return ggx_distribution(d, alpha_x, alpha_y) / (2 * (d.cos_theta_l + s_l));
}

/// The visible normal of a hemisphere seen from the stretched L, stretched back   [Heitz 2018]; u = r² on the disk,
/// v its azimuth.
template <class T>
Sampled<T> sample_ggx_visible(const UnitVector<T>& l, double alpha_x, double alpha_y, const T& u, const T& v) {
  using std::cos;
  using std::sin;
  const T s_l = stretched_length(l.x, l.y, l.z, alpha_x, alpha_y);
  const UnitVector<T> e{T(alpha_x) * l.x / s_l, T(alpha_y) * l.y / s_l, l.z / s_l};
  const T planar = sqrt(square(e.x) + square(e.y));
  const auto tilted = planar > T(0);
  const T inverse = 1 / select(tilted, planar, T(1));
  const UnitVector<T> side{-e.y * inverse, select(tilted, T(e.x * inverse), T(1)), T(0)};
  const UnitVector<T> up{-e.z * side.y, e.z * side.x, e.x * side.y - e.y * side.x};
  const T r = sqrt(u), phi = 2 * pi<T> * v, share = (1 + e.z) / 2;
  const T a = r * cos(phi), rest = 1 - square(a);
  const T b = (1 - share) * sqrt(rest) + share * r * sin(phi);
  const T c = sqrt(max(T(rest - square(b)), T(0)));
  const T z = max(T(b * up.z + c * e.z), T(1e-30));  // 0 by rounding at the rim
  const DirectionPair<T> pair = reflected(l, T(T(alpha_x) * (a * side.x + b * up.x + c * e.x) / z),
                                          T(T(alpha_y) * (a * side.y + b * up.y + c * e.y) / z));
  return {pair, ggx_visible_density(pair, alpha_x, alpha_y)};
}

}  // namespace albedo
