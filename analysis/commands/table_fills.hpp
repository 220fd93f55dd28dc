/// @file
/// The ways of `albedo table` that don't keep an integrated table in memory.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "albedo/table.hpp"
#include "analysis/commands/table_report.hpp"
#include "analysis/commands/table_request.hpp"
#include "analysis/files/tiled_table.hpp"

namespace albedo::analysis {

/// Whether the entries go to their places in a file instead of memory.
/// @throws ParameterError for --resume where they don't
bool is_tiled(const TableArguments& arguments, bool by_channel);

/// What fills the tiles of a table, and what it has to say when they are filled.
struct TileFill {
  Entries entries;
  std::size_t tile = 0;  ///< entries that suit it; 0: as many as suit the table
  std::function<void(FilledTable& table, nlohmann::ordered_json& provenance)> complete{};  ///< adds what is known
  std::function<int(int code)> judge{};  ///< may complain; the exit code
};

/// Made once the table is known to be valid; the source outlives what it returns.
using MakeTileFill = std::function<TileFill(const TableSource& source)>;

/// Computes and writes the table tile by tile, and says what was asked for. Returns the exit code.
int run_tiled(const TableArguments& arguments, const TableRequest& request, const TableOptions& options,
              const MakeTileFill& make_fill, nlohmann::ordered_json provenance, const std::function<double()>& seconds);

/// An integration for every entry.
[[nodiscard]] TileFill integrated_entries(const TableSource& source);

/// What --fill proxy does, after everything is checked. Returns the exit code.
/// @param in_tiles is_tiled()
int fill_from_proxy(const TableArguments& arguments, const TableRequest& request, TableOptions options, bool in_tiles,
                    nlohmann::ordered_json provenance, const std::function<double()>& seconds);

}  // namespace albedo::analysis
