#include "albedo/combinators/sum.hpp"

#include <algorithm>

#include "albedo/core/errors.hpp"
#include "albedo/core/parameter.hpp"
#include "core/text.hpp"

namespace albedo {
namespace {

std::string numbered(std::size_t part, const std::string& name) { return fmt::format("{}.{}", part + 1, name); }

void check(const std::vector<SumModel::Part>& parts) {
  if (parts.empty()) throw ParameterError("a sum has no parts and must have at least one");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i].model) throw ParameterError(fmt::format("part {} of the sum has no model", i + 1));
    if (scale_range.contains(parts[i].weight)) continue;
    throw ParameterError(fmt::format("sum: the weight of part {} is {:g} and must be within [{:g}, {:g}]", i + 1,
                                     parts[i].weight, scale_range.minimum, scale_range.maximum));
  }
}

ModelInfo sum_info(const std::vector<SumModel::Part>& parts) {
  ModelInfo info{.name = "sum", .title = "Sum", .source = "f = Σ w_i f_i", .deviation = "none"};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    info.title += (i == 0 ? " of " : " + ") + parts[i].model->info().name;
  }
  return info;
}

ModelInfo with_parameters(ModelInfo info, const std::vector<SumModel::Part>& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const ModelInfo& part = parts[i].model->info();
    info.parameters.push_back(
        {.name = numbered(i, "model"), .meaning = part.title, .range = {0, 0}, .choices = {part.name}});
    info.parameters.push_back({.name = numbered(i, "weight"),
                               .meaning = "weight of this part",
                               .range = scale_range,
                               .default_value = 1,
                               .per_channel = true});
    for (ParameterInfo parameter : part.parameters) {
      parameter.name = numbered(i, parameter.name);
      info.parameters.push_back(std::move(parameter));
    }
  }
  return info;
}

}  // namespace

SumModel::SumModel(std::vector<Part> parts) : parts_(std::move(parts)) {
  check(parts_);
  info_ = with_parameters(sum_info(parts_), parts_);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    for (Lobe lobe : parts_[i].model->lobes()) {
      if (parts_[i].weight == 0) continue;
      places_.push_back({i, lobe.component});
      lobe.component = static_cast<int>(places_.size()) - 1;
      lobe.weight *= parts_[i].weight;
      lobes_.push_back(lobe);
    }
  }
}

SumModel::SumModel(std::vector<Part> parts, ModelInfo info, std::optional<Claims> claims) : SumModel(std::move(parts)) {
  info_ = with_parameters(std::move(info), parts_);
  claims_ = claims;
}

Claims SumModel::claims() const {
  if (claims_) return *claims_;
  Claims all;
  double weights = 0;
  for (const Part& part : parts_) {
    if (part.weight == 0) continue;
    const Claims claims = part.model->claims();
    weights += part.weight;
    all.reciprocal = all.reciprocal && claims.reciprocal;
    all.conserves_energy = all.conserves_energy && claims.conserves_energy;
    all.bounded = all.bounded && claims.bounded;
    all.isotropic = all.isotropic && claims.isotropic;
  }
  all.conserves_energy = all.conserves_energy && weights <= 1;
  return all;
}

Parameters SumModel::parameters() const {
  Parameters values;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    values.emplace_back(numbered(i, "model"), parts_[i].model->info().name);
    values.emplace_back(numbered(i, "weight"), parts_[i].weight);
    for (const auto& [name, value] : parts_[i].model->parameters()) values.emplace_back(numbered(i, name), value);
  }
  return values;
}

std::vector<WrappingModel::Share> SumModel::coherent_shares(const Direction& /*l*/) const {
  std::vector<Share> shares;
  for (const Part& part : parts_) shares.push_back({part.model.get(), part.weight});
  return shares;
}

}  // namespace albedo
