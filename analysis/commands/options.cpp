#include "analysis/commands/options.hpp"

#include <limits>

#include "albedo/core/errors.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/text/text.hpp"
#include "analysis/text/value.hpp"

namespace albedo::analysis {
namespace {

void add_tolerance(const Syntax& command, std::optional<double>& target, const std::string& description) {
  const auto set = [&target](const std::string& text) {
    const double value = parse_number("--tolerance", text);
    if (!(value >= 1e-30 && value < 1))
      throw ParameterError("--tolerance is " + text + " and must be within [1e-30, 1)");
    target = value;
  };
  command.parsed("--tolerance", set, description).type_name("REL");
}

/// --budget, --precision, --seed, --threads and --json
template <class Options>
void add_common(const Syntax& command, Options& options) {
  add_integer<std::int64_t>(command, "--budget", options.budget, 1, std::numeric_limits<std::int64_t>::max(),
                            "most evaluations for one direction")
      .default_text(std::to_string(options.budget));
  add_choice(command, "--precision", all_precisions, options.precision, "the arithmetic of the model's formula");
  add_integer<std::uint64_t>(command, "--seed", options.seed, 0, std::numeric_limits<std::uint64_t>::max(),
                             "of the Monte Carlo rules")
      .default_text(std::to_string(options.seed));
  add_integer(command, "--threads", options.threads, 1, 1024, "default: one a core");
  command.flag("--json", options.json, "print one JSON object");
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
  object["rule"] = name_of(rule);
  object["warp"] = name_of(warp);
  object["tolerance"] = albedo().tolerance;
  object["precision"] = name_of(precision);
  if (is_monte_carlo(rule)) object["seed"] = seed;
}

void add_compute_options(const Syntax& command, ComputeOptions& options) {
  add_choice(command, "--rule", all_rules, options.rule, "where the points are");
  add_choice(command, "--warp", all_warps, options.warp,
             "the map they are taken through: the lobe's exact domain, all of V, or the sampling of the model's paper");
  add_tolerance(command, options.tolerance, "relative; default 1e-8, or 1e-4 for stratified, sobol and monte_carlo");
  add_common(command, options);
}

void add_method_options(const Syntax& command, MethodOptions& options) {
  add_choices(command, "--rule", all_rules, options.rules, "only these; default: all");
  add_choices(command, "--warp", all_warps, options.warps, "only these; default: all");
  add_tolerance(command, options.tolerance, "the last of a ladder; default 1e-12, or 1e-4 for the Monte Carlo rules");
  add_common(command, options);
}

void add_repeat(const Syntax& command, int& repeats) {
  add_integer(command, "--repeat", repeats, 1, 1000, "timings of every run, whose median counts; default 5");
}

OptionSyntax add_real(const Syntax& command, const std::string& option, double& target, double least, double most,
                      const std::string& description) {
  const auto set = [&target, option, least, most](const std::string& text) {
    const double value = parse_number(option, text);
    if (!(value >= least && value <= most)) {
      throw ParameterError(option + " is " + text + " and must be within [" + number_text(least, 6) + ", " +
                           number_text(most, 6) + "]");
    }
    target = value;
  };
  return command.parsed(option, set, description).type_name("X").default_text(number_text(target, 6));
}

OptionSyntax add_number(const Syntax& command, const std::string& name, double& value, const std::string& description) {
  const auto set = [&value, name](const std::string& text) { value = parse_number(name, text); };
  return command.parsed(name, set, description).default_text(number_text(value, 6));
}

}  // namespace albedo::analysis
