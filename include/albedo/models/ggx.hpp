#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/fresnel.hpp"
#include "albedo/microfacet/masking.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// GGX microfacets with Smith masking, anisotropic: f = F D G₂ / (4 N·L N·V)
/// [Walter et al. 2007, eqs. 20, 33; Heitz 2014, eqs. 72, 85, 86, 98 (separable), 99 (height-correlated)]
struct Ggx {
  double alpha_x = 0.3, alpha_y = 0.3;
  SmithMasking masking = SmithMasking::correlated;
  Fresnel fresnel;

  static ModelInfo info() {
    return {.name = "ggx",
            .title = "GGX, Smith masking",
            .source = "Walter et al. 2007, eqs. 20, 33; Heitz 2014, eqs. 85, 98, 99",
            .deviation = "none",
            .shorthands = {{"alpha", {"alpha_x", "alpha_y"}}}};
  }
  static std::vector<Parameter<Ggx>> parameters() {
    using M = Ggx;
    return with_fresnel<M>(
        {number<M, &M::alpha_x>("alpha_x", roughness_range, "roughness along x"),
         number<M, &M::alpha_y>("alpha_y", roughness_range, "roughness along y"),
         choice<M, &M::masking>("masking", {"correlated", "separable"}, "Smith masking–shadowing G₂")});
  }

  [[nodiscard]] Claims claims() const {
    return {.isotropic = alpha_x == alpha_y, .distribution = Measure::projected, .consistent_masking = true};
  }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe lobe = slope_lobe(0, Profile::ggx, alpha_x, alpha_y);
    lobe.horizon_layer = true;
    return {lobe};
  }

  template <class T>
  T facet_distribution(const DirectionPair<T>& d) const noexcept {
    return ggx_distribution(d, alpha_x, alpha_y);
  }
  template <class T>
  T facet_masking(const DirectionPair<T>& d) const noexcept {
    return ggx_masking(d, alpha_x, alpha_y);
  }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return fresnel(d.cos_theta_d) * ggx_distribution(d, alpha_x, alpha_y) *
           ggx_visibility(d, alpha_x, alpha_y, masking);
  }

  /// Visible half vectors [Heitz 2018], whichever the masking.
  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    return sample_ggx_visible(l, alpha_x, alpha_y, u, v);
  }
  template <class T>
  T density(int, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    return select(v.z + l.z > T(0), ggx_visible_density(half_vector_pair(l, v), alpha_x, alpha_y), T(0));
  }
};

}  // namespace albedo
