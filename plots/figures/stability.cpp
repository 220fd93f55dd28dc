#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "albedo/version.hpp"
#include "analysis/files/table_document.hpp"
#include "analysis/studies/methods.hpp"
#include "analysis/studies/stability.hpp"
#include "plots/figures/figure.hpp"
#include "plots/figures/gnuplot.hpp"

namespace albedo::plots {
namespace {

using analysis::Atlas;
using analysis::AtlasOptions;
using analysis::Form;
using analysis::Surface;

/// "sobol_paper_double": the beginning of a method's columns.
std::string name_of(const analysis::AtlasMethod& method) {
  std::string name(analysis::name_of(method.rule));
  return name.append("_").append(analysis::name_of(method.warp)).append("_").append(analysis::name_of(method.form));
}

/// What a width is drawn by: the decade of a roughness, or of 1 + exponent.
double height(const Surface& surface, double value) {
  return surface.is_exponent ? std::log10(1 + value) : std::log10(value);
}

void append_field(std::string& csv, double value) { analysis::append_number(csv += ',', value); }

/// One line a cell: its place, the reference, and each method's verdict and relative error.
std::string data(const Atlas& atlas, std::string_view name) {
  const AtlasOptions& options = atlas.options;
  std::string csv = "# version: albedo " + std::string(version) + "\n# command: albedo-figures " + std::string(name);
  csv += "\n# quantity: verdict (";
  for (std::size_t i = 0; i < analysis::all_verdicts.size(); ++i) {
    csv.append(i == 0 ? "" : ", ").append(std::to_string(i)).append(" ");
    csv += analysis::name_of(analysis::all_verdicts[i]);
  }
  csv += ") and relative error of the directional albedo";
  csv += "\n# reference: rule gauss, warp lobe, precision double, tolerance 1e-12\n# tolerance: ";
  analysis::append_number(csv, options.tolerance);
  csv += "\n# tolerance of stratified, sobol, monte_carlo: ";
  analysis::append_number(csv, options.random_tolerance);
  csv += " (right up to ";
  analysis::append_number(csv, analysis::random_slack);
  csv += " times that)\n# budget: " + std::to_string(options.budget);
  csv += "\n# unit of from_grazing (90 - theta_l) and phi_l: degrees";
  csv += "\nsurface,model,parameter,anisotropy,phi_l,value,height,from_grazing,reference";
  for (const analysis::AtlasMethod& method : atlas.methods) {
    csv.append(",").append(name_of(method)).append("_verdict,").append(name_of(method)) += "_error";
  }
  csv += '\n';
  for (std::size_t s = 0; s < atlas.surfaces.size(); ++s) {
    const Surface& surface = atlas.surfaces[s];
    for (std::size_t w = 0; w < surface.values.size(); ++w) {
      for (std::size_t i = 0; i < atlas.from_grazing.size(); ++i) {
        const std::size_t cell = atlas.cell(s, w, i);
        csv.append(std::to_string(s)).append(",").append(surface.model).append(",").append(surface.parameter);
        append_field(csv, surface.anisotropy);
        append_field(csv, surface.phi_degrees);
        append_field(csv, surface.values[w]);
        append_field(csv, height(surface, surface.values[w]));
        append_field(csv, atlas.from_grazing[i]);
        append_field(csv, atlas.references[cell].value);
        for (std::size_t m = 0; m < atlas.methods.size(); ++m) {
          const analysis::Answer& answer = atlas.answer(cell, m);
          csv.append(",").append(std::to_string(static_cast<int>(answer.verdict)));
          append_field(csv, answer.relative_error);
        }
        csv += '\n';
      }
    }
  }
  return csv;
}

std::size_t without_reference(const Atlas& atlas) {
  std::size_t count = 0;
  for (const Estimate& reference : atlas.references) count += reference.status == Status::converged ? 0U : 1U;
  return count;
}

/// "Ashikhmin–Shirley", on so many lines
std::string title_of(const Surface& surface, bool on_two_lines) {
  static const std::vector<std::pair<std::string, std::string>> titles{{"ward", "Ward"},
                                                                       {"cook_torrance", "Cook–Torrance"},
                                                                       {"ggx", "GGX"},
                                                                       {"phong", "Phong"},
                                                                       {"ashikhmin_shirley", "Ashikhmin–Shirley"}};
  std::string title = surface.model;
  for (const auto& [model, name] : titles) {
    if (model == surface.model) title = name;
  }
  constexpr std::string_view dash = "–";
  const std::size_t place = title.find(dash);
  if (on_two_lines && place != std::string::npos) title.insert(place + dash.size(), "\\n");
  return title;
}

void define_list(std::string& gp, const std::string& name, const std::vector<std::string>& items) {
  gp += "array " + name + " = [";
  const char* separator = "";
  for (const std::string& item : items) gp.append(separator).append("\"").append(item).append("\""), separator = ", ";
  gp += "]\n";
}

/// Lists and lengths that both scripts draw by: surfaces and the half widths of a cell.
std::string definitions(const Atlas& atlas, bool on_two_lines) {
  std::string gp = "\n# One panel a surface and method; a cell is a box around its place in decades\n";
  std::vector<std::string> titles, letters;
  std::string halves, exponents;
  for (const Surface& surface : atlas.surfaces) {
    titles.push_back(title_of(surface, on_two_lines));
    std::string letter = surface.is_exponent ? "n" : surface.model == "cook_torrance" ? "m" : "α";
    if (surface.anisotropy != 1) letter += surface.is_exponent ? "_u" : "_x";
    letters.push_back(std::move(letter));
    const double step = std::abs(height(surface, surface.values[1]) - height(surface, surface.values[0]));
    halves.append(halves.empty() ? "" : ", ");
    analysis::append_number(halves, step / 2);
    exponents.append(exponents.empty() ? "" : ", ").append(surface.is_exponent ? "1" : "0");
  }
  define_list(gp, "surfaces", titles);
  define_list(gp, "letters", letters);
  gp += "array half_height = [" + halves + "]\narray is_exponent = [" + exponents + "]\nhalf_width = ";
  analysis::append_number(gp, std::log10(atlas.from_grazing[0] / atlas.from_grazing[1]) / 2);
  gp += R"gp(
place(s) = column('surface') == s - 1 ? log10(column('from_grazing')) : NaN
# neighbours overlap a little, so that no seam shows between them
left(s) = place(s) - 1.04 * half_width
right(s) = place(s) + 1.04 * half_width
lower(s) = column('height') - 1.04 * half_height[s]
upper(s) = column('height') + 1.04 * half_height[s]
)gp";
  return gp;
}

/// An empty panel over all others, for the legend.
constexpr std::string_view legend_style = R"gp(
set multiplot
set lmargin at screen 0.02
set rmargin at screen 0.98
set tmargin at screen 0.995
set bmargin at screen 0.943
unset border
unset tics
set xrange [0:1]
set yrange [0:1]
set key center center vertical maxrows 3 Left reverse samplen 2 width -1 spacing 1.1 * letter font ',8'
)gp";

constexpr std::string_view panel_style = R"gp(
set border 15 linewidth 0.5 linecolor rgb '#000000'
set xrange [log10(90) + half_width : -10 - half_width]
set style fill solid 1 noborder
unset key
axes_of(s) = is_exponent[s] ? "set yrange [7 + half_height[s] : -half_height[s]]; " \
    ."set ytics out nomirror scale 0.4 offset 0.8, 0 font ',7' ('0' 0, '10^2' 2, '10^4' 4, '10^6' 6)" \
  : "set yrange [-5 - half_height[s] : log10(5) + half_height[s]]; " \
    ."set ytics out nomirror scale 0.4 offset 0.8, 0 font ',7' ('10^{−5}' -5, '10^{−3}' -3, '10^{−1}' -1)"
x_tics = "set xtics out nomirror scale 0.4 offset 0, 0.5 font ',7' ('1' 0, '' -3, '10^{−6}' -6, '' -9)"
no_x_tics = "set xtics out nomirror scale 0.4 ('' 0, '' -3, '' -6, '' -9)"
no_y_tics(s) = is_exponent[s] ? "set ytics ('' 0, '' 2, '' 4, '' 6)" : "set ytics ('' -5, '' -3, '' -1)"
)gp";

/// Verdicts of every rule on every warp.
std::string verdict_script(const Atlas& atlas, std::string_view name) {
  std::string gp = script_head(name, 17, 22) + definitions(atlas, true);
  double anisotropy = 1;
  for (const Surface& surface : atlas.surfaces) anisotropy = std::max(anisotropy, surface.anisotropy);
  gp += "suffix = '";
  if (anisotropy != 1) analysis::append_number(gp += ", anisotropy ", anisotropy), gp += ":1";
  gp += "'\n";
  gp += R"gp(rules = 'gauss cubature kronrod tanh_sinh stratified sobol monte_carlo'
array rule_titles = ['gauss', 'cubature', 'kronrod', 'tanh-sinh', 'stratified', 'Sobol', 'Monte Carlo']
warps = 'lobe hemisphere paper'
array warp_titles = ['on the lobe''s exact domain (warp lobe)', 'on polar angle and azimuth of V (warp hemisphere)', 'on the sampling published with the model (warp paper)']

# Light is right, dark is wrong; stripes lean towards the side on which an answer lies
set linetype 11 linecolor rgb '#E6EDF2'
set linetype 12 linecolor rgb '#9CC4E0'
set linetype 13 linecolor rgb '#3A5F7D'
set linetype 14 linecolor rgb '#C8320A'
set linetype 15 linecolor rgb '#000000'

)gp";
  gp += legend_style;
  gp +=
      R"gp(plot NaN with boxes linewidth 0.5 dashtype solid fillstyle solid 1 border linecolor rgb '#000000' fillcolor linetype 11 title 'right, and claims so', \
     NaN with boxes linewidth 0.5 dashtype solid fillstyle solid 1 border linecolor rgb '#000000' fillcolor linetype 12 title 'right, not claimed', \
     NaN with boxes linewidth 0.5 dashtype solid fillstyle pattern 4 border linecolor rgb '#000000' fillcolor linetype 13 title 'too low, not claimed', \
     NaN with boxes linewidth 0.5 dashtype solid fillstyle pattern 5 border linecolor rgb '#000000' fillcolor linetype 13 title 'too high, not claimed', \
     NaN with boxes linewidth 0.5 dashtype solid fillstyle solid 1 border linecolor rgb '#000000' fillcolor linetype 14 title 'wrong, and claims to be right', \
     NaN with boxes linewidth 0.5 dashtype solid fillstyle solid 1 border linecolor rgb '#000000' fillcolor linetype 15 title 'NaN or infinity'
)gp";
  gp += panel_style;
  gp += R"gp(
rows = |surfaces|
columns = words(rules)
panel_width = 0.905 / columns
panel_height = 0.257 / rows
do for [w = 1:words(warps)] {
  do for [s = 1:rows] {
    do for [r = 1:columns] {
      set lmargin at screen 0.085 + (r - 1) * panel_width
      set rmargin at screen 0.085 + (r - 0.06) * panel_width
      top = 0.905 - (w - 1) * 0.3 - (s - 1) * panel_height
      set tmargin at screen top
      set bmargin at screen top - 0.9 * panel_height
      eval axes_of(s)
      eval (s == rows ? x_tics : no_x_tics)
      unset xlabel
      if (r == 1) {
        set label 2 surfaces[s].', {/:Italic '.letters[s].'}' at screen 0.017, screen top - 0.45 * panel_height rotate center font ',8'
      } else { unset label 2; eval no_y_tics(s) }
      unset label 1
      unset label 3
      if (s == 1) { set label 1 rule_titles[r] at graph 0.5, graph 1.12 center font ',8' }
      if (s == 1 && r == 1) { set label 3 warp_titles[w].suffix at screen 0.085, screen top + 0.0245 font ',8.5' }
      if (s == rows && r == 4 && w == words(warps)) { set xlabel 'degrees from grazing incidence, 90° − {/:Italic θ}_{/:Italic L}' offset 0, 0.8 font ',8' }
      verdict = word(rules, r).'_'.word(warps, w).'_double_verdict'
      error = word(rules, r).'_'.word(warps, w).'_double_error'
      is(k) = column(verdict) == k
      plot data using (is(0) ? place(s) : NaN):'height':(left(s)):(right(s)):(lower(s)):(upper(s)) with boxxyerror linetype 11, \
           data using (is(1) ? place(s) : NaN):'height':(left(s)):(right(s)):(lower(s)):(upper(s)) with boxxyerror linetype 12, \
           data using (is(2) && column(error) < 0 ? place(s) : NaN):'height':(left(s)):(right(s)):(lower(s)):(upper(s)) with boxxyerror fillstyle pattern 4 linetype 13, \
           data using (is(2) && column(error) >= 0 ? place(s) : NaN):'height':(left(s)):(right(s)):(lower(s)):(upper(s)) with boxxyerror fillstyle pattern 5 linetype 13, \
           data using (is(3) ? place(s) : NaN):'height':(left(s)):(right(s)):(lower(s)):(upper(s)) with boxxyerror linetype 14, \
           data using (is(4) ? place(s) : NaN):'height':(left(s)):(right(s)):(lower(s)):(upper(s)) with boxxyerror linetype 15
    }
  }
}
unset multiplot
unset output
)gp";
  return gp;
}

/// Errors of the formula in float, in both forms.
std::string error_script(const Atlas& atlas, std::string_view name) {
  std::string gp = script_head(name, 17, 21) + definitions(atlas, false);
  gp += R"gp(forms = 'double float textbook_float'
array form_titles = ['double', 'float, from invariants', 'float, textbook form']

# Bins of the relative error, from light to dark
array bin_colors = ['#F7FCF0', '#CCEBC5', '#A8DDB5', '#7BCCC4', '#4EB3D3', '#2B8CBE', '#08589E', '#04223F']
array bin_titles = ['relative error below 10^{−6}', '10^{−6} … 10^{−5}', '10^{−5} … 10^{−4}', '10^{−4} … 10^{−3}', '0.1 % … 1 %', '1 % … 10 %', '10 % … 100 %', 'above 100 %']
bin(e) = e != e ? NaN : (e == 0 ? 1 : (b = int(floor(log10(abs(e)))) + 8, b < 1 ? 1 : (b > 8 ? 8 : b)))

)gp";
  gp += legend_style;
  gp +=
      R"gp(plot for [b = 1:8] NaN with boxes linewidth 0.5 dashtype solid fillstyle solid 1 border linecolor rgb '#000000' fillcolor rgb bin_colors[b] title bin_titles[b], \
     NaN with boxes linewidth 0.5 dashtype solid fillstyle pattern 2 border linecolor rgb '#000000' fillcolor rgb '#C8320A' title 'NaN or infinity'
)gp";
  gp += panel_style;
  gp += R"gp(
rows = |surfaces|
columns = words(forms)
panel_width = 0.9 / columns
panel_height = 0.85 / rows
do for [s = 1:rows] {
  do for [f = 1:columns] {
    set lmargin at screen 0.09 + (f - 1) * panel_width
    set rmargin at screen 0.09 + (f - 0.06) * panel_width
    top = 0.9 - (s - 1) * panel_height
    set tmargin at screen top
    set bmargin at screen top - 0.92 * panel_height
    eval axes_of(s)
    eval (s == rows ? x_tics : no_x_tics)
    unset xlabel
    if (f == 1) {
      set label 2 surfaces[s].', {/:Italic '.letters[s].'}' at screen 0.025, screen top - 0.46 * panel_height rotate center font ',8'
    } else { unset label 2; eval no_y_tics(s) }
    unset label 1
    if (s == 1) { set label 1 form_titles[f] at graph 0.5, graph 1.06 center font ',8' }
    if (s == rows && f == 2) { set xlabel 'degrees from grazing incidence, 90° − {/:Italic θ}_{/:Italic L}' offset 0, 0.8 font ',8' }
    verdict = 'gauss_lobe_'.word(forms, f).'_verdict'
    error = 'gauss_lobe_'.word(forms, f).'_error'
    finite(k) = column(verdict) != 4 && column(verdict) != 5 && bin(column(error)) == k
    plot for [k = 1:8] data using (finite(k) ? place(s) : NaN):'height':(left(s)):(right(s)):(lower(s)):(upper(s)) with boxxyerror linecolor rgb bin_colors[k], \
         data using (column(verdict) == 4 ? place(s) : NaN):'height':(left(s)):(right(s)):(lower(s)):(upper(s)) with boxxyerror fillstyle pattern 2 linecolor rgb '#C8320A'
  }
}
unset multiplot
unset output
)gp";
  return gp;
}

}  // namespace

Drawing stability(std::string_view name) {
  AtlasOptions options{.forms = {Form::float64}, .incidences = 16, .widths = 14, .budget = 50'000};
  if (name == "stability-anisotropic") {
    options.models = {"ward", "ggx", "ashikhmin_shirley"};
    options.isotropic = false;
  } else {
    options.models = {"ward", "ggx", "phong"};
    options.anisotropy = 1;
  }
  const Atlas atlas = analysis::compute_atlas(options);
  return {.data = data(atlas, name), .script = verdict_script(atlas, name), .unconverged = without_reference(atlas)};
}

Drawing stability_float(std::string_view name) {
  const Atlas atlas = analysis::compute_atlas({.rules = {Rule::gauss},
                                               .warps = {Warp::lobe},
                                               .anisotropy = 1,
                                               .incidences = 25,
                                               .widths = 20,
                                               .tolerance = 1e-6,
                                               .budget = 20'000});
  return {.data = data(atlas, name), .script = error_script(atlas, name), .unconverged = without_reference(atlas)};
}

}  // namespace albedo::plots
