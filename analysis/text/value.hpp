/// @file
/// The values on the command line, taken strictly: a whole argument is one value, or it is refused.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace albedo::analysis {

/// A finite decimal number. `what` names it in the message: "alpha: 'x' is not a finite number".
/// @throws ParameterError for anything else: nan, inf, hexadecimal, a blank, a leading plus, what a double can't hold
double parse_number(std::string_view what, std::string_view text);

/// NAME=VALUE.
struct Assignment {
  std::string name;
  std::string text;
};

/// @throws ParameterError if there is no '=' or no name before it
Assignment parse_assignment(std::string_view argument);

/// FROM:TO:COUNT[:log], evenly spaced numbers or powers.
struct RangeAxis {
  double from;
  double to;
  std::size_t count;  ///< 1 to 1e6; 1 only if from = to
  bool log;           ///< even steps of the logarithm; both ends are positive

  /// The numbers in order, exactly `from` and `to` at the ends.
  /// @throws ParameterError if a double can't tell neighbours apart
  [[nodiscard]] std::vector<double> values(std::string_view what) const;
};

/// Whether a value is meant as FROM:TO:COUNT[:log].
bool is_range(std::string_view text);

/// @throws ParameterError naming `what`
RangeAxis parse_range(std::string_view what, std::string_view text);

/// The numbers of a range, or of a list such as "0.1,0.2,0.4".
/// @throws ParameterError naming `what`
std::vector<double> parse_values(std::string_view what, std::string_view text);

/// A list of angles in degrees, each in [0, 90].
/// @throws ParameterError naming `what`
std::vector<double> parse_angles(std::string_view what, std::string_view text);

}  // namespace albedo::analysis
