#pragma once

#include "albedo/core/estimate.hpp"
#include "albedo/core/rule_options.hpp"
#include "core/integrand.hpp"

namespace albedo {

/// Nested tanh–sinh quadrature [Takahasi & Mori 1974]: the trapezoidal rule in t over v, and over u in each of its
/// nodes, where x = 1/(1 + exp(−π sinh t)). Steps are halved, 1/4 at first, on either level where it tells.
///
/// An error is the change from the step before; where the last three changes don't shrink as fast as they do for
/// analytic integrands (each like the one before to the power 1.5), eight times that and a quarter of the change
/// before. Rows are integrated to a tenth of what is asked for, and their errors are part of the reported error. Steps
/// have to be as small as a panel's features before the result is believed; where such places are narrow and many, this
/// rule exhausts its budget. A budget of less than the 64 points a panel of step 1 is answered with an infinite error
/// and no evaluations; less than those of step 1/4 never converge.
Estimate tanh_sinh(const Integrand<double>& integrand, const RuleOptions& options);

}  // namespace albedo
