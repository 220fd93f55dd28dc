#pragma once

#include "albedo/core/parameter.hpp"

namespace albedo {

enum class FresnelKind { none, schlick, conductor };

/// The Fresnel factor F(L·H) that several models share.
///  - none: F = 1
///  - schlick: f₀ + (1 − f₀)(1 − L·H)⁵ (Schlick 1994; Kurt et al. 2010, eq. 12); the default f₀ = 1 is F = 1
///  - conductor: unpolarised reflectance of an interface air–metal with complex index η + ik
struct Fresnel {
  FresnelKind kind = FresnelKind::schlick;
  double f0 = 1;
  double eta = 0.2;
  double k = 3;

  /// Of a lobe with this factor: where F vanishes at normal incidence, its fifth power of 1 − L·H is all there is.
  [[nodiscard]] double growth() const {
    constexpr double vanishing = 1e-3;
    return (*this)(1.0) < vanishing ? 5 : 1;
  }

  template <class T>
  T operator()(const T& cos_theta_d) const noexcept {
    switch (kind) {
      case FresnelKind::none:
        return T(1);
      case FresnelKind::schlick:
        // a cosine that rounding has put above 1 is no negative reflectance
        return T(f0) + T(1 - f0) * fifth_power(max(T(1 - cos_theta_d), T(0)));
      case FresnelKind::conductor:
        break;
    }
    const T cos2 = square(cos_theta_d);
    const T sin2 = 1 - cos2;
    const T eta2k2 = square(T(eta)) * square(T(k));
    const T t0 = T(eta - k) * T(eta + k) - sin2;
    const T a2_b2 = sqrt(square(t0) + 4 * eta2k2);  // a² + b² where (a + ib)² = (η + ik)² − sin²θ
    // a² = (a² + b² + t0)/2; its other form has no cancellation where t0 < 0
    const T a = sqrt(select(t0 > T(0), T((a2_b2 + t0) / 2), T(2 * eta2k2 / (a2_b2 - t0))));
    const T two_a_cos = 2 * a * cos_theta_d;
    const T senkrecht = (a2_b2 + cos2 - two_a_cos) / (a2_b2 + cos2 + two_a_cos);
    const T ratio = (cos2 * a2_b2 + square(sin2) - two_a_cos * sin2) / (cos2 * a2_b2 + square(sin2) + two_a_cos * sin2);
    return senkrecht * (1 + ratio) / 2;
  }
};

/// The Fresnel parameters of a model with a member `fresnel`, appended to its own.
template <class M>
std::vector<Parameter<M>> with_fresnel(std::vector<Parameter<M>> parameters) {
  parameters.push_back(
      choice<M, &M::fresnel, &Fresnel::kind>("fresnel", {"none", "schlick", "conductor"}, "Fresnel factor F(L·H)"));
  parameters.push_back(reflectance<M, &M::fresnel, &Fresnel::f0>("f0", "reflectance at normal incidence (schlick)"));
  parameters.push_back(
      reflectance<M, &M::fresnel, &Fresnel::eta>("eta", "index of refraction (conductor)", {1e-3, 100}));
  parameters.push_back(reflectance<M, &M::fresnel, &Fresnel::k>("k", "extinction coefficient (conductor)", {0, 100}));
  return parameters;
}

}  // namespace albedo
