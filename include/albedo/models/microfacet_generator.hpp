#pragma once

#include <optional>

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/fresnel.hpp"
#include "albedo/microfacet/masking.hpp"
#include "albedo/microfacet/power_area.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Ashikhmin, Premože and Shirley's generator: any density p of facet normals, shadowed by the facets' own projected
/// area,
///
///     f = p(H) ⟨N·H⟩ F / (4 g(L) g(V)),   g(K) = ∫ p(H) (H·K)₊ dω_H,   ⟨N·H⟩ = g(N),   ∫ p dω_H = 1
///
/// [Ashikhmin, Premože, Shirley 2000]. With p = D/∫D the area ∫D cancels: f = D F/(4 A(L) A(V)), A(K) = ∫ D (H·K)₊ =
/// N·K (1 + Λ(K)), which is Smith masking, separable. D is GGX's, Beckmann's, or the power (n+2)/(2π) (N·H)^n, n =
/// 2/α².
struct MicrofacetGenerator {
  enum class Distribution { ggx, beckmann, power };

  double alpha = 0.3;
  Distribution distribution = Distribution::ggx;
  Fresnel fresnel{};
  std::optional<PowerArea> power_area{};  ///< of a power distribution, set by load()

  static ModelInfo info() {
    return {.name = "microfacet_generator",
            .title = "Microfacet generator, Ashikhmin–Premože–Shirley 2000",
            .source = "Ashikhmin, Premože, Shirley 2000",
            .deviation = "none known; the paper's text was not available"};
  }
  static std::vector<Parameter<MicrofacetGenerator>> parameters() {
    using M = MicrofacetGenerator;
    return with_fresnel<M>(
        {number<M, &M::alpha>("alpha", roughness_range, "roughness of the facets"),
         choice<M, &M::distribution>("distribution", {"ggx", "beckmann", "power"}, "distribution of facet normals")});
  }

  [[nodiscard]] Claims claims() const { return {.distribution = Measure::projected, .consistent_masking = true}; }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe lobe = distribution == Distribution::power
                    ? power_lobe(0, exponent(), exponent())
                    : slope_lobe(0, distribution == Distribution::ggx ? Profile::ggx : Profile::gaussian, alpha, alpha);
    lobe.horizon_layer = true;
    lobe.growth = fresnel.growth();
    return {lobe};
  }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return fresnel(d.cos_theta_d) * facet_distribution(d) /
           (4 * area(d.l_x, d.l_y, d.cos_theta_l) * area(d.v_x, d.v_y, d.cos_theta_v));
  }

  [[nodiscard]] double exponent() const { return 2 / (alpha * alpha); }
  void load() {
    if (distribution == Distribution::power) power_area = PowerArea(exponent());
  }

  /// D(H)
  template <class T>
  T facet_distribution(const DirectionPair<T>& d) const noexcept {
    switch (distribution) {
      case Distribution::ggx:
        return ggx_distribution(d, alpha, alpha);
      case Distribution::beckmann:
        return albedo::beckmann(d, alpha, alpha);
      case Distribution::power:
        break;
    }
    return T(exponent() + 2) / (2 * pi<T>)*cos_theta_h_power(d, exponent());
  }

  /// G₁ = N·L/A(L)
  template <class T>
  T facet_masking(const DirectionPair<T>& d) const noexcept {
    return d.cos_theta_l / area(d.l_x, d.l_y, d.cos_theta_l);
  }

  /// A(K) of a direction (x, y, z).
  template <class T>
  T area(const T& x, const T& y, const T& z) const noexcept {
    switch (distribution) {
      case Distribution::ggx:
        return ggx_area(x, y, z, alpha, alpha);
      case Distribution::beckmann:
        return beckmann_area(x, y, z, alpha, alpha);
      case Distribution::power:
        break;
    }
    return (*power_area)(z);
  }

  /// Half vectors of density D N·H.
  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    switch (distribution) {
      case Distribution::ggx:
        return sample_ggx(l, alpha, alpha, u, v);
      case Distribution::beckmann:
        return sample_beckmann(l, alpha, alpha, u, v);
      case Distribution::power:
        break;
    }
    return sample_power(l, exponent() + 1, exponent() + 1, u, v);
  }
  template <class T>
  T density(int, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    const DirectionPair<T> d = half_vector_pair(l, v);
    return facet_distribution(d) * d.cos_theta_h / (4 * d.cos_theta_d);
  }
};

}  // namespace albedo
