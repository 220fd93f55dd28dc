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

Quad ScaledModel::coherent_albedo(const Direction& l) const {
  const Quad coherent = base_->coherent_albedo(l);
  return coherent == 0 ? coherent : Quad(coherent * factor(l.cos_theta, l.cos_theta));
}

Block ScaledModel::evaluate(int component, const DirectionPair<Block>& pair) const noexcept {
  const Block f = base_->evaluate(component, pair);
  return f * Block::generate([&](int lane) { return factor(pair.cos_theta_l[lane], pair.cos_theta_v[lane]); });
}
double ScaledModel::evaluate(int component, const DirectionPair<double>& pair) const noexcept {
  return base_->evaluate(component, pair) * factor(pair.cos_theta_l, pair.cos_theta_v);
}
float ScaledModel::evaluate(int component, const DirectionPair<float>& pair) const noexcept {
  return base_->evaluate(component, pair) *
         static_cast<float>(factor(static_cast<double>(pair.cos_theta_l), static_cast<double>(pair.cos_theta_v)));
}
Quad ScaledModel::evaluate(int component, const DirectionPair<Quad>& pair) const {
  return base_->evaluate(component, pair) *
         factor(static_cast<double>(pair.cos_theta_l), static_cast<double>(pair.cos_theta_v));
}

}  // namespace albedo
