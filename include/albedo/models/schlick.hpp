#pragma once

#include <algorithm>
#include <cmath>

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/elliptic_azimuth.hpp"
#include "albedo/microfacet/fresnel.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Schlick's rational model, one layer, glossy part   [Schlick 1994]:
///
///     f = S(L·H) Z(N·H) A(w) G(N·L) G(N·V) / (4π N·L N·V),   w the cosine of H's azimuth
///     Z(t) = r/(1 + r t² − t²)²,   A(w) = √(p/(p² − p² w² + w²)),   G(c) = c/(r − r c + c),   S Schlick's Fresnel
///     factor
///
/// Z/π is GGX with α² = r. A is √p where H leans along x and 1/√p across; its mean over the azimuth is 1 only for p
/// = 1. At grazing incidence G underestimates the masking: for p = 1 and small r, a(90°) tends to 1/(2√r).
struct Schlick {
  double r = 0.1;
  double p = 1;
  double f0 = 1;

  static ModelInfo info() {
    return {.name = "schlick",
            .title = "Schlick 1994, rational",
            .source = "Schlick 1994 (Computer Graphics Forum 13(3))",
            .deviation =
                "one layer, the glossy term with self-obstruction G alone; the paper's text was not available, "
                "the form is that of public code"};
  }
  static std::vector<Parameter<Schlick>> parameters() {
    using M = Schlick;
    return {number<M, &M::r>("r", {1e-12, 1}, "roughness; α² of GGX"),
            number<M, &M::p>("p", {1e-3, 1}, "isotropy: 1 is isotropic, towards 0 the lobe is elongated along y"),
            reflectance<M, &M::f0>("f0", "reflectance at normal incidence")};
  }

  /// a(L) passes 1 at grazing incidence below r = 0.1695 for p = 1, and below r = 0.2010 for p = 0.3, the worst.
  [[nodiscard]] Claims claims() const {
    return {.conserves_energy = r >= (p == 1 ? 0.17 : 0.202),
            .isotropic = p == 1,
            .distribution = p == 1 ? Measure::projected : Measure::none};
  }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    const double alpha = std::sqrt(r), stretch = std::sqrt(p);
    Lobe lobe = slope_lobe(0, Profile::ggx, alpha * stretch, alpha / stretch);
    // G(N·L) G(N·V) changes over N·V ~ r at the horizon and, at grazing incidence, at H = N: nodes towards both ends
    lobe.horizon_layer = true;
    lobe.horizon_exponent = 1.5;
    return {lobe};
  }

  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    const Fresnel fresnel{.f0 = f0};
    return fresnel(d.cos_theta_d) * facet_distribution(d) /
           (4 * obstruction(d.cos_theta_l) * obstruction(d.cos_theta_v));
  }

  /// Z A/π
  template <class T>
  T facet_distribution(const DirectionPair<T>& d) const noexcept {
    return zenith(d) * azimuthal(d) / pi<T>;
  }
  template <class T>
  T facet_masking(const DirectionPair<T>& d) const noexcept {
    return d.cos_theta_l / obstruction(d.cos_theta_l);
  }

  /// Z(N·H)
  template <class T>
  T zenith(const DirectionPair<T>& d) const noexcept {
    return T(r) / square(T(square(d.cos_theta_h) * (T(r) + tan2_theta_h(d))));
  }

  /// A(w) with w² = slope_x²/tan²θ_H; at H = N, where the azimuth has no value, that of w = 1
  template <class T>
  T azimuthal(const DirectionPair<T>& d) const noexcept {
    const T tiny = T(1e-30);
    return sqrt(T(p) * max(tan2_theta_h(d), tiny) / max(T(square(d.slope_x) + square(T(T(p) * d.slope_y))), tiny));
  }

  /// c/G(c)
  template <class T>
  T obstruction(const T& cosine) const noexcept {
    return T(r) + T(1 - r) * cosine;
  }

  /// Half vectors of density Z N·H A/(π mean A). With 1 − u for the paper's u its t² = u/(r − r u + u) is tan²θ_H =
  /// r u/(1 − u). A is inverted exactly: the paper's w = cos(π/2 √(p² v²/(1 − v² + p² v²))) has an azimuth x = 2φ/π of
  /// density ∝ (p² + (1 − p²) x²)^(−3/2), which is no power of A.
  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    using std::cos;
    using std::sin;
    const T slope = sqrt(T(r) * u / (1 - u)), phi = EllipticAzimuth<T>(p)(v);
    const DirectionPair<T> pair = reflected(l, T(slope * cos(phi)), T(slope * sin(phi)));
    return {pair, viewer_density(pair)};
  }
  template <class T>
  T density(int, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    return viewer_density(half_vector_pair(l, v));
  }

 private:
  template <class T>
  T viewer_density(const DirectionPair<T>& d) const noexcept {
    const T mean = sqrt(T(p)) / T(EllipticAzimuth<T>(p).mean());
    return zenith(d) * d.cos_theta_h * azimuthal(d) / (4 * pi<T> * mean * d.cos_theta_d);
  }
};

}  // namespace albedo
