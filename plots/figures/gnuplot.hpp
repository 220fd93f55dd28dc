/// @file
/// The one place that talks to gnuplot.
#pragma once

#include <string>
#include <vector>

#include "plots/figures/figure.hpp"

namespace albedo::plots {

/// Runs the drawing's script over its data once for each format and returns the pictures' bytes in that order. The same
/// drawing gives the same bytes: the date in a PDF is that of SOURCE_DATE_EPOCH, or 1970-01-01 if that is not set.
/// @throws WriteError if gnuplot is missing, fails, or leaves no picture
std::vector<std::string> draw_with_gnuplot(const std::string& name, const Drawing& drawing,
                                           const std::vector<Format>& formats);

/// The beginning of every figure's script: how to run it, the terminal of each format and the common style.
/// Line types 1–7 are Okabe and Ito's colours for every kind of colour vision, each with a dash pattern and width of
/// its own, so that a print in grey can be read too.
///
/// The script can use `width` and `height` (in cm), `data` (the CSV file's name, its columns known by their names) and
/// `letter` (to multiply what counts in heights of a letter).
std::string script_head(std::string_view name, double width_cm, double height_cm);

/// Lines for a script: the common look of a panel's axes.
extern const std::string_view axes_style;

/// Lines for a script: the axes of the next panel, in cm from the lower left corner of the paper.
std::string panel(double left, double bottom, double width, double height);

/// One entry of a legend: gnuplot's words for its looks ("lines linetype 1"), and what it says.
struct LegendEntry {
  std::string style, title;
};

/// Lines for a script: one legend for all panels, in a strip of its own across the paper, so that it covers no curve;
/// after it, the common look of axes. To come first in a multiplot.
std::string legend(double bottom, double height, int rows, const std::vector<LegendEntry>& entries);

/// Lines for a script: axes of an albedo against the angle of incidence in degrees, with a line at 1, above which a
/// surface reflects more than it receives. `top` ends the albedo's axis.
std::string albedo_axes(double top);

}  // namespace albedo::plots
