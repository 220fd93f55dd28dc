#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "albedo/version.hpp"
#include "analysis/studies/tradeoff.hpp"
#include "analysis/studies/tradeoff_writer.hpp"
#include "plots/figures/figure.hpp"
#include "plots/figures/gnuplot.hpp"

namespace albedo::plots {
namespace {

using analysis::Tradeoff;
using analysis::TradeoffMaterial;

/// A curve of every panel: its rule and warp as in the data, its title, and its looks: a line type of the common style
/// and a marker that tells it apart in grey.
struct Curve {
  const char *rule, *warp, *title;
  int line, marker;
};
constexpr std::array curves{Curve{"gauss", "lobe", "gauss, lobe", 1, 7},
                            Curve{"cubature", "lobe", "cubature, lobe", 2, 5},
                            Curve{"kronrod", "lobe", "kronrod, lobe", 3, 9},
                            Curve{"tanh_sinh", "lobe", "tanh–sinh, lobe", 4, 13},
                            Curve{"cubature", "hemisphere", "cubature, hemisphere", 2, 4},
                            Curve{"sobol", "lobe", "Sobol, lobe", 6, 11},
                            Curve{"stratified", "lobe", "stratified, lobe", 5, 10},
                            Curve{"monte_carlo", "paper", "Monte Carlo, paper", 7, 2}};

/// On paper, in centimetres.
constexpr double width = 18, left = 2.3, gap = 0.4, panel_width = 3.55, panel_height = 3.6, head = 2, foot = 1.25,
                 row_gap = 1.8;

struct Quantity {
  const char *column, *label, *range, *tics;
};
constexpr std::array quantities{Quantity{"seconds", "time [s]", "[3e-7:0.3]",
                                         "('1 µs' 1e-6, '' 1e-5 1, '100 µs' 1e-4, '' 1e-3 1, '10 ms' 1e-2, '' 1e-1 1)"},
                                Quantity{"evaluations", "evaluations", "[8:3e6]",
                                         "('10' 1e1, '' 1e2 1, '10^3' 1e3, '' 1e4 1, '10^5' 1e5, '' 1e6 1)"}};

/// Only the first panel of a row tells what its height means.
constexpr const char* labelled_y =
    "set ytics ('1' 1, '10^{−4}' 1e-4, '10^{−8}' 1e-8, '10^{−12}' 1e-12, "
    "'' 1e-2 1, '' 1e-6 1, '' 1e-10 1, '' 1e-14 1)\n";
constexpr const char* plain_y =
    "unset ylabel\nset ytics ('' 1, '' 1e-4, '' 1e-8, '' 1e-12, '' 1e-2 1, '' 1e-6 1, '' 1e-10 1, '' 1e-14 1)\n";

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

/// "α = 0.1" of the parameter that makes the material smooth or rough.
std::string parameter_text(const TradeoffMaterial& material) {
  const auto& [name, value] = material.parameters.front();
  return "{/:Italic " + (name == "alpha" ? std::string("α") : name) + "} = " + text(std::get<double>(value));
}

/// A panel's plot command: what is reported as thin whiskers behind, then the true errors.
std::string plot(const std::string& column) {
  std::string whiskers, lines;
  for (const Curve& curve : curves) {
    const std::string chosen = "chosen('" + std::string(curve.rule) + "', '" + curve.warp + "')";
    whiskers += "     data using (" + chosen + " ? column('" + column +
                "') : NaN):(column('true_error')):(0):(column('reported_error') - column('true_error')) with vectors "
                "nohead linecolor rgb colour_" +
                std::to_string(curve.line) + " linewidth 0.7, \\\n";
    lines += "     data using (" + chosen + " ? column('" + column +
             "') : NaN):(column('true_error')) with linespoints linetype " + std::to_string(curve.line) +
             " pointtype " + std::to_string(curve.marker) + " pointsize 0.42, \\\n";
  }
  std::string command = "plot" + (whiskers + lines).substr(4);
  return command.substr(0, command.size() - 4) + "\n";
}

std::string script(const Tradeoff& study, const std::vector<TradeoffMaterial>& materials, std::string_view name) {
  const std::size_t rows = 2 * materials.size(), columns = study.request.thetas.size();
  const double height = head + static_cast<double>(rows) * (panel_height + row_gap) - row_gap + foot;
  std::string gp = script_head(name, width, height);
  gp += R"(
# Paler shades of the lines' colours, for what a rule reports.
colour_1 = '#99C7E0'
colour_2 = '#EEBF99'
colour_3 = '#99D8C7'
colour_4 = '#EBC9DC'
colour_5 = '#F5D999'
colour_6 = '#BBE1F6'
colour_7 = '#AAAAAA'

set multiplot

# One legend for all panels.
set lmargin at screen 0.02
set rmargin at screen 0.98
set tmargin at screen 1
set bmargin at screen 1 - 1.35/height
unset border
unset tics
set xrange [0:1]
set yrange [0:1]
set key center center vertical maxrows 3 Left reverse samplen 2.5 spacing 1.1*letter
plot )";
  for (const Curve& curve : curves) {
    gp += "NaN with linespoints linetype " + std::to_string(curve.line) + " pointtype " + std::to_string(curve.marker) +
          " pointsize 0.55 title '" + curve.title + "', \\\n     ";
  }
  gp.resize(gp.size() - 9);
  gp += "\nunset key\n" + std::string(axes_style) + R"(
set logscale xy
set format x '10^{%T}'
set yrange [3e-16:3]
set grid xtics ytics linetype -1 linecolor rgb '#DDDDDD' linewidth 0.4
)";
  for (std::size_t row = 0; row < rows; ++row) {
    const TradeoffMaterial& material = materials[row / 2];
    const Quantity& quantity = quantities[row % 2];
    const double top = head + static_cast<double>(row) * (panel_height + row_gap);
    gp += "\n# " + material.label + ": error against " + quantity.label + "\nset tmargin at screen 1 - " + text(top) +
          "/height\nset bmargin at screen 1 - " + text(top + panel_height) + "/height\nset xrange " + quantity.range +
          "\nset xtics " + quantity.tics + "\nset xlabel '" + quantity.label + "' offset 0, 0.6*letter\n";
    for (std::size_t column = 0; column < columns; ++column) {
      const double begin = left + static_cast<double>(column) * (panel_width + gap);
      gp += "set lmargin at screen " + text(begin) + "/width\nset rmargin at screen " + text(begin + panel_width) +
            "/width\n";
      gp += column == 0 ? "set ylabel \"" + material.label + ", " + parameter_text(material) +
                              "\\nrelative error\" offset -0.3, 0\n" + labelled_y
                        : plain_y;
      gp += "set label 1 '{/:Italic θ}_{/:Italic L} = " + text(study.request.thetas[column]) +
            "°' at graph 0, graph 1.07\n";
      gp += "chosen(rule, warp) = strcol('material') eq '" + material.label +
            "' && column('theta_deg') == " + text(study.request.thetas[column]) +
            " && strcol('rule') eq rule && strcol('warp') eq warp\n";
      gp += plot(quantity.column);
    }
  }
  return gp + "unset multiplot\nunset output\n";
}

}  // namespace

Drawing tradeoff(std::string_view name) {
  constexpr std::string_view prefix = "tradeoff-";
  std::string model = name.starts_with(prefix) ? std::string(name.substr(prefix.size())) : "ward";
  std::ranges::replace(model, '-', '_');
  analysis::TradeoffRequest request = analysis::default_tradeoff();
  request.materials = analysis::usual_materials(model);
  const std::vector<TradeoffMaterial> materials = request.materials;
  const Tradeoff study = analysis::measure_tradeoff(std::move(request));

  nlohmann::ordered_json provenance{{"version", "albedo " + std::string(version)},
                                    {"command", "albedo-figures " + std::string(name)}};
  provenance.update(describe(study.request));
  std::ostringstream data;
  write_csv(provenance, study, data);
  return {.data = data.str(), .script = script(study, materials, name), .unconverged = study.unconverged()};
}

}  // namespace albedo::plots
