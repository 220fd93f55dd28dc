/// @file
/// Small line charts as inline SVG.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace albedo::analysis {

using ChartPoints = std::vector<std::pair<double, double>>;

struct Chart {
  std::string title{}, x_label{}, y_label{};
  double x_low = 0, x_high = 1, y_low = 0, y_high = 1;
  struct Line {
    ChartPoints points{};
    std::string style{};  ///< the CSS class of its stroke: "exact", "fitted", "limit"
  };
  ChartPoints band_low{}, band_high{};  ///< what is between them is shaded
  std::vector<Line> lines{};
  ChartPoints dots{};
};

/// Text in HTML: & < > and quotes are written as entities.
std::string escaped(const std::string& text);

/// The chart; what isn't finite is left out, and what is beyond the axes is cut off. Colours come from CSS classes and
/// currentColor.
std::string svg(const Chart& chart);

}  // namespace albedo::analysis
