/// @file
/// What the cases amount to.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "peers/measure.hpp"

namespace albedo::peers {

/// A case at a target in which gauss takes longer than the fastest library rule.
struct Slower {
  const CaseResult* result;
  double target;
  const PeerResult* peer;
};

/// The cases' ratios of a baseline's time to gauss's, at one target.
struct Ratios {
  std::vector<double> values{};  ///< of the cases that the baseline got right, ascending
  int cases = 0;

  [[nodiscard]] double median() const;
  [[nodiscard]] double smallest() const;
};

/// A row of the table.
struct Baseline {
  std::string name;
  /// Its ratio in a case at a target; infinite where it isn't right.
  std::function<double(const TargetResult&)> ratio;
};

/// hcubature and nested cquad asked for the target in (θ_V, φ_V); the best scalar rule; the best of all, integrands in
/// blocks.
std::vector<Baseline> baselines();

/// One for each of the results' targets.
std::vector<Ratios> ratios(const Baseline& baseline, const std::vector<CaseResult>& results);

/// The fastest that reaches the target; nullptr if none does. @param vectorised also rules on blocks
const PeerResult* best_peer(const TargetResult& result, bool vectorised);

std::vector<Slower> slower_cases(const std::vector<CaseResult>& results, bool vectorised);

/// gauss's true error is within the target, and it says so.
bool is_right(const TargetResult& result);

double median(std::vector<double> values);

}  // namespace albedo::peers
