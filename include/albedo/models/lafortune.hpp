#pragma once

#include <algorithm>
#include <limits>

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Lafortune's generalised cosine lobe: f = ρ (n+2)/(2π C^n) (c_x L_x V_x + c_y L_y V_y + c_z L_z V_z)₊^n, C = max|c|
/// [Lafortune et al. 1997; Neumann 1999, eq. 7; normalised as in Ngan et al. 2005]
///
/// The lobe's axis is A = (c_x L_x, c_y L_y, c_z L_z), not of unit length; mirror Phong is c = (−1, −1, 1).
struct Lafortune {
  double c_x = -1, c_y = -1, c_z = 1;
  double n = 20;
  double rho = 1;

  static ModelInfo info() {
    return {.name = "lafortune",
            .title = "Lafortune's generalised cosine lobe",
            .source = "Lafortune, Foo, Torrance, Greenberg 1997; Neumann 1999, eq. 7",
            .deviation = "one lobe, normalised by (n+2)/(2π max|c|^n) as in Ngan et al. 2005, which bounds a(L) by 1"};
  }
  static std::vector<Parameter<Lafortune>> parameters() {
    return {number<Lafortune, &Lafortune::c_x>("c_x", {-10, 10}, "weight of L_x V_x"),
            number<Lafortune, &Lafortune::c_y>("c_y", {-10, 10}, "weight of L_y V_y"),
            number<Lafortune, &Lafortune::c_z>("c_z", {-10, 10}, "weight of L_z V_z"),
            number<Lafortune, &Lafortune::n>("n", exponent_range, "exponent"),
            reflectance<Lafortune, &Lafortune::rho>("rho", "scale", scale_range)};
  }

  [[nodiscard]] double largest() const { return std::max({std::abs(c_x), std::abs(c_y), std::abs(c_z)}); }

  [[nodiscard]] Claims claims() const { return {.conserves_energy = rho <= 1, .isotropic = c_x == c_y}; }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe lobe = mirror_lobe(0, n, {c_x, c_y, c_z});
    lobe.weight = largest() > 0 ? rho : 0;
    return {lobe};
  }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    const double c = largest();
    // |A|² − C², relative to C², without cancellation: 0 for mirror Phong at any direction
    const T shortfall = T((c_x - c) * (c_x + c) / (c * c)) * square(d.l_x) +
                        T((c_y - c) * (c_y + c) / (c * c)) * square(d.l_y) +
                        T((c_z - c) * (c_z + c) / (c * c)) * square(d.cos_theta_l);
    // where little is left of |A|², it is a sum without cancellation itself
    const T left =
        square(T(T(c_x / c) * d.l_x)) + square(T(T(c_y / c) * d.l_y)) + square(T(T(c_z / c) * d.cos_theta_l));
    const T half(-0.5), tiny(std::numeric_limits<Scalar<T>>::min());
    const T log_length2 = select(shortfall > half, log1p(max(shortfall, half)), log(max(left, tiny)));
    return T(rho * (n + 2)) / (2 * pi<T>)*axis_power(d, n) * exp(T(n / 2) * log_length2);
  }

  /// Directions of density (n+1)/(2π) (A·V)₊^n about the normalised axis.
  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    return sample_axis(l, sampling_axis(l, c_x, c_y, c_z), n, u, v);
  }
  template <class T>
  T density(int, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    return axis_density(sampling_axis(l, c_x, c_y, c_z), n, v);
  }
};

}  // namespace albedo
