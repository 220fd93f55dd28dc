#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/fresnel.hpp"
#include "albedo/microfacet/masking.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Beckmann microfacets with Smith masking (its exact Λ, not a fit), anisotropic: f = F D G₂ / (4 N·L N·V)
/// [Walter et al. 2007, eqs. 20, 25; Heitz 2014, eqs. 66, 80, 98 (separable), 99 (height-correlated)]
struct Beckmann {
  double alpha_x = 0.3, alpha_y = 0.3;
  SmithMasking masking = SmithMasking::correlated;
  Fresnel fresnel;

  static ModelInfo info() {
    return {.name = "beckmann",
            .title = "Beckmann, Smith masking",
            .source = "Walter et al. 2007, eqs. 20, 25; Heitz 2014, eqs. 66, 98, 99",
            .deviation = "none",
            .shorthands = {{"alpha", {"alpha_x", "alpha_y"}}, {"m", {"alpha_x", "alpha_y"}}}};
  }
  static std::vector<Parameter<Beckmann>> parameters() {
    using M = Beckmann;
    return with_fresnel<M>(
        {number<M, &M::alpha_x>("alpha_x", roughness_range, "roughness along x"),
         number<M, &M::alpha_y>("alpha_y", roughness_range, "roughness along y"),
         choice<M, &M::masking>("masking", {"correlated", "separable"}, "Smith masking–shadowing G₂")});
  }

  [[nodiscard]] Claims claims() const {
    return {.isotropic = alpha_x == alpha_y, .distribution = Measure::projected, .consistent_masking = true};
  }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe lobe = slope_lobe(0, Profile::gaussian, alpha_x, alpha_y);
    lobe.horizon_layer = true;
    lobe.growth = fresnel.growth();
    return {lobe};
  }

  template <class T>
  T facet_distribution(const DirectionPair<T>& d) const noexcept {
    return albedo::beckmann(d, alpha_x, alpha_y);
  }
  template <class T>
  T facet_masking(const DirectionPair<T>& d) const noexcept {
    return beckmann_masking(d, alpha_x, alpha_y);
  }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return fresnel(d.cos_theta_d) * albedo::beckmann(d, alpha_x, alpha_y) *
           beckmann_visibility(d, alpha_x, alpha_y, masking);
  }

  /// Half vectors of density D N·H   [Walter et al. 2007, eqs. 28, 29].
  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    return sample_beckmann(l, alpha_x, alpha_y, u, v);
  }
  template <class T>
  T density(int, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    return beckmann_density(half_vector_pair(l, v), alpha_x, alpha_y);
  }
};

}  // namespace albedo
