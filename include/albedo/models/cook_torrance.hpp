#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/fresnel.hpp"
#include "albedo/microfacet/masking.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Cook–Torrance: f = k_d/π + k_s F exp(−tan²θ_H/m²) G / (4π m² cos⁴θ_H N·L N·V)   [Neumann 1999, eqs. 9, 10]
///
/// G is the V-cavity factor of eq. 10 or, with masking=none, 1. Normalised by 1/4; Ngan et al. 2005 use 1/π, which is
/// k_s = 4/π.
struct CookTorrance {
  enum class Masking { v_cavity, none };

  double m = 0.1;
  Masking masking = Masking::v_cavity;
  double k_s = 1, k_d = 0;
  Fresnel fresnel{};

  static ModelInfo info() {
    return {.name = "cook_torrance",
            .title = "Cook–Torrance, V-cavities",
            .source = "Neumann 1999, eqs. 9, 10",
            .deviation = "none; scale k_s and a Lambertian part k_d are added"};
  }
  static std::vector<Parameter<CookTorrance>> parameters() {
    using M = CookTorrance;
    return with_fresnel<M>(
        {number<M, &M::m>("m", roughness_range, "root mean square slope × √2"),
         choice<M, &M::masking>("masking", {"v_cavity", "none"}, "geometry factor G of eq. 10, or G = 1"),
         reflectance<M, &M::k_s>("k_s", "scale of the specular lobe", scale_range),
         reflectance<M, &M::k_d>("k_d", "albedo of the Lambertian part")});
  }

  [[nodiscard]] Claims claims() const {
    const bool masked = masking == Masking::v_cavity;
    return {.conserves_energy = masked && k_s + k_d <= 1,
            .bounded = masked,
            .distribution = Measure::projected,
            .consistent_masking = masked};
  }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe specular = slope_lobe(0, Profile::gaussian, m, m);
    specular.weight = k_s;
    specular.kink_v_cavity = masking == Masking::v_cavity;
    specular.growth = fresnel.growth();
    return {specular, {.component = 1, .weight = k_d}};
  }

  template <class T>
  T facet_distribution(const DirectionPair<T>& d) const noexcept {
    return albedo::beckmann(d, m, m);
  }
  /// G₁ of V-cavities, or 1.
  template <class T>
  T facet_masking(const DirectionPair<T>& d) const noexcept {
    return masking == Masking::v_cavity ? v_cavity_masking(d) : T(1);
  }

  template <class T>
  T evaluate(int component, const DirectionPair<T>& d) const noexcept {
    if (component == 1) return T(k_d) / pi<T>;
    const T f = T(k_s) * fresnel(d.cos_theta_d) * beckmann(d, m, m) / (4 * d.cos_theta_l * d.cos_theta_v);
    return masking == Masking::v_cavity ? T(f * v_cavity(d)) : f;
  }

  /// Half vectors from Beckmann's distribution; the Lambertian part: cosine-weighted.
  template <class T>
  Sampled<T> sample(int component, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    if (component == 1) return sample_cosine(l, u, v);
    return sample_beckmann(l, m, m, u, v);
  }
  template <class T>
  T density(int component, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    if (component == 1) return cosine_density(v);
    return beckmann_density(half_vector_pair(l, v), m, m);
  }
};

}  // namespace albedo
