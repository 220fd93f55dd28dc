#include <array>
#include <string>
#include <vector>

#include "plots/data/albedo_curves.hpp"
#include "plots/figures/figure.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/sheet.hpp"

namespace albedo::plots {
namespace {

using analysis::AlbedoCurves;

constexpr std::array styles{"lines linetype 7", "lines linetype 1", "lines linetype 2",
                            "lines linetype 3", "lines linetype 4", "lines linetype 5"};

std::string data(const AlbedoCurves& curves, std::string_view name, const char* source) {
  Sheet sheet(name, source);
  sheet.note("quantity", "directional albedo and the absolute error of each value");
  note_curves(sheet, curves);
  add_curves(sheet, curves);
  return sheet.text();
}

std::string plot(const std::vector<std::string>& columns) {
  std::string command = "plot ";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    command +=
        "data using 'theta_l':'" + columns[i] + "' with " + styles[i] + (i + 1 < columns.size() ? ", \\\n     " : "\n");
  }
  return command;
}

/// 0 … 90° by half degrees, and closer to 90° what half degrees miss of a divergence.
std::vector<Direction> directions() {
  std::vector<Direction> all = directions_by_degrees(0.5);
  all.pop_back();
  for (const double theta : {89.6, 89.7, 89.8, 89.9, 89.95, 89.98, 89.99, 89.995, 89.999, 89.9999}) {
    all.push_back(Direction::from_degrees(theta));
  }
  all.push_back(Direction::from_degrees(90));
  return all;
}

constexpr std::array roughnesses_9{0.05, 0.1, 0.2, 0.5, 1.0, 3.0};

std::string column_9(double m) { return "m" + short_text(m); }

std::string script_9(std::string_view name) {
  std::string gp = script_head(name, 8.5, 7.6) + "\nset multiplot\n";
  std::vector<LegendEntry> entries;
  std::vector<std::string> columns;
  for (std::size_t i = 0; i < roughnesses_9.size(); ++i) {
    entries.push_back({styles[i], "{/:Italic m} = " + short_text(roughnesses_9[i])});
    columns.push_back(column_9(roughnesses_9[i]));
  }
  gp += legend(6.6, 0.9, 2, entries) + panel(1.3, 1.2, 6.9, 5.3) + albedo_axes(1.3) + plot(columns);
  return gp + "unset multiplot\nunset output\n";
}

constexpr std::array roughnesses_10{0.05, 0.1, 0.3, 1.0};
constexpr std::array exponents_10{0.0, 0.1, 0.25, 0.5, 0.75};

std::string column_10(double m, double exponent) { return "m" + short_text(m) + "_alpha" + short_text(exponent); }

std::string script_10(std::string_view name) {
  std::string gp = script_head(name, 17, 13.4) + "\nset multiplot\n";
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < exponents_10.size(); ++i) {
    entries.push_back({styles[i], "{/:Italic α} = " + short_text(exponents_10[i])});
  }
  gp += legend(12.6, 0.7, 1, entries);
  for (std::size_t i = 0; i < roughnesses_10.size(); ++i) {
    const double m = roughnesses_10[i];
    std::vector<std::string> columns;
    for (const double exponent : exponents_10) columns.push_back(column_10(m, exponent));
    gp += "\n" + panel(i % 2 == 0 ? 1.3 : 9.7, i < 2 ? 7.6 : 1.2, 6.7, 4.4) + albedo_axes(1.6);
    gp += "set label 1 '(" + std::string(1, static_cast<char>('a' + i)) + ") {/:Italic m} = " + short_text(m) +
          "' at graph 0, graph 1.07\n" + plot(columns);
  }
  return gp + "unset multiplot\nunset output\n";
}

}  // namespace

Drawing kurt_2(std::string_view name) {
  std::vector<analysis::CurveRequest> requests;
  for (const double m : roughnesses_9) requests.push_back({column_9(m), "kurt", {{"m", m}, {"equation", "9"}}});
  const AlbedoCurves curves = analysis::albedo_curves(std::move(requests), directions());
  return {.data = data(curves, name, "Kurt, Szirmay-Kalos, Krivanek 2010, fig. 2 and eq. 9"),
          .script = script_9(name),
          .unconverged = curves.unconverged()};
}

Drawing kurt_3(std::string_view name) {
  std::vector<analysis::CurveRequest> requests;
  for (const double m : roughnesses_10) {
    for (const double exponent : exponents_10) {
      requests.push_back({column_10(m, exponent), "kurt", {{"m", m}, {"exponent", exponent}, {"equation", "10"}}});
    }
  }
  const AlbedoCurves curves = analysis::albedo_curves(std::move(requests), directions());
  return {.data = data(curves, name, "Kurt, Szirmay-Kalos, Krivanek 2010, fig. 3 and eq. 10"),
          .script = script_10(name),
          .unconverged = curves.unconverged()};
}

}  // namespace albedo::plots
