#include "analysis/commands/options.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <sstream>
#include <string_view>

#include "albedo/core/errors.hpp"
#include "albedo/core/suggestion.hpp"
#include "analysis/commands/text.hpp"
#include "analysis/input/value.hpp"

namespace albedo::analysis {
namespace {

template <class E>
struct Name {
  std::string_view name;
  E value;
};
template <class E>
Name(std::string_view, E) -> Name<E>;

constexpr std::array rule_names{Name{"gauss", Rule::gauss},
                                Name{"cubature", Rule::cubature},
                                Name{"kronrod", Rule::kronrod},
                                Name{"tanh_sinh", Rule::tanh_sinh},
                                Name{"stratified", Rule::stratified},
                                Name{"sobol", Rule::sobol},
                                Name{"monte_carlo", Rule::monte_carlo}};
constexpr std::array warp_names{Name{"lobe", Warp::lobe}, Name{"hemisphere", Warp::hemisphere},
                                Name{"paper", Warp::paper}};
constexpr std::array precision_names{Name{"double", Precision::float64}, Name{"float", Precision::float32},
                                     Name{"quad", Precision::quad}};

template <class Names, class E>
std::string name_of(const Names& names, E value) {
  return std::string(std::ranges::find_if(names, [&](const auto& entry) { return entry.value == value; })->name);
}

/// The value of a name. @throws ParameterError that says which there are
template <class Names>
auto value_of(const Names& names, const std::string& option, const std::string& text) {
  const auto found = std::ranges::find_if(names, [&](const auto& entry) { return entry.name == text; });
  if (found != names.end()) return found->value;
  std::vector<std::string> valid;
  for (const auto& entry : names) valid.emplace_back(entry.name);
  const std::string close = suggestion(text, valid);
  throw ParameterError(option + " is '" + text + "' and must be one of " + joined(valid, ", ") +
                       (close.empty() ? "" : "; did you mean '" + close + "'?"));
}

template <class Names>
std::string type_name(const Names& names) {
  std::vector<std::string> valid;
  for (const auto& entry : names) valid.emplace_back(entry.name);
  return joined(valid, "|");
}

/// An option that takes one of several names.
template <class Names, class E>
void add_choice(CLI::App& command, const std::string& option, const Names& names, E& target,
                const std::string& description) {
  const auto set = [&names, &target, option](const std::string& text) { target = value_of(names, option, text); };
  command.add_option_function<std::string>(option, set, description)
      ->type_name(type_name(names))
      ->default_str(name_of(names, target));
}

/// An option that takes some of several names, with commas between them; given again, it adds to them.
template <class Names, class E>
void add_choices(CLI::App& command, const std::string& option, const Names& names, std::vector<E>& target,
                 const std::string& description) {
  const auto set = [&names, &target, option](const std::vector<std::string>& lists) {
    for (const std::string& list : lists) {
      std::istringstream stream(list.empty() ? "," : list);
      for (std::string name; std::getline(stream, name, ',');) {
        const auto value = value_of(names, option, name);
        if (std::ranges::find(target, value) == target.end()) target.push_back(value);
      }
    }
  };
  command.add_option_function<std::vector<std::string>>(option, set, description)
      ->type_name(type_name(names) + "[,...]")
      ->allow_extra_args(false);
}

/// An option that takes a whole number within [least, most].
template <class Integer>
CLI::Option* add_integer(CLI::App& command, const std::string& option, Integer& target, Integer least, Integer most,
                         const std::string& description) {
  const auto set = [&target, option, least, most](const std::string& text) {
    Integer value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < least || value > most) {
      throw ParameterError(option + " is '" + text + "' and must be a whole number within [" + std::to_string(least) +
                           ", " + std::to_string(most) + "]");
    }
    target = value;
  };
  return command.add_option_function<std::string>(option, set, description)->type_name("N");
}

void add_tolerance(CLI::App& command, std::optional<double>& target, const std::string& description) {
  const auto set = [&target](const std::string& text) {
    const double value = parse_number("--tolerance", text);
    if (!(value >= 1e-30 && value < 1))
      throw ParameterError("--tolerance is " + text + " and must be within [1e-30, 1)");
    target = value;
  };
  command.add_option_function<std::string>("--tolerance", set, description)->type_name("REL");
}

/// --budget, --precision, --seed, --threads and --json
template <class Options>
void add_common(CLI::App& command, Options& options) {
  add_integer<std::int64_t>(command, "--budget", options.budget, 1, std::numeric_limits<std::int64_t>::max(),
                            "most evaluations for one direction")
      ->default_str(std::to_string(options.budget));
  add_choice(command, "--precision", precision_names, options.precision, "the arithmetic of the model's formula");
  add_integer<std::uint64_t>(command, "--seed", options.seed, 0, std::numeric_limits<std::uint64_t>::max(),
                             "of the Monte Carlo rules")
      ->default_str(std::to_string(options.seed));
  add_integer(command, "--threads", options.threads, 1, 1024, "default: one a core");
  command.add_flag("--json", options.json, "print one JSON object");
}

}  // namespace

std::string name_of(Rule rule) { return name_of(rule_names, rule); }
std::string name_of(Warp warp) { return name_of(warp_names, warp); }
std::string name_of(Precision precision) { return name_of(precision_names, precision); }

AlbedoOptions ComputeOptions::albedo() const {
  const double usual = is_monte_carlo(rule) ? 1e-4 : 1e-8;
  return {.rule = rule,
          .warp = warp,
          .precision = precision,
          .tolerance = tolerance.value_or(usual),
          .budget = budget,
          .seed = seed};
}

void ComputeOptions::describe(nlohmann::ordered_json& object) const {
  object["rule"] = name_of(rule_names, rule);
  object["warp"] = name_of(warp_names, warp);
  object["tolerance"] = albedo().tolerance;
  object["precision"] = name_of(precision_names, precision);
  if (is_monte_carlo(rule)) object["seed"] = seed;
}

void add_compute_options(CLI::App& command, ComputeOptions& options) {
  add_choice(command, "--rule", rule_names, options.rule, "where the points are");
  add_choice(command, "--warp", warp_names, options.warp,
             "the map they are taken through: the lobe's exact domain, all of V, or the sampling of the model's paper");
  add_tolerance(command, options.tolerance, "relative; default 1e-8, or 1e-4 for stratified, sobol and monte_carlo");
  add_common(command, options);
}

void add_method_options(CLI::App& command, MethodOptions& options) {
  add_choices(command, "--rule", rule_names, options.rules, "only these; default: all");
  add_choices(command, "--warp", warp_names, options.warps, "only these; default: all");
  add_tolerance(command, options.tolerance, "the last of a ladder; default 1e-12, or 1e-4 for the Monte Carlo rules");
  add_common(command, options);
}

void add_repeat(CLI::App& command, int& repeats) {
  add_integer(command, "--repeat", repeats, 1, 1000, "timings of every run, whose median counts; default 5");
}

CLI::Option* add_number(CLI::App& command, const std::string& name, double& value, const std::string& description) {
  const auto set = [&value, name](const std::string& text) { value = parse_number(name, text); };
  return command.add_option_function<std::string>(name, set, description)->default_str(number_text(value, 6));
}

}  // namespace albedo::analysis
