/// @file
/// A table on its way to a file: axes, entries and where they come from. The file's ending chooses the format.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "albedo/table.hpp"

namespace albedo::analysis {

/// A table that is not copied: the entries stay where they were computed.
struct TableDocument {
  std::string name{};               ///< an identifier, such as "ggx_albedo"
  std::string quantity = "albedo";  ///< what an entry is
  std::vector<TableAxis> axes{};
  const double* values = nullptr;  ///< C order: the last axis runs fastest; a divergent albedo is +infinity
  const double* errors = nullptr;  ///< in the same order, or null
  nlohmann::ordered_json provenance = nlohmann::ordered_json::object();

  /// The number of entries.
  [[nodiscard]] std::size_t size() const;
};

/// The ending of a path with its dot, in lower case: ".csv".
std::string ending_of(const std::string& path);

/// Writes the table as .csv, .json, .npy, .exr or .hpp, as the ending of `path` says (in any case); "-" is CSV on
/// standard output.
/// @throws ParameterError if the ending is none of these, or the format can't hold these axes
/// @throws WriteError if the file can't be written whole, or an entry is neither a number nor +infinity
void write_table(const TableDocument& table, const std::string& path);

/// Throws what write_table() would throw for the path and the axes, before anything is computed.
void check_table_path(const std::string& path, const std::vector<TableAxis>& axes);

/// Appends a number with 17 significant digits, which read back as the same double ("inf" and "nan" where it is one).
void append_number(std::string& text, double value);

/// The place on an axis as text: the name, or the number with 17 digits.
std::string axis_text(const TableAxis& axis, std::size_t index);

/// Where an entry stands, for messages: "alpha=0.1, theta=30".
std::string describe_entry(const TableDocument& table, std::size_t entry);

/// One item of the provenance as text that stays on its line in a comment of CSV or C++.
std::string comment_text(const nlohmann::ordered_json& item);

}  // namespace albedo::analysis
