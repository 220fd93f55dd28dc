/// @file
#pragma once

#include <string>
#include <vector>

#include "analysis/files/table_document.hpp"

namespace albedo::analysis {

/// Writes the entries as a NumPy array (NPY format 1.0, '<f8', C order), and axes and provenance to sidecar_path().
/// Neither file appears before both are whole, and the array never stands without its sidecar.
void write_npy(const TableDocument& table, const std::string& path);

/// The bytes before the entries of an array with these axes.
std::string npy_header(const std::vector<TableAxis>& axes);

/// The path of an array with .json in place of its ending.
std::string sidecar_path(const std::string& path);

}  // namespace albedo::analysis
