#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "plots/data/albedo_curves.hpp"
#include "plots/figures/figure.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/sheet.hpp"

namespace albedo::plots {
namespace {

using analysis::AlbedoCurves;

constexpr std::size_t decades = 8;  // of N·L, from 1 down to 1e-8
constexpr std::size_t steps_per_decade = 20;

enum Curve : std::size_t { phong, he_torrance, he_torrance_diffuse, ward, cook_torrance, cook_torrance_without_g };

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

std::string data(const AlbedoCurves& curves, std::string_view name) {
  Sheet sheet(name, "Neumann, Neumann, Szirmay-Kalos 1999, fig. 1");
  sheet.note("quantity", "directional albedo and the absolute error of each value");
  for (std::size_t i = 0; i < curves.curves.size(); ++i) {
    sheet.note("grazing exponent of " + curves.curves[i].label, curves.grazing_exponent(i));
  }
  note_curves(sheet, curves);
  add_curves(sheet, curves);
  return sheet.text();
}

/// Where the label of a curve stands in the second panel: on the curve, three decades before its end.
std::string place_of(const AlbedoCurves& curves, std::size_t curve) {
  const std::size_t row = curves.directions.size() - 1 - 3 * steps_per_decade;
  return number_text(curves.directions[row].cos_theta) + ", " + number_text(curves.estimates[curve][row].value);
}

std::string script(const AlbedoCurves& curves, std::string_view name) {
  std::string gp = script_head(name, 17, 8.4);
  gp += "\n# Exponents of N·L at grazing incidence, measured between N·L = 1e-7 and 1e-8\n";
  for (const std::size_t curve : {ward, cook_torrance_without_g}) {
    gp += "exponent_" + curves.curves[curve].label + " = " + number_text(curves.grazing_exponent(curve)) + "\n";
  }
  gp += R"(
power_law(p) = sprintf('∝ ({/:Italic N}·{/:Italic L})^{%s%.4f}', p < 0 ? '−' : '', abs(p))

set multiplot
)";
  gp += legend(6.9, 1.5, 3,
               {{"lines linetype 1", "Phong, {/:Italic n} = 150"},
                {"lines linetype 5", "He–Torrance, {/:Italic σ}_0 = 0.1, {/:Italic τ} = 1.7"},
                {"lines linetype 6", "its directional-diffuse part"},
                {"lines linetype 4", "Ward, {/:Italic m} = 0.1"},
                {"lines linetype 3", "Cook–Torrance, {/:Italic m} = 0.1"},
                {"lines linetype 2", "Cook–Torrance, {/:Italic m} = 0.1, {/:Italic G} ≡ 1"}});
  gp += R"(
# (a) Albedo against the angle; a line that leaves at the top goes on in (b).
)" + panel(1.3, 1.2, 6.7, 5.5) +
        albedo_axes(1.4) + R"(set label 1 '(a)' at graph 0.03, graph 0.94
plot data using 'theta_l':'phong' with lines linetype 1, \
     data using 'theta_l':'he_torrance' with lines linetype 5, \
     data using 'theta_l':'he_torrance_diffuse' with lines linetype 6, \
     data using 'theta_l':'ward' with lines linetype 4, \
     data using 'theta_l':'cook_torrance' with lines linetype 3, \
     data using 'theta_l':'cook_torrance_without_g' with lines linetype 2

# (b) The same on logarithmic scales, where a power law is a straight line.
)" + panel(9.7, 1.2, 6.7, 5.5) +
        R"(set logscale xy
set xrange [1:1e-8]
set yrange [1e-3:1e7]
set xtics ('1' 1, '10^{−2}' 1e-2, '10^{−4}' 1e-4, '10^{−6}' 1e-6, '10^{−8}' 1e-8, \
           '' 1e-1 1, '' 1e-3 1, '' 1e-5 1, '' 1e-7 1)
set ytics ('10^{−2}' 1e-2, '1' 1, '10^2' 1e2, '10^4' 1e4, '10^6' 1e6, '' 1e-3 1, '' 1e-1 1, '' 1e1 1, '' 1e3 1, '' 1e5 1, '' 1e7 1)
set xlabel '{/:Italic N}·{/:Italic L} = cos {/:Italic θ}_{/:Italic L}'
set label 1 '(b)'
set label 2 at graph 0.985, first 1 right offset 0, 0.5
# a label along its line: from a slope in decades to an angle on paper, 6.7 cm have 8 decades, 5.5 cm 10
angle(p) = atan(-p * (5.5 / 10) / (6.7 / 8)) * 180 / pi
set label 3 power_law(exponent_ward) at )" +
        place_of(curves, ward) + R"( center rotate by angle(exponent_ward) offset -0.2, 0.9
set label 4 power_law(exponent_cook_torrance_without_g) at )" +
        place_of(curves, cook_torrance_without_g) +
        R"( center rotate by angle(exponent_cook_torrance_without_g) offset -0.4, 0.8
plot data using 'cos_theta_l':'phong' with lines linetype 1, \
     data using 'cos_theta_l':'he_torrance' with lines linetype 5, \
     data using 'cos_theta_l':'he_torrance_diffuse' with lines linetype 6, \
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
  const AlbedoCurves curves = analysis::albedo_curves(
      {{"phong", "phong", {{"n", 150.0}}},
       {"he_torrance", "he_torrance", {{"sigma0", 0.1}, {"tau", 1.7}}},
       {"he_torrance_diffuse", "he_torrance", {{"sigma0", 0.1}, {"tau", 1.7}, {"part", "directional_diffuse"}}},
       {"ward", "ward", {{"m", 0.1}}},
       {"cook_torrance", "cook_torrance", {{"m", 0.1}, {"masking", "v_cavity"}}},
       {"cook_torrance_without_g", "cook_torrance", {{"m", 0.1}, {"masking", "none"}}}},
      incidence_directions());
  return {.data = data(curves, name), .script = script(curves, name), .unconverged = curves.unconverged()};
}

}  // namespace albedo::plots
