#pragma once

#include "albedo/core/estimate.hpp"
#include "albedo/core/rule_options.hpp"
#include "core/integrand.hpp"

namespace albedo {

/// Nested Gauss–Kronrod quadrature: 15 nodes over v, in each of them 21 over u; both levels globally adaptive.
///
/// An interval's error is the difference between the rule and the Gauss rule in it, or QUADPACK's rescaling of it where
/// that is larger [Piessens et al. 1983]; what bisecting changed unforeseen is kept in the halves' errors. Rows are
/// integrated to a tenth of what is asked for, and their errors are part of the reported error. Nothing is believed
/// before the intervals of v are no wider than four widths of the panel's features in them, or than their distance from
/// those beside them; rows near a feature are divided likewise.
/// In a panel with an edge inside, an interval also answers for what an edge may hide between its outermost nodes and
/// its ends; a jump that isn't announced so and cuts off a corner between the nodes isn't seen. A budget of less than
/// 315 points a panel is answered with an infinite error and no evaluations.
Estimate kronrod(const Integrand<double>& integrand, const RuleOptions& options);

}  // namespace albedo
