/// @file
/// A plan on the disk: its tables, its numbers and its page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "analysis/scenes/plan/plan.hpp"

namespace albedo::analysis {

/// @throws WriteError if there is no such directory and none can be made, or nothing can be written into it
void check_plan_directory(const std::string& directory);

/// Writes plan.json and plan.html, and NAME.exr, NAME.npy (with NAME.json) and NAME.hpp for every table. Entries are
/// the values as they are held.
/// @throws WriteError
void write_plan(const Scene& scene, const Plan& plan, const nlohmann::ordered_json& object,
                const std::string& directory);

}  // namespace albedo::analysis
