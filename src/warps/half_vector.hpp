#pragma once

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "warps/ray.hpp"
#include "warps/sample.hpp"
#include "warps/turn.hpp"

namespace albedo {

/// The exact domain of a half-vector lobe, in polar coordinates (r, ψ) of its own slopes:
///
///     slope_H = τ/ρ (α_x cosψ, α_y sinψ),   ρ(ψ)² = α_x² cos²ψ + α_y² sin²ψ,   τ = tanθ_H
///     τ = ρ r  (gaussian, ggx)   or   1 + τ² = exp(2ρ²r²)  (power: cosθ_H = exp(−ρ²r²))
///
/// so that a lobe falls off with r like exp(−r²) or (1 + r²)^−2, whatever its roughness. With b = tanθ_L (cosφ along
/// the ray)·ρ and q = √(b² + ρ²), V is above the horizon for τ < (b + q)/ρ, the ray's edges (design: linear in angles)
/// are elementary, and
///
///     cosθ_V = cos²θ_H cosθ_L (τ_e − τ)(τ + 1/τ_e),   L·H = cosθ_H cosθ_L (1 + bτ/ρ)
///
/// have no cancellation when τ_e − τ is taken from the distance to the end of the ray.
template <class T>
class HalfVectorWarp {
  using S = Scalar<T>;

 public:
  /// @param tolerance relative; what a Gaussian or power lobe has beyond it is left out
  HalfVectorWarp(const Lobe& lobe, const Direction& l, double tolerance)
      : profile_(lobe.slopes().profile),
        symmetric_(mirror_symmetric(lobe, l)),
        turning_(lobe.horizon_layer && lobe.slopes().width_x != lobe.slopes().width_y),
        alpha_x_(lobe.slopes().width_x),
        alpha_y_(lobe.slopes().width_y),
        l_(unit_vector<S>(l)),
        axis_(lobe_axis(lobe, l_)),
        turn_(make_turn(lobe, l)) {
    const Cut cut = profile_ == Profile::ggx ? Cut{1e250, 0} : lobe_cut(tolerance, lobe.growth);
    cut_ = cut.radius;
    truncation_ = cut.truncation;
    widest_ = lobe.slopes().width_x > lobe.slopes().width_y ? S(alpha_x_) : S(alpha_y_);
    cut_tau_ = tau_of_radius(cut_ * widest_);
    stretch_ = profile_ == Profile::ggx || (profile_ == Profile::gaussian && widest_ * cut_ > 2);
    horizon_exponent_ = lobe.horizon_exponent;
    horizon_layer_ = lobe.horizon_layer && lobe.widths().narrow < 0.3;
    // Smith's Λ has a cone at V = N, rounded over an angle of 1/α: a point inside the domain of wide lobes
    const double widest = lobe.widths().wide;
    const bool cone = lobe.horizon_layer && widest >= (profile_ == Profile::ggx ? 1.5 : 0.3);
    rough_ = cone || turning_;
    digits_ = -std::log10(tolerance);
    split(lobe);
  }

  [[nodiscard]] const std::vector<Panel>& panels() const { return panels_; }
  [[nodiscard]] double truncation() const { return truncation_; }

  /// What a ray (a fixed azimuth) has in common for all its points.
  struct Line {
    T slope_x, slope_y;     // of the half vector, per unit of τ/ρ
    T rho, inverse_rho, b;  // b/ρ = tanδ
    T horizon;              // τ_e
    T inverse_horizon;
    T begin, extent, end;  // of r, or of arsinh(r/scale) where stretched
    T scale;
    T gap;        // from the panel's end to the horizon, in r
    T horizon_x;  // power: ρ r_e
    T weight;
  };

  [[nodiscard]] Line line(int panel, const T& v) const {
    const Part& part = parts_[static_cast<std::size_t>(panel)];
    T cosine, sine, slope;
    turn_.at(T(part.arc.begin + (part.arc.end - part.arc.begin) * v), cosine, sine, slope);
    // relative to the projection of L, then in the axes of the roughness
    const T along = cosine * offset_cos_ - sine * offset_sin_;
    const T across = sine * offset_cos_ + cosine * offset_sin_;
    Line ray;
    ray.slope_x = alpha_x_ * (along * axis_cos_ - across * axis_sin_);
    ray.slope_y = alpha_y_ * (along * axis_sin_ + across * axis_cos_);
    const T rho2 = square(ray.slope_x) + square(ray.slope_y);
    ray.rho = sqrt(rho2);
    ray.inverse_rho = 1 / ray.rho;
    ray.b = tan_alpha_ * along * ray.inverse_rho;
    const T q = sqrt(square(ray.b) + 1);
    const T larger = abs(ray.b) + q, smaller = 1 / larger;
    ray.horizon = select(ray.b > T(0), larger, smaller);
    ray.inverse_horizon = select(ray.b > T(0), smaller, larger);
    const T far = radius(ray, ray.horizon);
    ray.horizon_x = far * ray.rho;
    const T limit = min(far, T(cut_));
    const T begin = part.from == Edge::origin ? T(0) : min(radius(ray, edge(ray, part.from)), limit);
    const T end = part.to == Edge::rim ? limit : min(radius(ray, edge(ray, part.to)), limit);
    ray.gap = part.to == Edge::rim ? T(far - limit) : T(far - end);
    if (stretch_) {
      ray.scale = profile_ == Profile::ggx ? min(T(1), ray.inverse_rho) : ray.inverse_rho;
      ray.begin = arsinh(T(begin / ray.scale));
      ray.end = arsinh(T(end / ray.scale));
    } else {
      ray.scale = T(1);
      ray.begin = begin;
      ray.end = end;
    }
    ray.extent = ray.end - ray.begin;
    ray.weight = slope * ray.extent *
                 (turn_.quarter() * (part.arc.end - part.arc.begin) * (4 * alpha_x_ * alpha_y_) * (symmetric_ ? 2 : 1));
    return ray;
  }

  [[nodiscard]] Sample<T> point(int panel, const Line& ray, const T& u) const {
    const Part& part = parts_[static_cast<std::size_t>(panel)];
    T g, complement, slope;
    part.ends.at(u, g, complement, slope);
    T r = ray.begin + ray.extent * g;
    T to_horizon = ray.gap;
    if (stretch_) {
      const T rise = expm1(r);
      const T fall = expm1(T(ray.extent * complement / 2));
      const T per_rise = 1 / (1 + rise), per_fall = 1 / (1 + fall);
      // r_end − r = 2 scale cosh(y_mid) sinh(y_mid − y), where y_mid is halfway to the end
      const T twice_cosh = (1 + rise) * (1 + fall) + per_rise * per_fall;
      to_horizon += ray.scale * twice_cosh * (fall + fall * per_fall) / 2;
      slope = slope * ray.scale * (1 + square(rise) * per_rise / 2);
      r = ray.scale * (rise + rise * per_rise) / 2;
    } else {
      to_horizon += ray.extent * complement;
    }
    const T x = ray.rho * r;
    T tau, tau2, to_rim, area;
    if (profile_ == Profile::power) {
      const T grown = expm1(T(2 * square(x)));
      tau2 = grown;
      tau = sqrt(grown);
      area = 2 * (1 + grown);
      to_rim = (1 + grown) * expm1(T(2 * ray.rho * to_horizon * (ray.horizon_x + x))) / (ray.horizon + tau);
    } else {
      tau = x;
      tau2 = square(x);
      area = T(1);
      to_rim = ray.rho * to_horizon;
    }
    const T cos2_h = 1 / (1 + tau2);
    const T cos_h = sqrt(cos2_h);
    const T cos_d = cos_h * l_.z * (1 + ray.b * tau);
    const T cos_v = cos2_h * l_.z * to_rim * (tau + ray.inverse_horizon);
    const T per_tau = tau * ray.inverse_rho;
    const T slope_x = ray.slope_x * per_tau;
    const T slope_y = ray.slope_y * per_tau;
    const T reach = 2 * cos_d * cos_h;  // V = 2 (L·H) H − L
    const T v_x = reach * slope_x - l_.x;
    const T v_y = reach * slope_y - l_.y;
    const T axis_gap = (square(T(axis_.x - v_x)) + square(T(axis_.y - v_y)) + square(T(axis_.z - cos_v))) / 2;
    return {{T(l_.z), cos_v, T(l_.x), T(l_.y), v_x, v_y, cos_d, cos_h, slope_x, slope_y, axis_gap},
            ray.weight * slope * r * area * cos_d * cos_h * cos2_h * cos_v};
  }

 private:
  /// Where a ray is divided.
  enum class Edge {
    origin,         // H = N
    equal_cosines,  // cosθ_V = cosθ_L: t = δ
    cavity_light,   // V-cavity, the light's side: t = π/2 − δ
    cavity_viewer,  // V-cavity, the viewer's side: t = π/6 + δ/3
    rim,            // the horizon, or where the lobe has ended
  };
  inline static const std::vector<Edge> whole_ray{Edge::origin, Edge::rim};
  struct Part {
    Arc<S> arc;
    Edge from, to;
    EndMap ends;
  };

  Turn<S> make_turn(const Lobe& lobe, const Direction& l) {
    S cos_theta, sin_theta, cos_phi, sin_phi;
    polar_angle(l, cos_theta, sin_theta);
    azimuth(l, cos_phi, sin_phi);
    const S tangent = sin_theta / cos_theta;
    const S gx = alpha_x_ * cos_phi, gy = alpha_y_ * sin_phi;
    const S g = sqrt(gx * gx + gy * gy);
    tan_alpha_ = tangent * g;
    axis_cos_ = gx / g;
    axis_sin_ = gy / g;
    // the quadratic form b² + ρ² in the axes along and across the projection of L
    const S x2 = square(alpha_x_), y2 = square(alpha_y_);
    const S m11 = x2 * square(axis_cos_) + y2 * square(axis_sin_) + square(tan_alpha_);
    const S m22 = x2 * square(axis_sin_) + y2 * square(axis_cos_);
    const S m12 = (y2 - x2) * axis_cos_ * axis_sin_;
    const S half = (m11 - m22) / 2;
    const S root = sqrt(half * half + m12 * m12);
    const S largest = (m11 + m22) / 2 + root;
    const S ratio = alpha_x_ * alpha_y_ * sqrt(1 + square(tangent)) / largest;  // √(smallest/largest)
    offset_cos_ = 1;
    offset_sin_ = 0;
    const bool kinked = lobe.kink_equal_cosines || lobe.kink_v_cavity;  // then ±K must stay where cosφ = 0
    if (!kinked && root > 0 && lobe.slopes().width_x != lobe.slopes().width_y) {
      const S cos_2 = half / root;  // of twice the angle to the form's larger axis
      const S larger = sqrt((1 + abs(cos_2)) / 2), smaller = abs(m12 / root) / (2 * larger);
      offset_cos_ = cos_2 >= 0 ? larger : smaller;
      offset_sin_ = cos_2 >= 0 ? smaller : larger;
      if (m12 < 0) offset_sin_ = -offset_sin_;
    }
    return Turn<S>(min(ratio, S(1)));
  }

  /// τ(ρr)
  [[nodiscard]] S tau_of_radius(const S& x) const {
    return profile_ == Profile::power ? S(sqrt(expm1(S(2 * x * x)))) : x;
  }
  /// r of τ on a ray
  [[nodiscard]] T radius(const Line& ray, const T& tau) const {
    return ray.inverse_rho * (profile_ == Profile::power ? T(sqrt(T(log1p(square(tau)) / 2))) : tau);
  }
  /// tan(π/6 + arctan(x)/3), in terms of arctan(1/|x|), which keeps digits for x → −∞.
  [[nodiscard]] static T tan_of_third(const T& x) {
    using std::atan;
    const T third = atan(T(1 / max(T(abs(x)), T(1e-30)))) * (2 / (3 * pi<T>));  // in quarter turns
    T sine, cosine;
    sincos_quarter(select(x < T(0), third, T(Scalar<T>(2) / 3 - third)), sine, cosine);
    return sine / cosine;
  }
  [[nodiscard]] T edge(const Line& ray, Edge which) const {
    switch (which) {
      case Edge::origin:
        return T(0);
      case Edge::equal_cosines:
        return max(ray.b, T(0));
      case Edge::cavity_light:
        return 1 / max(ray.b, T(1e-30));
      case Edge::cavity_viewer:
        return tan_of_third(ray.b);
      case Edge::rim:
        break;
    }
    return ray.horizon;
  }

  /// Divides the turn where edges enter or leave the lobe, and its rays at the edges.
  void split(const Lobe& lobe) {
    const S tangent = sqrt(square(l_.x) + square(l_.y)) / l_.z;
    if (lobe.kink_v_cavity) {
      split_cavity(tangent);
    } else if (lobe.kink_equal_cosines && tangent > 0) {
      split_equal_cosines();
    } else if (symmetric_ && offset_sin_ != 0 && tangent > 0) {
      add({S(-1), S(1)}, whole_ray);  // the form's larger axis is across the plane of incidence, a quarter turn off
    } else {
      add_whole({S(0), S(2)}, whole_ray);
    }
  }

  /// The edge t = δ exists for δ > 0, from r = 0 at δ = 0 on; where it is beyond the lobe's end it is left out.
  void split_equal_cosines() {
    static const std::vector<Edge> divided{Edge::origin, Edge::equal_cosines, Edge::rim};
    for (const int side : {1, -1}) {
      if (side < 0 && symmetric_) break;
      const std::vector<S> borders = edge_borders(side);
      for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
        const S begin = side * borders[i], end = side * borders[i + 1];
        const bool inside = edge_margin((begin + end) / 2) > 0;
        add(side > 0 ? Arc<S>{begin, end} : Arc<S>{end, begin}, inside ? divided : whole_ray);
      }
    }
    add_whole({S(1), S(2)}, whole_ray);
  }

  /// 0, where |x| ≤ K has the edge t = δ enter or leave the lobe, and 1.
  [[nodiscard]] std::vector<S> edge_borders(int side) const {
    std::vector<S> borders{S(0)};
    if (alpha_x_ == alpha_y_) {
      const S cosine = alpha_x_ * tau_of_radius(alpha_x_ * cut_) / tan_alpha_;
      if (cosine < 1) borders.push_back(turn_.fraction(cosine));
    } else {
      static constexpr int steps = 24;
      S before = edge_margin(S(0));
      for (int i = 0; i < steps; ++i) {
        // closer together near ±K, where the edge is short
        const auto place = [](int k) { return S(1 - square(square(S(steps - k) / steps))); };
        const S after = edge_margin(side * place(i + 1));
        if ((before > 0) != (after > 0)) {
          std::uintmax_t most = 60;
          const auto border = boost::math::tools::toms748_solve([&](const S& f) { return edge_margin(side * f); },
                                                                place(i), place(i + 1), before, after,
                                                                boost::math::tools::eps_tolerance<S>(52), most);
          borders.push_back((border.first + border.second) / 2);
        }
        before = after;
      }
    }
    borders.push_back(S(1));
    return borders;
  }

  /// How far within the lobe the edge t = δ is at x = f K.
  [[nodiscard]] S edge_margin(const S& f) const {
    S cosine, sine, slope;
    turn_.at(f, cosine, sine, slope);
    const S x = alpha_x_ * (cosine * axis_cos_ - sine * axis_sin_),
            y = alpha_y_ * (cosine * axis_sin_ + sine * axis_cos_);
    const S rho = sqrt(square(x) + square(y));
    return rho * tau_of_radius(rho * cut_) - tan_alpha_ * cosine;
  }

  /// An isotropic lobe's sectors, from cosφ = 1 down.
  void split_cavity(const S& tangent) {
    using std::atan;
    using std::tan;
    S begin = 0;
    const auto down_to = [&](const S& cosine, const std::vector<Edge>& edges) {
      const S end = cosine <= -1 ? S(2) : cosine >= 1 ? S(0) : turn_.fraction(cosine);
      if (!(end > begin)) return;
      add_whole({begin, end}, edges);
      begin = end;
    };
    const S reach = cut_tau_;
    if (reach >= 1) {
      if (tangent > 1) down_to(1 / tangent, {Edge::origin, Edge::cavity_light, Edge::equal_cosines, Edge::rim});
      down_to(S(-1), {Edge::origin, Edge::cavity_viewer, Edge::rim});
      return;
    }
    if (reach * tangent > 1) down_to(1 / (reach * tangent), {Edge::origin, Edge::cavity_light, Edge::rim});
    const S farthest =
        tan(S(3 * atan(reach) - boost::math::constants::half_pi<S>()));  // tanδ of the edge that meets the end
    const S enters = tangent > 0 ? S(farthest / tangent) : S(farthest > 0 ? 2 : -2);
    down_to(max(enters, S(-1)), whole_ray);
    down_to(S(-1), {Edge::origin, Edge::cavity_viewer, Edge::rim});
  }

  /// An arc of the half turn, on both sides of the plane of incidence unless they are the same.
  void add_whole(const Arc<S>& arc, const std::vector<Edge>& edges) {
    for (const Arc<S>& part : symmetric_ ? std::vector<Arc<S>>{arc} : whole_turn(arc)) add(part, edges);
  }

  void add(const Arc<S>& arc, const std::vector<Edge>& edges) {
    const double nearest =
        static_cast<double>(1 / (sqrt(square(widest_) + square(tan_alpha_)) + tan_alpha_));  // bounds r_e and 1/r_e′
    const bool fractional = horizon_exponent_ != std::floor(horizon_exponent_);
    const bool half_integer = 2 * horizon_exponent_ == std::floor(2 * horizon_exponent_);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      EndMap ends;
      if (fractional && edges[i + 1] == Edge::rim && nearest < static_cast<double>(cut_)) {
        ends.right = half_integer ? 2 : std::max(3.0, 3 / (horizon_exponent_ + 1));
      }
      if (fractional && edges[i] == Edge::origin && nearest < 0.5) ends.left = half_integer ? 2 : 3;
      if (horizon_layer_ && edges[i + 1] == Edge::rim) ends.right = 3;
      parts_.push_back({arc, edges[i], edges[i + 1], ends});
      const double extent = static_cast<double>(arc.end - arc.begin);
      const AxisKind kind = extent == 4.0                 ? AxisKind::periodic
                            : symmetric_ && extent == 2.0 ? AxisKind::even_periodic
                                                          : AxisKind::interval;
      const Reach reached = reach(static_cast<int>(parts_.size()) - 1);
      Axis radial{AxisKind::interval, radial_order(ends, edges, i, reached.longest)};
      const bool ends_by_itself = profile_ != Profile::ggx && !stretch_ && reached.horizon > gaussian_reach;
      if (std::is_same_v<T, Block> && edges.size() == 2 && ends_by_itself) {
        parts_.back().ends = {};
        radial = {AxisKind::gaussian, 5, static_cast<double>(cut_)};
      }
      panels_.push_back({radial, {kind, azimuth_order(kind, extent, edges.size() > 2)}, {}});
      panels_.back().layered = rough_;
      panels_.back().turning = turning_;
    }
  }

  /// What a part's rays have between them: the r at which the first meets the horizon, and the longest's length.
  struct Reach {
    double horizon = std::numeric_limits<double>::infinity(), longest = 0;

    void include(double far, double extent) { horizon = std::min(horizon, far), longest = std::max(longest, extent); }
  };

  /// Looks at eight rays, the first and the last among them.
  [[nodiscard]] Reach reach(int part) const {
    constexpr int rays = block_width;
    const auto place = [](int i) { return static_cast<double>(i) / (rays - 1); };
    Reach result;
    if constexpr (std::is_same_v<T, Block>) {
      const Line ray = line(part, Block::generate(place));
      const Block far = ray.horizon_x * ray.inverse_rho;
      for (int i = 0; i < rays; ++i) result.include(far[i], ray.extent[i]);
    } else {
      for (int i = 0; i < rays; ++i) {
        const Line ray = line(part, T(place(i)));
        result.include(static_cast<double>(T(ray.horizon_x * ray.inverse_rho)), static_cast<double>(ray.extent));
      }
    }
    return result;
  }

  /// Beside the turn's own length: an edge that enters the lobe does so like exp(−r²).
  [[nodiscard]] int azimuth_order(AxisKind kind, double extent, bool edged) const {
    if (l_.z == 1 && alpha_x_ == alpha_y_) return kind == AxisKind::interval ? 4 : 2;  // all rays are the same
    int order = turn_.order(kind, extent, digits_, 1.2);
    // masking turns with the viewer's azimuth, faster than the lobe's own shape; slopes above 1 bring L near the
    // facets' planes
    if (horizon_layer_ && turning_) order = profile_ == Profile::ggx ? 3 * order : order + order / 2;
    if (profile_ == Profile::ggx && widest_ > 1.5) order += 2 * static_cast<int>(digits_);
    if (horizon_exponent_ < 0) order += order / 2;
    if (kind == AxisKind::interval) order += static_cast<int>(0.4 * digits_);
    return std::min(edged ? std::max(order, static_cast<int>(1.65 * digits_)) : order, 128);
  }

  /// What is needed at eight digits on a part from edge `begin` on, measured.
  [[nodiscard]] int radial_order(const EndMap& ends, const std::vector<Edge>& edges, std::size_t begin,
                                 double longest) const {
    double nodes = 15.5;
    const double grazing = -std::log(static_cast<double>(l_.z));
    if (profile_ == Profile::ggx) {  // the tail's length, in decades
      const double decades = std::asinh(1 / static_cast<double>(min(alpha_x_, alpha_y_)));
      nodes = (horizon_layer_ ? 15 + 3.2 * decades : 8.5 + 3.8 * decades) + 2.6 * grazing + (widest_ > 1.5 ? 28 : 0);
      if (alpha_x_ != alpha_y_) nodes *= turning_ ? 1.2 : 1.4;
    } else if (ends.left > 1 || ends.right > 1) {
      nodes = ends.right > 1 && ends.right != 2 ? 31 : ends.left > 1 ? 26 : 21;
    } else if (begin > 0) {
      nodes = edges[begin] == Edge::cavity_light ? 18 : edges[begin] == Edge::equal_cosines ? 13.5 : 11.5;
    } else if (edges.size() > 2) {
      nodes = grazing > 1.5 ? 15 : 13.5;
    }
    if (turning_ && profile_ != Profile::ggx) nodes *= 1.3;
    if (!stretch_) nodes *= (7 + 1.6 * longest) / 15;  // a whole lobe is 5 long
    return static_cast<int>(nodes * (2 + digits_) / 10);
  }

  Profile profile_;
  bool symmetric_;
  bool turning_;  // masking that depends on the viewer's azimuth
  bool stretch_ = false;
  S alpha_x_, alpha_y_, widest_;
  UnitVector<S> l_;
  UnitVector<S> axis_;
  S tan_alpha_, axis_cos_, axis_sin_, offset_cos_, offset_sin_;  // set by make_turn
  Turn<S> turn_;
  S cut_, cut_tau_;
  double truncation_ = 0;
  double horizon_exponent_ = 1;
  bool horizon_layer_ = false;
  bool rough_ = false;
  double digits_ = 8;
  std::vector<Part> parts_;
  std::vector<Panel> panels_;
};

}  // namespace albedo
