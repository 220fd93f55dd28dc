#pragma once

#include "albedo/core/estimate.hpp"
#include "albedo/core/rule_options.hpp"
#include "core/integrand.hpp"

namespace albedo {

/// Globally adaptive cubature with Genz and Malik's rule of degree 7 (17 points in the plane), error from its embedded
/// rule of degree 5.
///
/// The box with the largest error is halved along the axis of the largest fourth difference [Genz & Malik 1980], until
/// the errors sum up to the tolerance. A box that holds a panel's feature isn't believed before it is as small as the
/// feature, and what halving a box changed stays in the halves' errors: a part of it where the box's error had foreseen
/// it, all of it where it hadn't.
/// Values and errors are summed anew at the end. In a panel with an edge inside, a box also answers for what an edge
/// may hide between its outermost points and its borders. A budget of less than 17 points a panel is answered with an
/// infinite error and no evaluations; less than 425 points a panel never converge.
Estimate cubature(const Integrand<double>& integrand, const RuleOptions& options);

}  // namespace albedo
