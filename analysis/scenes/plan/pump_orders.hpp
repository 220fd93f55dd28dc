/// @file
/// How often the lobes of a plan would have to be pumped instead.
#pragma once

#include "analysis/scenes/plan/cases.hpp"

namespace albedo::analysis {

/// For each case with a reciprocal, isotropic lobe that no texture varies and that needs a correction: the least number
/// K of pumpings (Neumann 1999, without control) for which f ((1 − F₀) + F₀/D_K), which is reciprocal too, is right
/// within the tolerance in a white furnace: s a_F |a_K − 1|/E. None up to PlanOptions::most_pumpings: no order.
void find_pump_orders(const CaseLooks& looks, const CosineGrid& grid, Plan& plan);

}  // namespace albedo::analysis
