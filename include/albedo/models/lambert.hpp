#pragma once

#include "albedo/core/parameter.hpp"

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
};

}  // namespace albedo
