#pragma once

#include "albedo/models/ward_family.hpp"

namespace albedo {

/// ρ_s exp(−tan²θ_H (cos²φ_H/α_x² + sin²φ_H/α_y²)) / (4π α_x α_y N·L N·V)   [Dür 2006; Kurt et al. 2010, §2]
///
/// Its albedo diverges at grazing incidence like (N·L)^−1, faster than Ward's own. Its half vectors weigh
/// ρ_s L·H (N·H)³/N·L.
struct WardDuerVariant {
  static constexpr double horizon_exponent = 0;
  static constexpr bool is_bounded = false;

  static ModelInfo info() {
    return {.name = "ward_duer",
            .title = "Ward–Dür 2006",
            .source = "Dür 2006 (J. Graphics Tools 11(1)): Ward 1992 with √(N·L N·V) replaced by N·L N·V",
            .deviation = "none known; the paper's text was not available, the form is that of public code"};
  }

  template <class M, class T>
  static T specular(const M& m, const DirectionPair<T>& d) noexcept {
    return T(m.rho_s) * exp(-scaled_slope2(d, m.alpha_x, m.alpha_y)) /
           (4 * pi<T> * T(m.alpha_x) * T(m.alpha_y) * d.cos_theta_l * d.cos_theta_v);
  }
};

/// Dür's variant of Ward's model.
using WardDuer = WardFamily<WardDuerVariant>;

}  // namespace albedo
