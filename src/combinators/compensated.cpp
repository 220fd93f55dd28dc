#include "albedo/combinators/compensated.hpp"

#include <cmath>

#include "core/check.hpp"

namespace albedo {
namespace {

ModelInfo compensated_info() {
  return {
      .name = "compensated",
      .title = "Compensated",
      .source = "Turquin 2019",
      .deviation = "a from a table raised by its error",
      .parameters = {{.name = "rho", .meaning = "lost light that comes back", .range = {0, 1}, .default_value = 1}}};
}

std::unique_ptr<Model> checked(std::unique_ptr<Model> base, double rho) {
  check_number("compensated: rho", rho, {0, 1}, "[0, 1]");
  if (base) check_isotropic("compensated", *base);
  return base;
}

}  // namespace

CompensatedModel::CompensatedModel(std::unique_ptr<Model> base, double rho, double tolerance)
    : ScaledModel(checked(std::move(base), rho), compensated_info()),
      rho_(rho),
      albedo_(this->base(), {.albedo = {.tolerance = tolerance}}) {
  for (const AlbedoCurve::Node& node : albedo_.nodes()) {
    check_positive_albedo("compensated", this->base(), node.albedo.value, node.cos_theta);
  }
}

Claims CompensatedModel::claims() const {
  Claims claims = ScaledModel::claims();
  claims.reciprocal = false;
  claims.conserves_energy = claims.conserves_energy || rho_ == 1;
  claims.bounded = claims.bounded || rho_ == 1;
  return claims;
}

Parameters CompensatedModel::own_parameters() const { return {{"rho", rho_}}; }

double CompensatedModel::factor_of(double cos_l, double) const noexcept {
  return (1 - rho_) + rho_ / albedo_.upper(cos_l);
}

}  // namespace albedo
