/// @file
/// A figure's data on their way to a file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plots/data/albedo_curves.hpp"

namespace albedo::plots {

/// The text of a CSV file: lines "# key: value" that say where the numbers come from, a line of column names, and rows
/// of numbers with 17 digits. Numbers only, so that gnuplot reads every column by its name.
class Sheet {
 public:
  /// Begins with the program's version, the command that makes the figure, and what is drawn after whom.
  Sheet(std::string_view figure, std::string_view source);

  void note(std::string_view key, std::string_view value);
  void note(std::string_view key, double value);
  void note(std::string_view key, std::size_t value);
  void columns(const std::vector<std::string>& names);
  void row(const std::vector<double>& numbers);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// A number with 17 digits.
std::string number_text(double value);

/// A round number as titles and column names have it: "0.1".
std::string short_text(double value);

/// Notes what the curves are, how they were integrated and how well: model and parameters of each, rule, tolerance,
/// largest relative error, how many did not converge.
void note_curves(Sheet& sheet, const analysis::AlbedoCurves& curves);

/// The curves as columns theta_l, cos_theta_l, and LABEL, LABEL_error of each.
void add_curves(Sheet& sheet, const analysis::AlbedoCurves& curves);

/// 0, step, 2 step … 90 degrees.
std::vector<Direction> directions_by_degrees(double step);

}  // namespace albedo::plots
