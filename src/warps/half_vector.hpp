#pragma once

#include <cmath>
#include <limits>

#include "warps/half_vector_frame.hpp"
#include "warps/half_vector_orders.hpp"
#include "warps/half_vector_sectors.hpp"

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
      : frame_(lobe, l, tolerance), axis_(lobe_axis(lobe, frame_.l)) {
    const auto add_sector = [this](const Arc<S>& arc, const HalfVectorEdges& edges) { add(arc, edges); };
    HalfVectorSectors<S, decltype(add_sector)>(frame_, lobe, add_sector);
  }

  [[nodiscard]] const std::vector<Panel>& panels() const { return panels_; }
  [[nodiscard]] double truncation() const { return frame_.truncation; }

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
    frame_.turn.at(T(part.arc.begin + (part.arc.end - part.arc.begin) * v), cosine, sine, slope);
    // relative to the projection of L, then in the axes of the roughness
    const T along = cosine * frame_.offset_cos - sine * frame_.offset_sin;
    const T across = sine * frame_.offset_cos + cosine * frame_.offset_sin;
    Line ray;
    ray.slope_x = frame_.alpha_x * (along * frame_.axis_cos - across * frame_.axis_sin);
    ray.slope_y = frame_.alpha_y * (along * frame_.axis_sin + across * frame_.axis_cos);
    const T rho2 = square(ray.slope_x) + square(ray.slope_y);
    ray.rho = sqrt(rho2);
    ray.inverse_rho = 1 / ray.rho;
    ray.b = frame_.tan_alpha * along * ray.inverse_rho;
    const T q = sqrt(square(ray.b) + 1);
    const T larger = abs(ray.b) + q, smaller = 1 / larger;
    ray.horizon = select(ray.b > T(0), larger, smaller);
    ray.inverse_horizon = select(ray.b > T(0), smaller, larger);
    const T far = radius(ray, ray.horizon);
    ray.horizon_x = far * ray.rho;
    const T limit = min(far, T(frame_.cut));
    const T begin = part.from == Edge::origin ? T(0) : min(radius(ray, edge(ray, part.from)), limit);
    const T end = part.to == Edge::rim ? limit : min(radius(ray, edge(ray, part.to)), limit);
    ray.gap = part.to == Edge::rim ? T(far - limit) : T(far - end);
    if (frame_.stretch) {
      ray.scale = frame_.profile == Profile::ggx ? min(T(1), ray.inverse_rho) : ray.inverse_rho;
      ray.begin = arsinh(T(begin / ray.scale));
      ray.end = arsinh(T(end / ray.scale));
    } else {
      ray.scale = T(1);
      ray.begin = begin;
      ray.end = end;
    }
    ray.extent = ray.end - ray.begin;
    ray.weight = slope * ray.extent *
                 (frame_.turn.quarter() * (part.arc.end - part.arc.begin) * (4 * frame_.alpha_x * frame_.alpha_y) *
                  (frame_.symmetric ? 2 : 1));
    return ray;
  }

  [[nodiscard]] Sample<T> point(int panel, const Line& ray, const T& u) const {
    const Part& part = parts_[static_cast<std::size_t>(panel)];
    T g, complement, slope;
    part.ends.at(u, g, complement, slope);
    T r = ray.begin + ray.extent * g;
    T to_horizon = ray.gap;
    if (frame_.stretch) {
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
    if (frame_.profile == Profile::power) {
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
    const T cos_d = cos_h * frame_.l.z * (1 + ray.b * tau);
    const T cos_v = cos2_h * frame_.l.z * to_rim * (tau + ray.inverse_horizon);
    const T per_tau = tau * ray.inverse_rho;
    const T slope_x = ray.slope_x * per_tau;
    const T slope_y = ray.slope_y * per_tau;
    const T reach = 2 * cos_d * cos_h;  // V = 2 (L·H) H − L
    const T v_x = reach * slope_x - frame_.l.x;
    const T v_y = reach * slope_y - frame_.l.y;
    const T axis_gap = (square(T(axis_.x - v_x)) + square(T(axis_.y - v_y)) + square(T(axis_.z - cos_v))) / 2;
    return {{T(frame_.l.z), cos_v, T(frame_.l.x), T(frame_.l.y), v_x, v_y, cos_d, cos_h, slope_x, slope_y, axis_gap},
            ray.weight * slope * r * area * cos_d * cos_h * cos2_h * cos_v};
  }

 private:
  using Edge = HalfVectorEdge;
  struct Part {
    Arc<S> arc;
    Edge from, to;
    EndMap ends;
  };

  /// r of τ on a ray
  [[nodiscard]] T radius(const Line& ray, const T& tau) const {
    return ray.inverse_rho * (frame_.profile == Profile::power ? T(sqrt(T(log1p(square(tau)) / 2))) : tau);
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

  /// The panels of a sector: from edge to edge.
  void add(const Arc<S>& arc, const HalfVectorEdges& edges) {
    const double nearest = static_cast<double>(
        1 / (sqrt(square(frame_.widest) + square(frame_.tan_alpha)) + frame_.tan_alpha));  // bounds r_e and 1/r_e′
    const bool fractional = frame_.horizon_exponent != std::floor(frame_.horizon_exponent);
    const bool half_integer = 2 * frame_.horizon_exponent == std::floor(2 * frame_.horizon_exponent);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      EndMap ends;
      if (fractional && edges[i + 1] == Edge::rim && nearest < static_cast<double>(frame_.cut)) {
        ends.right = half_integer ? 2 : std::max(3.0, 3 / (frame_.horizon_exponent + 1));
      }
      if (fractional && edges[i] == Edge::origin && nearest < 0.5) ends.left = half_integer ? 2 : 3;
      if (frame_.horizon_layer && edges[i + 1] == Edge::rim) ends.right = 3;
      parts_.push_back({arc, edges[i], edges[i + 1], ends});
      const double extent = static_cast<double>(arc.end - arc.begin);
      const AxisKind kind = extent == 4.0                       ? AxisKind::periodic
                            : frame_.symmetric && extent == 2.0 ? AxisKind::even_periodic
                                                                : AxisKind::interval;
      const Reach reached = reach(static_cast<int>(parts_.size()) - 1);
      Axis radial{AxisKind::interval, radial_order(frame_, ends, edges, i, reached.longest)};
      const bool ends_by_itself = frame_.profile != Profile::ggx && !frame_.stretch && reached.horizon > gaussian_reach;
      if (std::is_same_v<T, Block> && edges.size() == 2 && ends_by_itself) {
        parts_.back().ends = {};
        radial = {AxisKind::gaussian, 5, static_cast<double>(frame_.cut)};
      }
      panels_.push_back({radial, {kind, azimuth_order(frame_, kind, extent, edges.size() > 2)}, {}});
      panels_.back().layered = frame_.rough;
      panels_.back().turning = frame_.turning;
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

  HalfVectorFrame<S> frame_;
  UnitVector<S> axis_;
  std::vector<Part> parts_;
  std::vector<Panel> panels_;
};

}  // namespace albedo
