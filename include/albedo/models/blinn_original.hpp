#pragma once

#include "albedo/microfacet/sampling.hpp"
#include "albedo/models/blinn.hpp"

namespace albedo {

/// Blinn's model as first published: f = c (N·H)^n / (N·L)   [Neumann 1999, eq. 5]. Not reciprocal; L is the light.
struct BlinnOriginal {
  double n = 20;

  static ModelInfo info() {
    return {.name = "blinn_original",
            .title = "Blinn 1977, as published",
            .source = "Neumann 1999, eq. 5",
            .deviation =
                "the paper leaves the constant open; here a(0) = 1. Not reciprocal: a(L) integrates over V with the "
                "light L "
                "fixed, as Neumann's eq. 2"};
  }
  static std::vector<Parameter<BlinnOriginal>> parameters() {
    return {number<BlinnOriginal, &BlinnOriginal::n>("n", exponent_range, "exponent")};
  }

  [[nodiscard]] Claims claims() const { return {.reciprocal = false, .conserves_energy = false, .bounded = false}; }
  [[nodiscard]] std::vector<Lobe> lobes() const { return {power_lobe(0, n, n)}; }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return T(blinn_normalization(n)) * cos_theta_h_power(d, n) / d.cos_theta_l;
  }

  /// Half vectors of density (n+1)/(2π) (N·H)^n.
  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    return sample_power(l, n, n, u, v);
  }
  template <class T>
  T density(int, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    return power_density(half_vector_pair(l, v), n, n);
  }
};

}  // namespace albedo
