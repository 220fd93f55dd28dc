#include <algorithm>
#include <cmath>

#include "albedo/core/errors.hpp"
#include "albedo/core/suggestion.hpp"
#include "albedo/registry.hpp"
#include "core/text.hpp"
#include "models/built_in.hpp"

namespace albedo {
namespace {

std::string text(const Range& range) {
  return fmt::format("[{}, {}]", shortest_text(range.minimum), shortest_text(range.maximum));
}

struct Registry {
  std::vector<std::reference_wrapper<const ModelInfo>> infos;
  std::vector<detail::Factory> factories;

  static Registry& instance() {
    static Registry registry = [] {
      Registry built;
      for (const BuiltInModel& model : built_in_models()) built.add(model.info, model.factory);
      return built;
    }();
    return registry;
  }

  void add(const ModelInfo& info, detail::Factory factory) {
    infos.emplace_back(info);
    factories.push_back(factory);
  }

  [[nodiscard]] std::size_t find(std::string_view name) const {
    const auto found =
        std::ranges::find(infos, name, [](const ModelInfo& info) { return std::string_view(info.name); });
    if (found != infos.end()) return static_cast<std::size_t>(found - infos.begin());
    std::vector<std::string> names;
    for (const ModelInfo& info : infos) names.push_back(info.name);
    const std::string close = suggestion(name, names);
    throw UnknownModel(fmt::format("unknown model '{}'{}", name,
                                   close.empty() ? "; known are " + joined(names) : "; did you mean '" + close + "'?"));
  }
};

void check_name(const std::string& subject, const std::string& name, const std::vector<std::string>& taken) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (name.empty() || !is_letter(name.front()) ||
      !std::ranges::all_of(name, [&](char c) { return is_letter(c) || is_digit(c); })) {
    throw ParameterError(subject + " is named '" + name + "' and must be named by letters, digits and underscores");
  }
  if (std::ranges::find(taken, name) != taken.end()) {
    throw ParameterError(subject + " can't be named '" + name + "': the name is taken");
  }
}

/// What the library's own models are known to satisfy.
void check_info(const ModelInfo& info) {
  std::vector<std::string> taken{"sum", "coupled"};
  for (const ModelInfo& other : model_infos()) taken.push_back(other.name);
  check_name("a model", info.name, taken);
  taken = {"theta", "cos_theta", "phi", "weight"};
  for (const ParameterInfo& parameter : info.parameters) {
    check_name("a parameter of " + info.name, parameter.name, taken);
    taken.push_back(parameter.name);
    if (!parameter.is_text && !parameter.range.contains(parameter.default_value)) {
      throw ParameterError(info.name + ": the default of " + parameter.name + " is " +
                           shortest_text(parameter.default_value) + " and must be within " + text(parameter.range));
    }
  }
  for (const Shorthand& shorthand : info.shorthands) {
    check_name("a shorthand of " + info.name, shorthand.name, taken);
    taken.push_back(shorthand.name);
    for (const std::string& parameter : shorthand.parameters) {
      if (info.find(parameter) == nullptr) {
        throw ParameterError(info.name + ": the shorthand " + shorthand.name + " sets '" + parameter +
                             "', and there is no such parameter");
      }
    }
  }
}

}  // namespace

namespace detail {

std::vector<std::string> resolved(const ModelInfo& model, const std::string& name) {
  std::vector<std::string> names = model.resolve(name);
  if (!names.empty()) return names;
  std::vector<std::string> candidates;
  for (const ParameterInfo& parameter : model.parameters) candidates.push_back(parameter.name);
  for (const Shorthand& shorthand : model.shorthands) candidates.push_back(shorthand.name);
  const std::string close = suggestion(name, candidates);
  throw ParameterError(model.name + " has no parameter '" + name + "'" +
                       (!close.empty()       ? "; did you mean '" + close + "'?"
                        : candidates.empty() ? "; it has none"
                                             : "; it has " + joined(candidates)));
}

double checked_value(const ModelInfo& model, const ParameterInfo& parameter, const ParameterValue& value) {
  const std::string subject = model.name + ": " + parameter.name;
  if (const auto* name = std::get_if<std::string>(&value)) {
    const auto found = std::find(parameter.choices.begin(), parameter.choices.end(), *name);
    if (found != parameter.choices.end()) return static_cast<double>(found - parameter.choices.begin());
    const std::string valid = parameter.is_choice() ? "one of " + joined(parameter.choices) : "a number";
    throw ParameterError(subject + " is '" + *name + "' and must be " + valid);
  }
  const double number = std::get<double>(value);
  if (parameter.is_choice()) {  // names such as Kurt's equation=9 look like numbers
    return checked_value(model, parameter, ParameterValue(shortest_text(number)));
  }
  check_range(model, parameter, number);
  return number;
}

void check_range(const ModelInfo& model, const ParameterInfo& parameter, double value) {
  if (parameter.range.contains(value)) return;
  throw ParameterError(fmt::format("{}: {} is {} and must be within {}", model.name, parameter.name,
                                   shortest_text(value), text(parameter.range)));
}

const std::string& checked_text(const ModelInfo& model, const ParameterInfo& parameter, const ParameterValue& value) {
  if (const auto* given = std::get_if<std::string>(&value)) return *given;
  throw ParameterError(model.name + ": " + parameter.name + " is a number and must be a text");
}

void register_model(const ModelInfo& info, Factory factory) {
  check_info(info);
  Registry::instance().add(info, factory);
}

}  // namespace detail

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
  return registry.factories[index](parameters);
}

std::vector<std::reference_wrapper<const ModelInfo>> model_infos() { return Registry::instance().infos; }

const ModelInfo& model_info(std::string_view name) {
  const Registry& registry = Registry::instance();
  return registry.infos[registry.find(name)];
}

}  // namespace albedo
