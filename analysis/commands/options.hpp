/// @file
/// The options that every computing subcommand takes.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "albedo/directional_albedo.hpp"
#include "analysis/commands/syntax.hpp"

namespace albedo::analysis {

struct ComputeOptions {
  Rule rule = Rule::gauss;
  Warp warp = Warp::lobe;
  Precision precision = Precision::float64;
  std::optional<double> tolerance{};  ///< not given: as the rule can meet
  std::int64_t budget = AlbedoOptions{}.budget;
  std::uint64_t seed = AlbedoOptions{}.seed;
  int threads = 0;  ///< 0: as many as OpenMP would use
  bool json = false;

  [[nodiscard]] AlbedoOptions albedo() const;

  /// Appends "rule", "warp", "tolerance", "precision" and, where it matters, "seed".
  void describe(nlohmann::ordered_json& object) const;
};

/// Adds --rule, --warp, --tolerance, --budget, --precision, --seed, --threads and --json; `options` must outlive the
/// parsing. While parsing, a value that is malformed or out of range throws a ParameterError.
void add_compute_options(const Syntax& command, ComputeOptions& options);

/// The same for what compares several rules and warps.
struct MethodOptions {
  std::vector<Rule> rules{};  ///< empty: all
  std::vector<Warp> warps{};
  Precision precision = Precision::float64;
  std::optional<double> tolerance{};
  std::int64_t budget = 400'000;
  std::uint64_t seed = AlbedoOptions{}.seed;
  int threads = 0;
  bool json = false;
};

/// Adds --rule, --warp (lists), --tolerance, --budget, --precision, --seed, --threads and --json.
void add_method_options(const Syntax& command, MethodOptions& options);

/// Adds --repeat.
void add_repeat(const Syntax& command, int& repeats);

/// Adds an option whose value is one finite number.
OptionSyntax add_number(const Syntax& command, const std::string& name, double& value, const std::string& description);

}  // namespace albedo::analysis
