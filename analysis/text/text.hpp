/// @file
/// JSON and columns as the program prints them.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "core/text.hpp"

namespace albedo::analysis {

/// JSON on one line, but for an array of objects: there every object has its own. Numbers have 17 significant digits,
/// what is not finite is null, and bytes that are not UTF-8 become U+FFFD.
std::string json_text(const nlohmann::ordered_json& value);

/// Rows of cells, every column as wide as its widest cell and aligned to the right.
void print_columns(std::ostream& out, const std::vector<std::vector<std::string>>& rows);

}  // namespace albedo::analysis
