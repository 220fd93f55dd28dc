#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// The energy-preserving model on the halfway disk of Edwards et al. 2006: a density p of the point u of the unit disk
/// that the half vector is projected to, with the light fixed,
///
///     u = N·L H_xy/N·H − L_xy,   f = p(u) (N·L)²/(4 N·V L·H (N·H)³),   a(L) = ∫ p du over the unit disk
///
/// Here p is a lump around the mirror direction u = −L_xy: p = (n+1)/(π R²) (1 − (N·L tanθ_H/R)²)₊^n. Not reciprocal.
/// What of the lump is beyond the unit disk (R > 1 − sinθ_L) is lost.
struct Edwards {
  double n = 20;
  double radius = 1;

  static ModelInfo info() {
    return {.name = "edwards",
            .title = "Edwards et al. 2006, halfway disk",
            .source = "Edwards, Boulos, Johnson, Shirley, Ashikhmin, Stark, Wyman 2006 (ACM TOG 25(1))",
            .deviation =
                "one lump of constant radius around the mirror direction; the paper's text was not available, the "
                "form is that of public code. Not reciprocal: a(L) integrates over V with the light L fixed"};
  }
  static std::vector<Parameter<Edwards>> parameters() {
    using M = Edwards;
    return {number<M, &M::n>("n", {1, 1e8}, "exponent of the lump"),
            number<M, &M::radius>("radius", {1e-3, 1}, "radius of the lump on the unit disk")};
  }

  [[nodiscard]] Claims claims() const { return {.reciprocal = false}; }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    const double width = radius / std::sqrt(n + 1);
    Lobe lobe = slope_lobe(0, Profile::ggx, width, width);  // the lump's slopes grow like 1/N·L: no one width fits
    return {lobe};
  }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return viewer_density(d) / d.cos_theta_v;
  }

  /// p(u) |∂u/∂V| = p(u) (N·L)²/(4 L·H (N·H)³), with which the paper draws V: f N·V, so that every V weighs 1.
  template <class T>
  T viewer_density(const DirectionPair<T>& d) const noexcept {
    const T from_centre2 = square(T(d.cos_theta_l / T(radius))) * (square(d.slope_x) + square(d.slope_y));
    const T lump = exp(T(n) * log1p(-min(from_centre2, T(1 - 1e-15))));
    const T density = T((n + 1) / (radius * radius)) / pi<T> * select(from_centre2 < T(1.0), lump, T(0.0));
    return density * square(d.cos_theta_l) / (4 * d.cos_theta_d * d.cos_theta_h * square(d.cos_theta_h));
  }

  /// A point of the lump, whose distance from its centre is R √(1 − (1 − u)^(1/(n+1))), and the V it stands for. A
  /// point beyond the rim of the unit disk is a V below the horizon.
  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    using std::cos;
    using std::sin;
    const T slope = T(radius) * sqrt(-expm1(T(log1p(-u) / T(n + 1)))) / l.z, phi = 2 * pi<T> * v;
    const DirectionPair<T> pair = reflected(l, T(slope * cos(phi)), T(slope * sin(phi)));
    return {pair, viewer_density(pair)};
  }
  template <class T>
  T density(int, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    return viewer_density(half_vector_pair(l, v));
  }
};

}  // namespace albedo
