/// @file
/// Numbers and messages as text: everything that is formatted goes through {fmt}.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace albedo {

/// A number with so many significant digits, 17 read back as the same double; "inf" and "nan" where it is one.
std::string number_text(double value, int digits = 17);

/// As few characters as read back as the same double: 1e+06 and not 1000000.
std::string shortest_text(double value);

/// "a, b, c"
std::string joined(const std::vector<std::string>& items, const std::string& separator = ", ");

}  // namespace albedo
