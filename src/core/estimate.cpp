#include "albedo/core/estimate.hpp"

namespace albedo {

std::string_view to_string(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::embedded:
      return "embedded";
    case ErrorKind::rule_difference:
      return "rule_difference";
    case ErrorKind::standard_error:
      return "standard_error";
    case ErrorKind::extrapolated:
      break;
  }
  return "extrapolated";
}

std::string_view to_string(Status status) {
  switch (status) {
    case Status::converged:
      return "converged";
    case Status::budget_exhausted:
      return "budget_exhausted";
    case Status::rounding_limited:
      return "rounding_limited";
    case Status::divergent:
      return "divergent";
    case Status::non_finite:
      break;
  }
  return "non_finite";
}

}  // namespace albedo
