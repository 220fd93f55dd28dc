/// @file
/// The options that every computing subcommand takes.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "albedo/directional_albedo.hpp"

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
void add_compute_options(CLI::App& command, ComputeOptions& options);

/// Adds an option whose value is one finite number.
CLI::Option* add_number(CLI::App& command, const std::string& name, double& value, const std::string& description);

}  // namespace albedo::analysis
