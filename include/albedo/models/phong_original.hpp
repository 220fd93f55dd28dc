#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Phong's model as first published: f = (n+1)/(2π) (R·V)₊^n / (N·L)   [Neumann 1999, eq. 5]. Not reciprocal; L is the
/// light.
struct PhongOriginal {
  double n = 20;

  static ModelInfo info() {
    return {.name = "phong_original",
            .title = "Phong 1975, as published",
            .source = "Neumann 1999, eq. 5; constant (n+1)/2π of the lobe's volume",
            .deviation = "none; not reciprocal: a(L) integrates over V with the light L fixed, as Neumann's eq. 2"};
  }
  static std::vector<Parameter<PhongOriginal>> parameters() {
    return {number<PhongOriginal, &PhongOriginal::n>("n", exponent_range, "exponent")};
  }

  [[nodiscard]] Claims claims() const { return {.reciprocal = false, .conserves_energy = false, .bounded = false}; }
  [[nodiscard]] std::vector<Lobe> lobes() const { return {mirror_lobe(0, n)}; }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return T(n + 1) / (2 * pi<T>)*axis_power(d, n) / d.cos_theta_l;
  }

  /// Directions of density (n+1)/(2π) (R·V)₊^n.
  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    return sample_axis(l, sampling_axis(l, -1, -1, 1), n, u, v);
  }
  template <class T>
  T density(int, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    return axis_density(sampling_axis(l, -1, -1, 1), n, v);
  }
};

}  // namespace albedo
