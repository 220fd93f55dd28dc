/// @file
/// What the figures of pictures share.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "plots/figures/figure.hpp"
#include "plots/render/path_tracer.hpp"
#include "plots/render/picture.hpp"

namespace albedo::plots {

/// A number with few digits, for labels and scripts.
std::string rounded_text(double value);

/// A length on the page for a script, with a decimal point: gnuplot divides whole numbers as such.
std::string cm(double length);

/// The version and the command, to which a figure adds what it is of.
nlohmann::ordered_json provenance_of(std::string_view name);

/// "# key: value" lines of all of it.
std::string comment_lines(const nlohmann::ordered_json& provenance);

/// SUFFIX.exr (linear, float) and SUFFIX.png (sRGB, 8 bits, with the exposure) of a picture.
std::vector<Attachment> files_of(const std::string& suffix, const render::Picture& picture, double exposure,
                                 const nlohmann::ordered_json& provenance);

/// One picture of several, as a line of a figure's CSV.
struct Panel {
  std::string label;  ///< without commas
  const render::Rendering& rendering;
};

/// A whole CSV: the provenance, and for each picture its size, samples, mean luminance, and standard errors.
std::string panels_csv(const nlohmann::ordered_json& provenance, const std::vector<Panel>& panels);

/// "N samples a pixel; standard error of the luminance: mean X, largest Y", over all of the renderings; on one line or,
/// for a narrow figure's label, two.
std::string noise_text(const std::vector<Panel>& panels, bool two_lines = false);

/// A rectangle of the page, in cm from its lower left corner.
struct Place {
  double left, bottom, width, height;
};

/// Lines of a script that make a place the current panel; no border, no tics.
std::string bare_panel(const Place& place);

/// Lines of a script that put a picture of so many pixels there: NAME-SUFFIX.png.
std::string placed_picture(std::string_view name, const std::string& suffix, const render::Picture& picture,
                           const Place& place);

/// A line of a script: a label at a place of the page in cm. `how` is "center", "left" or "right", and what else `set
/// label` takes.
std::string label_at(double x, double y, const std::string& text, const std::string& how = "center");

/// The 16 pairs of exponents n_u × n_v of Ashikhmin and Shirley's figures, n_u from left to right, n_v from above.
inline constexpr std::array<double, 4> exponents{10, 100, 1000, 10000};

std::string exponent_text(double exponent);

/// A figure of 4 × 4 spheres on a plane, one for each pair of exponents.
Drawing sphere_grid(std::string_view name, const std::string& what, double exposure,
                    std::vector<render::SurfaceLobe> (*lobes)(double n_u, double n_v));

/// Labels of the rows and columns of a 4 × 4 mosaic at a place.
std::string exponent_labels(const Place& place);

}  // namespace albedo::plots
