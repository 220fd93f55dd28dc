#pragma once

#include <algorithm>

#include "albedo/core/parameter.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/fresnel.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// Kurt, Szirmay-Kalos and Křivánek's halfway-vector model, D Beckmann's distribution   [Kurt et al. 2010]:
///
///     eq. 9:      f = k_d/π + k_s F D / (4 L·H max(N·L, N·V))
///     eq. 10, 11: f = k_d/π + k_s F D / (4 L·H (N·L N·V)^exponent)          (the paper's α)
///     eq. 13:     the same, with k_d (1 − F)/π
struct Kurt {
  enum class Equation { eq_9, eq_10, eq_11, eq_13 };

  double m_x = 0.1, m_y = 0.1;
  double exponent = 0;
  Equation equation = Equation::eq_10;
  double k_s = 1, k_d = 0;
  Fresnel fresnel{};

  static ModelInfo info() {
    return {.name = "kurt",
            .title = "Kurt, Szirmay-Kalos, Křivánek 2010",
            .source = "Kurt et al. 2010, eqs. 9, 10, 11, 13; eq. 14 is a sum of them",
            .deviation = "none; eqs. 9 and 10 are given eq. 11's k_s and k_d (1 and 0)",
            .shorthands = {{"m", {"m_x", "m_y"}}}};
  }
  static std::vector<Parameter<Kurt>> parameters() {
    using M = Kurt;
    return with_fresnel<M>(
        {number<M, &M::m_x>("m_x", roughness_range, "roughness along x"),
         number<M, &M::m_y>("m_y", roughness_range, "roughness along y"),
         number<M, &M::exponent>("exponent", {0, 1.5}, "the paper's α: power of N·L N·V (eqs. 10, 11, 13)"),
         choice<M, &M::equation>("equation", {"9", "10", "11", "13"}, "equation of the paper"),
         reflectance<M, &M::k_s>("k_s", "scale of the specular lobe", scale_range),
         reflectance<M, &M::k_d>("k_d", "albedo of the diffuse part")});
  }

  [[nodiscard]] Claims claims() const {
    constexpr double widest = 1.88;  // the limit of eq. 9 at grazing incidence passes 1 at m = 1.8811
    const bool conserves = equation == Equation::eq_9 && k_s + k_d <= 1 && std::max(m_x, m_y) <= widest;
    return {.conserves_energy = conserves,
            .bounded = equation == Equation::eq_9 || exponent == 0,
            .isotropic = m_x == m_y,
            .distribution = Measure::projected};
  }
  [[nodiscard]] std::vector<Lobe> lobes() const {
    Lobe specular = slope_lobe(0, Profile::gaussian, m_x, m_y);
    specular.weight = k_s;
    specular.kink_equal_cosines = equation == Equation::eq_9;
    specular.growth = fresnel.growth();
    specular.horizon_exponent = equation == Equation::eq_9 ? 1 : 1 - exponent;
    return {specular, {.component = 1, .weight = k_d}};
  }

  template <class T>
  T facet_distribution(const DirectionPair<T>& d) const noexcept {
    return albedo::beckmann(d, m_x, m_y);
  }

  template <class T>
  T evaluate(int component, const DirectionPair<T>& d) const noexcept {
    if (component == 1) return T(k_d) / pi<T> * (equation == Equation::eq_13 ? T(1 - fresnel(d.cos_theta_d)) : T(1));
    const T numerator = T(k_s) * fresnel(d.cos_theta_d) * beckmann(d, m_x, m_y) / (4 * d.cos_theta_d);
    if (equation == Equation::eq_9) return numerator / max(d.cos_theta_l, d.cos_theta_v);
    return numerator * exp(T(-exponent) * log(T(d.cos_theta_l * d.cos_theta_v)));
  }

  /// Beckmann's half vectors [eqs. 16–20; eq. 17 with the quadrant of 2πξ₂]; the diffuse part: cosine-weighted.
  template <class T>
  Sampled<T> sample(int component, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    if (component == 1) return sample_cosine(l, u, v);
    return sample_beckmann(l, m_x, m_y, u, v);
  }
  template <class T>
  T density(int component, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    if (component == 1) return cosine_density(v);
    return beckmann_density(half_vector_pair(l, v), m_x, m_y);
  }
};

}  // namespace albedo
