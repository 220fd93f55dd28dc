#pragma once

#include "albedo/models/smith_microfacets.hpp"

namespace albedo {

/// GGX's facets   [Walter et al. 2007, eq. 33; Heitz 2014, eqs. 72, 85, 86]
struct GgxFacets {
  static constexpr Profile profile = Profile::ggx;

  static ModelInfo info() {
    return {.name = "ggx",
            .title = "GGX, Smith masking",
            .source = "Walter et al. 2007, eqs. 20, 33; Heitz 2014, eqs. 85, 98, 99",
            .deviation = "none",
            .shorthands = {{"alpha", {"alpha_x", "alpha_y"}}}};
  }

  template <class T>
  static T distribution(const DirectionPair<T>& d, double alpha_x, double alpha_y) noexcept {
    return ggx_distribution(d, alpha_x, alpha_y);
  }
  template <class T>
  static T area(const T& x, const T& y, const T& z, double alpha_x, double alpha_y) noexcept {
    return ggx_area(x, y, z, alpha_x, alpha_y);
  }
  /// 1/(2(N·V s_L + N·L s_V)), s the stretched length of L and V   [Heitz 2014, eq. 99]
  template <class T>
  static T correlated_visibility(const DirectionPair<T>& d, double alpha_x, double alpha_y) noexcept {
    const T s_l = stretched_length(d.l_x, d.l_y, d.cos_theta_l, alpha_x, alpha_y);
    const T s_v = stretched_length(d.v_x, d.v_y, d.cos_theta_v, alpha_x, alpha_y);
    return 1 / (2 * (d.cos_theta_v * s_l + d.cos_theta_l * s_v));
  }

  /// Visible half vectors [Heitz 2018], whichever the masking.
  template <class T>
  static Sampled<T> sample(const UnitVector<T>& l, double alpha_x, double alpha_y, const T& u, const T& v) noexcept {
    return sample_ggx_visible(l, alpha_x, alpha_y, u, v);
  }
  template <class T>
  static T density(const UnitVector<T>& l, const UnitVector<T>& v, double alpha_x, double alpha_y) noexcept {
    return select(v.z + l.z > T(0), ggx_visible_density(half_vector_pair(l, v), alpha_x, alpha_y), T(0));
  }
};

/// GGX microfacets with Smith masking, anisotropic.
using Ggx = SmithMicrofacets<GgxFacets>;

}  // namespace albedo
