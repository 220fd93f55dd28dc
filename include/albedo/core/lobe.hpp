#pragma once

#include <algorithm>
#include <cmath>
#include <variant>

namespace albedo {

/// How a lobe of half vectors falls off from its centre.
enum class Profile {
  gaussian,  ///< exp(−tan²θ_H(cos²φ_H/α_x² + sin²φ_H/α_y²))
  ggx,       ///< (1 + tan²θ_H(…))^−2: a heavy tail that only the horizon cuts
  power,     ///< a power n of N·H; its width is (n + 1)^(−1/2)
};

// Around what a lobe's reflection is concentrated, and how narrowly.

/// Around nothing: all of the hemisphere.
struct CosineLobe {};

/// A = (x L_x, y L_y, z L_z), normalised: the mirror direction unless a model says otherwise.
struct LobeAxis {
  double x = -1, y = -1, z = 1;
};

/// A power n of A·V.
struct MirrorLobe {
  double width;  ///< (n + 1)^(−1/2)
  LobeAxis axis{};
};

/// The half vector's slopes.
struct SlopeLobe {
  Profile profile;
  double width_x, width_y;
};

/// The mirror direction, in elevation and azimuth; isotropic.
struct NearMirrorLobe {
  double width;        ///< ~ that of its half vectors' slopes
  double facet_width;  ///< the facets' part of it, and of the layer along the horizon
};

/// Nothing a width would tell: a table over the half vector's polar angle and azimuth.
struct HalfAnglesLobe {};

using LobeShape = std::variant<CosineLobe, MirrorLobe, SlopeLobe, NearMirrorLobe, HalfAnglesLobe>;

/// What a model tells about the shape of one of its lobes, so that a warp can put points where it is. It is a hint for
/// placing points, panel edges and end-point substitutions: a wrong lobe costs evaluations, never correctness of the
/// formula.
struct Lobe {
  int component = 0;  ///< its number in Model::evaluate
  double weight = 1;  ///< 0 switches the lobe off
  LobeShape shape{};
  bool kink_equal_cosines = false;  ///< the formula has a max or min of N·L and N·V
  bool kink_v_cavity = false;       ///< the formula has the V-cavity geometry factor
  double horizon_exponent = 1;      ///< f cosθ_V ~ cosθ_V^p at the horizon
  double growth = 1;  ///< beside its profile, the formula grows towards the lobe's end like r^(2 growth) at most
  bool horizon_layer = false;  ///< the formula changes over cosθ_V ~ width near the horizon (Smith masking)
  bool hidden_kinks = false;   ///< the formula has kinks at places that no warp knows of: rules are to believe less

  /// The shape, or nullptr if it is another.
  template <class Shape>
  [[nodiscard]] const Shape* as() const {
    return std::get_if<Shape>(&shape);
  }
  template <class Shape>
  [[nodiscard]] bool is() const {
    return std::holds_alternative<Shape>(shape);
  }
  /// @throws std::bad_variant_access for a lobe of another shape
  [[nodiscard]] const SlopeLobe& slopes() const { return std::get<SlopeLobe>(shape); }

  /// The narrower and the wider one of its widths, 1 where it has none.
  struct Widths {
    double narrow = 1, wide = 1;
  };
  [[nodiscard]] Widths widths() const {
    if (const auto* mirror = as<MirrorLobe>()) return {mirror->width, mirror->width};
    if (const auto* near = as<NearMirrorLobe>()) return {near->width, near->width};
    if (const auto* slopes = as<SlopeLobe>()) {
      return {std::min(slopes->width_x, slopes->width_y), std::max(slopes->width_x, slopes->width_y)};
    }
    return {};
  }
  [[nodiscard]] LobeAxis axis() const { return is<MirrorLobe>() ? as<MirrorLobe>()->axis : LobeAxis{}; }
};

/// A lobe of half vectors whose slopes have the given profile and widths.
inline Lobe slope_lobe(int component, Profile profile, double alpha_x, double alpha_y) {
  return {.component = component, .shape = SlopeLobe{profile, alpha_x, alpha_y}};
}

/// A lobe (N·H)^n, with an exponent per axis.
inline Lobe power_lobe(int component, double n_x, double n_y) {
  return slope_lobe(component, Profile::power, 1 / std::sqrt(n_x + 1), 1 / std::sqrt(n_y + 1));
}

/// A lobe (A·V)₊^n around the mirror direction or another axis.
inline Lobe mirror_lobe(int component, double n, const LobeAxis& axis = {}) {
  return {.component = component, .shape = MirrorLobe{1 / std::sqrt(n + 1), axis}};
}

}  // namespace albedo
