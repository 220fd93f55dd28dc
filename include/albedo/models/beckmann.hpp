#pragma once

#include "albedo/models/smith_microfacets.hpp"

namespace albedo {

/// Beckmann's facets, with the exact Λ, not a fit   [Walter et al. 2007, eq. 25; Heitz 2014, eqs. 66, 80]
struct BeckmannFacets {
  static constexpr Profile profile = Profile::gaussian;

  static ModelInfo info() {
    return {.name = "beckmann",
            .title = "Beckmann, Smith masking",
            .source = "Walter et al. 2007, eqs. 20, 25; Heitz 2014, eqs. 66, 98, 99",
            .deviation = "none",
            .shorthands = {{"alpha", {"alpha_x", "alpha_y"}}, {"m", {"alpha_x", "alpha_y"}}}};
  }

  template <class T>
  static T distribution(const DirectionPair<T>& d, double alpha_x, double alpha_y) noexcept {
    return beckmann(d, alpha_x, alpha_y);
  }
  template <class T>
  static T area(const T& x, const T& y, const T& z, double alpha_x, double alpha_y) noexcept {
    return beckmann_area(x, y, z, alpha_x, alpha_y);
  }
  /// 1/(4(N·L N·V + N·V e_L + N·L e_V)) with e = z Λ   [Heitz 2014, eq. 99]
  template <class T>
  static T correlated_visibility(const DirectionPair<T>& d, double alpha_x, double alpha_y) noexcept {
    const T e_l = beckmann_shadow(d.l_x, d.l_y, d.cos_theta_l, alpha_x, alpha_y);
    const T e_v = beckmann_shadow(d.v_x, d.v_y, d.cos_theta_v, alpha_x, alpha_y);
    return 1 / (4 * (d.cos_theta_l * d.cos_theta_v + d.cos_theta_v * e_l + d.cos_theta_l * e_v));
  }

  /// Half vectors of density D N·H   [Walter et al. 2007, eqs. 28, 29].
  template <class T>
  static Sampled<T> sample(const UnitVector<T>& l, double alpha_x, double alpha_y, const T& u, const T& v) noexcept {
    return sample_beckmann(l, alpha_x, alpha_y, u, v);
  }
  template <class T>
  static T density(const UnitVector<T>& l, const UnitVector<T>& v, double alpha_x, double alpha_y) noexcept {
    return beckmann_density(half_vector_pair(l, v), alpha_x, alpha_y);
  }
};

/// Beckmann microfacets with Smith masking, anisotropic.
using Beckmann = SmithMicrofacets<BeckmannFacets>;

}  // namespace albedo
