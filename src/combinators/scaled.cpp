#include "albedo/combinators/scaled.hpp"

#include <utility>

#include "albedo/core/errors.hpp"

namespace albedo {

ScaledModel::ScaledModel(std::unique_ptr<Model> base, ModelInfo info) : base_(std::move(base)), info_(std::move(info)) {
  if (!base_) throw ParameterError(info_.name + ": there is no model and there must be one");
  const ModelInfo& of_base = base_->info();
  info_.title += ": " + of_base.title;
  info_.parameters.insert(info_.parameters.begin(),
                          {.name = "model", .meaning = of_base.title, .choices = {of_base.name}});
  for (ParameterInfo parameter : of_base.parameters) {
    parameter.name = "base." + parameter.name;
    info_.parameters.push_back(std::move(parameter));
  }
}

Claims ScaledModel::claims() const {
  Claims claims = base_->claims();
  claims.distribution = Measure::none;
  claims.consistent_masking = false;
  return claims;
}

Parameters ScaledModel::parameters() const {
  Parameters values{{"model", base_->info().name}};
  for (auto& own : own_parameters()) values.push_back(std::move(own));
  for (const auto& [name, value] : base_->parameters()) values.emplace_back("base." + name, value);
  return values;
}

std::vector<WrappingModel::Share> ScaledModel::coherent_shares(const Direction& l) const {
  if (base_->coherent_albedo(l) == 0) return {};  // not to be multiplied by an infinite factor
  return {{base_.get(), factor_of(l.cos_theta, l.cos_theta)}};
}

}  // namespace albedo
