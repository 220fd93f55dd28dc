/// @file
/// What an audit prints: a model's checks one a line, a list's one a row, and all of it as JSON or CSV.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <vector>

#include "analysis/studies/audits.hpp"

namespace albedo::analysis {

/// Every check of one model with what was found.
void print_checks(std::ostream& out, const AuditCase& one);

/// One row a case, in Markdown or as columns.
void print_rows(std::ostream& out, const std::vector<AuditCase>& cases, bool markdown);

/// One row a list and model: how many of its materials create energy, by how much, beyond which angle. In Markdown or
/// as columns.
void print_summaries(std::ostream& out, const std::vector<AuditSummary>& summaries, bool markdown);

nlohmann::ordered_json audit_json(const AuditCase& one);

/// One row a case, 17 digits.
void write_csv(const nlohmann::ordered_json& provenance, const std::vector<AuditCase>& cases, std::ostream& out);

}  // namespace albedo::analysis
