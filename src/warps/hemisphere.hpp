#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "warps/sample.hpp"
#include "warps/turn.hpp"

namespace albedo {

/// All directions V by their polar angle and azimuth. For any lobe but a diffuse one the hemisphere is divided at its
/// axis, and the axis is announced as a feature.
///
/// A diffuse lobe with a kink at equal cosines (Oren–Nayar) is divided there and at a quarter turn from L.
template <class T>
class HemisphereWarp {
  using S = Scalar<T>;

 public:
  HemisphereWarp(const Lobe& lobe, const Direction& l, double tolerance)
      : symmetric_(lobe.is<CosineLobe>() || (!lobe.is<HalfAnglesLobe>() && mirror_symmetric(lobe, l))),
        l_(unit_vector<S>(l)),
        axis_(lobe_axis(lobe, l_)) {
    const S planar = sqrt(square(axis_.x) + square(axis_.y));
    const S l_planar = sqrt(square(l_.x) + square(l_.y));
    if (planar > 0) {
      cos_phi_ = axis_.x / planar, sin_phi_ = axis_.y / planar;
    } else if (l_planar > 0) {
      cos_phi_ = -l_.x / l_planar, sin_phi_ = -l_.y / l_planar;
    }
    const double digits = -std::log10(tolerance);
    if (lobe.is<CosineLobe>()) {
      if (lobe.kink_equal_cosines && l_planar > 0) {
        split_at_kinks(digits);
      } else {
        add({S(0), S(1), S(0), S(1)}, {8, 4});
      }
      return;
    }
    using std::atan2;
    const S split = axis_.z > 0 ? S(2 * atan2(planar, axis_.z) / pi<T>) : S(1);
    const int order = 8 + static_cast<int>(digits);
    for (const S& side : {S(1), S(-1)}) {
      if (split < 1) add({split, S(1), S(0), side}, {order, order});
      if (split > 0) add({S(0), split, S(0), side}, {order, order});
      if (symmetric_) break;
    }
    const double sine = static_cast<double>(planar), cosine = static_cast<double>(axis_.z);
    // A lobe that reaches the horizon, or is elongated, isn't tracked: then nothing is believed.
    const auto [narrow, wide] = lobe.widths();
    const bool heavy = lobe.is<SlopeLobe>() && lobe.slopes().profile == Profile::ggx;
    const double reach = heavy ? 100 : 4;  // in widths; a heavy tail is met far out
    const bool grazing = cosine < 0.03 || (cosine < 0.2 && cosine < reach * wide);
    const bool changing = lobe.is<NearMirrorLobe>() && wide < 0.1;  // wider than it says away from N
    const bool unknown = lobe.is<HalfAnglesLobe>();
    if (grazing || changing || unknown || wide > 4 * narrow) {
      for (Panel& panel : panels_) panel.tracked = false;
      return;
    }
    if (lobe.is<MirrorLobe>()) {
      for (int ring = -3; ring <= 3; ++ring) {
        const double theta = std::atan2(sine, cosine) + ring * wide;
        announce(std::sin(theta), std::max(std::cos(theta), 0.0), narrow, narrow);
      }
    } else {
      announce_ridge(wide, narrow, static_cast<double>(l_planar), static_cast<double>(l_.z));
    }
  }

  [[nodiscard]] const std::vector<Panel>& panels() const { return panels_; }
  [[nodiscard]] double truncation() const { return 0; }

  struct Line {
    T cosine, sine;  // of V's azimuth
  };

  [[nodiscard]] Line line(int panel, const T& v) const {
    const Part& part = parts_[static_cast<std::size_t>(panel)];
    T c, s;
    sincos_quarter(T(2 * (part.turn0 + (part.turn1 - part.turn0) * v)), s, c);
    return {cos_phi_ * c - sin_phi_ * s, sin_phi_ * c + cos_phi_ * s};
  }

  [[nodiscard]] Sample<T> point(int panel, const Line& ray, const T& u) const {
    const Part& part = parts_[static_cast<std::size_t>(panel)];
    T cosine, sine;  // from the horizon, where the cosine keeps its digits
    sincos_quarter(T((1 - part.end) + (part.end - part.begin) * (1 - u)), cosine, sine);
    const UnitVector<T> v{sine * ray.cosine, sine * ray.sine, cosine};
    return {direction_pair(broadcast<T>(l_), v, broadcast<T>(axis_)), T(part.weight) * sine * cosine};
  }

 private:
  struct Part {
    S begin, end;    // of the polar angle, in quarter turns
    S turn0, turn1;  // of the azimuth from the lobe's, in units of π
    S weight = 0;
  };

  void split_at_kinks(double digits) {
    using std::atan2;
    const int order = 2 + static_cast<int>(digits);
    const S kink = S(2 * atan2(S(sqrt(square(l_.x) + square(l_.y))), l_.z) / pi<T>);
    for (const auto& [from, to] : {std::pair{S(0), kink}, std::pair{kink, S(1)}}) {
      add({from, to, S(0), S(0.5)}, {order, order});
      add({from, to, S(0.5), S(1)}, {order, order});
    }
  }

  void add(Part part, const std::array<int, 2>& orders) {
    using std::abs;
    part.weight = (part.end - part.begin) * abs(part.turn1 - part.turn0) * square(pi<T>) / (symmetric_ ? 1 : 2);
    const AxisKind kind =
        symmetric_ && abs(part.turn1 - part.turn0) == 1 ? AxisKind::even_periodic : AxisKind::interval;
    parts_.push_back(part);
    panels_.push_back({{AxisKind::interval, orders[0]}, {kind, orders[1]}});
  }

  /// A lobe of half vectors isn't round in V: it is the image of a Gaussian of slopes, narrow in azimuth near the
  /// horizon. Announces it at half vectors in the plane of incidence, out to three widths or to the horizon, and closer
  /// together there.
  void announce_ridge(double wide, double width, double sin_l, double cos_l) {
    constexpr int steps = 24;
    const double rim = -cos_l / (1 + sin_l);  // slope of the half vector whose V is at the horizon
    const double begin = std::max(rim, -3 * wide), end = 3 * wide;
    for (int step = 0; step <= steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      const double slope = begin + (end - begin) * (begin == rim ? share * share * share : share);
      const double cos_h = 1 / std::sqrt(1 + slope * slope);
      const double cos_d = cos_h * (cos_l + sin_l * slope);
      const double cos_v = std::max(2 * cos_d * cos_h - cos_l, 0.0), planar = sin_l - 2 * cos_d * cos_h * slope;
      announce(planar, cos_v, width * cos_h * cos_h, width * cos_d * cos_h);
    }
  }

  /// A feature at polar angle (sine, cosine; sine < 0: on the other side of the zenith) of the given angular widths.
  void announce(double sine, double cosine, double along, double across) {
    const double place = 2 * std::atan2(std::abs(sine), cosine) / pi<double>, width_place = along / pi<double>;
    const double width_turn = across / (2 * pi<double> * std::max({std::abs(sine), across, 1e-300}));
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const double begin = static_cast<double>(parts_[i].begin), end = static_cast<double>(parts_[i].end);
      if (place < begin || place > end) continue;
      for (int step = 0; step <= 6; ++step) {  // to three widths aside, or around the zenith
        const double aside = step * width_turn;
        if (aside > 1) break;
        panels_[i].features.push_back(
            {(place - begin) / (end - begin), sine < 0 ? 1 - aside : aside, width_place / (end - begin), width_turn});
      }
    }
  }

  bool symmetric_;
  UnitVector<S> l_, axis_;
  S cos_phi_ = 1, sin_phi_ = 0;
  std::vector<Part> parts_;
  std::vector<Panel> panels_;
};

}  // namespace albedo
