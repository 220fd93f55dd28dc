/// @file
#pragma once

#include <string>

#include "analysis/files/table_document.hpp"

namespace albedo::analysis {

/// Writes a table named NAME as a self-contained C++17 header of constants, in which an axis is called AXIS:
/// NAME_shape, NAME_axis_AXIS (numbers or names) and NAME_values in C order.
void write_hpp(const TableDocument& table, const std::string& path);

}  // namespace albedo::analysis
