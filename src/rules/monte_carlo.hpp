#pragma once

#include "albedo/core/estimate.hpp"
#include "albedo/core/rule_options.hpp"
#include "core/integrand.hpp"

namespace albedo {

/// Plain Monte Carlo: independent uniform points, as many in every panel. The error is the standard error of the mean
/// (one sigma), from the sample variance in each panel.
///
/// Points come from counter-based streams (Philox4x32-10) keyed by the seed and counted by panel and index. Their
/// number grows by what the variance asks for until the tolerance is met. Nothing is believed before there are 1024
/// points a panel and some 256 in every feature, nor while a single point makes more than a twentieth of the variance
/// (a variance that isn't known yet, or is infinite).
/// A budget of less than 2 points a panel is answered with an infinite error and no evaluations.
Estimate monte_carlo(const Integrand<double>& integrand, const RuleOptions& options);

}  // namespace albedo
