#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// The reciprocal Phong model: f = (n+2)/(2π) (R·V)₊^n   [Neumann 1999, eq. 6; constant of eq. 22; Lewis 1993]
struct Phong {
  double n = 20;

  static ModelInfo info() {
    return {.name = "phong",
            .title = "Phong, reciprocal",
            .source = "Neumann 1999, eq. 6 (Lewis 1993)",
            .deviation = "none: the constant (n+2)/2π is that of eq. 22 and makes a(0) = 1"};
  }
  static std::vector<Parameter<Phong>> parameters() {
    return {number<Phong, &Phong::n>("n", exponent_range, "exponent")};
  }

  [[nodiscard]] Claims claims() const { return {}; }
  [[nodiscard]] std::vector<Lobe> lobes() const { return {mirror_lobe(0, n)}; }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return T(n + 2) / (2 * pi<T>)*axis_power(d, n);
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
