#include "analysis/scenes/plan/plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

#include "albedo/core/errors.hpp"
#include "analysis/scenes/plan/cases.hpp"
#include "analysis/scenes/plan/pump_orders.hpp"
#include "analysis/scenes/plan/sharing.hpp"
#include "analysis/scenes/plan/verify.hpp"
#include "analysis/subjects/material_table.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

constexpr std::size_t most_cases = 10'000, most_materials = 100'000;

bool is_rgb(const SceneMaterial& material) { return channels_of({material.material}).size() == 3; }

/// One case for all that are the same.
void find_cases(const Scene& scene, Plan& plan) {
  if (scene.materials.size() > most_materials) {
    throw FormatError("'" + scene.path + "' has " + std::to_string(scene.materials.size()) +
                      " materials, and a plan takes at most " + std::to_string(most_materials));
  }
  const bool has_colours = std::ranges::any_of(scene.materials, is_rgb);
  plan.channels = has_colours ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"all"};
  std::unordered_map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    std::vector<std::size_t>& cases = plan.of_material.emplace_back();
    const std::size_t channels = has_colours && is_rgb(scene.materials[i]) ? 3 : 1;
    for (std::size_t channel = 0; channel < channels; ++channel) {
      const auto [found, is_new] = numbers.try_emplace(key_of(scene.materials[i], channel), plan.cases.size());
      if (is_new) plan.cases.push_back({.material = i, .channel = channel});
      cases.push_back(found->second);
      if (plan.cases.size() > most_cases) {
        throw FormatError("'" + scene.path + "' has more than " + std::to_string(most_cases) +
                          " different reflectances, which is more than a plan takes");
      }
    }
  }
}

}  // namespace

std::string_view name_of(Need need) {
  constexpr std::array<std::string_view, 5> names{"nothing", "constant", "curve", "table", "unknown"};
  return names[static_cast<std::size_t>(need)];
}

std::size_t Plan::bytes() const {
  std::size_t sum = 0;
  for (const PlanTable& table : tables) sum += table.table.bytes();
  return sum;
}

std::size_t Plan::usual_bytes() const { return of_material.size() * 32 * 32 * 32 * sizeof(float); }

PictureError Plan::largest_error() const {
  PictureError largest;
  for (const PlanTable& table : tables) {
    largest.furnace = std::max(largest.furnace, table.met.furnace);
    largest.point = std::max(largest.point, table.met.point);
  }
  return largest;
}

std::size_t Plan::unknown() const {
  return static_cast<std::size_t>(std::ranges::count(cases, Need::unknown, &PlanCase::need));
}

void check_plan_options(const PlanOptions& options) {
  const auto refuse = [](const std::string& what, double value, const std::string& range) {
    throw ParameterError(fmt::format("{} is {} and must be within {}", what, number_text(value), range));
  };
  if (!(options.tolerance >= 1e-5 && options.tolerance <= 0.5)) refuse("error", options.tolerance, "[1e-5, 0.5]");
  if (!(options.least_theta >= 0 && options.least_theta < options.largest_theta)) {
    refuse("the least angle", options.least_theta, "[0, the largest angle)");
  }
  if (!(options.largest_theta <= 89.9)) refuse("the largest angle", options.largest_theta, "(0, 89.9]");
}

Plan plan_scene(const Scene& scene, const PlanOptions& options) {
  check_plan_options(options);
  constexpr int most_refinements = 2;
  Plan empty{.options = options, .notes = scene.notes};
  find_cases(scene, empty);
  const CosineGrid grid(options.least_theta, options.largest_theta);
  for (int refinement = 0;; ++refinement) {
    Plan plan = empty;
    const CaseLooks looks(scene, plan, grid, refinement);
    looks.describe(plan);
    make_tables(looks, grid, plan);
    verify(scene, plan);
    // what varies with a second variable may do so between the places at which that was looked at
    const bool can_refine = std::ranges::any_of(plan.tables, [&](const PlanTable& table) {
      return table.met.largest() > options.tolerance && looks[table.cases.front()].references.size() > 1;
    });
    if (can_refine && refinement < most_refinements) continue;
    find_pump_orders(looks, grid, plan);
    return plan;
  }
}

}  // namespace albedo::analysis
