/// @file
#pragma once

#include "analysis/claims/claims.hpp"

namespace albedo::analysis {

/// Walter's eqs. 27 and 28-33 over random boxes, as printed and with each of two symbols corrected (doc/bounds.md).
Finding bounds_as_printed(const ModelSource& make);

}  // namespace albedo::analysis
