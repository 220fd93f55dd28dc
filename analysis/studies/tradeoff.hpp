/// @file
/// Speed against accuracy: what every rule on every warp really reaches, what it says it reaches, and what that takes.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "albedo/directional_albedo.hpp"
#include "albedo/reference.hpp"
#include "analysis/studies/methods.hpp"
#include "numerics/parallel.hpp"

namespace albedo::analysis {

/// A model with its parameters, under a label that tells it from others of the same model ("smooth", "rough").
struct TradeoffMaterial {
  std::string model{};
  std::string label{};
  Parameters parameters{};
};

/// What is to be measured.
struct TradeoffRequest {
  std::vector<TradeoffMaterial> materials{};
  std::vector<double> thetas{0, 60, 85, 89.9};  ///< of L in degrees, below 90
  double phi = 0;                               ///< of L in degrees
  std::vector<Rule> rules{};
  std::vector<Warp> warps{};
  std::vector<double> tolerances{};         ///< of deterministic rules, falling
  std::vector<double> random_tolerances{};  ///< of Monte Carlo rules, falling
  Precision precision = Precision::float64;
  std::int64_t budget = 400'000;       ///< most evaluations of a run
  std::uint64_t seed = 1;              ///< of Monte Carlo rules
  int repeats = 5;                     ///< of every timing; runs of more than a millisecond, half of them
  double reference_tolerance = 1e-15;  ///< of the reference, relative
  int threads = 0;                     ///< for the references, which aren't timed; 0: as many as OpenMP would use
  ProgressCallback progress{};         ///< called from the calling thread
};

/// All rules on all warps, no materials; tolerances from 0.1 down to the last in steps of a digit, or half a digit for
/// the Monte Carlo rules.
TradeoffRequest default_tradeoff(double last = 1e-12, double last_random = 1e-4);

/// The smooth and the rough material of a model: of those the default set has, its own; of any other model, the one of
/// its default parameters. @throws UnknownModel
std::vector<TradeoffMaterial> usual_materials(const std::string& model);

/// The models of the default set.
const std::vector<std::string>& tradeoff_models();

/// One rule on one warp, asked for one tolerance.
struct TradeoffRun {
  Method method{};
  double tolerance = 0;
  Estimate estimate{};
  double true_error = 0;      ///< |value − reference|/|reference|
  double reported_error = 0;  ///< the estimate's own, over |reference|
  double seconds = 0;         ///< median of the repeats, single thread

  /// Wrong and claims to be converged: the true error is more than the reported one, or than four standard errors;
  /// `slack` is what the reference itself is good for, relative.
  [[nodiscard]] bool wrong(double slack) const;
};

/// All runs for a material and a direction.
struct TradeoffCell {
  std::size_t material = 0;
  double theta = 0;
  EstimateIn<Quad> reference{};
  std::vector<TradeoffRun> runs{};  ///< by method; each one's ladder ends where a tighter tolerance changes nothing

  /// What the reference is good for, relative.
  [[nodiscard]] double slack() const;
  /// The first run of a method from which on its true error stays at or below a target; null if there is none.
  [[nodiscard]] const TradeoffRun* reaching(const Method& method, double target) const;
};

/// The whole study.
struct Tradeoff {
  TradeoffRequest request{};  ///< the materials' parameters completed with the defaults
  std::vector<TradeoffCell> cells{};

  /// References that missed their tolerance.
  [[nodiscard]] std::size_t unconverged() const;
  /// The methods that have runs, in the request's order.
  [[nodiscard]] std::vector<Method> methods() const;
};

/// How a method does over all cells it was run on, at one target for the true error.
struct MethodSummary {
  std::size_t cells = 0;
  std::size_t reached = 0;
  double seconds = 0;      ///< medians over all its cells, infinite where most of them don't reach the target
  double evaluations = 0;  ///< likewise
  double ratio = 0;        ///< median of its time to that of gauss on the lobe's warp in the same cell
};
MethodSummary summary_of(const Tradeoff& study, const Method& method, double target);

/// Measures. A reference first, then all runs of a cell take turns, so that a busy machine is so for all alike.
/// @throws UnknownModel, ParameterError as make_model() and directional_albedo() do, or for angles outside [0, 90)
Tradeoff measure_tradeoff(TradeoffRequest request);

}  // namespace albedo::analysis
