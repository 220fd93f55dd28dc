#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "plots/data/bound_curves.hpp"
#include "plots/figures/figure.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/sheet.hpp"

namespace albedo::plots {
namespace {

using analysis::BoundCurve;
using analysis::BoundedBox;

constexpr double alpha = 0.2, theta_l = 45;
constexpr std::array sides{0.1, 0.4};
/// Panel (a): a box of the second side, whose middle is at this angle.
constexpr double example_theta = 60;

std::string column(const char* quantity, const BoundCurve& curve) {
  return std::string(quantity) + "_" + short_text(curve.side);
}

std::string data(const std::vector<BoundCurve>& curves, std::string_view name) {
  Sheet sheet(name, "Walter 2005, fig. 6, eqs. 25-33 (doc/bounds.md)");
  sheet.note("quantity",
             "cosine_S, product_S: largest cos(theta_V) and f cos(theta_V) [1/sr] over a cube of side S, by a search; "
             "cosine_bound_S, product_bound_S: their bounds; at_middle: f cos(theta_V) in the middle's direction");
  sheet.note("model", "ward alpha=" + short_text(alpha) + " rho_s=1 rho_d=0");
  sheet.note("theta_l", theta_l);
  sheet.note("theta",
             "of the cube's middle, at distance 1, in the plane of incidence [degrees]; negative on the light's side");
  std::vector<std::string> columns{"theta", "at_middle"};
  for (const BoundCurve& curve : curves) {
    for (const char* const quantity : {"cosine_bound", "cosine", "product_bound", "product"}) {
      columns.push_back(column(quantity, curve));
    }
  }
  sheet.columns(columns);
  for (std::size_t i = 0; i < curves.front().boxes.size(); ++i) {
    std::vector<double> row{curves.front().boxes[i].theta, curves.front().boxes[i].at_middle};
    for (const BoundCurve& curve : curves) {
      const BoundedBox& box = curve.boxes[i];
      row.insert(row.end(), {box.cosine_bound, box.cosine, box.product_bound, box.product});
    }
    sheet.row(row);
  }
  return sheet.text();
}

/// The box from the side; the mirror's side is on the right.
std::string example_panel(const BoundCurve& curve) {
  const auto* const example = &*std::ranges::find(curve.boxes, example_theta, &BoundedBox::theta);
  const DirectionBox& box = example->box;
  const double left = -box.x_max, right = -box.x_min, bottom = box.z_min, top = box.z_max;
  std::ostringstream gp;
  gp << "\n# (a) A box from the side\n"
     << panel(0.3, 1.6, 5, 4) << "unset border\nunset tics\nset xrange [-0.1:1.4]\nset yrange [-0.1:1.1]\n"
     << "set label 1 '(a)' at graph 0.03, graph 1.05\n"
     << "set object 1 rectangle from " << left << ", " << bottom << " to " << right << ", " << top
     << " fillstyle solid 1 border linecolor rgb '#000000' fillcolor rgb '#9CC4E0'\n"
     << "set arrow 1 from -0.1, 0 to 1.4, 0 nohead linetype 7\n"
     << "set arrow 2 from 0, 0 to 0, 0.95 linetype 7\n"
     << "set arrow 3 from 0, 0 to " << left << ", " << top << " nohead linetype 2 front\n"
     << "set arrow 4 from " << left << ", " << top << " to " << 1.3 * left << ", " << 1.3 * top
     << " linetype 2 dashtype solid front\n"
     << "set label 2 '{/:Italic N}' at 0, 1.01 center\n"
     << "set label 3 'box' at " << (left + right) / 2 + 0.05 << ", " << (top + bottom) / 2 - 0.08 << " center front\n"
     << "set label 4 'cos {/:Italic θ}_{/:Italic V} ≤ " << std::round(1000 * example->cosine_bound) / 1000 << "' at "
     << 1.3 * left - 0.25 << ", " << 1.3 * top + 0.08 << " left\n"
     << "plot NaN\n"
     << "unset object 1\n";
  for (int i = 1; i <= 4; ++i) gp << "unset arrow " << i << "\nunset label " << i << '\n';
  return gp.str();
}

/// Bounds as full lines, the largest values found dashed, of both sides.
std::string plot(const std::vector<BoundCurve>& curves, const std::string& quantity) {
  std::string command = "plot ";
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::string colour = i == 0 ? "1" : "5";
    command += "data using 'theta':'" + column((quantity + "_bound").c_str(), curves[i]) + "' with lines linetype " +
               colour + ", \\\n     data using 'theta':'" + column(quantity.c_str(), curves[i]) +
               "' with lines linetype " + (i == 0 ? "3" : "2");
    command += i + 1 < curves.size() ? ", \\\n     " : "";
  }
  return command;
}

std::string script(const std::vector<BoundCurve>& curves, std::string_view name) {
  std::string gp = script_head(name, 17, 7.2) + "\nset multiplot\n";
  gp += legend(6.2, 0.9, 2,
               {{"lines linetype 1", "bound, side " + short_text(sides[0])},
                {"lines linetype 3", "largest value, side " + short_text(sides[0])},
                {"lines linetype 5", "bound, side " + short_text(sides[1])},
                {"lines linetype 2", "largest value, side " + short_text(sides[1])},
                {"lines linetype 7", "value in the middle"}});
  gp += example_panel(curves.back());
  gp += std::string(axes_style) + R"(
# (b) The cosine
set xrange [-90:90]
set xtics 45 offset 0, 0.8 * (1 - letter)
set mxtics 3
set xlabel 'angle of the box [degrees]' offset 0, 1.3 - letter
set yrange [0:1.1]
set ytics 0.2
set mytics 2
set format y '%.1f'
set ylabel 'cos {/:Italic θ}_{/:Italic V}' offset 2 - letter, 0
set label 1 '(b)' at graph 0.02, graph 1.06
)";
  gp +=
      panel(6.5, 1.2, 4.2, 4.4) + plot(curves, "cosine") + ", \\\n     [-90:90] cos(x*pi/180) with lines linetype 7\n";
  gp += R"(
# (c) f cosθ
set yrange [0:*]
set ytics autofreq
set format y '%g'
set ylabel '{/:Italic f} cos {/:Italic θ}_{/:Italic V} [sr^{−1}]' offset 1 - letter, 0
set label 1 '(c)'
)";
  gp += panel(12.4, 1.2, 4.2, 4.4) + plot(curves, "product") +
        ", \\\n     data using 'theta':'at_middle' with lines linetype 7\n";
  return gp + "unset multiplot\nunset output\n";
}

}  // namespace

Drawing walter_6(std::string_view name) {
  std::vector<double> thetas;
  for (int i = -180; i <= 180; ++i) thetas.push_back(0.5 * i);
  const Ward ward{.alpha_x = alpha, .alpha_y = alpha};
  std::vector<BoundCurve> curves;
  for (const double side : sides) {
    curves.push_back(analysis::bound_curve(ward, Direction::from_degrees(theta_l), side, thetas));
  }
  return {.data = data(curves, name), .script = script(curves, name)};
}

}  // namespace albedo::plots
