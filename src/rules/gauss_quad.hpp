#pragma once

#include "albedo/core/quad.hpp"
#include "rules/gauss.hpp"

namespace albedo {

extern template EstimateIn<Quad> gauss(const Integrand<Quad>&, const RuleOptions&);

}  // namespace albedo
