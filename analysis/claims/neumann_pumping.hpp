/// @file
/// Claims N6 to N11, of pumping.
#pragma once

#include <vector>

#include "analysis/claims/claims.hpp"

namespace albedo::analysis {

std::vector<Claim> pumping_claims();

}  // namespace albedo::analysis
