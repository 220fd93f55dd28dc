/// @file
/// The figures: what they are called, and how one becomes files.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace albedo::plots {

/// A file beside a figure's data: NAME-suffix, such as neumann-8-scene.exr.
struct Attachment {
  std::string suffix;
  std::string bytes;
};

/// A figure before it is drawn.
struct Drawing {
  std::string data;             ///< the whole CSV file
  std::string script;           ///< the whole gnuplot script, which reads the files from the directory it is run in
  std::size_t unconverged = 0;  ///< numbers in it that did not reach their tolerance
  std::vector<Attachment> attachments{};  ///< the pictures that it places
};

/// One entry of the list of figures.
struct Figure {
  std::string_view name;   ///< on the command line, and of its files
  std::string_view title;  ///< what it shows
  Drawing (*draw)(std::string_view name);
  /// What the figure needs of the user and hasn't got; empty if it can be drawn. Null: it needs nothing.
  std::string (*lacks)() = nullptr;
};

/// Neumann, Neumann, Szirmay-Kalos 1999, figure 1.
Drawing neumann_1(std::string_view name);
/// The same, figure 2: domains of L, H and V.
Drawing neumann_2(std::string_view name);
/// The same, figures 3 to 6: `neumann-3` and `neumann-5` of Phong, `neumann-4` and `neumann-6` of Blinn; the latter two
/// of each under control.
Drawing neumann_pumped(std::string_view name);
/// The same, figure 7: eq. 22.
Drawing neumann_7(std::string_view name);

/// Walter 2005, figure 6: bounds over a box of directions.
Drawing walter_6(std::string_view name);

/// Kurt, Szirmay-Kalos, Křivánek 2010, figure 1: measured materials, of the directory that the environment variable
/// ALBEDO_MEASURED_DIR names. @throws ParameterError without any
Drawing kurt_1(std::string_view name);
/// What figure 1 needs and hasn't got.
std::string kurt_1_lacks();
/// The same, figures 2 and 3: eqs. 9 and 10.
Drawing kurt_2(std::string_view name);
Drawing kurt_3(std::string_view name);
/// The same, figure 7: fits of one material in the plane of incidence.
Drawing kurt_7(std::string_view name);

/// Which parameters of Kurt's, Ward's and Duer's models reflect more than they receive, and from which angle on.
Drawing plausibility(std::string_view name);

/// Speed against accuracy, a page of one model: `tradeoff` of Ward, `tradeoff-MODEL` of another.
Drawing tradeoff(std::string_view name);

/// The stability atlas in double precision: verdicts on every rule and warp. `stability` of isotropic lobes,
/// `stability-anisotropic` of those 1000 times as wide one way as the other.
Drawing stability(std::string_view name);

/// The stability atlas of the gauss rule on the lobe warp: errors of formulas in float.
Drawing stability_float(std::string_view name);

/// Ashikhmin & Shirley 2000, figures 2 (spheres in a furnace, and curves), 3 (gold), 4 (half a sphere, and curves) and
/// 6 (red plastic).
Drawing ashikhmin_2(std::string_view name);
Drawing ashikhmin_3(std::string_view name);
Drawing ashikhmin_4(std::string_view name);
Drawing ashikhmin_6(std::string_view name);

/// Kurt, Szirmay-Kalos & Křivánek 2010, figures 12 and 13: spheres.
Drawing kurt_12(std::string_view name);
Drawing kurt_13(std::string_view name);

/// Neumann 1999, figure 8: the tank with pyramids.
Drawing neumann_8(std::string_view name);

/// Walter 2005, figure 3: the box, and the bias of equal weights.
Drawing walter_3(std::string_view name);

/// The renderer's furnace test.
Drawing furnace(std::string_view name);

/// Every figure.
const std::vector<Figure>& figures();

/// The figure of that name. @throws ParameterError, with a suggestion for a misspelt name
const Figure& find_figure(const std::string& name);

enum class Format { pdf, png, svg };

std::string_view to_string(Format format);

/// @throws ParameterError unless the text names a format
Format parse_format(const std::string& text);

/// Writes NAME.csv, NAME.gp, the attachments and one NAME.FORMAT for each format into a directory, which is made if
/// need be. None appears unless all of them are whole. Without formats there is nothing to draw, and gnuplot isn't
/// needed.
/// @returns how many of the figure's numbers did not reach their tolerance
/// @throws WriteError
std::size_t write_figure(const Figure& figure, const std::string& directory, const std::vector<Format>& formats);

}  // namespace albedo::plots
