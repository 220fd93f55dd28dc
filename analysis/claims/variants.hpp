/// @file
/// Formulas that the papers' models are compared with, or that repair a claim: models of one's own, as any user may
/// write them.
#pragma once

#include <cmath>

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/registry.hpp"

namespace albedo::analysis {

/// Blinn's lobe over L.H, normalised as a density: f = (n+1)/(8 pi) (N.H)^n/(L.H)
struct BlinnOverCosine {
  double n = 20;

  static ModelInfo info() {
    return {.name = "blinn_over_cosine", .title = "Blinn over L.H", .source = "a repair", .deviation = "none"};
  }
  static std::vector<Parameter<BlinnOverCosine>> parameters() {
    return {number<BlinnOverCosine, &BlinnOverCosine::n>("n", exponent_range, "exponent")};
  }
  [[nodiscard]] Claims claims() const { return {}; }
  [[nodiscard]] std::vector<Lobe> lobes() const { return {power_lobe(0, n, n)}; }
  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return T((n + 1) / 8) / pi<T> * cos_theta_h_power(d, n) / d.cos_theta_d;
  }
};

/// What samples of Ward's sampling with equal weights integrate: f cosine = p_o of eq. 9 above the horizon   [Walter
/// 2005]
struct EqualWeights {
  double alpha = 0.1;

  static ModelInfo info() {
    return {.name = "equal_weights", .title = "Ward, equal weights", .source = "Walter 2005", .deviation = "none"};
  }
  static std::vector<Parameter<EqualWeights>> parameters() {
    return {number<EqualWeights, &EqualWeights::alpha>("alpha", roughness_range, "roughness")};
  }
  [[nodiscard]] Claims claims() const { return {.reciprocal = false}; }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe lobe = slope_lobe(0, Profile::gaussian, alpha, alpha);
    lobe.horizon_exponent = 0;
    return {lobe};
  }
  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return beckmann(d, alpha, alpha) * d.cos_theta_h / (4 * d.cos_theta_d * d.cos_theta_v);
  }
};

/// Equality in Kurt's eq. 8, L his w_o and V his w_i: f = D/(4 L.H N.V); density=1: with the density D N.H in D's place
struct KurtBound {
  double m = 0.1, density = 0;

  static ModelInfo info() {
    return {
        .name = "kurt_bound", .title = "Kurt's upper bound", .source = "Kurt et al. 2010, eq. 8", .deviation = "none"};
  }
  static std::vector<Parameter<KurtBound>> parameters() {
    return {number<KurtBound, &KurtBound::m>("m", roughness_range, "roughness"),
            number<KurtBound, &KurtBound::density>("density", {0, 1}, "power of N.H")};
  }
  [[nodiscard]] Claims claims() const { return {.reciprocal = false}; }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe lobe = slope_lobe(0, Profile::gaussian, m, m);
    lobe.horizon_exponent = 0;
    return {lobe};
  }
  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return beckmann(d, m, m) * exp(T(density) * log(d.cos_theta_h)) / (4 * d.cos_theta_d * d.cos_theta_v);
  }
};

/// Kurt's eq. 9 with a power: f = D (N.H)^density/(4 L.H max(N.L, N.V)^power)
struct KurtMax {
  double m = 0.1, power = 1, density = 0;

  static ModelInfo info() {
    return {.name = "kurt_max", .title = "Kurt, power of the larger cosine", .source = "a repair", .deviation = "none"};
  }
  static std::vector<Parameter<KurtMax>> parameters() {
    return {number<KurtMax, &KurtMax::m>("m", roughness_range, "roughness"),
            number<KurtMax, &KurtMax::power>("power", {0, 2}, "of the larger cosine"),
            number<KurtMax, &KurtMax::density>("density", {0, 1}, "power of N.H")};
  }
  [[nodiscard]] Claims claims() const { return {}; }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe lobe = slope_lobe(0, Profile::gaussian, m, m);
    lobe.kink_equal_cosines = true;
    return {lobe};
  }
  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    const T larger = max(d.cos_theta_l, d.cos_theta_v);
    return beckmann(d, m, m) * exp(T(density) * log(d.cos_theta_h) - T(power) * log(larger)) / (4 * d.cos_theta_d);
  }
};

}  // namespace albedo::analysis
