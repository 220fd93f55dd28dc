/// @file
/// What `albedo claims` prints: a table for a terminal, JSON, and a page in Markdown.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <vector>

#include "analysis/claims/claims.hpp"

namespace albedo::analysis {

/// A claim a row, its text wrapped so that no line is longer than 120 columns.
void print_claims(std::ostream& out, const std::vector<Claim>& claims, const std::vector<Finding>& findings);

/// [{"id", "paper", "where", "claim", "verdict", "found", "condition", "worst", "repair", "quantities"}, ...]
nlohmann::ordered_json claims_json(const std::vector<Claim>& claims, const std::vector<Finding>& findings);

/// One table a paper; `command` is what made it.
void print_markdown(std::ostream& out, const std::vector<Claim>& claims, const std::vector<Finding>& findings,
                    const std::string& command);

}  // namespace albedo::analysis
