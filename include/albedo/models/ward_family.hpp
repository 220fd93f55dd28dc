#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Ward's model and its variants: f = ρ_d/π + ρ_s times a lobe of Beckmann's half vectors.
///
/// A Variant is the model's info, the lobe's formula `specular(model, pair)` with ρ_s in it, its power of N·V at the
/// horizon, and whether its albedo is at most ρ_s.
template <class Variant>
struct WardFamily {
  double alpha_x = 0.1, alpha_y = 0.1;
  double rho_s = 1, rho_d = 0;

  static ModelInfo info() {
    ModelInfo info = Variant::info();
    info.shorthands = {{"alpha", {"alpha_x", "alpha_y"}}, {"m", {"alpha_x", "alpha_y"}}};
    return info;
  }
  static std::vector<Parameter<WardFamily>> parameters() {
    using M = WardFamily;
    return {number<M, &M::alpha_x>("alpha_x", roughness_range, "roughness along x"),
            number<M, &M::alpha_y>("alpha_y", roughness_range, "roughness along y"),
            reflectance<M, &M::rho_s>("rho_s", "scale of the specular lobe", scale_range),
            reflectance<M, &M::rho_d>("rho_d", "albedo of the Lambertian part")};
  }

  [[nodiscard]] Claims claims() const {
    return {.conserves_energy = Variant::is_bounded ? rho_s + rho_d <= 1 : rho_s == 0,
            .bounded = Variant::is_bounded || rho_s == 0,
            .isotropic = alpha_x == alpha_y,
            .distribution = Measure::projected};
  }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe specular = slope_lobe(0, Profile::gaussian, alpha_x, alpha_y);
    specular.weight = rho_s;
    specular.horizon_exponent = Variant::horizon_exponent;
    return {specular, {.component = 1, .weight = rho_d}};
  }

  template <class T>
  T facet_distribution(const DirectionPair<T>& d) const noexcept {
    return beckmann(d, alpha_x, alpha_y);
  }

  template <class T>
  T evaluate(int component, const DirectionPair<T>& d) const noexcept {
    if (component == 1) return T(rho_d) / pi<T>;
    return Variant::specular(*this, d);
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
