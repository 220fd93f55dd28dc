#pragma once

#include <algorithm>
#include <cmath>

#include "warps/ray.hpp"
#include "warps/sample.hpp"
#include "warps/turn.hpp"

namespace albedo {

/// All directions V by their elevation and azimuth, gathered around the mirror direction R of an isotropic model: for
/// lobes whose width differs from one incidence to another, and whose formula has a layer along the horizon.
///
/// The elevation is e = 1 − √(1 − μ), μ = cosθ_V, that is nearly linear in θ_V, and V = (1 − e) √(1 + μ) (cosφ, sinφ),
/// φ from R's azimuth on. Both are away from R by w sinh(A u), so that points lie evenly in the lobe (of width w) and
/// as in a logarithm outside it; half the turn is enough. The sum L + V keeps its digits at R:
///
///     μ − N·L = (e − e_R)(2 − e − e_R),   sinθ_L − sinθ_V = (μ − N·L)(μ + N·L)/(sinθ_L + sinθ_V)
template <class T>
class NearMirrorWarp {
  using S = Scalar<T>;

 public:
  NearMirrorWarp(const Lobe& lobe, const Direction& l, double tolerance) {
    S cos_phi, sin_phi;
    polar_angle(l, cos_l_, sin_l_);
    azimuth(l, cos_phi, sin_phi);
    along_x_ = cos_phi, along_y_ = sin_phi;
    // √(1 − cosθ) from the sine, near the zenith
    below_zenith_ = cos_l_ > S(0.5) ? S(sin_l_ / sqrt(S(1 + cos_l_))) : S(sqrt(S(1 - cos_l_)));
    mirror_ = cos_l_ / (1 + below_zenith_);
    // facets turn V by twice their slope; diffraction spreads it evenly in (V_x, V_y), seen aslant
    const auto [width, facet_width] = std::get<NearMirrorLobe>(lobe.shape);
    const S facets = S(2 * facet_width);
    const S spread = S(2 * std::sqrt(std::max(0.0, square(width) - square(facet_width))));
    const S aslant = spread / (cos_l_ + sqrt(spread));
    const S elevation = S(0.6) * sqrt(S(square(facets) + square(aslant)));
    const S azimuth_width = sqrt(S(square(S(facets * cos_l_)) + square(spread))) / pi<S>;
    turn_ = stretched(S(1), azimuth_width / max(sin_l_, azimuth_width));
    const double digits = -std::log10(tolerance);
    const S layer = S(facet_width) / 2;
    const S middle = mirror_ / 2;
    add({S(0), S(1), stretched(middle, layer)}, digits);
    add({mirror_, S(-1), stretched(middle, elevation)}, digits);
    // where masking sets in at R itself, it changes with cosθ_V as fast as N·L is small;
    // facets as wide as the sky have no layer
    S from = 0;
    const S knee = min(elevation, below_zenith_);
    if (cos_l_ < 2 * facets && mirror_ < knee && min(elevation, facets) < below_zenith_) {
      add({mirror_, S(1), stretched(knee, mirror_)}, digits);
      from = knee;
    }
    if (from < below_zenith_) add({mirror_ + from, S(1), stretched(S(below_zenith_ - from), elevation)}, digits);
    // masking's layer along the horizon, and its cone at V = N, rounded over an angle of 1/width
    for (Panel& panel : panels_) panel.layered = true;
  }

  [[nodiscard]] const std::vector<Panel>& panels() const { return panels_; }
  [[nodiscard]] double truncation() const { return 0; }

  struct Line {
    T sine, half_sine;  // of φ and φ/2
    T weight;
  };

  [[nodiscard]] Line line(int, const T& v) const {
    T turn, slope, half_cosine;
    Line ray;
    turn_.at(v, turn, slope);
    sincos_quarter(turn, ray.half_sine, half_cosine);
    ray.sine = 2 * ray.half_sine * half_cosine;
    ray.weight = 2 * pi<T> * slope;
    return ray;
  }

  [[nodiscard]] Sample<T> point(int panel, const Line& ray, const T& u) const {
    const Part& part = parts_[static_cast<std::size_t>(panel)];
    T away, slope;
    part.elevation.at(u, away, slope);
    const T e = T(part.from) + T(part.side) * away;
    const T from_mirror = T(part.from - mirror_) + T(part.side) * away;
    const T to_zenith = T(below_zenith_) - from_mirror;  // 1 − e
    const T rise = from_mirror * (to_zenith + T(below_zenith_));
    const T mu = e * (2 - e);
    const T sine = to_zenith * sqrt(T(1 + mu));
    // L + V, in the plane of incidence (L at azimuth 0) and across
    const T along = rise * (mu + T(cos_l_)) / (T(sin_l_) + sine) + 2 * sine * square(ray.half_sine);
    const T across = -sine * ray.sine;
    const T up = mu + T(cos_l_);
    const T planar2 = square(along) + square(across);
    const T length = sqrt(planar2 + square(up));
    const auto turned = [&](const T& a, const T& b, T& x, T& y) {
      x = a * T(along_x_) - b * T(along_y_);
      y = a * T(along_y_) + b * T(along_x_);
    };
    DirectionPair<T> pair;
    pair.cos_theta_l = T(cos_l_), pair.cos_theta_v = mu;
    turned(T(sin_l_), T(0.0), pair.l_x, pair.l_y);
    turned(T(along - T(sin_l_)), across, pair.v_x, pair.v_y);
    turned(T(along / up), T(across / up), pair.slope_x, pair.slope_y);
    pair.cos_theta_d = length / 2;
    pair.cos_theta_h = up / length;
    pair.axis_gap = (planar2 + square(rise)) / 2;
    return {pair, ray.weight * slope * 2 * to_zenith * mu};
  }

 private:
  /// w sinh(A u), u = 1 at the extent.
  struct Stretch {
    S width, factor;

    void at(const T& u, T& value, T& slope) const {
      const T rise = expm1(T(T(factor) * u));
      value = T(width) * (rise + rise / (1 + rise)) / 2;
      slope = T(width * factor) * (1 + square(rise) / (2 * (1 + rise)));
    }
  };
  struct Part {
    S from, side;  // e of u = 0, and whether e falls (−1) or rises (1) from there
    Stretch elevation;
  };

  void add(const Part& part, double digits) {
    parts_.push_back(part);
    const int order_phi = sin_l_ > 0 ? order(turn_, digits) : 4;
    panels_.push_back({{AxisKind::interval, order(part.elevation, digits)}, {AxisKind::interval, order_phi}});
  }

  static Stretch stretched(const S& extent, const S& width) { return {width, arsinh(S(extent / width))}; }

  /// What is needed, measured.
  static int order(const Stretch& stretch, double digits) {
    return static_cast<int>((10 + 5 * static_cast<double>(stretch.factor)) * (2 + digits) / 10);
  }

  S cos_l_, sin_l_, along_x_, along_y_;
  S mirror_, below_zenith_;  // e of R, and 1 − e
  Stretch turn_;
  std::vector<Part> parts_;
  std::vector<Panel> panels_;
};

}  // namespace albedo
