/// @file
/// The one place that talks to gnuplot.
#pragma once

#include <string>
#include <vector>

#include "plots/figure.hpp"

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

}  // namespace albedo::plots
