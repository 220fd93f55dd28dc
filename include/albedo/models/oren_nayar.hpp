#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Oren and Nayar's rough matte surface, qualitative model:
///
///     f = ρ/π (A + B max(0, cos(φ_L − φ_V)) sinα tanβ),   A = 1 − 0.5 σ²/(σ² + 0.33),   B = 0.45 σ²/(σ² + 0.09)
///
/// with α = max(θ_L, θ_V), β = min(θ_L, θ_V)   [Oren & Nayar 1994, eq. 30]. sinα tanβ cos(φ_L − φ_V) is the product of
/// the tangential parts of L and V over max(N·L, N·V).
///
/// a(L) = ρ (A + 2B sinθ/π ((1 − sin³θ)/(3 cosθ) + (θ − sinθ cosθ)/2)), which rises from ρA to ρ(A + B/2) at 90°.
struct OrenNayar {
  double sigma = 0.3;
  double rho = 1;

  static ModelInfo info() {
    return {.name = "oren_nayar",
            .title = "Oren–Nayar 1994, qualitative",
            .source = "Oren & Nayar 1994, eq. 30",
            .deviation = "none for the qualitative model; the full one (eqs. 27–29) is not there"};
  }
  static std::vector<Parameter<OrenNayar>> parameters() {
    using M = OrenNayar;
    return {number<M, &M::sigma>("sigma", {0, 2}, "standard deviation of the facets' angles [rad]"),
            reflectance<M, &M::rho>("rho", "albedo of a facet")};
  }

  [[nodiscard]] double level() const { return 1 - 0.5 * sigma * sigma / (sigma * sigma + 0.33); }
  [[nodiscard]] double slope() const { return 0.45 * sigma * sigma / (sigma * sigma + 0.09); }

  [[nodiscard]] Claims claims() const { return {.conserves_energy = rho * (level() + slope() / 2) <= 1}; }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    return {{.component = 0, .weight = rho}, {.component = 1, .weight = rho * slope(), .kink_equal_cosines = true}};
  }

  template <class T>
  T evaluate(int component, const DirectionPair<T>& d) const noexcept {
    if (component == 0) return T(rho * level()) / pi<T>;
    return T(rho * slope()) / pi<T> * max(T(d.l_x * d.v_x + d.l_y * d.v_y), T(0.0)) / max(d.cos_theta_l, d.cos_theta_v);
  }

  /// Cosine-weighted directions.
  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    return sample_cosine(l, u, v);
  }
  template <class T>
  T density(int, const UnitVector<T>&, const UnitVector<T>& v) const noexcept {
    return cosine_density(v);
  }
};

}  // namespace albedo
