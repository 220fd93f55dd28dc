#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "albedo/core/errors.hpp"
#include "plots/data/measured_albedos.hpp"
#include "plots/figures/figure.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/sheet.hpp"

namespace albedo::plots {
namespace {

using analysis::MeasuredAlbedos;

constexpr const char* variable = "ALBEDO_MEASURED_DIR";
constexpr double tolerance = 3e-3;

std::vector<std::string> files() {
  const char* const directory = std::getenv(variable);
  return directory == nullptr ? std::vector<std::string>{} : analysis::measured_files(directory);
}

/// Relative luminance of linear RGB with the primaries of ITU-R BT.709.
double luminance(const std::array<Estimate, 3>& rgb) {
  return 0.2126 * rgb[0].value + 0.7152 * rgb[1].value + 0.0722 * rgb[2].value;
}

std::string column(std::size_t material) { return "material" + std::to_string(material + 1); }

std::string data(const MeasuredAlbedos& albedos, std::string_view name) {
  Sheet sheet(name, "Kurt, Szirmay-Kalos, Krivanek 2010, fig. 1, with other materials");
  sheet.note("quantity",
             "directional albedo: its luminance (ITU-R BT.709), that of R, G and B, and the absolute errors of these");
  for (std::size_t i = 0; i < albedos.names.size(); ++i) sheet.note(column(i), albedos.names[i]);
  sheet.note("rule", "cubature");
  sheet.note("warp", "lobe");
  sheet.note("tolerance", albedos.options.tolerance);
  sheet.note("largest relative error", albedos.worst_relative_error());
  sheet.note("not converged", albedos.unconverged());
  sheet.note("unit of theta_l", "degrees");
  std::vector<std::string> columns{"theta_l"};
  for (std::size_t i = 0; i < albedos.names.size(); ++i) {
    columns.push_back(column(i));
    for (const char* const channel : {"_r", "_g", "_b"}) {
      columns.push_back(column(i) + channel);
      columns.push_back(column(i) + channel + "_error");
    }
  }
  sheet.columns(columns);
  for (std::size_t t = 0; t < albedos.thetas.size(); ++t) {
    std::vector<double> row{albedos.thetas[t]};
    for (const auto& material : albedos.estimates) {
      row.push_back(luminance(material[t]));
      for (const Estimate& channel : material[t]) {
        row.push_back(channel.value);
        row.push_back(channel.error);
      }
    }
    sheet.row(row);
  }
  return sheet.text();
}

/// A file's name as gnuplot's enhanced text shows it unchanged, within single quotes.
std::string plain(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c == '\'') text += '\'';
    if (std::string_view("_^{}@&~\\").find(c) != std::string_view::npos) text += '\\';
    text += c;
  }
  return text;
}

std::string script(const MeasuredAlbedos& albedos, std::string_view name) {
  double top = 0;
  for (const auto& material : albedos.estimates) {
    for (const auto& rgb : material) top = std::max(top, luminance(rgb));
  }
  std::vector<std::string> titles;
  std::size_t longest = 0;
  for (const std::string& material : albedos.names) {
    titles.push_back(material.ends_with("_rgb") ? material.substr(0, material.size() - 4) : material);
    longest = std::max(longest, titles.back().size());
  }
  const std::size_t count = albedos.names.size(), rows = longest <= 14 ? (count + 1) / 2 : count;
  const double strip = 0.2 + 0.38 * static_cast<double>(rows);
  std::string gp = script_head(name, 8.5, 6.9 + strip) + "\nset multiplot\n";
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < count; ++i) {
    entries.push_back({"lines linetype " + std::to_string(i % 7 + 1), plain(titles[i])});
  }
  gp += legend(6.8, strip, static_cast<int>(rows), entries) + panel(1.3, 1.2, 6.9, 5.3);
  gp += albedo_axes(std::max(1.1, std::ceil(11 * top) / 10));
  gp += "plot ";
  for (std::size_t i = 0; i < count; ++i) {
    gp += "data using 'theta_l':'" + column(i) + "' with " + entries[i].style + (i + 1 < count ? ", \\\n     " : "\n");
  }
  return gp + "unset multiplot\nunset output\n";
}

}  // namespace

std::string kurt_1_lacks() {
  if (!files().empty()) return "";
  return std::string("measured materials: set ") + variable + " to a directory with RGL .bsdf or MERL .binary files";
}

Drawing kurt_1(std::string_view name) {
  if (const std::string lacking = kurt_1_lacks(); !lacking.empty()) {
    throw ParameterError(std::string(name) + " needs " + lacking);
  }
  std::vector<double> thetas;
  for (double theta = 0; theta < 88; theta += theta < 60 ? 5 : 2.5) thetas.push_back(theta);
  const MeasuredAlbedos albedos =
      analysis::measured_albedos(files(), std::move(thetas), {.rule = Rule::cubature, .tolerance = tolerance});
  return {.data = data(albedos, name), .script = script(albedos, name), .unconverged = albedos.unconverged()};
}

}  // namespace albedo::plots
