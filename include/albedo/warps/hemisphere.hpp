#pragma once

#include <algorithm>
#include <array>

#include "albedo/warps/sample.hpp"
#include "albedo/warps/turn.hpp"

namespace albedo {

/// All directions V by their cosine μ = cosθ_V and their azimuth. Diffuse lobes are polynomials in μ; for any other
/// lobe the hemisphere is divided at its axis, and the axis is announced as a feature.
template <class T>
class HemisphereWarp {
  using S = Scalar<T>;

 public:
  HemisphereWarp(const Lobe& lobe, const Direction& l, double tolerance)
      : symmetric_(lobe.shape == LobeShape::cosine || mirror_symmetric(lobe, l)),
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
    if (lobe.shape == LobeShape::cosine) {
      add({S(0), S(1), S(0), S(1)}, {8, 4});
      return;
    }
    const S split = axis_.z > 0 ? S(axis_.z) : S(0);
    const int order = 8 + static_cast<int>(digits);
    for (const S& side : {S(1), S(-1)}) {
      if (split > 0) add({S(0), split, S(0), side}, {order, order});
      if (split < 1) add({split, S(1), S(0), side}, {order, order});
      if (symmetric_) break;
    }
    const double sine = static_cast<double>(planar), cosine = static_cast<double>(axis_.z);
    // A lobe that reaches the horizon, or is elongated, isn't tracked: then nothing is believed.
    const double narrow = std::min(lobe.width_x, lobe.width_y), wide = std::max(lobe.width_x, lobe.width_y);
    const bool grazing = cosine < 0.03 || (cosine < 0.2 && cosine < 4 * wide);
    if (grazing || wide > 4 * narrow) {
      for (Panel& panel : panels_) panel.tracked = false;
      return;
    }
    if (lobe.shape == LobeShape::mirror) {
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
    const T mu = part.mu0 + (part.mu1 - part.mu0) * u;
    const T s = sqrt(T((1 - part.mu0) - (part.mu1 - part.mu0) * u) * (1 + mu));
    const UnitVector<T> v{s * ray.cosine, s * ray.sine, mu};
    return {direction_pair(broadcast<T>(l_), v, broadcast<T>(axis_)), T(part.weight) * mu};
  }

 private:
  struct Part {
    S mu0, mu1, turn0, turn1;  // turns in units of π, from the lobe's azimuth
    S weight = 0;
  };

  void add(Part part, const std::array<int, 2>& orders) {
    using std::abs;
    part.weight = (part.mu1 - part.mu0) * abs(part.turn1 - part.turn0) * pi<T> * (symmetric_ ? 2 : 1);
    const AxisKind kind = symmetric_ ? AxisKind::even_periodic : AxisKind::interval;
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
    const double width_mu = along * (std::abs(sine) + along) / 2;
    const double width_turn = across / (2 * pi<double> * std::max({std::abs(sine), across, 1e-300}));
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const double mu0 = static_cast<double>(parts_[i].mu0), mu1 = static_cast<double>(parts_[i].mu1);
      if (cosine < mu0 || cosine > mu1) continue;
      for (int step = 0; step <= 6; ++step) {  // to three widths aside, or around the zenith
        const double aside = step * width_turn;
        if (aside > 1) break;
        panels_[i].features.push_back(
            {(cosine - mu0) / (mu1 - mu0), sine < 0 ? 1 - aside : aside, width_mu / (mu1 - mu0), width_turn});
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
