/// @file
#pragma once

#include <string>

#include "analysis/files/table_document.hpp"

namespace albedo::analysis {

/// Writes a table as CSV (RFC 4180, but lines end with LF): the provenance in lines "# key: value", a line of column
/// names, and one line an entry: its place on every axis, the albedo and, if known, its error.
void write_csv(const TableDocument& table, const std::string& path);

/// A field of a line of CSV, quoted if it must be.
std::string csv_field(const std::string& text);

}  // namespace albedo::analysis
