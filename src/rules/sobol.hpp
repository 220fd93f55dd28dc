#pragma once

#include "albedo/core/estimate.hpp"
#include "albedo/core/rule_options.hpp"
#include "core/integrand.hpp"
#include "rules/stratified.hpp"

namespace albedo {

/// Randomised quasi-Monte Carlo: the first 2^k points of Sobol's sequence in each panel, in `replicate_count`
/// independent Owen scrambles. The error is the standard error of their mean (one sigma, 15 degrees of freedom), or a
/// quarter of what it was for half of the points where that is larger.
///
/// Every scramble is a nested permutation of the binary digits [Owen 1995] by a hash of the digits before
/// [Laine & Karras 2011, sect. 3; Burley 2020], keyed by a counter-based stream (Philox4x32-10) of seed, replicate and
/// panel; so each point is uniform and each replicate stays a (0, 2)-sequence in base 2. k grows, keeping the points
/// there are, until the tolerance is met; a feature has to hold a point of every replicate before the result is
/// believed.
/// While a single point makes more than a twentieth of the sum of squares (an infinite variance), nothing is believed.
/// A budget of less than 16 points a panel is answered with an infinite error and no evaluations; less than 1024 points
/// a panel never converge.
Estimate sobol(const Integrand<double>& integrand, const RuleOptions& options);

}  // namespace albedo
