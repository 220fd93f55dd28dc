#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// The stretched Phong family: f = (n+2)/(2π) (R·V)₊^n / max(N·L, N·V)^q. q = 0 is Phong, q = 1 Neumann's metallic
/// model
/// ("max"-Phong)   [Neumann, Neumann, Szirmay-Kalos 1999, Compact Metallic Reflectance Models; Neumann 1999, eq. 22]
struct NeumannStretched {
  double n = 20;
  double q = 0.5;

  static ModelInfo info() {
    return {
        .name = "neumann_stretched",
        .title = "Stretched Phong",
        .source = "Neumann, Neumann, Szirmay-Kalos 1999 (Compact Metallic Reflectance Models); Neumann 1999, eq. 22",
        .deviation = "none for q = 1; the power q is that of public code named after the paper"};
  }
  static std::vector<Parameter<NeumannStretched>> parameters() {
    using M = NeumannStretched;
    return {number<M, &M::n>("n", exponent_range, "exponent"),
            number<M, &M::q>("q", {0, 1}, "power of max(N·L, N·V) in the denominator")};
  }

  /// With n = 0, a(L) passes 1 for q > 0.5; it stays below from n = 0.749 on for q = 0.95, from n = 1.341 on for q =
  /// 0.99. For q = 1 it is at most 1 from n = 2 on: see neumann_phong.
  [[nodiscard]] Claims claims() const {
    return {.conserves_energy = n >= 2 || q <= 0.5 || (q <= 0.95 && n >= 0.75) || (q <= 0.99 && n >= 1.35)};
  }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe lobe = mirror_lobe(0, n);
    lobe.kink_equal_cosines = q > 0;
    return {lobe};
  }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return T(n + 2) / (2 * pi<T>)*axis_power(d, n) * exp(T(-q) * log(T(max(d.cos_theta_l, d.cos_theta_v))));
  }

  /// Directions of density (n+1)/(2π) (R·V)₊^n, of weight (n+2)/(n+1) N·V/max(N·L, N·V)^q.
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
