#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "plots/data/lobe_fit.hpp"
#include "plots/figures/figure.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/sheet.hpp"

namespace albedo::plots {
namespace {

using analysis::LobeFit;

constexpr std::array incidences{0.0, 30.0, 60.0};
/// The panels' scales: how far they reach to the left, to the right and upwards.
struct Reach {
  double left, right, top;
};
constexpr std::array reaches{Reach{0.45, 0.45, 0.45}, Reach{0.45, 0.45, 0.45}, Reach{0.7, 1.0, 0.854}};

/// A fit of "dark-specular-fabric" (MERL), green channel.
struct Fit {
  const char *column, *title, *style, *model, *source;
  Parameters parameters;
  std::unique_ptr<Model> lobe;
};

Fit published(const char* column, const char* title, const char* style, const char* model, Parameters parameters) {
  auto lobe = make_model(model, parameters);
  return {column, title, style, model, "Low et al. 2012, metric E1", std::move(parameters), std::move(lobe)};
}

Fit fitted(const char* column, const char* title, const char* style, const char* model, const LobeFit& fit) {
  return {
      column, title, style, model, "fitted here to cook_torrance", fit.parameters, make_model(model, fit.parameters)};
}

/// Where Löw et al. give no fit, a model is fitted to the Cook–Torrance one, which stands for the measured values.
std::vector<Fit> all_fits() {
  std::vector<Fit> fits;
  // analysis/data/low_*_e1.json
  fits.push_back(published("ashikhmin_shirley", "Ashikhmin–Shirley", "lines linetype 1", "ashikhmin_shirley",
                           {{"n", 33.235335}, {"r_s", 0.016006170630736356}, {"k_s", 0.37116}, {"k_d", 0.0116}}));
  fits.push_back(published("cook_torrance", "Cook–Torrance", "lines linetype 7", "cook_torrance",
                           {{"m", 0.216092},
                            {"fresnel", "conductor"},
                            {"eta", 1.31159},
                            {"k", 0.0},
                            {"masking", "v_cavity"},
                            {"k_s", 0.24608},
                            {"k_d", 0.0122}}));
  const Model& target = *fits.back().lobe;
  fits.push_back(
      fitted("ward", "Ward", "lines linetype 2", "ward",
             analysis::fit_lobe(target, "ward", {}, {{"alpha", 0.02, 1, {0.1, 0.2, 0.4}}}, {"rho_s", "rho_d"})));
  fits.push_back(
      fitted("kurt", "Kurt, eq. 11", "lines linetype 3", "kurt",
             analysis::fit_lobe(target, "kurt", {{"equation", "11"}},
                                {{"m", 0.02, 1, {0.15, 0.3}}, {"f0", 0, 1, {0.02, 0.3}}, {"exponent", 0, 1, {0, 0.3}}},
                                {"k_s", "k_d"})));
  return fits;
}

std::string column(const Fit& fit, double incidence) { return std::string(fit.column) + "_" + short_text(incidence); }

std::string data(const std::vector<Fit>& fits, std::string_view name) {
  Sheet sheet(name, "Kurt, Szirmay-Kalos, Krivanek 2010, fig. 7, without the measured values");
  sheet.note(
      "quantity",
      "MODEL_A: f [1/sr] towards theta_v in the plane of incidence, of light from A degrees; positive angles are "
      "on the side of the mirror direction");
  sheet.note("material", "dark-specular-fabric (MERL), green channel");
  for (const Fit& fit : fits) {
    std::string text = fit.model;
    for (const auto& [parameter, value] : fit.parameters) {
      const auto* const word = std::get_if<std::string>(&value);
      text.append(" ").append(parameter).append("=").append(word != nullptr ? *word
                                                                            : number_text(std::get<double>(value)));
    }
    sheet.note("model " + std::string(fit.column), text + " (" + fit.source + ")");
  }
  sheet.note("unit of theta_v", "degrees");
  std::vector<std::string> columns{"theta_v"};
  for (const double incidence : incidences) {
    for (const Fit& fit : fits) columns.push_back(column(fit, incidence));
  }
  sheet.columns(columns);
  for (int i = -179; i <= 179; ++i) {
    const double view = 0.5 * i;
    const Direction v = Direction::from_degrees(std::abs(view), view < 0 ? 0 : 180);
    std::vector<double> row{view};
    for (const double incidence : incidences) {
      for (const Fit& fit : fits) row.push_back(brdf<double>(*fit.lobe, Direction::from_degrees(incidence), v));
    }
    sheet.row(row);
  }
  return sheet.text();
}

std::string script(const std::vector<Fit>& fits, std::string_view name) {
  std::string gp = script_head(name, 17, 5);
  gp += R"(
# The radius is the cube root of f, whose values stand along the horizon [1/sr]; L is on the left, its mirror direction on the right.
across(f) = column(f)**(1/3.) * sin(column('theta_v') * pi/180)
upward(f) = column(f)**(1/3.) * cos(column('theta_v') * pi/180)

set multiplot
)";
  std::vector<LegendEntry> entries;
  for (const Fit& fit : fits) entries.push_back({fit.style, fit.title});
  gp += legend(4.2, 0.7, 1, entries);
  gp += R"(
unset border
unset tics
set parametric
set trange [0:pi]
)";
  for (std::size_t i = 0; i < incidences.size(); ++i) {
    const double angle = incidences[i] * pi<double> / 180;
    const Reach& reach = reaches[i];
    std::string circles;
    std::ostringstream lines;
    lines << "\n"
          << panel(0.4 + 5.5 * static_cast<double>(i), 0.5, 5.2, 2.8) << "set xrange [" << -reach.left << ":"
          << reach.right << "]\nset yrange [" << -reach.top / 14 << ":" << reach.top << "]\n"
          << "set arrow 1 from " << -reach.left << ", 0 to " << reach.right
          << ", 0 nohead linecolor rgb '#808080' linewidth 0.5 back\n"
          << "set arrow 2 from 0, 0 to 0, " << reach.top << " nohead linecolor rgb '#C0C0C0' linewidth 0.5 back\n"
          << "set label 1 '(" << static_cast<char>('a' + i) << ") {/:Italic θ}_{/:Italic L} = " << incidences[i]
          << "°' at graph 0.02, graph 1.07\n"
          << "set arrow 3 from " << -0.95 * reach.top * std::sin(angle) << ", " << 0.95 * reach.top * std::cos(angle)
          << " to " << -0.7 * reach.top * std::sin(angle) << ", " << 0.7 * reach.top * std::cos(angle)
          << " linecolor rgb '#000000' linewidth 1.2 front\n"
          << "set label 2 '{/:Italic L}' at " << -1.05 * reach.top * std::sin(angle) << ", "
          << 1.05 * reach.top * std::cos(angle) << " center\n";
    int circle = 4;
    for (const double f : {0.01, 0.1, 0.7}) {
      const double radius = std::cbrt(f);
      if (radius > reach.right) continue;
      lines << "set label " << circle++ << " '" << f << "' at " << radius << ", 0 center offset 0, -0.7 font ',6.5'"
            << " textcolor rgb '#606060'\n";
      circles += short_text(radius) + "*cos(t), " + short_text(radius) +
                 "*sin(t) with lines linecolor rgb '#C0C0C0' linewidth 0.5 dashtype solid, \\\n     ";
    }
    lines << "plot " << circles;
    gp += lines.str();
    for (std::size_t k = 0; k < fits.size(); ++k) {
      const std::string f = "'" + column(fits[k], incidences[i]) + "'";
      gp += "data using (across(" + f + ")):(upward(" + f + ")) with " + fits[k].style +
            (k + 1 < fits.size() ? ", \\\n     " : "\n");
    }
  }
  return gp + "unset multiplot\nunset output\n";
}

}  // namespace

Drawing kurt_7(std::string_view name) {
  const std::vector<Fit> fits = all_fits();
  return {.data = data(fits, name), .script = script(fits, name)};
}

}  // namespace albedo::plots
