#pragma once

#include <numbers>

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/fresnel.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Ashikhmin and Premože's distribution-based model with Beckmann's distribution: f = F D / (4 (N·L + N·V − N·L N·V))
/// [Ashikhmin & Premože 2007]
///
/// a(L) ≤ ∫ D (L·H)₊ = N·L (1 + Λ(L)), which is at most max(1, m/(2√π)), and a(90°) = m/(2√π).
struct AshikhminPremoze {
  double m = 0.3;
  Fresnel fresnel{};

  static ModelInfo info() {
    return {.name = "ashikhmin_premoze",
            .title = "Ashikhmin–Premože 2007, distribution-based",
            .source = "Ashikhmin & Premože 2007 (the denominator N·L + N·V − N·L N·V)",
            .deviation =
                "the paper leaves the distribution and its constant open: here Beckmann's with ∫D N·H = 1, and "
                "c = 1/4; the paper's text was not available, the form is that of public code"};
  }
  static std::vector<Parameter<AshikhminPremoze>> parameters() {
    using M = AshikhminPremoze;
    return with_fresnel<M>({number<M, &M::m>("m", roughness_range, "root mean square slope × √2")});
  }

  [[nodiscard]] Claims claims() const {
    return {.conserves_energy = m * std::numbers::inv_sqrtpi / 2 <= 1, .distribution = Measure::projected};
  }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe lobe = slope_lobe(0, Profile::gaussian, m, m);
    lobe.growth = fresnel.growth();
    return {lobe};
  }

  template <class T>
  T facet_distribution(const DirectionPair<T>& d) const noexcept {
    return albedo::beckmann(d, m, m);
  }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return fresnel(d.cos_theta_d) * albedo::beckmann(d, m, m) /
           (4 * (d.cos_theta_l + d.cos_theta_v - d.cos_theta_l * d.cos_theta_v));
  }

  /// Half vectors of density D N·H.
  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    return sample_beckmann(l, m, m, u, v);
  }
  template <class T>
  T density(int, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    return beckmann_density(half_vector_pair(l, v), m, m);
  }
};

}  // namespace albedo
