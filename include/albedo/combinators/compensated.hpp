#pragma once

#include <memory>

#include "albedo/combinators/scaled.hpp"
#include "albedo/curve.hpp"

namespace albedo {

/// f* = f (1 + ρ (1 − a(L)) / a(L)): the light lost comes back in the shape of what isn't   [Turquin 2019, "Practical
/// multiple scattering compensation for microfacet models"]. a* = a + ρ (1 − a), which is 1 for ρ = 1.
///
/// L is the direction whose albedo is asked for; renderers have the viewer there. It isn't reciprocal. a is the table
/// raised by its error, so that a* ≤ 1.
class CompensatedModel final : public ScaledModel {
 public:
  /// @param base      isotropic, with a positive albedo
  /// @param rho       share of the lost light that comes back, within [0, 1]
  /// @param tolerance of the table of a
  /// @throws ParameterError for another base or rho, and as AlbedoCurve does
  explicit CompensatedModel(std::unique_ptr<Model> base, double rho = 1, double tolerance = 1e-8);

  [[nodiscard]] const AlbedoCurve& albedo() const { return albedo_; }
  [[nodiscard]] Claims claims() const override;

 private:
  [[nodiscard]] double factor_of(double cos_l, double cos_v) const noexcept override;
  [[nodiscard]] Parameters own_parameters() const override;

  double rho_;
  AlbedoCurve albedo_;
};

}  // namespace albedo
