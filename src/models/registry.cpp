#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "albedo/core/erased_model.hpp"
#include "albedo/core/errors.hpp"
#include "albedo/core/suggestion.hpp"
#include "albedo/models/all.hpp"

namespace albedo {
namespace {

std::string text(double value) {
  std::array<char, 32> buffer{};
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

std::string text(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

double checked_value(const ModelInfo& model, const ParameterInfo& parameter, const ParameterValue& value) {
  const std::string subject = model.name + ": " + parameter.name;
  if (const auto* name = std::get_if<std::string>(&value)) {
    const auto found = std::find(parameter.choices.begin(), parameter.choices.end(), *name);
    if (found != parameter.choices.end()) return static_cast<double>(found - parameter.choices.begin());
    const std::string valid = parameter.is_choice() ? "one of " + text(parameter.choices) : "a number";
    throw ParameterError(subject + " is '" + *name + "' and must be " + valid);
  }
  const double number = std::get<double>(value);
  if (parameter.is_choice()) {  // names such as Kurt's equation=9 look like numbers
    return checked_value(model, parameter, ParameterValue(text(number)));
  }
  if (!parameter.range.contains(number)) {
    throw ParameterError(subject + " is " + text(number) + " and must be within [" + text(parameter.range.minimum) +
                         ", " + text(parameter.range.maximum) + "]");
  }
  return number;
}

template <class M>
std::unique_ptr<Model> make(const ModelInfo& info, const Parameters& parameters) {
  M model;
  for (const auto& [name, value] : parameters) {
    const std::vector<std::string> names = info.resolve(name);
    if (names.empty()) {
      std::vector<std::string> candidates;
      for (const ParameterInfo& parameter : info.parameters) candidates.push_back(parameter.name);
      for (const Shorthand& shorthand : info.shorthands) candidates.push_back(shorthand.name);
      const std::string close = suggestion(name, candidates);
      throw ParameterError(info.name + " has no parameter '" + name + "'" +
                           (close.empty() ? "; it has " + text(candidates) : "; did you mean '" + close + "'?"));
    }
    for (const Parameter<M>& parameter : M::parameters()) {
      if (std::find(names.begin(), names.end(), parameter.info.name) == names.end()) continue;
      if (parameter.info.is_text) {
        if (!std::holds_alternative<std::string>(value)) {
          throw ParameterError(info.name + ": " + name + " is a number and must be a text");
        }
        parameter.text(model) = std::get<std::string>(value);
      } else {
        parameter.set(model, checked_value(info, parameter.info, value));
      }
    }
  }
  if constexpr (requires { model.load(); }) model.load();
  return std::make_unique<ErasedModel<M>>(std::move(model), info);
}

template <class M>
ModelInfo complete_info() {
  ModelInfo info = M::info();
  for (const Parameter<M>& parameter : M::parameters()) info.parameters.push_back(parameter.info);
  info.claims = M{}.claims();
  return info;
}

struct Registry {
  using Factory = std::unique_ptr<Model> (*)(const ModelInfo&, const Parameters&);

  std::vector<ModelInfo> infos;
  std::vector<Factory> factories;

  template <class... Models>
  explicit Registry(ModelList<Models...>) : infos{complete_info<Models>()...}, factories{&make<Models>...} {}

  static const Registry& instance() {
    static const Registry registry{AllModels{}};
    return registry;
  }

  [[nodiscard]] std::size_t find(std::string_view name) const {
    const auto found =
        std::find_if(infos.begin(), infos.end(), [&](const ModelInfo& info) { return info.name == name; });
    if (found != infos.end()) return static_cast<std::size_t>(found - infos.begin());
    std::vector<std::string> names;
    for (const ModelInfo& info : infos) names.push_back(info.name);
    const std::string close = suggestion(name, names);
    throw UnknownModel("unknown model '" + std::string(name) + "'" +
                       (close.empty() ? "; known are " + text(names) : "; did you mean '" + close + "'?"));
  }
};

}  // namespace

const ParameterInfo* ModelInfo::find(std::string_view wanted) const {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(), [&](const auto& p) { return p.name == wanted; });
  return found == parameters.end() ? nullptr : &*found;
}

bool ModelInfo::needs_input() const {
  return std::any_of(parameters.begin(), parameters.end(), [](const ParameterInfo& p) { return p.is_text; });
}

const ParameterInfo* ModelInfo::channel() const {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(), [](const auto& p) { return p.is_choice() && p.per_channel; });
  return found == parameters.end() ? nullptr : &*found;
}

std::vector<std::string> ModelInfo::resolve(std::string_view wanted) const {
  for (const Shorthand& shorthand : shorthands) {
    if (shorthand.name == wanted) return shorthand.parameters;
  }
  if (find(wanted) != nullptr) return {std::string(wanted)};
  return {};
}

std::unique_ptr<Model> make_model(std::string_view name, const Parameters& parameters) {
  const Registry& registry = Registry::instance();
  const std::size_t index = registry.find(name);
  return registry.factories[index](registry.infos[index], parameters);
}

const std::vector<ModelInfo>& model_infos() { return Registry::instance().infos; }

const ModelInfo& model_info(std::string_view name) {
  const Registry& registry = Registry::instance();
  return registry.infos[registry.find(name)];
}

}  // namespace albedo
