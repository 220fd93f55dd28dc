#pragma once

#include <memory>

#include "albedo/combinators/sum.hpp"
#include "albedo/core/parameter.hpp"
#include "albedo/curve.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// The matte part below a surface that reflects R(θ), from a table of R:
///
///     f = r_m (1 − R(L))₊ (1 − R(V))₊ / (π (1 − R̄)),   1 − R̄ = 2 ∫ (1 − R(μ))₊ μ dμ
///
/// [Shirley et al. 1997; Ashikhmin & Shirley 2000, eq. 12]. Its albedo is r_m (1 − R(L)). R is the table raised by its
/// error, so that surface and matte part together reflect no more than they get.
struct TabulatedMatte {
  double r_m = 1;
  std::shared_ptr<const AlbedoCurve> surface{};
  double transmitted_mean = 1;  ///< 1 − R̄

  static ModelInfo info();
  static std::vector<Parameter<TabulatedMatte>> parameters();
  [[nodiscard]] Claims claims() const { return {}; }
  [[nodiscard]] std::vector<Lobe> lobes() const { return {{.component = 0, .weight = r_m}}; }

  /// R is a table in double, whatever T.
  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    return T(r_m / transmitted_mean) / pi<T> * transmitted(d.cos_theta_l) * transmitted(d.cos_theta_v);
  }

  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    return sample_cosine(l, u, v);
  }
  template <class T>
  T density(int, const UnitVector<T>&, const UnitVector<T>& v) const noexcept {
    return cosine_density(v);
  }

  [[nodiscard]] double transmitted(double cosine) const noexcept { return std::max(1 - surface->upper(cosine), 0.0); }
  template <class T>
  [[nodiscard]] T transmitted(const T& cosine) const noexcept {
    return static_cast<T>(transmitted(static_cast<double>(cosine)));
  }
  [[nodiscard]] Block transmitted(const Block& cosine) const noexcept {
    return Block::generate([&](int i) { return transmitted(cosine[i]); });
  }
};

/// A surface over a matte body: any specular model, and below it the tabulated matte part that takes what it leaves,
/// a(L) = R(L) + r_m (1 − R(L)).
/// @param surface   isotropic, and claiming energy conservation
/// @param r_m       reflectance of the body, within [0, 1]
/// @param tolerance of the table of R
/// @throws ParameterError for another surface or r_m, and as AlbedoCurve does
std::unique_ptr<Model> coupled(std::unique_ptr<Model> surface, double r_m = 1, double tolerance = 1e-8);

}  // namespace albedo
