#pragma once

#include <cmath>

#include "warps/sample.hpp"
#include "warps/turn.hpp"

namespace albedo {

/// All directions V by their half vector's polar angle t and its azimuth φ from that of L, as tables of measurements
/// have them. With A² = cos²θ_L + sin²θ_L cos²φ, the horizon is at tan t₁ = (A + sinθ_L cosφ)/cosθ_L, and
///
///     t = t₁ u²,   L·H = A sin(2t₁ − t),   cosθ_V = A sin(2(t₁ − t)),   dω_V = 4 L·H sin t dt dφ
///
/// Nothing but the horizon is followed: what a table has inside is left to the rule, told so by Panel::layered.
template <class T>
class HalfAnglesWarp {
  using S = Scalar<T>;

 public:
  HalfAnglesWarp(const Lobe& lobe, const Direction& l, double /*tolerance*/) : l_(unit_vector<S>(l)) {
    polar_angle(l, cos_l_, sin_l_);
    azimuth(l, cos_phi_, sin_phi_);
    axis_ = lobe_axis(lobe, l_);
    constexpr int order = 12;
    for (int i = 0; i < parts * parts; ++i) {
      panels_.push_back({{AxisKind::interval, order}, {AxisKind::interval, order}});
      panels_.back().layered = true;
    }
  }

  [[nodiscard]] const std::vector<Panel>& panels() const { return panels_; }
  [[nodiscard]] double truncation() const { return 0; }

  struct Line {
    T cosine, sine;  // of φ
    T size;          // A
    T last;          // t₁, in quarter turns
  };

  [[nodiscard]] Line line(int panel, const T& v) const {
    using std::atan;
    Line ray;
    sincos_quarter(T(4 * (T(S(panel / parts)) + v) / S(parts) - 2), ray.sine, ray.cosine);
    const T along = T(sin_l_) * ray.cosine;
    const T distance = T(abs(along));
    ray.size = sqrt(T(square(T(cos_l_)) + square(along)));
    // t₁ on the side away from L is small at grazing incidence: there it isn't a difference
    const T steep = atan(T(T(cos_l_) / (ray.size + distance))) * 2 / pi<T>;
    ray.last = select(along > T(0), T(1 - steep), steep);
    return ray;
  }

  [[nodiscard]] Sample<T> point(int panel, const Line& ray, const T& u) const {
    const T place = (T(S(panel % parts)) + u) / S(parts), rest = (T(S(parts - 1 - panel % parts)) + (1 - u)) / S(parts);
    const T t = ray.last * square(place), left = ray.last * rest * (1 + place);
    T cos_t, sin_t, ahead, unused, above;
    sincos_quarter(t, sin_t, cos_t);
    sincos_quarter(T(ray.last + left), ahead, unused);
    sincos_quarter(T(2 * left), above, unused);
    const T cos_d = ray.size * ahead;
    const auto turned = [&](const T& a, const T& b, T& x, T& y) {
      x = a * T(cos_phi_) - b * T(sin_phi_);
      y = a * T(sin_phi_) + b * T(cos_phi_);
    };
    DirectionPair<T> pair;
    pair.cos_theta_l = T(cos_l_), pair.cos_theta_v = ray.size * above;
    pair.l_x = T(l_.x), pair.l_y = T(l_.y);
    const T planar = 2 * cos_d * sin_t;
    turned(T(planar * ray.cosine - T(sin_l_)), T(planar * ray.sine), pair.v_x, pair.v_y);
    const T slope = sin_t / cos_t;
    turned(T(slope * ray.cosine), T(slope * ray.sine), pair.slope_x, pair.slope_y);
    pair.cos_theta_d = cos_d;
    pair.cos_theta_h = cos_t;
    pair.axis_gap = gap(broadcast<T>(axis_), {pair.v_x, pair.v_y, pair.cos_theta_v});
    const T jacobian = 4 * cos_d * sin_t * (pi<T> * ray.last * place / S(parts)) * (2 * pi<T> / S(parts));
    return {pair, pair.cos_theta_v * jacobian};
  }

 private:
  static constexpr int parts = 4;  // of both axes: a rule begins with some points everywhere

  UnitVector<S> l_, axis_;
  S cos_l_, sin_l_, cos_phi_, sin_phi_;
  std::vector<Panel> panels_;
};

}  // namespace albedo
