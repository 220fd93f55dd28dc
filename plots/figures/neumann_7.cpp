#include <array>
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

constexpr std::array exponents{2.0, 5.0, 20.0, 100.0, 1000.0};
constexpr std::array styles{"lines linetype 1", "lines linetype 2", "lines linetype 3", "lines linetype 4",
                            "lines linetype 5"};
constexpr double lobe_exponent = 20;
constexpr std::array incidences{0.0, 30.0, 60.0, 80.0};
constexpr double step = 0.5;  // degrees

std::string albedo_column(double n) { return "n" + short_text(n); }
std::string radiance_column(double incidence) { return "radiance_" + short_text(incidence); }

/// f cosθ_L towards V in the plane of incidence; positive views are on the mirror's side.
double radiance(const Model& model, double theta_l, double view) {
  const Direction l = Direction::from_degrees(theta_l);
  return brdf<double>(model, l, Direction::from_degrees(std::abs(view), view < 0 ? 0 : 180)) * l.cos_theta;
}

std::string data(const AlbedoCurves& curves, std::string_view name) {
  Sheet sheet(name, "Neumann, Neumann, Szirmay-Kalos 1999, fig. 7 and eq. 22");
  sheet.note("quantity",
             "nN: directional albedo of light from theta with n = N, and its absolute error; radiance_A: output "
             "radiance f cos(theta_L) with n = 20 towards theta in the plane of incidence, of light from A degrees");
  note_curves(sheet, curves);
  sheet.note("theta", "degrees; negative on the side of the light, where the albedo is that of its absolute value");
  std::vector<std::string> columns{"theta"};
  for (const auto& curve : curves.curves) {
    columns.push_back(curve.label);
    columns.push_back(curve.label + "_error");
  }
  for (const double incidence : incidences) columns.push_back(radiance_column(incidence));
  sheet.columns(columns);
  const auto model = make_model("neumann_phong", {{"n", lobe_exponent}});
  const int count = static_cast<int>(curves.directions.size()) - 1;
  for (int i = -count; i <= count; ++i) {
    const auto at = static_cast<std::size_t>(std::abs(i));
    std::vector<double> row{90.0 * i / count};
    for (const auto& estimates : curves.estimates) {
      row.push_back(estimates[at].value);
      row.push_back(estimates[at].error);
    }
    for (const double incidence : incidences) row.push_back(radiance(*model, incidence, row.front()));
    sheet.row(row);
  }
  return sheet.text();
}

std::string script(std::string_view name) {
  std::string gp = script_head(name, 17, 7.2) + "\nset multiplot\n" + std::string(axes_style);
  gp += "\n# (a) Albedo\n" + panel(1.3, 1.2, 6.7, 5.5) + albedo_axes(1.1);
  gp +=
      "set label 1 '(a)' at graph 0, graph 1.05\nset key at graph 0.04, graph 0.05 left bottom Left reverse samplen "
      "3.5 "
      "spacing letter\nplot ";
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    gp += "data using 'theta':'" + albedo_column(exponents[i]) + "' with " + styles[i] +
          " title '{/:Italic n} = " + short_text(exponents[i]) + (i + 1 < exponents.size() ? "', \\\n     " : "'\n");
  }
  gp += "\n# (b) Output radiance\nunset arrow 1\nunset label 2\n" + panel(9.7, 1.2, 6.7, 5.5);
  gp += R"(set xrange [-90:90]
set xtics 30
set mxtics 2
set yrange [0:4.2]
set ytics 1
set mytics 2
set format y '%g'
set xlabel 'viewing angle {/:Italic θ}_{/:Italic V} [degrees]'
set ylabel 'output radiance, {/:Italic n} = 20 [sr^{−1}]' offset 1 - letter, 0
set label 1 '(b)'
set arrow 2 from graph 0, first 22/(2*pi) to graph 1, first 22/(2*pi) nohead linecolor rgb '#808080' linewidth 0.5 back
set label 2 '({/:Italic n} + 2)/2π' at graph 0.03, first 22/(2*pi) offset 0, 0.5
set key at graph 0.03, graph 0.7 left center
plot )";
  for (std::size_t i = 0; i < incidences.size(); ++i) {
    gp += "data using 'theta':'" + radiance_column(incidences[i]) + "' with " + styles[i] +
          " title '{/:Italic θ}_{/:Italic L} = " + short_text(incidences[i]) +
          (i + 1 < incidences.size() ? "°', \\\n     " : "°'\n");
  }
  return gp + "unset multiplot\nunset output\n";
}

}  // namespace

Drawing neumann_7(std::string_view name) {
  std::vector<analysis::CurveRequest> requests;
  for (const double n : exponents) requests.push_back({albedo_column(n), "neumann_phong", {{"n", n}}});
  const AlbedoCurves curves = analysis::albedo_curves(std::move(requests), directions_by_degrees(step));
  return {.data = data(curves, name), .script = script(name), .unconverged = curves.unconverged()};
}

}  // namespace albedo::plots
