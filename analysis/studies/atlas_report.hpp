/// @file
/// What `albedo stability` prints and writes of an atlas.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>

#include "analysis/studies/stability.hpp"

namespace albedo::analysis {

/// How often a method's answers were of each kind.
struct MethodCount {
  AtlasMethod method;
  std::array<std::size_t, all_verdicts.size()> verdicts{};
  std::size_t below = 0, above = 0;  ///< the reference, of the unconverged and the wrong
  double worst = 0;                  ///< the largest |relative error| of a wrong answer; 0: none
};

std::vector<MethodCount> count_verdicts(const Atlas& atlas);

/// A table of verdicts by rule, warp and precision.
void print_atlas(const Atlas& atlas, std::ostream& out);

/// Grid, tolerances and the counts, without the answers.
nlohmann::ordered_json atlas_summary(const Atlas& atlas);

/// Writes every answer: CSV, one line each under the provenance, or one JSON object, as the ending of the path says.
/// "-" is CSV on standard output.
/// @throws WriteError, ParameterError
void write_atlas(const Atlas& atlas, nlohmann::ordered_json provenance, const std::string& path);

}  // namespace albedo::analysis
