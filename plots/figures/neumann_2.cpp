#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "plots/data/critical_region.hpp"
#include "plots/figures/figure.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/sheet.hpp"

namespace albedo::plots {
namespace {

using analysis::ChartPoint;
using analysis::CriticalRegion;
using Outline = std::vector<UnitVector<double>>;

constexpr double cap_angle = 12;
/// The arc of L is longer than four caps, and shorter.
constexpr std::array first_thetas{30.0, 70.0};
constexpr std::array names{"large", "small"};

/// Both charts' places of one outline; the slopes are of half vectors of the arc's first L, and none of V below the
/// horizon.
void add_places(std::vector<double>& row, const CriticalRegion& one, const Outline& outline, std::size_t i) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (outline.empty()) {
    row.insert(row.end(), {none, none, none, none});
    return;
  }
  const ChartPoint place = analysis::hemisphere_point(outline[i]);
  const auto l = unit_vector<double>(Direction::from_degrees(one.domains.first_theta));
  const bool above = outline[i].z > -1e-9;
  const ChartPoint slope = above ? analysis::slope_point(l, outline[i]) : ChartPoint{none, none};
  row.insert(row.end(), {place.x, place.y, slope.x, slope.y});
}

std::string data(const std::vector<CriticalRegion>& cases, std::string_view name) {
  Sheet sheet(name, "Neumann, Neumann, Szirmay-Kalos 1999, fig. 2 and sec. 2.1");
  sheet.note("quantity", "outlines of domains of V for two arcs of L and a cap of half vectors H around N");
  sheet.note("cap of H", cap_angle);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string which = names[i];
    sheet.note("arc of L, " + which, "from theta " + short_text(cases[i].domains.first_theta) + " to 90, azimuth 0");
    sheet.note("solid angle of the critical region [sr], " + which, cases[i].solid_angle);
  }
  sheet.note("longest arc with a critical region", 4 * cap_angle);
  sheet.note("from_first, from_last", "the V that the first and the last L of the arc mirror in the cap");
  sheet.note("x, y", "theta cos(phi), theta sin(phi) of V in degrees");
  sheet.note("slope_x, slope_y", "H_x/H_z, H_y/H_z of the half vector of V and the first L");
  std::vector<std::string> columns{"psi", "cap_x", "cap_y", "cap_slope_x", "cap_slope_y"};
  for (const char* const which : names) {
    for (const char* const outline : {"from_first", "from_last", "region"}) {
      for (const char* const place : {"x", "y", "slope_x", "slope_y"}) {
        columns.push_back(std::string(which) + "_" + outline + "_" + place);
      }
    }
  }
  sheet.columns(columns);
  const std::size_t points = cases.front().from_first.size();
  for (std::size_t i = 0; i < points; ++i) {
    const double psi = 360.0 * static_cast<double>(i) / static_cast<double>(points - 1);
    const double c = std::cos(psi * pi<double> / 180), s = std::sin(psi * pi<double> / 180);
    const double radius = std::tan(cap_angle * pi<double> / 180);
    std::vector<double> row{psi, cap_angle * c, cap_angle * s, radius * c, radius * s};
    for (const CriticalRegion& one : cases) {
      for (const Outline* outline : {&one.from_first, &one.from_last, &one.region}) add_places(row, one, *outline, i);
    }
    sheet.row(row);
  }
  return sheet.text();
}

std::string hemisphere_panel(const CriticalRegion& one, const std::string& which, double left, char letter) {
  std::ostringstream gp;
  gp << "\n# The hemisphere from above, " << which << " arc\n"
     << panel(left, 7.2, 7, 7) << R"(unset border
unset tics
unset xlabel
unset ylabel
set xrange [-119:119]
set yrange [-119:119]
set parametric
set trange [0:2*pi]
)";
  gp << "set label 1 '(" << letter << ")' at graph 0.02, graph 0.97\n"
     << "set label 2 'arc of {/:Italic L}: " << 90 - one.domains.first_theta
     << "°, cap of {/:Italic H}: " << one.domains.cap_angle << "°' at graph 0.5, graph 0.97 center\n"
     << "set label 3 '{/:Italic N}' at 0, " << one.domains.cap_angle + 7 << " center\n"
     << "set label 4 'domain of {/:Italic L}' at 99, 0 rotate by -90 center\n"
     << "set label 5 '30°' at 0, -30 center offset 0, -0.5 textcolor rgb '#808080' font ',7'\n"
     << "set label 6 '60°' at 0, -60 center offset 0, -0.5 textcolor rgb '#808080' font ',7'\n"
     << "set label 7 'horizon' at 0, -90 center offset 0, -0.6 textcolor rgb '#808080' font ',7'\n"
     << "set arrow 1 from " << one.domains.first_theta
     << ", 0 to 90, 0 nohead linecolor rgb '#000000' linewidth 3 front\n";
  gp << "plot 30*cos(t), 30*sin(t) with lines linecolor rgb '#C0C0C0' linewidth 0.5 dashtype solid, \\\n"
     << "     60*cos(t), 60*sin(t) with lines linecolor rgb '#C0C0C0' linewidth 0.5 dashtype solid, \\\n";
  if (!one.region.empty()) {
    gp << "     data using '" << which << "_region_x':'" << which
       << "_region_y' with filledcurves closed fillstyle solid 1 fillcolor rgb '#E69F00', \\\n";
  }
  gp << "     90*cos(t), 90*sin(t) with lines linecolor rgb '#000000' linewidth 0.8 dashtype solid, \\\n"
     << "     data using 'cap_x':'cap_y' with filledcurves closed fillstyle solid 1 fillcolor rgb '#9CC4E0', \\\n"
     << "     data using 'cap_x':'cap_y' with lines linewidth 0.8 linecolor rgb '#000000' dashtype solid, \\\n"
     << "     data using '" << which << "_from_first_x':'" << which << "_from_first_y' with lines linetype 1, \\\n"
     << "     data using '" << which << "_from_last_x':'" << which << "_from_last_y' with lines linetype 2\n"
     << "unset parametric\nunset arrow 1\nunset label 4\nunset label 5\nunset label 6\nunset label 7\n";
  return gp.str();
}

/// What the arc's first L can mirror from above the horizon, and what from the domain of the last L.
std::string slope_panel(const CriticalRegion& one, const std::string& which, double left, char letter) {
  const double first = one.domains.first_theta * pi<double> / 180;
  const double middle = std::tan(first), radius = 1 / std::cos(first);  // of the circle of slopes with V on the horizon
  std::ostringstream gp;
  gp << "\n# Slopes of half vectors, " << which << " arc\n"
     << axes_style << panel(left, 1.2, 6.3, 5.2) << R"(set xrange [-0.7:0.3]
set yrange [-0.41:0.41]
set xtics 0.2 offset 0, 0.8 * (1 - letter)
set ytics 0.2
set mxtics 2
set mytics 2
set format y '%g'
set xlabel 'slope {/:Italic H_x}/{/:Italic H_z}' offset 0, 1.3 - letter
)";
  gp << (letter == 'c' ? "set ylabel 'slope {/:Italic H_y}/{/:Italic H_z}' offset 1 - letter, 0\n" : "unset ylabel\n")
     << "set label 1 '(" << letter << ")' at graph 0.02, graph 1.06\n"
     << "set label 2 '{/:Italic V} on the horizon' at " << middle - std::sqrt(square(radius) - square(0.37)) + 0.02
     << ", -0.37 left textcolor rgb '#606060'\n"
     << "unset label 3\nset parametric\nset trange [0:2*pi]\nplot ";
  if (!one.region.empty()) {
    gp << "data using '" << which << "_region_slope_x':'" << which
       << "_region_slope_y' with filledcurves closed fillstyle solid 1 fillcolor rgb '#E69F00', \\\n     ";
  }
  gp << middle << " + " << radius << "*cos(t), " << radius
     << "*sin(t) with lines linecolor rgb '#808080' linewidth 0.8 dashtype solid, \\\n     "
     << "data using 'cap_slope_x':'cap_slope_y' with lines linetype 1, \\\n     data using '" << which
     << "_from_last_slope_x':'" << which << "_from_last_slope_y' with lines linetype 2\nunset parametric\n";
  return gp.str();
}

std::string script(const std::vector<CriticalRegion>& cases, std::string_view name) {
  std::string gp = script_head(name, 16, 15.2) + "\nset multiplot\n";
  gp += legend(14.2, 0.9, 2,
               {{"lines linetype 1", "{/:Italic H} in the cap, {/:Italic L} steepest"},
                {"lines linetype 2", "{/:Italic H} in the cap, {/:Italic L} on the horizon"},
                {"boxes fillstyle solid 1 noborder fillcolor rgb '#E69F00'",
                 "critical region: {/:Italic H} in the cap for every {/:Italic L}"}});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    gp += hemisphere_panel(cases[i], names[i], i == 0 ? 1.1 : 8.8, static_cast<char>('a' + i));
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    gp += slope_panel(cases[i], names[i], i == 0 ? 1.9 : 9.4, static_cast<char>('c' + i));
  }
  return gp + "unset multiplot\nunset output\n";
}

}  // namespace

Drawing neumann_2(std::string_view name) {
  std::vector<CriticalRegion> cases;
  for (const double first : first_thetas) cases.push_back(analysis::critical_region({first, cap_angle}));
  return {.data = data(cases, name), .script = script(cases, name)};
}

}  // namespace albedo::plots
