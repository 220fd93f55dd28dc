#pragma once

#include "warps/ray.hpp"
#include "warps/sample.hpp"
#include "warps/turn.hpp"

namespace albedo {

/// The exact domain of a lobe (A·V)₊^n: polar coordinates (α, β) about its axis A (polar angle θ_A), cosα = exp(−ρ²r²),
/// ρ² = 1/(n+1), so that the lobe falls off like exp(−r²). With h = sinθ_A cosβ,
///
///     cosθ_V = cosθ_A cosα + h sinα,   the horizon (h < 0) is tanα = cosθ_A/|h|,   cosθ_V = cosθ_A is tan(α/2) =
///     tanθ_A cosβ.
///
/// An axis below the horizon (Lafortune, c_z < 0) is allowed: then only β in (−π/2, π/2) is lit, from tanα = |cosθ_A|/h
/// on.
template <class T>
class MirrorLobeWarp {
  using S = Scalar<T>;

 public:
  /// @param tolerance relative; what the lobe has beyond it is left out
  MirrorLobeWarp(const Lobe& lobe, const Direction& l, double tolerance)
      : l_(unit_vector<S>(l)),
        axis_(lobe_axis(lobe, l_)),
        axis_sin_(sqrt(square(axis_.x) + square(axis_.y))),
        rho_(std::get<MirrorLobe>(lobe.shape).width),
        cut_(lobe_cut(tolerance).radius),
        truncation_(lobe_cut(tolerance).truncation),
        turn_(min(S(1), max(S(abs(axis_.z)), S(1e-15)))),
        digits_(-std::log10(tolerance)) {
    const S cos_phi = axis_sin_ > 0 ? S(axis_.x / axis_sin_) : S(1);
    const S sin_phi = axis_sin_ > 0 ? S(axis_.y / axis_sin_) : S(0);
    up_ = {-axis_.z * cos_phi, -axis_.z * sin_phi, axis_sin_};
    across_ = {-sin_phi, cos_phi, S(0)};
    split(lobe);
  }

  [[nodiscard]] const std::vector<Panel>& panels() const { return panels_; }
  [[nodiscard]] double truncation() const { return truncation_; }

  /// What a ray (a fixed β) has in common for all its points.
  struct Line {
    T cosine, sine;  // of β
    T height;        // h
    T horizon_x;     // ρ r at the horizon, where h < 0
    T begin, extent;
    T gap;  // from the panel's end to the horizon, in r
    T weight;
  };

  [[nodiscard]] Line line(int panel, const T& v) const {
    const Part& part = parts_[static_cast<std::size_t>(panel)];
    Line ray;
    T slope;
    turn_.at(T(part.arc.begin + (part.arc.end - part.arc.begin) * v), ray.cosine, ray.sine, slope);
    ray.height = axis_sin_ * ray.cosine;
    const T far = sqrt(T(log1p(square(T(axis_.z / ray.height))) / 2)) / rho_;
    T limit = select(ray.height < T(0), min(far, T(cut_)), T(cut_));
    ray.begin = T(0);
    if (axis_.z <= 0) {
      ray.begin = far;
      limit = sqrt(T(square(far) + square(cut_)));
    }
    if (part.from == Edge::equal_cosines) ray.begin = min(kink(ray), limit);
    const T end = part.to == Edge::equal_cosines ? min(kink(ray), limit) : limit;
    ray.horizon_x = select(ray.height < T(0), T(far * rho_), T(1));
    ray.gap = select(ray.height < T(0), T(far - end), T(0));
    ray.extent = end - ray.begin;
    ray.weight = slope * ray.extent * (turn_.quarter() * (part.arc.end - part.arc.begin) * 4 * square(rho_));
    return ray;
  }

  [[nodiscard]] Sample<T> point(int, const Line& ray, const T& u) const {
    const T r = ray.begin + ray.extent * u;
    const T x = rho_ * r;
    const T x2 = square(x);
    const T axis_gap = -expm1(-x2);
    const T cosine = exp(-x2);
    const T sine = sqrt(axis_gap * (1 + cosine));
    const T plain = axis_.z * cosine + ray.height * sine;
    // towards the horizon, cos²α − cos²α_h (and with it cosθ_V) from the distance to the end of the ray
    const T to_horizon = ray.gap + ray.extent * (1 - u);
    const T drop = abs(ray.height);
    const T exact =
        square(drop) * expm1(T(2 * rho_ * to_horizon * (ray.horizon_x + x))) / (axis_.z * cosine + drop * sine);
    const T cos_v = select(ray.height < T(0), exact, plain);
    const T to_up = sine * ray.cosine, to_side = sine * ray.sine;
    const UnitVector<T> v{axis_.x * cosine + up_.x * to_up + across_.x * to_side,
                          axis_.y * cosine + up_.y * to_up + across_.y * to_side, cos_v};
    Sample<T> sample{direction_pair(broadcast<T>(l_), v, v), ray.weight * cosine * r * cos_v};
    sample.pair.axis_gap = axis_gap;
    return sample;
  }

 private:
  enum class Edge { origin, equal_cosines, rim };
  struct Part {
    Arc<S> arc;
    Edge from, to;
  };

  /// r where cosθ_V = cosθ_A: α = 2δ, or none (infinity) for tanδ ≥ 1
  [[nodiscard]] T kink(const Line& ray) const {
    const T tan2 = square(T(max(ray.cosine, T(0)) * (axis_sin_ / axis_.z)));
    const T inside = min(T(2 * tan2 / (1 + tan2)), T(1 - 1e-14));  // 1 − cos2δ
    return sqrt(-log1p(-inside)) / rho_;
  }

  void split(const Lobe& lobe) {
    if (axis_.z <= 0) {
      if (axis_sin_ == 0) return;  // straight down: nothing of the lobe is above the horizon
      add({S(0), S(1)}, Edge::origin, Edge::rim);
      return;
    }
    // the horizon's edge begins where the lobe ends; with a small exponent the lobe is not small there, and has a kink
    const bool wide = 1 / square(static_cast<double>(rho_)) < 3 + 2 * digits_;
    const S tangent = axis_sin_ / axis_.z;
    if (lobe.kink_equal_cosines && tangent > 0) {
      using std::acos;
      using std::tan;
      const S reach = tan(acos(exp(-square(rho_ * cut_))) / 2) / tangent;
      const S begin = reach < S(0.8) ? turn_.fraction(reach) : S(0);
      if (begin > 0) add({S(0), begin}, Edge::origin, Edge::rim);
      add({begin, S(1)}, Edge::origin, Edge::equal_cosines);
      add({begin, S(1)}, Edge::equal_cosines, Edge::rim);
      add({S(1), S(2)}, Edge::origin, Edge::rim);
    } else if (wide && tangent > 0) {
      add({S(0), S(1)}, Edge::origin, Edge::rim);
      add({S(1), S(2)}, Edge::origin, Edge::rim);
    } else {
      add({S(0), S(2)}, Edge::origin, Edge::rim);
    }
  }

  void add(const Arc<S>& arc, Edge from, Edge to) {
    parts_.push_back({arc, from, to});
    const double extent = static_cast<double>(arc.end - arc.begin);
    const AxisKind kind = extent == 2 ? AxisKind::even_periodic : AxisKind::interval;
    // where the lobe ends by itself, everywhere on the arc: its nearest horizon is at the arc's end
    const double nearest = extent_to_horizon(arc.end);
    const bool divided = from == Edge::equal_cosines || to == Edge::equal_cosines;
    const double exponent = 1 / square(static_cast<double>(rho_));
    const double nodes = from == Edge::equal_cosines ? 1.35 : exponent < 4 ? 2 : 1.55;  // a digit
    Axis radial{AxisKind::interval, static_cast<int>(nodes * (2 + digits_))};
    if (std::is_same_v<T, Block> && axis_.z > 0 && !divided && nearest > gaussian_reach && exponent > 4) {
      radial = {AxisKind::gaussian, exponent < 16 ? 8 : 5, static_cast<double>(cut_)};
    }
    int order = turn_.order(kind, extent, digits_, 1.2);
    if (kind == AxisKind::interval) order += static_cast<int>(0.4 * digits_);
    if (axis_sin_ == 0 && kind != AxisKind::interval) order = 2;  // all rays are the same
    panels_.push_back({radial, {kind, divided ? std::max(order, static_cast<int>(1.65 * digits_)) : order}, {}});
  }

  /// r of the horizon at x = f K.
  [[nodiscard]] double extent_to_horizon(const S& f) const {
    S cosine, sine, slope;
    turn_.at(f, cosine, sine, slope);
    const S height = axis_sin_ * cosine;
    if (f <= 1 || !(height < 0)) return 1e9;
    return static_cast<double>(sqrt(S(log1p(square(S(axis_.z / height))) / 2)) / rho_);
  }

  UnitVector<S> l_, axis_;
  S axis_sin_, rho_, cut_;
  double truncation_;
  Turn<S> turn_;
  double digits_;
  UnitVector<S> up_{}, across_{};
  std::vector<Part> parts_;
  std::vector<Panel> panels_;
};

}  // namespace albedo
