/// @file
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>

#include "analysis/scenes/plan/plan.hpp"

namespace albedo::analysis {

/// The plan as one HTML file: a summary, a section for each table with its figures as inline SVG, and what isn't
/// modelled. It asks for nothing from elsewhere and runs nothing.
void write_plan_page(std::ostream& out, const Scene& scene, const Plan& plan, const nlohmann::ordered_json& object);

}  // namespace albedo::analysis
