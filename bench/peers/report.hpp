/// @file
/// The results as text and as JSON.
#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "peers/summary.hpp"

namespace albedo::peers {

/// Where and when the times were taken.
struct Machine {
  std::string processor;
  int cores = 0;
  double load_before = 0, load_after = 0;  ///< one-minute averages

  static Machine look();
};

void print_report(std::ostream& out, const std::vector<CaseResult>& results, const std::vector<Peer>& peers,
                  const Machine& machine);

nlohmann::ordered_json json_report(const std::vector<CaseResult>& results, const MeasureOptions& options,
                                   const Machine& machine);

}  // namespace albedo::peers
