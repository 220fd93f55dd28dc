/// @file
/// What `albedo curve --form rational` does.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "albedo/rational_form.hpp"
#include "analysis/commands/options.hpp"
#include "analysis/text/assertion.hpp"

namespace albedo::analysis {

struct RationalRequest {
  RationalOptions options{};
  std::string output;  ///< empty: none
  bool json = false;   ///< one JSON object on standard output
  std::vector<Assertion> assertions{};
  nlohmann::ordered_json description;  ///< of the model and the integration
};

/// Fits, writes, and returns the exit code.
int run_rational_curve(const Model& model, const RationalRequest& request, const std::string& command_line);

}  // namespace albedo::analysis
