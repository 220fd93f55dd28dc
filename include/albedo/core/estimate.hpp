#pragma once

#include <cstdint>
#include <string_view>

namespace albedo {

/// What an Estimate's error is; kinds don't compare with each other.
enum class ErrorKind {
  embedded,         ///< from the decay of the expansion on the rule's own nodes, and from comparing orders
  rule_difference,  ///< difference between two rules on the same points, summed over boxes
  standard_error,   ///< standard error of the mean of independent replicates (one sigma)
  extrapolated,     ///< change between two evaluations on the way to a limit
};

/// How an integration ended.
enum class Status {
  converged,         ///< the error meets the tolerance
  budget_exhausted,  ///< not converged: the error is larger than the tolerance, or isn't to be believed
  rounding_limited,  ///< the arithmetic can't meet the tolerance, whatever the budget
  divergent,         ///< the integral is infinite
  non_finite,        ///< the formula returned NaN or infinity at some point
};

/// The result of an integration: a value, and what can be believed of it. The value is never clamped.
struct Estimate {
  double value = 0;
  double error = 0;  ///< absolute
  ErrorKind error_kind = ErrorKind::embedded;
  std::int64_t evaluations = 0;  ///< of the BRDF
  Status status = Status::converged;
};

/// An Estimate whose value and error are in the number type of the computation.
template <class S>
struct EstimateIn {
  S value{};
  S error{};
  std::int64_t evaluations = 0;
  Status status = Status::converged;
};

std::string_view to_string(ErrorKind kind);
std::string_view to_string(Status status);

}  // namespace albedo
