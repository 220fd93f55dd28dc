#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Neumann's metallic Phong: f = (n+2)/(2π) (R·V)₊^n / max(N·L, N·V)   [Neumann 1999, eq. 22]
struct NeumannPhong {
  double n = 20;

  static ModelInfo info() {
    return {.name = "neumann_phong",
            .title = "Neumann's metallic Phong",
            .source = "Neumann 1999, eq. 22; Ashikhmin & Shirley 2000, eq. 2",
            .deviation = "none"};
  }
  static std::vector<Parameter<NeumannPhong>> parameters() {
    return {number<NeumannPhong, &NeumannPhong::n>("n", exponent_range, "exponent")};
  }

  /// The paper claims conservation for every n. Near normal incidence a(L) = 1 + K θ^(n+2) − (n+2)/8 θ⁴ + …, where K =
  /// ∫ cos^(n+2) over half a turn/(2π(n+1)) is what the horizon cuts off a lobe whose part below it would count as
  /// negative: for n < 2 it passes 1, by 1.086 − 1 for n = 0 (at 45°), 2.6e-8 for n = 1.5 (at 1.4°).
  [[nodiscard]] Claims claims() const { return {.conserves_energy = n >= 2}; }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe lobe = mirror_lobe(0, n);
    lobe.kink_equal_cosines = true;
    return {lobe};
  }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return T(n + 2) / (2 * pi<T>)*axis_power(d, n) / max(d.cos_theta_l, d.cos_theta_v);
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
