#pragma once

#include "albedo/core/estimate.hpp"
#include "albedo/core/rule_options.hpp"
#include "core/integrand.hpp"

namespace albedo {

/// Independent replicates that the standard error of the stratified rule is estimated from.
inline constexpr int replicate_count = 16;

/// Jittered stratified Monte Carlo: one random point in each of n × n strata of every panel, in `replicate_count`
/// independent replicates. The error is the standard error of their mean (one sigma, 15 degrees of freedom).
///
/// Points come from counter-based streams (Philox4x32-10) keyed by the seed and counted by replicate, panel, size and
/// stratum: the same seed gives the same bits in any order of evaluation. A panel's feature has to be met by the strata
/// before the result is believed; n grows until the tolerance is met.
/// While a single point makes more than a twentieth of the sum of squares (an infinite variance), nothing is believed.
/// A budget of less than 16 points a panel is answered with an infinite error and no evaluations; less than 1024 points
/// a panel never converge.
Estimate stratified(const Integrand<double>& integrand, const RuleOptions& options);

}  // namespace albedo
