#include "albedo/combinators/balanced.hpp"

#include <cmath>

namespace albedo {
namespace {

ModelInfo balanced_info() {
  return {.name = "balanced",
          .title = "Balanced",
          .source = "Sinkhorn & Knopp 1967, of the kernel integrated over azimuths",
          .deviation = "s from a table raised by its error",
          .parameters = {{.name = "rho", .meaning = "albedo reached", .range = {0, 1}, .default_value = 1}}};
}

}  // namespace

BalancedModel::BalancedModel(std::unique_ptr<Model> base, const BalanceOptions& options)
    : ScaledModel(std::move(base), balanced_info()), balance_(this->base(), options) {}

Claims BalancedModel::claims() const {
  Claims claims = ScaledModel::claims();
  claims.conserves_energy = claims.bounded = true;
  return claims;
}

Parameters BalancedModel::own_parameters() const { return {{"rho", balance_.options().rho}}; }

double BalancedModel::factor_of(double cos_l, double cos_v) const noexcept {
  return std::exp(-balance_.log_s(cos_l) - balance_.log_s(cos_v));
}

}  // namespace albedo
