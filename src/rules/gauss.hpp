#pragma once

#include "albedo/core/estimate.hpp"
#include "albedo/core/rule_options.hpp"
#include "core/integrand.hpp"

namespace albedo {

/// Product rule on each panel: Gauss–Legendre on an interval, equidistant points on a turn.
///
/// Both rules are extended by about as many nodes as they have, and what that changes is the error: along u, Kronrod's
/// extension on a few rays that stand for all of them (the most doubtful by their last Legendre coefficients); along v
/// the rays of the extension join the others, and the coefficients of the whole tell how much of the change is left.
/// Orders are raised until the tolerance is met; where the coefficients don't decay at the largest, the panel is
/// bisected.
template <class S>
EstimateIn<S> gauss(const Integrand<S>& integrand, const RuleOptions& options);

// In double; rules/gauss_quad.cpp has that of 113 bits.
extern template EstimateIn<double> gauss(const Integrand<double>&, const RuleOptions&);

/// The same as an Estimate.
Estimate gauss_estimate(const Integrand<double>& integrand, const RuleOptions& options);

}  // namespace albedo
