#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// The constant that makes the albedo of (N·H)^n exactly 1 at normal incidence: c = (n+2)(n+4)/(8π (2^(−n/2) + n)).
inline double blinn_normalization(double n) { return (n + 2) * (n + 4) / (8 * pi<double> * (std::exp2(-n / 2) + n)); }

/// The reciprocal Blinn model: f = c (N·H)^n   [Neumann 1999, eq. 6]
struct Blinn {
  double n = 20;

  static ModelInfo info() {
    return {.name = "blinn",
            .title = "Blinn, reciprocal",
            .source = "Neumann 1999, eq. 6",
            .deviation = "the paper leaves the constant open; here a(0) = 1 exactly"};
  }
  static std::vector<Parameter<Blinn>> parameters() {
    return {number<Blinn, &Blinn::n>("n", exponent_range, "exponent")};
  }

  [[nodiscard]] Claims claims() const { return {}; }
  [[nodiscard]] std::vector<Lobe> lobes() const { return {power_lobe(0, n, n)}; }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return T(blinn_normalization(n)) * cos_theta_h_power(d, n);
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
