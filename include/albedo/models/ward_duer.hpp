#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Dür's variant of Ward's model: f = ρ_d/π + ρ_s exp(−tan²θ_H (cos²φ_H/α_x² + sin²φ_H/α_y²)) / (4π α_x α_y N·L N·V)
/// [Dür 2006; Kurt et al. 2010, §2]. Its albedo diverges at grazing incidence like (N·L)^−1, faster than Ward's own.
struct WardDuer {
  double alpha_x = 0.1, alpha_y = 0.1;
  double rho_s = 1, rho_d = 0;

  static ModelInfo info() {
    return {.name = "ward_duer",
            .title = "Ward–Dür 2006",
            .source = "Dür 2006 (J. Graphics Tools 11(1)): Ward 1992 with √(N·L N·V) replaced by N·L N·V",
            .deviation = "none known; the paper's text was not available, the form is that of public code",
            .shorthands = {{"alpha", {"alpha_x", "alpha_y"}}, {"m", {"alpha_x", "alpha_y"}}}};
  }
  static std::vector<Parameter<WardDuer>> parameters() {
    using M = WardDuer;
    return {number<M, &M::alpha_x>("alpha_x", roughness_range, "roughness along x"),
            number<M, &M::alpha_y>("alpha_y", roughness_range, "roughness along y"),
            reflectance<M, &M::rho_s>("rho_s", "scale of the specular lobe", scale_range),
            reflectance<M, &M::rho_d>("rho_d", "albedo of the Lambertian part")};
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
    specular.horizon_exponent = 0;
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
           (4 * pi<T> * T(alpha_x) * T(alpha_y) * d.cos_theta_l * d.cos_theta_v);
  }

  /// Ward's half vectors, of weight ρ_s L·H (N·H)³/N·L; the Lambertian part: cosine-weighted.
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
