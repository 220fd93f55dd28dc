/// @file
/// A plan as a table for a terminal, as JSON, and what both have in common with its HTML page.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "analysis/scenes/plan/plan.hpp"

namespace albedo::analysis {

/// A material's channels in one: the most that any of them needs.
struct MaterialSummary {
  std::string name, model, where, claims, loss, need, tables, pumpings, reason;
  double largest = 0;  ///< of a(L)
  PictureError uncorrected{};
};
std::vector<MaterialSummary> summaries_of(const Scene& scene, const Plan& plan);

/// A sentence or two that say what it comes to.
std::string verdict_of(const Scene& scene, const Plan& plan);

/// "7 nodes", "5 x 9 nodes over alpha and cos_theta", "0.93 at every angle".
std::string form_text(const PlanTable& table);

void print_plan(std::ostream& out, const Scene& scene, const Plan& plan);
nlohmann::ordered_json plan_json(const Scene& scene, const Plan& plan);

}  // namespace albedo::analysis
