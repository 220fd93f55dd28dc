#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/fresnel.hpp"
#include "albedo/microfacet/masking.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Anisotropic microfacets with Smith masking: f = F D G₂ / (4 N·L N·V)   [Walter et al. 2007, eq. 20], with
///  - separable: G₂ = 1/((1 + Λ(L))(1 + Λ(V)))        [Heitz 2014, eq. 98]
///  - correlated: G₂ = 1/(1 + Λ(L) + Λ(V))            [Heitz 2014, eq. 99]
///
/// The Facets are the model's info, their profile, distribution D, area N·K (1 + Λ(K)) as seen from K, correlated
/// visibility G₂/(4 N·L N·V), and a sampler with its density.
template <class Facets>
struct SmithMicrofacets {
  double alpha_x = 0.3, alpha_y = 0.3;
  SmithMasking masking = SmithMasking::correlated;
  Fresnel fresnel{};

  static ModelInfo info() { return Facets::info(); }
  static std::vector<Parameter<SmithMicrofacets>> parameters() {
    using M = SmithMicrofacets;
    return with_fresnel<M>(
        {number<M, &M::alpha_x>("alpha_x", roughness_range, "roughness along x"),
         number<M, &M::alpha_y>("alpha_y", roughness_range, "roughness along y"),
         choice<M, &M::masking>("masking", {"correlated", "separable"}, "Smith masking–shadowing G₂")});
  }

  [[nodiscard]] Claims claims() const {
    return {.isotropic = alpha_x == alpha_y, .distribution = Measure::projected, .consistent_masking = true};
  }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe lobe = slope_lobe(0, Facets::profile, alpha_x, alpha_y);
    lobe.horizon_layer = true;
    lobe.growth = fresnel.growth();
    return {lobe};
  }

  template <class T>
  T facet_distribution(const DirectionPair<T>& d) const noexcept {
    return Facets::distribution(d, alpha_x, alpha_y);
  }
  /// G₁(L) = 1/(1 + Λ(L))   [Heitz 2014, eq. 43]
  template <class T>
  T facet_masking(const DirectionPair<T>& d) const noexcept {
    return d.cos_theta_l / Facets::area(d.l_x, d.l_y, d.cos_theta_l, alpha_x, alpha_y);
  }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return fresnel(d.cos_theta_d) * facet_distribution(d) * visibility(d);
  }

  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    return Facets::sample(l, alpha_x, alpha_y, u, v);
  }
  template <class T>
  T density(int, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    return Facets::density(l, v, alpha_x, alpha_y);
  }

 private:
  /// G₂/(4 N·L N·V), without dividing by a cosine.
  template <class T>
  [[nodiscard]] T visibility(const DirectionPair<T>& d) const noexcept {
    if (masking == SmithMasking::correlated) return Facets::correlated_visibility(d, alpha_x, alpha_y);
    return 1 / (4 * Facets::area(d.l_x, d.l_y, d.cos_theta_l, alpha_x, alpha_y) *
                Facets::area(d.v_x, d.v_y, d.cos_theta_v, alpha_x, alpha_y));
  }
};

}  // namespace albedo
