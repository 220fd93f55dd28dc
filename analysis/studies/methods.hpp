/// @file
/// The rules and warps by name, as on the command line.
#pragma once

#include <array>
#include <string_view>

#include "albedo/directional_albedo.hpp"

namespace albedo::analysis {

inline constexpr std::array all_rules{Rule::gauss,      Rule::cubature, Rule::kronrod,    Rule::tanh_sinh,
                                      Rule::stratified, Rule::sobol,    Rule::monte_carlo};
inline constexpr std::array all_warps{Warp::lobe, Warp::hemisphere, Warp::paper};

constexpr std::string_view name_of(Rule rule) {
  constexpr std::array<std::string_view, all_rules.size()> names{"gauss",      "cubature", "kronrod",    "tanh_sinh",
                                                                 "stratified", "sobol",    "monte_carlo"};
  return names[static_cast<std::size_t>(rule)];
}

constexpr std::string_view name_of(Warp warp) {
  constexpr std::array<std::string_view, all_warps.size()> names{"lobe", "hemisphere", "paper"};
  return names[static_cast<std::size_t>(warp)];
}

/// Whether the paper warp can be had for all of a model's lobes.
inline bool has_samplers(const Model& model) {
  for (const Lobe& lobe : model.lobes()) {
    if (!model.has_sampler(lobe.component)) return false;
  }
  return true;
}

}  // namespace albedo::analysis
