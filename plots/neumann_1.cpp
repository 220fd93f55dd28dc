#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "albedo/version.hpp"
#include "analysis/output/csv_writer.hpp"
#include "analysis/output/table_document.hpp"
#include "analysis/studies/albedo_curves.hpp"
#include "plots/figure.hpp"
#include "plots/gnuplot.hpp"

namespace albedo::plots {
namespace {

using analysis::AlbedoCurves;

constexpr std::size_t decades = 8;  // of N·L, from 1 down to 1e-8
constexpr std::size_t steps_per_decade = 20;

enum Curve : std::size_t { phong, ward, cook_torrance, cook_torrance_without_g };

/// Even steps in the angle for the first panel and in log N·L for the second, from normal incidence to N·L = 1e-8.
std::vector<Direction> incidence_directions() {
  std::vector<Direction> directions;
  directions.reserve(180 + decades * steps_per_decade);
  for (int half_degrees = 0; half_degrees < 180; ++half_degrees) {
    directions.push_back(Direction::from_degrees(0.5 * half_degrees));
  }
  for (std::size_t i = 1; i <= decades * steps_per_decade; ++i) {
    directions.push_back(Direction::from_cosine(std::pow(10.0, -static_cast<double>(i) / steps_per_decade)));
  }
  std::ranges::stable_sort(directions, std::ranges::greater{}, &Direction::cos_theta);
  return directions;
}

std::string text(const ParameterValue& value) {
  if (const auto* name = std::get_if<std::string>(&value)) return *name;
  std::string number;
  analysis::append_number(number, std::get<double>(value));
  return number;
}

std::string data(const AlbedoCurves& curves, std::string_view name) {
  std::string csv = "# version: albedo " + std::string(version) + "\n# command: albedo-figures " + std::string(name);
  csv += "\n# source: Neumann, Neumann, Szirmay-Kalos 1999, fig. 1 (without He-Torrance)";
  csv += "\n# quantity: directional albedo and the absolute error of each value";
  for (const auto& curve : curves.curves) {
    csv += "\n# curve " + curve.label + ": " + curve.model;
    for (const auto& [parameter, value] : curve.parameters)
      csv.append(" ").append(parameter).append("=") += text(value);
  }
  for (std::size_t i = 0; i < curves.curves.size(); ++i) {
    csv += "\n# grazing exponent of " + curves.curves[i].label + ": ";
    analysis::append_number(csv, curves.grazing_exponent(i));
  }
  csv += "\n# rule: gauss\n# warp: lobe\n# precision: double\n# tolerance: ";
  analysis::append_number(csv, curves.options.tolerance);
  csv += "\n# largest relative error: ";
  analysis::append_number(csv, curves.worst_relative_error());
  csv += "\n# not converged: " + std::to_string(curves.unconverged());
  csv += "\n# unit of theta_l: degrees\ntheta_l,cos_theta_l";
  for (const auto& curve : curves.curves)
    csv.append(",").append(curve.label).append(",").append(curve.label) += "_error";
  csv += '\n';
  for (std::size_t row = 0; row < curves.directions.size(); ++row) {
    analysis::append_number(csv, curves.directions[row].theta_degrees());
    analysis::append_number(csv += ',', curves.directions[row].cos_theta);
    for (const auto& estimates : curves.estimates) {
      analysis::append_number(csv += ',', estimates[row].value);
      analysis::append_number(csv += ',', estimates[row].error);
    }
    csv += '\n';
  }
  return csv;
}

/// Where the label of a curve stands in the second panel: on the curve, three decades before its end.
std::string place_of(const AlbedoCurves& curves, std::size_t curve) {
  const std::size_t row = curves.directions.size() - 1 - 3 * steps_per_decade;
  std::string place;
  analysis::append_number(place, curves.directions[row].cos_theta);
  analysis::append_number(place += ", ", curves.estimates[curve][row].value);
  return place;
}

std::string script(const AlbedoCurves& curves, std::string_view name) {
  std::string gp = script_head(name, 17, 7);
  gp += "\n# Exponents of N·L at grazing incidence, measured between N·L = 1e-7 and 1e-8\n";
  for (const std::size_t curve : {ward, cook_torrance_without_g}) {
    gp += "exponent_" + curves.curves[curve].label + " = ";
    analysis::append_number(gp, curves.grazing_exponent(curve));
    gp += '\n';
  }
  gp += R"(
power_law(p) = sprintf('∝ ({/:Italic N}·{/:Italic L})^{%s%.4f}', p < 0 ? '−' : '', abs(p))

set multiplot

# One legend for both panels, in a panel of its own.
set lmargin at screen 0.075
set rmargin at screen 0.965
set tmargin at screen 1
set bmargin at screen 0.87
unset border
unset tics
set yrange [0:1]
set key center center vertical maxrows 2 Left reverse samplen 4.5 width 2 spacing letter
plot NaN with lines linetype 1 title 'Phong, {/:Italic n} = 150', \
     NaN with lines linetype 4 title 'Ward, {/:Italic m} = 0.1', \
     NaN with lines linetype 3 title 'Cook–Torrance, {/:Italic m} = 0.1', \
     NaN with lines linetype 2 title 'Cook–Torrance, {/:Italic m} = 0.1, {/:Italic G} ≡ 1'
unset key
)" + std::string(axes_style) +
        R"(
# (a) Albedo against the angle; a line that leaves at the top goes on in (b).
set lmargin at screen 0.075
set rmargin at screen 0.47
set tmargin at screen 0.85
set bmargin at screen 0.175
set xrange [0:90]
set xtics 15 offset 0, 0.8 * (1 - letter)
set mxtics 3
set yrange [0:1.4]
set ytics 0.2
set mytics 2
set format y '%.1f'
set xlabel 'angle of incidence {/:Italic θ}_{/:Italic L} [degrees]' offset 0, 1.3 - letter
set ylabel 'directional albedo {/:Italic a}({/:Italic L})' offset 2 - letter, 0
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead linecolor rgb '#808080' linewidth 0.5 back
set label 1 '(a)' at graph 0.03, graph 0.94
set label 2 '{/:Italic a} = 1' at graph 0.03, first 1 offset 0, 0.5
plot data using 'theta_l':'phong' with lines linetype 1, \
     data using 'theta_l':'ward' with lines linetype 4, \
     data using 'theta_l':'cook_torrance' with lines linetype 3, \
     data using 'theta_l':'cook_torrance_without_g' with lines linetype 2

# (b) The same on logarithmic scales, where a power law is a straight line.
set lmargin at screen 0.57
set rmargin at screen 0.965
set logscale xy
set xrange [1:1e-8]
set yrange [1e-2:1e7]
set xtics ('1' 1, '10^{−2}' 1e-2, '10^{−4}' 1e-4, '10^{−6}' 1e-6, '10^{−8}' 1e-8, \
           '' 1e-1 1, '' 1e-3 1, '' 1e-5 1, '' 1e-7 1)
set ytics ('10^{−2}' 1e-2, '1' 1, '10^2' 1e2, '10^4' 1e4, '10^6' 1e6, '' 1e-1 1, '' 1e1 1, '' 1e3 1, '' 1e5 1, '' 1e7 1)
set xlabel '{/:Italic N}·{/:Italic L} = cos {/:Italic θ}_{/:Italic L}'
set label 1 '(b)'
set label 2 at graph 0.985, first 1 right offset 0, 0.5
# a label along its line: from a slope in decades to an angle on paper, 0.395 of the width has 8 decades, 0.675 of the height 9
angle(p) = atan(-p * (0.675 * height / 9) / (0.395 * width / 8)) * 180 / pi
set label 3 power_law(exponent_ward) at )" +
        place_of(curves, ward) + R"( center rotate by angle(exponent_ward) offset -0.2, 0.9
set label 4 power_law(exponent_cook_torrance_without_g) at )" +
        place_of(curves, cook_torrance_without_g) +
        R"( center rotate by angle(exponent_cook_torrance_without_g) offset -0.4, 0.8
plot data using 'cos_theta_l':'phong' with lines linetype 1, \
     data using 'cos_theta_l':'ward' with lines linetype 4, \
     data using 'cos_theta_l':'cook_torrance' with lines linetype 3, \
     data using 'cos_theta_l':'cook_torrance_without_g' with lines linetype 2
unset multiplot
unset output
)";
  return gp;
}

}  // namespace

Drawing neumann_1(std::string_view name) {
  const AlbedoCurves curves =
      analysis::albedo_curves({{"phong", "phong", {{"n", 150.0}}},
                               {"ward", "ward", {{"m", 0.1}}},
                               {"cook_torrance", "cook_torrance", {{"m", 0.1}, {"masking", "v_cavity"}}},
                               {"cook_torrance_without_g", "cook_torrance", {{"m", 0.1}, {"masking", "none"}}}},
                              incidence_directions());
  return {.data = data(curves, name), .script = script(curves, name), .unconverged = curves.unconverged()};
}

}  // namespace albedo::plots
