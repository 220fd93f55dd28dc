/// @file
/// What `albedo table` was asked for, and what it says of a table.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "albedo/table.hpp"
#include "albedo/table_growth.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/commands/options.hpp"
#include "analysis/files/table_document.hpp"
#include "analysis/text/assertion.hpp"

namespace albedo::analysis {

/// Where entries come from: an integration each, or series that few of them make.
enum class Fill { direct, proxy };
inline constexpr std::array all_fills{Fill::direct, Fill::proxy};
inline std::string_view name_of(Fill fill) { return fill == Fill::direct ? "direct" : "proxy"; }

struct TableArguments {
  ModelArguments model;
  ComputeOptions options;
  std::string materials, output, log;
  bool summary = false, errors = false, resume = false;
  Fill fill = Fill::direct;
  int verified = 250;                  ///< random places at which a proxy is compared with integrations
  int tile = 0;                        ///< entries of a tile of a .npy; 0: as many as suit it
  TableGrowth growth{.max_error = 0};  ///< 0: the table doesn't grow
  std::vector<Assertion> assertions;
};

/// A table, wherever its entries are.
struct FilledTable {
  std::vector<TableAxis> axes{};  ///< of the document
  std::size_t entries = 0;
  TableTally tally{.worst_error = 0};        ///< evaluations with those of the verification, where they are told
  std::optional<std::size_t> worst_entry{};  ///< where it is told
  double interpolation_error = 0;
  std::vector<double> values{}, errors{};  ///< empty where they are in a file
};

/// @param axes of the document
[[nodiscard]] FilledTable filled(std::vector<TableAxis> axes, AlbedoTable table);

using EntryAt = std::function<double(std::size_t entry)>;

/// How the entries were computed, and what is known of them.
void complete(nlohmann::ordered_json& provenance, const TableArguments& arguments, const FilledTable& table);

/// What is said of a table at the end.
[[nodiscard]] nlohmann::ordered_json summary_of(const TableArguments& arguments, const FilledTable& table,
                                                const nlohmann::ordered_json& provenance, double seconds);

/// Says what was asked for of a table that is written, and returns the exit code.
int report(const TableArguments& arguments, const FilledTable& table, const EntryAt& value,
           const nlohmann::ordered_json& provenance, double seconds);

/// Writes the table and says what was asked for.
/// @param grown_error the largest error met between the entries of a table that has grown, as they are held
int conclude(const TableArguments& arguments, FilledTable table, double grown_error, nlohmann::ordered_json provenance,
             double seconds);

}  // namespace albedo::analysis
