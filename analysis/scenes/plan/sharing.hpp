/// @file
/// Which tables, and who shares them.
#pragma once

#include "analysis/scenes/plan/cases.hpp"

namespace albedo::analysis {

/// Decides for every case whether nothing, a curve or a table of two variables suffices, and makes as few and as small
/// ones as are found: cases of one lobe share a table, and so do different lobes that one curve serves in fewer bytes.
void make_tables(const CaseLooks& looks, const CosineGrid& grid, Plan& plan);

}  // namespace albedo::analysis
