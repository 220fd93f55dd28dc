#include "analysis/commands/options.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
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

/// An option that takes one of several names.
template <class Names, class E>
void add_choice(CLI::App& command, const std::string& option, const Names& names, E& target,
                const std::string& description) {
  std::vector<std::string> valid;
  for (const auto& entry : names) valid.emplace_back(entry.name);
  const auto set = [&names, &target, option, valid](const std::string& text) {
    const auto found = std::ranges::find_if(names, [&](const auto& entry) { return entry.name == text; });
    if (found == names.end()) {
      const std::string close = suggestion(text, valid);
      throw ParameterError(option + " is '" + text + "' and must be one of " + joined(valid, ", ") +
                           (close.empty() ? "" : "; did you mean '" + close + "'?"));
    }
    target = found->value;
  };
  command.add_option_function<std::string>(option, set, description)
      ->type_name(joined(valid, "|"))
      ->default_str(name_of(names, target));
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

}  // namespace

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
  command
      .add_option_function<std::string>(
          "--tolerance",
          [&options](const std::string& text) {
            const double value = parse_number("--tolerance", text);
            if (!(value >= 1e-30 && value < 1))
              throw ParameterError("--tolerance is " + text + " and must be within [1e-30, 1)");
            options.tolerance = value;
          },
          "relative; default 1e-8, or 1e-4 for stratified, sobol and monte_carlo")
      ->type_name("REL");
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

CLI::Option* add_number(CLI::App& command, const std::string& name, double& value, const std::string& description) {
  const auto set = [&value, name](const std::string& text) { value = parse_number(name, text); };
  return command.add_option_function<std::string>(name, set, description)->default_str(number_text(value, 6));
}

}  // namespace albedo::analysis
