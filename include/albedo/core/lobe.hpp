#pragma once

#include <cmath>

namespace albedo {

/// Around what a lobe's reflection is concentrated.
enum class LobeShape {
  cosine,       ///< around nothing: all of the hemisphere
  mirror,       ///< a polar angle from an axis A (Phong: the mirror direction)
  half_vector,  ///< the half vector's slopes
  near_mirror,  ///< the mirror direction, in elevation and azimuth; width_x ~ that of its half vectors' slopes
                ///< (isotropic)
  half_angles,  ///< nothing a width would tell: a table over the half vector's polar angle and azimuth
};

/// How a lobe falls off from its centre.
enum class Profile {
  gaussian,  ///< exp(−tan²θ_H(cos²φ_H/α_x² + sin²φ_H/α_y²))
  ggx,       ///< (1 + tan²θ_H(…))^−2: a heavy tail that only the horizon cuts
  power,     ///< a power n of a cosine; its width is (n + 1)^(−1/2)
};

/// What a model tells about the shape of one of its lobes, so that a warp can put points where it is. It is a hint for
/// placing points, panel edges and end-point substitutions: a wrong lobe costs evaluations, never correctness of the
/// formula.
struct Lobe {
  int component = 0;  ///< its number in Model::evaluate
  double weight = 1;  ///< 0 switches the lobe off
  LobeShape shape = LobeShape::cosine;
  Profile profile = Profile::gaussian;
  double width_x = 1;  ///< in slope (half_vector) or (n + 1)^(−1/2) (power)
  double width_y = 1;
  /// A = (a_x L_x, a_y L_y, a_z L_z), normalised: the axis of a mirror lobe. The default is the mirror direction.
  double axis_x = -1, axis_y = -1, axis_z = 1;
  bool kink_equal_cosines = false;  ///< the formula has a max or min of N·L and N·V
  bool kink_v_cavity = false;       ///< the formula has the V-cavity geometry factor
  double horizon_exponent = 1;      ///< f cosθ_V ~ cosθ_V^p at the horizon
  double growth = 1;  ///< beside its profile, the formula grows towards the lobe's end like r^(2 growth) at most
  bool horizon_layer = false;  ///< the formula changes over cosθ_V ~ width near the horizon (Smith masking)
  bool hidden_kinks = false;   ///< the formula has kinks at places that no warp knows of: rules are to believe less
  double facet_width = 0;      ///< near_mirror: the facets' part of width_x, and of the layer along the horizon
};

/// A lobe of half vectors whose slopes have the given profile and widths.
inline Lobe slope_lobe(int component, Profile profile, double alpha_x, double alpha_y) {
  return {.component = component,
          .shape = LobeShape::half_vector,
          .profile = profile,
          .width_x = alpha_x,
          .width_y = alpha_y};
}

/// A lobe (N·H)^n, with an exponent per axis.
inline Lobe power_lobe(int component, double n_x, double n_y) {
  return slope_lobe(component, Profile::power, 1 / std::sqrt(n_x + 1), 1 / std::sqrt(n_y + 1));
}

/// A lobe (A·V)₊^n around the mirror direction (or another axis, set afterwards).
inline Lobe mirror_lobe(int component, double n) {
  return {.component = component,
          .shape = LobeShape::mirror,
          .profile = Profile::power,
          .width_x = 1 / std::sqrt(n + 1),
          .width_y = 1 / std::sqrt(n + 1)};
}

}  // namespace albedo
