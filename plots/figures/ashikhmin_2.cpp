#include <algorithm>

#include "analysis/files/table_document.hpp"
#include "analysis/text/progress.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/pictures.hpp"
#include "plots/render/furnace.hpp"

namespace albedo::plots {
namespace {

constexpr std::size_t size = 96;
constexpr double tolerance = 1e-5;
constexpr double exposure = 0.8;  // tells the furnace from the page

std::unique_ptr<Model> material(double n_u, double n_v) {
  return make_model("ashikhmin_shirley", {{"n_u", n_u}, {"n_v", n_v}});
}

/// a(θ) along u for every pair; along v it is that of the exchanged pair.
std::string curves_csv(std::size_t& unconverged) {
  std::string csv = "theta";
  for (const double n_u : exponents) {
    for (const double n_v : exponents) csv += ",a_" + exponent_text(n_u) + "_" + exponent_text(n_v);
  }
  csv += '\n';
  for (int half_degrees = 0; half_degrees <= 180; half_degrees += 2) {
    const double theta = std::min(half_degrees / 2.0, 89.9);
    analysis::append_number(csv, theta);
    for (const double n_u : exponents) {
      for (const double n_v : exponents) {
        const Estimate a =
            directional_albedo(*material(n_u, n_v), Direction::from_degrees(theta), {.tolerance = tolerance});
        if (a.status != Status::converged) ++unconverged;
        analysis::append_number(csv += ',', a.value);
      }
    }
    csv += '\n';
  }
  return csv;
}

}  // namespace

Drawing ashikhmin_2(std::string_view name) {
  analysis::ProgressBar progress;
  nlohmann::ordered_json provenance = provenance_of(name);
  provenance["source"] = "Ashikhmin & Shirley 2000, fig. 2";
  provenance["model"] = "ashikhmin_shirley r_s=1 r_d=0";
  provenance["pixels"] = "the albedo of the direction to the eye, integrated for each: no path tracing, no noise";
  std::vector<render::Picture> pictures;
  std::size_t unconverged = 0;
  double worst = 0;
  for (const double n_v : exponents) {
    for (const double n_u : exponents) {
      const auto model = material(n_u, n_v);
      render::AlbedoSphere sphere = render::albedo_sphere(*model, size, tolerance);
      unconverged += sphere.unconverged;
      worst = std::max(worst, sphere.worst_error);
      const Estimate centre = directional_albedo(*model, Direction{}, {.tolerance = tolerance});
      provenance["sphere n_u=" + exponent_text(n_u) + " n_v=" + exponent_text(n_v)] = {
          {"centre", centre.value}, {"darkest", sphere.darkest}, {"brightest", sphere.brightest}};
      pictures.push_back(std::move(sphere.picture));
      progress.update(pictures.size(), 16);
    }
  }
  provenance["tolerance"] = tolerance;
  provenance["largest error of a pixel"] = worst;
  const render::Picture picture = mosaic(pictures, 4, 4, 1 / exposure);

  const Place place{0.75, 0.9, 8.1, 8.1};
  std::string script =
      script_head(name, 17.8, 9.6) + R"(
set multiplot
unset key
)" + exponent_labels(place) +
      label_at(4.8, 0.4, "(a) spheres in a furnace of radiance 1") +
      label_at(14, 0.35, "(b) as curves; along {/:Italic v}, exchange {/:Italic n_u} and {/:Italic n_v}") +
      placed_picture(name, "spheres", picture, place) + "unset label\n" + std::string(axes_style) + R"(
# (b) Curves
set grid ytics linetype -1 linecolor rgb '#DDDDDD' linewidth 0.4
)";
  for (std::size_t panel = 0; panel < exponents.size(); ++panel) {
    const double left = 10.4 + 3.8 * static_cast<double>(panel % 2), bottom = panel < 2 ? 5.6 : 1.7;
    const std::string n_u = exponent_text(exponents[panel]);
    script += bare_panel({left, bottom, 3.3, 3.1}) + std::string(axes_style) + R"(set xrange [0:90]
set yrange [0:1.05]
set xtics 30
set mxtics 3
set ytics 0.5
set mytics 5
)" +
              (panel % 2 == 0 ? "set format y '%.1f'\nset ylabel 'albedo {/:Italic a}' offset 1.8 - letter, 0\n"
                              : "set format y ''\n") +
              (panel >= 2 ? "set xlabel '{/:Italic θ} along {/:Italic u} [degrees]' offset 0, 1.5 - letter\n"
                          : "set format x ''\n") +
              "set label 1 '{/:Italic n}_{/:Italic u} = " + n_u + "' at graph 0.5, graph 1.07 center\n" +
              (panel == 1 ? "set key at graph 0.04, graph 0.02 left bottom Left reverse samplen 2.5 spacing 1\n"
                          : "unset key\n") +
              "plot ";
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      script += std::string(i == 0 ? "" : ", \\\n     ") + "data using 'theta':'a_" + n_u + "_" +
                exponent_text(exponents[i]) + "' with lines linetype " + std::to_string(i + 1) +
                " title '{/:Italic n}_{/:Italic v} = " + exponent_text(exponents[i]) + "'";
    }
    script += "\n";
  }
  script += "unset multiplot\nunset output\n";
  std::string data = curves_csv(unconverged);
  return {.data = comment_lines(provenance) + data,
          .script = std::move(script),
          .unconverged = unconverged,
          .attachments = files_of("spheres", picture, exposure, provenance)};
}

}  // namespace albedo::plots
