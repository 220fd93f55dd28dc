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

/// Product rule on each panel: Gauss–Legendre on an interval, the midpoint rule on a turn.
///
/// The integrand's expansion (Legendre or Fourier) is read off the rule's own nodes. A rule of n nodes errs by the
/// coefficient near 2n, which the decay of the known ones bounds; that is the error, and it tells the order that the
/// tolerance needs. Where the coefficients don't decay at the largest order, the panel is bisected. The error of an
/// order that was raised is also compared with what raising it changed.
template <class S>
EstimateIn<S> gauss(const Integrand<S>& integrand, const RuleOptions& options);

extern template EstimateIn<double> gauss(const Integrand<double>&, const RuleOptions&);
extern template EstimateIn<Quad> gauss(const Integrand<Quad>&, const RuleOptions&);

}  // namespace albedo
