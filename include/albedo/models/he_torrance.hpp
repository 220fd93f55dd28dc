#pragma once

#include <cmath>

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/fresnel.hpp"
#include "albedo/microfacet/wave_series.hpp"

namespace albedo {

/// He, Torrance, Sillion and Greenberg's physical model of a surface with Gaussian heights of standard deviation σ₀ and
/// a Gaussian autocorrelation of length τ, under light of wavelength λ   [He et al. 1991, eqs. 23–25, 69–84]:
///
///     f = k_s F S G D/(π N·L N·V) + k_d/π + coherent part
///     D = π² τ²/(4λ²) Σ_{m≥1} g^m e^(−g)/(m! m) exp(−b/m),   b = (2π/λ)² τ² |(L+V)_xy|²/4
///     g = ((2πσ/λ)(N·L + N·V))²,   G = (|L+V|²/(N·L + N·V))² = 4 (L·H)²/(N·H)²
///     S = S₁(L) S₁(V),   S₁ = (1 − erfc(x)/2)/(1 + Λ),   x = τ cotθ/(2σ₀),   Λ = (e^(−x²)/(x√π) − erfc(x))/2
///     σ = σ₀/√(1 + (z₀/σ₀)²),   √(π/2) z₀ = (σ₀/4)(K_L + K_V) exp(−z₀²/2σ₀²),   K = tanθ erfc(x)
///
/// The equation for z₀ has the solution (z₀/σ₀)² = W₀((K_L + K_V)²/8π), W₀ Lambert's. G's factors with polarisation
/// vectors (eq. 76) are |L×V|⁴ over itself.
///
/// The coherent part reflects into the mirror direction alone, k_s F e^(−g) S of the light, with F, g and S taken
/// there. A delta has no value f: evaluate() leaves it out, coherent_albedo() tells it apart, and the albedo has it
/// unless part=directional_diffuse.
struct HeTorrance {
  enum class Part { total, directional_diffuse, specular };

  double sigma0 = 0.1, tau = 1.7, wavelength = 0.5;
  Part part = Part::total;
  double k_s = 1, k_d = 0;
  Fresnel fresnel{};

  static ModelInfo info() {
    return {.name = "he_torrance",
            .title = "He, Torrance, Sillion, Greenberg 1991",
            .source = "He et al. 1991, eqs. 23–25, 69–84, with the erratum to eq. 25",
            .deviation =
                "eq. 25 has its erratum's e^(−x²); in eq. 78 v_xy is in wave numbers, without which a smooth surface "
                "reflects more than it receives; unpolarised light; scale k_s is added; the paper's text was not "
                "available, the form is that of public code"};
  }
  static std::vector<Parameter<HeTorrance>> parameters() {
    using M = HeTorrance;
    return with_fresnel<M>(
        {number<M, &M::sigma0>("sigma0", {1e-6, 1e3}, "standard deviation of the surface's heights [µm]"),
         number<M, &M::tau>("tau", {1e-3, 1e6}, "correlation length of the heights [µm]"),
         number<M, &M::wavelength>("wavelength", {1e-3, 1e3}, "wavelength of the light [µm]"),
         choice<M, &M::part>("part", {"total", "directional_diffuse", "specular"},
                             "all of it, the directional-diffuse part, or the coherent reflection alone"),
         reflectance<M, &M::k_s>("k_s", "scale of all but the uniform-diffuse part", scale_range),
         reflectance<M, &M::k_d>("k_d", "albedo of the uniform-diffuse part")});
  }

  [[nodiscard]] Claims claims() const { return {.conserves_energy = false}; }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    // in slopes at normal incidence, of the facets and of diffraction; towards grazing incidence diffraction's grows
    const double width = std::hypot(roughness(), wavelength / (2 * pi<double> * tau));
    const Lobe directional{.component = 0,
                           .weight = part == Part::specular ? 0 : k_s,
                           .shape = NearMirrorLobe{.width = width, .facet_width = roughness()}};
    return {directional, {.component = 1, .weight = part == Part::total ? k_d : 0}};
  }

  template <class T>
  T evaluate(int component, const DirectionPair<T>& d) const noexcept {
    if (component == 1) return T(k_d) / pi<T>;
    const Side<T> light = side(d.l_x, d.l_y, d.cos_theta_l), viewer = side(d.v_x, d.v_y, d.cos_theta_v);
    const T shrink = 1 + lambert_w(T(min(T(huge<T>), T(square(T(light.k + viewer.k)) / (8 * pi<T>)))));  // (σ₀/σ)²
    const T g = square(T(T(4 * sigma0 / wavelength) * pi<T> * d.cos_theta_d * d.cos_theta_h)) / shrink;
    const T ratio = shrink * tan2_theta_h(d) / square(T(roughness()));  // b/g
    return T(k_s) * fresnel(d.cos_theta_d) * pi<T> * square(T(T(tau / wavelength) * d.cos_theta_d / d.cos_theta_h)) *
           light.visibility * viewer.visibility * wave_series(g, ratio);
  }

  /// k_s F e^(−g) S of the mirror direction.
  template <class T>
  [[nodiscard]] T coherent_albedo(const Direction& l) const {
    if (part == Part::directional_diffuse) return 0;
    T cosine, sine;
    polar_angle(l, cosine, sine);
    if (cosine == 0) return 0;  // S₁
    const Side<T> there = side(sine, T(0), cosine);
    const T shrink = 1 + lambert_w(min(T(huge<T>), T(square(there.k) / (2 * pi<T>))));
    const T g = square(T(4 * pi<T> * sigma0 / wavelength * cosine)) / shrink;
    return k_s * fresnel(cosine) * exp(T(-g)) * square(T(cosine * there.visibility));
  }

 private:
  /// K² overflows where a cosine is below 1e-19 in float, 1e-154 in double.
  template <class T>
  static constexpr double huge = std::is_same_v<Scalar<T>, float> ? 1e37 : 1e300;

  /// α = 2σ₀/τ, the root mean square slope × √2.
  [[nodiscard]] double roughness() const { return 2 * sigma0 / tau; }

  /// Of one direction: S₁/cosθ, and K.
  template <class T>
  struct Side {
    T visibility, k;
  };

  /// With cosθ Λ = s e^(−x²)(1/√π − x e^(x²) erfc(x))/2, s = α sinθ, x = cosθ/s: neither a division by a cosine nor a
  /// difference of error functions.
  template <class T>
  [[nodiscard]] Side<T> side(const T& x, const T& y, const T& cosine) const noexcept {
    const T sine = sqrt(T(square(x) + square(y)));
    const T s = T(roughness()) * sine;
    const T a = min(T(cosine / s), T(12.0));  // beyond, Λ and K < 1e-60
    const T gauss = exp(-square(a)), scaled = scaled_erfc(a);
    const T shadow = s * gauss * (1 / sqrt(pi<T>) - a * scaled) / 2;
    return {T((1 - gauss * scaled / 2) / (cosine + shadow)), T(sine * gauss * scaled / cosine)};
  }
};

}  // namespace albedo
