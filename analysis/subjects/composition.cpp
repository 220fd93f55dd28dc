#include "analysis/subjects/composition.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include "albedo/combinators/coupled.hpp"
#include "albedo/combinators/sum.hpp"
#include "albedo/core/errors.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

constexpr std::string_view surface = "surface.";

std::unique_ptr<Model> make_plain(const ModelPart& part) { return make_model(part.model, part.parameters); }

std::unique_ptr<Model> make_checked_part(const ModelPart& part) {
  std::unique_ptr<Model> model = make_plain(part);
  std::vector<std::string> names;
  for (const auto& [name, value] : part.parameters) names.push_back(name);
  check_set_once(model_info(part.model), names);
  return model;
}

std::unique_ptr<Model> combined(const Composition& composition,
                                const std::function<std::unique_ptr<Model>(const ModelPart&)>& make) {
  if (!is_combination(composition.name)) return make(composition.parts.front());
  if (composition.name == coupled_name) return coupled(make(composition.parts.front()), composition.r_m);
  std::vector<SumModel::Part> parts;
  for (const ModelPart& part : composition.parts) parts.push_back({part.weight, make(part)});
  return std::make_unique<SumModel>(std::move(parts));
}

}  // namespace

bool is_combination(const std::string& name) { return name == sum_name || name == coupled_name; }

void check_set_once(const ModelInfo& model, const std::vector<std::string>& names) {
  std::map<std::string, std::string> setters;
  for (const std::string& name : names) {
    for (const std::string& parameter : model.resolve(name)) {
      const auto [other, is_new] = setters.emplace(parameter, name);
      if (is_new) continue;
      throw ParameterError(
          fmt::format("{}: {} is set twice, by {} and by {}", model.name, parameter, other->second, name));
    }
  }
}

const ParameterInfo* ModelPart::open_channel() const {
  const ParameterInfo* channel = model_info(model).channel();
  const auto is_channel = [&](const auto& p) { return channel != nullptr && p.first == channel->name; };
  return std::ranges::any_of(parameters, is_channel) ? nullptr : channel;
}

Composition::Target Composition::target(const std::string& parameter) const {
  if (!is_combination(name)) return {.parameter = parameter};
  if (name == coupled_name) {
    if (parameter == "r_m") return {.kind = Target::Kind::r_m};
    if (parameter.starts_with(surface)) return {.parameter = parameter.substr(surface.size())};
    throw ParameterError(
        fmt::format("coupled has no parameter '{}'; it has r_m, and those of its surface begin with "
                    "'surface.', such as surface.alpha",
                    parameter));
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string number = fmt::format("{}.", i + 1);
    if (!parameter.starts_with(number)) continue;
    const std::string own = parameter.substr(number.size());
    return {.kind = own == "weight" ? Target::Kind::weight : Target::Kind::parameter, .part = i, .parameter = own};
  }
  throw ParameterError(fmt::format(
      "sum has no parameter '{}'; those of its parts begin with their number, such as 1.weight", parameter));
}

const ParameterInfo* Composition::info(const Target& target) const {
  if (target.kind != Target::Kind::parameter) return nullptr;
  const ModelInfo& model = model_info(parts[target.part].model);
  const std::vector<std::string> names = model.resolve(target.parameter);
  return names.empty() ? nullptr : model.find(names.front());
}

std::vector<std::string> Composition::set_by(const Target& target) const {
  if (target.kind == Target::Kind::r_m) return {"2.r_m"};
  if (target.kind == Target::Kind::weight) return {fmt::format("{}.weight", target.part + 1)};
  std::vector<std::string> names = model_info(parts[target.part].model).resolve(target.parameter);
  if (is_combination(name)) {
    for (std::string& one : names) one = fmt::format("{}.{}", target.part + 1, one);
  }
  return names;
}

void Composition::set(const Target& target, const ParameterValue& value) {
  switch (target.kind) {
    case Target::Kind::r_m:
      r_m = std::get<double>(value);
      break;
    case Target::Kind::weight:
      parts[target.part].weight = std::get<double>(value);
      break;
    case Target::Kind::parameter:
      parts[target.part].parameters.emplace_back(target.parameter, value);
  }
}

void Composition::set_channel(const std::string& channel) {
  for (ModelPart& part : parts) {
    if (const ParameterInfo* open = part.open_channel()) part.parameters.emplace_back(open->name, channel);
  }
}

std::vector<std::string> Composition::channels() const {
  for (const ModelPart& part : parts) {
    if (const ParameterInfo* channel = part.open_channel()) return channel->choices;
  }
  return {""};
}

std::unique_ptr<Model> Composition::make() const { return combined(*this, make_plain); }

std::unique_ptr<Model> Composition::make_checked() const { return combined(*this, make_checked_part); }

void Composition::check(const Target& target, const ParameterValue& value) const {
  if (target.kind == Target::Kind::parameter) {
    make_model(parts[target.part].model, {{target.parameter, value}});
    return;
  }
  Composition one{.name = name, .parts = std::vector<ModelPart>(target.part + 1, {.model = "lambert"})};
  one.set(target, value);
  static_cast<void>(one.make());
}

bool Composition::is_dear() const {
  return name == coupled_name || std::ranges::any_of(parts, [](const ModelPart& part) {
           return std::ranges::any_of(model_info(part.model).parameters, &ParameterInfo::is_text);
         });
}

}  // namespace albedo::analysis
