#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "albedo/core/estimate.hpp"
#include "albedo/core/rule_options.hpp"
#include "core/integrand.hpp"

namespace albedo {

/// Widths of a feature from its place on, beyond which none of it is left.
inline constexpr double feature_reach = 32;

/// What rounding may make of a sum of that magnitude, subnormal numbers among it.
template <class S>
S rounding_of(const S& magnitude) {
  constexpr int units = 16;
  if (magnitude == 0) return S(0);
  return std::max<S>(units * std::numeric_limits<S>::epsilon() * magnitude, std::numeric_limits<S>::min());
}

/// The result of a rule whose first look alone costs more than the budget: nothing is known.
inline Estimate unaffordable(ErrorKind kind) {
  return {0, std::numeric_limits<double>::infinity(), kind, 0, Status::budget_exhausted};
}

/// Sets value, error and status of a Monte Carlo estimate; `met`: every feature has been looked at, by enough points to
/// tell an error. True where there is nothing more to do.
inline bool conclude(Estimate& estimate, double mean, double standard_error, bool met,
                     const Integrand<double>& integrand, const RuleOptions& options) {
  estimate.value = mean;
  estimate.error = standard_error + integrand.truncation() * std::abs(mean);
  constexpr double least = 1e-140;  // the squares of less are subnormal, and tell nothing
  if (!std::isfinite(mean) || !std::isfinite(standard_error)) {
    estimate.status = Status::non_finite;
  } else if (mean != 0 && std::abs(mean) < least) {
    estimate.error = std::numeric_limits<double>::infinity();
    estimate.status = Status::rounding_limited;
  } else if (met && estimate.error <= options.tolerance * std::abs(mean)) {
    estimate.status = Status::converged;
  } else {
    estimate.status = Status::budget_exhausted;
  }
  return estimate.status != Status::budget_exhausted;
}

/// The largest of many squares and their sum: where one makes more than a twentieth, the variance isn't known yet, or
/// is infinite.
struct Squares {
  double largest = 0, sum = 0;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;  ///< of the values themselves

  void add(double value) {
    largest = std::max(largest, value * value);
    sum += value * value;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  [[nodiscard]] bool dominated() const { return largest > sum / 20; }
  [[nodiscard]] double range() const { return highest - lowest; }
};

/// Whether check(feature) holds for every feature of every panel.
template <class Check>
bool every_feature(const Integrand<double>& integrand, const Check& check) {
  return std::all_of(integrand.panels().begin(), integrand.panels().end(), [&](const Panel& panel) {
    return std::all_of(panel.features.begin(), panel.features.end(), check);
  });
}

}  // namespace albedo
