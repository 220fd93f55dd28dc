/// @file
#pragma once

#include <ostream>
#include <string>

#include "analysis/files/table_document.hpp"

namespace albedo::analysis {

/// Writes a table as {"provenance", "axes", "shape", "albedo", "error"}: the last two are nested arrays, "error" only
/// if it is known. JSON has no infinity: a divergent albedo is null.
void write_json(const TableDocument& table, const std::string& path);

/// Writes what is not an entry, {"provenance", "axes", "shape"}, for formats that have no place for it.
void write_json_description(const TableDocument& table, std::ostream& out);

}  // namespace albedo::analysis
