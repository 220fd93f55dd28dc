#pragma once

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/fresnel.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Ashikhmin–Shirley's anisotropic Phong model   [Ashikhmin & Shirley 2000, eqs. 10, 13, 15]:
///
///     f = k_s √((n_u+1)(n_v+1))/(8π) (N·H)^(n_u cos²φ_H + n_v sin²φ_H) F(L·H) / (L·H max(N·L, N·V))
///       + 28 r_d/(23π) (1 − r_s)(1 − (1 − N·L/2)⁵)(1 − (1 − N·V/2)⁵) + k_d/π
///
/// with Schlick's F from r_s. normalization=projected has √((n_u+2)(n_v+2)), for which it is the integral of the
/// distribution times N·H that is 1 [Pharr & Humphreys 2004]; the paper's own makes the distribution a density. The
/// scale k_s and the Lambertian part k_d are not the paper's; published fits need them.
struct AshikhminShirley {
  enum class Normalization { paper, projected };

  double n_u = 100, n_v = 100;
  double r_s = 1, r_d = 0;
  double k_s = 1, k_d = 0;
  Normalization normalization = Normalization::paper;

  static ModelInfo info() {
    return {.name = "ashikhmin_shirley",
            .title = "Ashikhmin–Shirley 2000",
            .source = "Ashikhmin & Shirley 2000, eqs. 10, 13, 15",
            .deviation = "none; scale k_s and a Lambertian part k_d are added",
            .shorthands = {{"n", {"n_u", "n_v"}}}};
  }
  static std::vector<Parameter<AshikhminShirley>> parameters() {
    using M = AshikhminShirley;
    return {number<M, &M::n_u>("n_u", exponent_range, "exponent along x"),
            number<M, &M::n_v>("n_v", exponent_range, "exponent along y"),
            reflectance<M, &M::r_s>("r_s", "specular reflectance at normal incidence (Schlick)"),
            reflectance<M, &M::r_d>("r_d", "reflectance of the paper's diffuse part"),
            reflectance<M, &M::k_s>("k_s", "scale of the specular lobe", scale_range),
            reflectance<M, &M::k_d>("k_d", "albedo of an added Lambertian part"),
            choice<M, &M::normalization>("normalization", {"paper", "projected"},
                                         "of the distribution: (n+1), a density; or (n+2), a height field's")};
  }

  [[nodiscard]] Claims claims() const {
    return {.conserves_energy = k_s <= 1 && k_d == 0,
            .isotropic = n_u == n_v,
            .distribution = normalization == Normalization::paper ? Measure::solid_angle : Measure::projected};
  }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe specular = power_lobe(0, n_u, n_v);
    specular.weight = k_s;
    specular.kink_equal_cosines = true;
    specular.growth = Fresnel{.f0 = r_s}.growth();
    return {specular, {.component = 1, .weight = r_d * (1 - r_s)}, {.component = 2, .weight = k_d}};
  }

  template <class T>
  T evaluate(int component, const DirectionPair<T>& d) const noexcept {
    if (component == 0) return specular(d);
    return component == 1 ? diffuse(d) : T(T(k_d) / pi<T>);
  }

  /// Eq. 15
  template <class T>
  T specular(const DirectionPair<T>& d) const noexcept {
    const Fresnel fresnel{.f0 = r_s};
    return T(k_s) * facet_distribution(d) * fresnel(d.cos_theta_d) /
           (4 * d.cos_theta_d * max(d.cos_theta_l, d.cos_theta_v));
  }

  /// Eq. 5, with n + 1 or n + 2. The exponent is written with slopes, e ln(N·H) = −(n_u x² + n_v y²) ln(1 + t²)/2t²,
  /// so that H = N is not 0/0.
  template <class T>
  T facet_distribution(const DirectionPair<T>& d) const noexcept {
    const T tan2 = max(tan2_theta_h(d), T(1e-30));
    const T exponent = (T(n_u) * square(d.slope_x) + T(n_v) * square(d.slope_y)) / tan2;
    const Scalar<T> add = normalization == Normalization::paper ? 1 : 2;
    const Scalar<T> scale = sqrt(Scalar<T>((Scalar<T>(n_u) + add) * (Scalar<T>(n_v) + add)));
    return T(scale) / (2 * pi<T>)*exp(-exponent * log1p(tan2) / 2);
  }

  /// Eq. 13 (its constant: eq. 14).
  template <class T>
  T diffuse(const DirectionPair<T>& d) const noexcept {
    return T(28 * Scalar<T>(r_d) * (1 - Scalar<T>(r_s))) / (23 * pi<T>)*rise(T(d.cos_theta_l / 2)) *
           rise(T(d.cos_theta_v / 2));
  }

  /// 1 − (1 − x)⁵, multiplied out: no cancellation at grazing incidence.
  template <class T>
  static T rise(const T& x) noexcept {
    return x * (5 + x * (-10 + x * (10 + x * (-5 + x))));
  }

  /// Half vectors of eq. 5 [eqs. 17–20]; both diffuse parts: cosine-weighted.
  template <class T>
  Sampled<T> sample(int component, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    if (component != 0) return sample_cosine(l, u, v);
    return sample_power(l, n_u, n_v, u, v);
  }
  template <class T>
  T density(int component, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    if (component != 0) return cosine_density(v);
    return power_density(half_vector_pair(l, v), n_u, n_v);
  }
};

}  // namespace albedo
