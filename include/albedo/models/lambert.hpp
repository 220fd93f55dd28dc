#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Lambert's diffuse reflector: f = ρ/π. Its albedo is ρ.
struct Lambert {
  double rho = 1;

  static ModelInfo info() {
    return {.name = "lambert", .title = "Lambert", .source = "Lambert 1760: f = ρ/π", .deviation = "none"};
  }
  static std::vector<Parameter<Lambert>> parameters() { return {reflectance<Lambert, &Lambert::rho>("rho", "albedo")}; }

  [[nodiscard]] Claims claims() const { return {}; }
  [[nodiscard]] std::vector<Lobe> lobes() const { return {{.component = 0, .weight = rho}}; }

  template <class T>
  T evaluate(int, const DirectionPair<T>&) const noexcept {
    return T(rho) / pi<T>;
  }

  /// Cosine-weighted directions: the exact sampler.
  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    return sample_cosine(l, u, v);
  }
  template <class T>
  T density(int, const UnitVector<T>&, const UnitVector<T>& v) const noexcept {
    return cosine_density(v);
  }
};

}  // namespace albedo
