#pragma once

#include "albedo/core/estimate.hpp"
#include "albedo/core/integrand.hpp"
#include "albedo/rules/options.hpp"

namespace albedo {

/// An Estimate whose value and error are in the number type of the computation.
template <class S>
struct EstimateIn {
  S value{};
  S error{};
  std::int64_t evaluations = 0;
  Status status = Status::converged;
};

/// Product rule on each panel: Gauss–Legendre on an interval, equidistant points on a turn.
///
/// Both rules are extended by about as many nodes as they have, and what that changes is the error: along u, Kronrod's
/// extension on a few rays that stand for all of them (the most doubtful by their last Legendre coefficients); along v
/// the rays of the extension join the others, and the coefficients of the whole tell how much of the change is left.
/// Orders are raised until the tolerance is met; where the coefficients don't decay at the largest, the panel is
/// bisected.
template <class S>
EstimateIn<S> gauss(const Integrand<S>& integrand, const RuleOptions& options);

extern template EstimateIn<double> gauss(const Integrand<double>&, const RuleOptions&);
extern template EstimateIn<Quad> gauss(const Integrand<Quad>&, const RuleOptions&);

}  // namespace albedo
