#pragma once

#include "albedo/models/ward_family.hpp"

namespace albedo {

/// ρ_s exp(−tan²θ_H (cos²φ_H/α_x² + sin²φ_H/α_y²)) / (4π α_x α_y √(N·L N·V))
/// [Ward 1992; Walter 2005, eq. 4; Neumann 1999, eq. 8 with m = α]
struct WardVariant {
  static constexpr double horizon_exponent = 0.5;
  static constexpr bool is_bounded = false;

  static ModelInfo info() {
    return {.name = "ward",
            .title = "Ward 1992, anisotropic",
            .source = "Walter 2005, eq. 4; Neumann 1999, eq. 8",
            .deviation = "none"};
  }

  template <class M, class T>
  static T specular(const M& m, const DirectionPair<T>& d) noexcept {
    return T(m.rho_s) * exp(-scaled_slope2(d, m.alpha_x, m.alpha_y)) /
           (4 * pi<T> * T(m.alpha_x) * T(m.alpha_y) * sqrt(T(d.cos_theta_l * d.cos_theta_v)));
  }
};

/// Ward's anisotropic model.
using Ward = WardFamily<WardVariant>;

}  // namespace albedo
