#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// The matte part of Shirley, Smits, Hu and Lafortune's coupled model, for a polished surface of Schlick's reflectance
/// R(θ) = r₀ + (1 − r₀)(1 − cosθ)⁵:
///
///     f = 21 r_m/(20π (1 − r₀)) (1 − R(θ_L))(1 − R(θ_V)),   a(L) = r_m (1 − R(θ_L))
///
/// [Shirley et al. 1997; the coupling c (1 − R(L))(1 − R(V)): Ashikhmin & Shirley 2000, eq. 12]
struct ShirleyMatte {
  double r0 = 0.04;
  double r_m = 1;

  static ModelInfo info() {
    return {.name = "shirley_matte",
            .title = "Shirley et al. 1997, coupled matte",
            .source = "Shirley, Smits, Hu, Lafortune 1997; Ashikhmin & Shirley 2000, eq. 12",
            .deviation = "the matte part alone; a mirror or a narrow lobe of reflectance R is added to it"};
  }
  static std::vector<Parameter<ShirleyMatte>> parameters() {
    using M = ShirleyMatte;
    return {reflectance<M, &M::r0>("r0", "reflectance of the polished surface at normal incidence (Schlick)"),
            reflectance<M, &M::r_m>("r_m", "reflectance of the matte part below it")};
  }

  [[nodiscard]] Claims claims() const { return {}; }
  [[nodiscard]] std::vector<Lobe> lobes() const { return {{.component = 0, .weight = r_m * (1 - r0)}}; }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return T(21 * r_m * (1 - r0)) / (20 * pi<T>)*rise(d.cos_theta_l) * rise(d.cos_theta_v);
  }

  /// 1 − (1 − x)⁵, multiplied out: no cancellation at grazing incidence.
  template <class T>
  static T rise(const T& x) noexcept {
    return x * (5 + x * (-10 + x * (10 + x * (-5 + x))));
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
