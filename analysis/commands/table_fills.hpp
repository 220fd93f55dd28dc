/// @file
/// The ways of `albedo table` that don't keep an integrated table in memory.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "albedo/table.hpp"
#include "analysis/commands/table_report.hpp"
#include "analysis/commands/table_request.hpp"

namespace albedo::analysis {

/// Whether the entries go to their places in a file instead of memory.
/// @throws ParameterError for --resume where they don't
bool is_tiled(const TableArguments& arguments, bool by_channel);

/// Computes and writes the table tile by tile, and says what was asked for. Returns the exit code.
int run_tiled(const TableArguments& arguments, const TableRequest& request, const TableOptions& options,
              nlohmann::ordered_json provenance, const std::function<double()>& seconds);

/// What --fill proxy does, after everything is checked. Returns the exit code.
/// @param options of its integrations
int fill_from_proxy(const TableArguments& arguments, const TableRequest& request, TableOptions options,
                    nlohmann::ordered_json provenance, const std::function<double()>& seconds);

}  // namespace albedo::analysis
