/// @file
/// What can be compared: rules, warps and arithmetics, by their names on the command line.
#pragma once

#include <array>
#include <string>

#include "albedo/directional_albedo.hpp"

namespace albedo::analysis {

/// A rule on a warp.
struct Method {
  Rule rule = Rule::gauss;
  Warp warp = Warp::lobe;

  bool operator==(const Method&) const = default;
};

inline constexpr std::array all_rules{Rule::gauss,      Rule::cubature, Rule::kronrod,    Rule::tanh_sinh,
                                      Rule::stratified, Rule::sobol,    Rule::monte_carlo};
inline constexpr std::array all_warps{Warp::lobe, Warp::hemisphere, Warp::paper};
inline constexpr std::array all_precisions{Precision::float64, Precision::float32, Precision::quad};

/// As on the command line.
std::string name_of(Rule rule);
std::string name_of(Warp warp);
std::string name_of(Precision precision);

/// Whether the paper warp can be had for all of a model's lobes.
bool has_samplers(const Model& model);

}  // namespace albedo::analysis
