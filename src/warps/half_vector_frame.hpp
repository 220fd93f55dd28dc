#pragma once

#include <cmath>

#include "warps/ray.hpp"
#include "warps/sample.hpp"
#include "warps/turn.hpp"

namespace albedo {

/// Where a half-vector lobe stands as seen from L: what its rays, the division of its turn and the numbers of its nodes
/// are made from.
template <class S>
struct HalfVectorFrame {
  Profile profile;
  bool symmetric;
  bool turning;  // masking that depends on the viewer's azimuth
  bool stretch = false;
  S alpha_x, alpha_y, widest;
  UnitVector<S> l;
  S tan_alpha, axis_cos, axis_sin, offset_cos, offset_sin;  // set by make_turn
  Turn<S> turn;
  S cut, cut_tau;
  double truncation = 0;
  double horizon_exponent = 1;
  bool horizon_layer = false;
  bool rough = false;
  double digits = 8;

  HalfVectorFrame(const Lobe& lobe, const Direction& direction, double tolerance)
      : profile(lobe.slopes().profile),
        symmetric(mirror_symmetric(lobe, direction)),
        turning(lobe.horizon_layer && lobe.slopes().width_x != lobe.slopes().width_y),
        alpha_x(lobe.slopes().width_x),
        alpha_y(lobe.slopes().width_y),
        l(unit_vector<S>(direction)),
        turn(make_turn(lobe, direction)) {
    const Cut end = profile == Profile::ggx ? Cut{1e250, 0} : lobe_cut(tolerance, lobe.growth);
    cut = end.radius;
    truncation = end.truncation;
    widest = lobe.slopes().width_x > lobe.slopes().width_y ? S(alpha_x) : S(alpha_y);
    cut_tau = tau_of_radius(cut * widest);
    stretch = profile == Profile::ggx || (profile == Profile::gaussian && widest * cut > 2);
    horizon_exponent = lobe.horizon_exponent;
    horizon_layer = lobe.horizon_layer && lobe.widths().narrow < 0.3;
    // Smith's Λ has a cone at V = N, rounded over an angle of 1/α: a point inside the domain of wide lobes
    const bool cone = lobe.horizon_layer && lobe.widths().wide >= (profile == Profile::ggx ? 1.5 : 0.3);
    rough = cone || turning;
    digits = -std::log10(tolerance);
  }

  /// τ(ρr)
  [[nodiscard]] S tau_of_radius(const S& x) const {
    return profile == Profile::power ? S(sqrt(expm1(S(2 * x * x)))) : x;
  }

 private:
  Turn<S> make_turn(const Lobe& lobe, const Direction& direction) {
    S cos_theta, sin_theta, cos_phi, sin_phi;
    polar_angle(direction, cos_theta, sin_theta);
    azimuth(direction, cos_phi, sin_phi);
    const S tangent = sin_theta / cos_theta;
    const S gx = alpha_x * cos_phi, gy = alpha_y * sin_phi;
    const S g = sqrt(gx * gx + gy * gy);
    tan_alpha = tangent * g;
    axis_cos = gx / g;
    axis_sin = gy / g;
    // the quadratic form b² + ρ² in the axes along and across the projection of L
    const S x2 = square(alpha_x), y2 = square(alpha_y);
    const S m11 = x2 * square(axis_cos) + y2 * square(axis_sin) + square(tan_alpha);
    const S m22 = x2 * square(axis_sin) + y2 * square(axis_cos);
    const S m12 = (y2 - x2) * axis_cos * axis_sin;
    const S half = (m11 - m22) / 2;
    const S root = sqrt(half * half + m12 * m12);
    const S largest = (m11 + m22) / 2 + root;
    const S ratio = alpha_x * alpha_y * sqrt(1 + square(tangent)) / largest;  // √(smallest/largest)
    offset_cos = 1;
    offset_sin = 0;
    const bool kinked = lobe.kink_equal_cosines || lobe.kink_v_cavity;  // then ±K must stay where cosφ = 0
    if (!kinked && root > 0 && lobe.slopes().width_x != lobe.slopes().width_y) {
      const S cos_2 = half / root;  // of twice the angle to the form's larger axis
      const S larger = sqrt((1 + abs(cos_2)) / 2), smaller = abs(m12 / root) / (2 * larger);
      offset_cos = cos_2 >= 0 ? larger : smaller;
      offset_sin = cos_2 >= 0 ? smaller : larger;
      if (m12 < 0) offset_sin = -offset_sin;
    }
    return Turn<S>(min(ratio, S(1)));
  }
};

}  // namespace albedo
