#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Ward's anisotropic model: f = ρ_d/π + ρ_s exp(−tan²θ_H (cos²φ_H/α_x² + sin²φ_H/α_y²)) / (4π α_x α_y √(N·L N·V))
/// [Ward 1992; Walter 2005, eq. 4; Neumann 1999, eq. 8 with m = α]
struct Ward {
  double alpha_x = 0.1, alpha_y = 0.1;
  double rho_s = 1, rho_d = 0;

  static ModelInfo info() {
    return {.name = "ward",
            .title = "Ward 1992, anisotropic",
            .source = "Walter 2005, eq. 4; Neumann 1999, eq. 8",
            .deviation = "none",
            .shorthands = {{"alpha", {"alpha_x", "alpha_y"}}, {"m", {"alpha_x", "alpha_y"}}}};
  }
  static std::vector<Parameter<Ward>> parameters() {
    return {number<Ward, &Ward::alpha_x>("alpha_x", roughness_range, "roughness along x"),
            number<Ward, &Ward::alpha_y>("alpha_y", roughness_range, "roughness along y"),
            reflectance<Ward, &Ward::rho_s>("rho_s", "scale of the specular lobe", scale_range),
            reflectance<Ward, &Ward::rho_d>("rho_d", "albedo of the Lambertian part")};
  }

  [[nodiscard]] Claims claims() const {
    return {.conserves_energy = rho_s == 0,
            .bounded = rho_s == 0,
            .isotropic = alpha_x == alpha_y,
            .distribution = Measure::projected};
  }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe specular = slope_lobe(0, Profile::gaussian, alpha_x, alpha_y);
    specular.weight = rho_s;
    specular.horizon_exponent = 0.5;
    return {specular, {.component = 1, .weight = rho_d}};
  }

  template <class T>
  T facet_distribution(const DirectionPair<T>& d) const noexcept {
    return albedo::beckmann(d, alpha_x, alpha_y);
  }

  template <class T>
  T evaluate(int component, const DirectionPair<T>& d) const noexcept {
    if (component == 1) return T(rho_d) / pi<T>;
    return T(rho_s) * exp(-scaled_slope2(d, alpha_x, alpha_y)) /
           (4 * pi<T> * T(alpha_x) * T(alpha_y) * sqrt(T(d.cos_theta_l * d.cos_theta_v)));
  }

  /// Ward's half vectors [Walter 2005, eqs. 6–9]; the Lambertian part: cosine-weighted.
  template <class T>
  Sampled<T> sample(int component, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    if (component == 1) return sample_cosine(l, u, v);
    return sample_beckmann(l, alpha_x, alpha_y, u, v);
  }
  template <class T>
  T density(int component, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    if (component == 1) return cosine_density(v);
    return beckmann_density(half_vector_pair(l, v), alpha_x, alpha_y);
  }
};

}  // namespace albedo
