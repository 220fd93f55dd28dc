#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "plots/data/plausibility.hpp"
#include "plots/figures/figure.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/sheet.hpp"

namespace albedo::plots {
namespace {

using analysis::CurveRequest;
using analysis::Plausibility;

constexpr double last_theta = 89, tolerance = 1e-7;

/// Kurt's eq. 10 over cells of m × α; the cells' middles.
constexpr int columns = 60, rows = 50;
constexpr double first_m = 0.03, last_m = 3, last_exponent = 1;

double m_of(double place) { return first_m * std::pow(last_m / first_m, place / columns); }
double exponent_of(double place) { return last_exponent * place / rows; }

/// The others over m alone.
struct Family {
  const char *label, *title, *model, *style;
};
constexpr std::array families{Family{"ward", "Ward", "ward", "lines linetype 1"},
                              Family{"duer", "Ward–Duer", "ward_duer", "lines linetype 2"},
                              Family{"kurt_9", "Kurt, eq. 9", "kurt", "lines linetype 3"}};
constexpr int steps = 96;

double m_of_step(int step) { return first_m * std::pow(10 / first_m, static_cast<double>(step) / steps); }

std::vector<CurveRequest> map_materials() {
  std::vector<CurveRequest> materials;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      materials.push_back({"", "kurt", {{"m", m_of(i + 0.5)}, {"exponent", exponent_of(j + 0.5)}, {"equation", "10"}}});
    }
  }
  return materials;
}

std::vector<CurveRequest> family_materials(const Family& family) {
  std::vector<CurveRequest> materials;
  for (int i = 0; i <= steps; ++i) {
    Parameters parameters{{"m", m_of_step(i)}};
    if (std::string(family.model) == "kurt") parameters.emplace_back("equation", "9");
    materials.push_back({"", family.model, parameters});
  }
  return materials;
}

/// 90° − θ of the critical angle in degrees; 0 where the albedo passes 1 nowhere above cosθ = 1e-60.
double distance(const Plausibility& one) {
  return one.critical.exists ? std::asin(one.critical.cos_theta) * 180 / pi<double> : 0;
}

using Families = std::vector<std::vector<Plausibility>>;

std::string data(const std::vector<Plausibility>& map, const Families& curves, std::string_view name) {
  Sheet sheet(name, "Kurt 2010, eqs. 9 and 10; Ward 1992; Duer 2005; F = 1");
  sheet.note(
      "quantity",
      "largest: directional albedo, the largest one up to 89 degrees, at theta; grazing: its limit at 90 degrees; "
      "critical: degrees from grazing incidence at which the albedo passes 1, 0 if closer than cos(theta) = "
      "1e-60 or nowhere");
  sheet.note("model 0", "kurt equation=10, cells of m x exponent");
  for (std::size_t i = 0; i < families.size(); ++i) {
    sheet.note("model " + std::to_string(i + 1),
               std::string(families[i].model) + (i == 2 ? " equation=9" : "") + ", exponent not used");
  }
  sheet.note("rule", "gauss");
  sheet.note("tolerance", tolerance);
  sheet.columns({"model", "m", "m_low", "m_high", "exponent", "exponent_low", "exponent_high", "largest", "theta",
                 "grazing", "critical"});
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Plausibility& one = map[static_cast<std::size_t>(j * columns + i)];
      sheet.row({0, m_of(i + 0.5), m_of(i), m_of(i + 1), exponent_of(j + 0.5), exponent_of(j), exponent_of(j + 1),
                 one.largest, one.theta, one.grazing, distance(one)});
    }
  }
  for (std::size_t f = 0; f < families.size(); ++f) {
    for (int i = 0; i <= steps; ++i) {
      const Plausibility& one = curves[f][static_cast<std::size_t>(i)];
      sheet.row({static_cast<double>(f + 1), m_of_step(i), m_of_step(i), m_of_step(i), 0, 0, 0, one.largest, one.theta,
                 one.grazing, distance(one)});
    }
  }
  return sheet.text();
}

struct Bin {
  const char *above, *colour, *title;  ///< the bin's lower end
};
/// Of 90° − θ, from light to dark.
constexpr std::array critical_bins{Bin{"-1", "#F7FCF0", "below 10^{−6}°"},
                                   Bin{"1e-6", "#D4EBCB", "10^{−6}° … 10^{−3}°"},
                                   Bin{"1e-3", "#A8DDB5", "10^{−3}° … 0.1°"},
                                   Bin{"0.1", "#6FBFC8", "0.1° … 1°"},
                                   Bin{"1", "#3D95C2", "1° … 5°"},
                                   Bin{"5", "#1668A5", "5° … 15°"},
                                   Bin{"15", "#0A4580", "15° … 30°"},
                                   Bin{"30", "#031F3C", "above 30°"}};
/// Of the albedo; the hue changes at 1.
constexpr std::array albedo_bins{Bin{"-1", "#F7FAFC", "below 0.6"},   Bin{"0.6", "#E6EEF5", "0.6 … 0.8"},
                                 Bin{"0.8", "#D3E2EE", "0.8 … 0.95"}, Bin{"0.95", "#BCD3E6", "0.95 … 1"},
                                 Bin{"1", "#E07B2A", "1 … 1.2"},      Bin{"1.2", "#B5520F", "1.2 … 2"},
                                 Bin{"2", "#7D3006", "2 … 10"},       Bin{"10", "#3D1701", "above 10"}};

template <std::size_t Count>
std::string map_panel(const std::array<Bin, Count>& bins, const std::string& quantity, double left, char letter,
                      const std::string& title) {
  std::ostringstream gp;
  gp << "\n# " << quantity << " over m and alpha\n"
     << panel(left, 7.6, 4, 5) << "set logscale x\nunset logscale y\nset xrange [" << first_m << ":" << last_m
     << "]\nset yrange [0:" << last_exponent << "]\n"
     << R"(set xtics (0.03, 0.1, 0.3, 1, 3) offset 0, 0.8 * (1 - letter)
set ytics 0.2
set mytics 2
set format y '%.1f'
set xlabel 'roughness {/:Italic m}' offset 0, 1.3 - letter
set ylabel 'exponent {/:Italic α}' offset 2 - letter, 0
)"
     << "set label 1 '(" << letter << ") Kurt, eq. 10: " << title << "' at graph 0, graph 1.07\n"
     << "set key at graph 1.06, graph 1 left top Left reverse samplen 1 spacing 1.1*letter\n";
  gp << "low(k) = ";
  for (std::size_t i = 0; i < Count; ++i) gp << "k == " << i << " ? " << bins[i].above << " : ";
  gp << "1e300\ninside(k) = column('model') == 0 && column('" << quantity << "') >= low(k) && column('" << quantity
     << "') < low(k + 1)\nplot ";
  for (std::size_t i = 0; i < Count; ++i) {
    gp << "data using (inside(" << i << ") ? column('m') : NaN):'exponent':'m_low':'m_high':'exponent_low':"
       << "'exponent_high' with boxxyerror fillstyle solid 1 border linecolor rgb '" << bins[i].colour
       << "' linewidth 0.2 fillcolor rgb '" << bins[i].colour
       << "' notitle, \\\n     NaN with boxes linewidth 0.5 dashtype solid fillstyle solid 1 border linecolor rgb "
          "'#000000' "
          "fillcolor rgb '"
       << bins[i].colour << "' title '" << bins[i].title << "'" << (i + 1 < Count ? ", \\\n     " : "\n");
  }
  return gp.str();
}

std::string curves_panel(const std::string& value, double left, char letter, const std::string& title,
                         const std::string& axis) {
  std::string gp = "\n# " + title + " over m\n" + panel(left, 1.2, 6.3, 4.6);
  gp += "set logscale x\nset xrange [" + short_text(first_m) + ":10]\nset xtics (0.03, 0.1, 0.3, 1, 3, 10)\n" + axis;
  gp += "set label 1 '(" + std::string(1, letter) + ") " + title + "' at graph 0, graph 1.07\nplot ";
  for (std::size_t i = 0; i < families.size(); ++i) {
    gp += "data using (column('model') == " + std::to_string(i + 1) + " ? column('m') : NaN):(" + value + ") with " +
          families[i].style + " title '" + families[i].title + (i + 1 < families.size() ? "', \\\n     " : "'\n");
  }
  return gp;
}

std::string script(std::string_view name) {
  std::string gp = script_head(name, 17, 13.4) + "\nset multiplot\n" + std::string(axes_style);
  gp += map_panel(critical_bins, "critical", 1.9, 'a', "where {/:Italic a} passes 1, 90° − {/:Italic θ}");
  gp += map_panel(albedo_bins, "largest", 10.1, 'b', "largest {/:Italic a} up to 89°");
  gp += curves_panel("column('critical') > 0 ? column('critical') : NaN", 1.9, 'c',
                     "where {/:Italic a} passes 1, 90° − {/:Italic θ}",
                     R"(set logscale y
set yrange [1e-6:100]
set ytics ('10^{−6}' 1e-6, '10^{−4}' 1e-4, '10^{−2}' 1e-2, '1' 1, '' 1e-5 1, '' 1e-3 1, '' 1e-1 1, '' 10 1, '100' 100)
unset mytics
set ylabel '90° − {/:Italic θ} [degrees]' offset 1 - letter, 0
set key at graph 0.97, graph 0.06 right bottom Left reverse samplen 3.5 spacing letter
)");
  gp += curves_panel("column('largest')", 10.1, 'd', "largest {/:Italic a} up to 89°", R"(set yrange [0.03:30]
set ytics ('0.03' 0.03, '0.1' 0.1, '0.3' 0.3, '1' 1, '3' 3, '10' 10, '30' 30)
set ylabel 'largest albedo' offset 1 - letter, 0
set key at graph 0.03, graph 0.05 left bottom Left reverse samplen 3.5 spacing letter
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead linecolor rgb '#808080' linewidth 0.5 back
)");
  return gp + "unset multiplot\nunset output\n";
}

std::size_t unconverged(const std::vector<Plausibility>& materials) {
  std::size_t count = 0;
  for (const Plausibility& one : materials) count += static_cast<std::size_t>(one.unconverged);
  return count;
}

}  // namespace

Drawing plausibility(std::string_view name) {
  const std::vector<Plausibility> map = analysis::plausibility_map(map_materials(), last_theta, tolerance);
  std::size_t missed = unconverged(map);
  Families curves;
  for (const Family& family : families) {
    curves.push_back(analysis::plausibility_map(family_materials(family), last_theta, tolerance));
    missed += unconverged(curves.back());
  }
  return {.data = data(map, curves, name), .script = script(name), .unconverged = missed};
}

}  // namespace albedo::plots
