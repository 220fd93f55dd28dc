#include <algorithm>

#include "analysis/files/table_document.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/pictures.hpp"
#include "plots/render/furnace.hpp"

namespace albedo::plots {
namespace {

constexpr double exponent = 10000, tolerance = 1e-8;

std::unique_ptr<Model> material(double k_s, double r_d) {
  return make_model("ashikhmin_shirley", {{"n", exponent}, {"r_s", 0.05}, {"k_s", k_s}, {"r_d", r_d}});
}

}  // namespace

Drawing ashikhmin_4(std::string_view name) {
  constexpr std::size_t size = 400;
  const auto both = material(1, 1), specular = material(1, 0), diffuse = material(0, 1);
  const render::AlbedoSphere sphere = render::albedo_sphere(*both, size, tolerance);
  std::size_t unconverged = sphere.unconverged;
  nlohmann::ordered_json provenance = provenance_of(name);
  provenance["source"] = "Ashikhmin & Shirley 2000, fig. 4";
  provenance["model"] = "ashikhmin_shirley n=10000 r_s=0.05 r_d=1";
  provenance["pixels"] = "the albedo of the direction to the eye, from its curve: no path tracing, no noise";
  provenance["largest error of a pixel"] = sphere.worst_error;
  provenance["darkest"] = sphere.darkest;
  provenance["brightest"] = sphere.brightest;
  provenance["bound"] = "r of section 3: R_s + (1 - R_s)(1 - cos/2)^5";
  std::string data = comment_lines(provenance) + "r,theta,total,specular,diffuse,bound\n";
  for (int i = 0; i <= 360; ++i) {
    const Direction l = Direction::from_degrees(std::min(i / 4.0, 89.95));
    analysis::append_number(data, l.sin_theta);
    analysis::append_number(data += ',', l.theta_degrees());
    for (const Model* model : {both.get(), specular.get(), diffuse.get()}) {
      const Estimate a = directional_albedo(*model, l, {.tolerance = tolerance});
      if (a.status != Status::converged) ++unconverged;
      analysis::append_number(data += ',', a.value);
    }
    analysis::append_number(data += ',', 0.05 + 0.95 * std::pow(1 - l.cos_theta / 2, 5));
    data += '\n';
  }

  // the right half of the picture, over the axis of r = sinθ
  const double scale = static_cast<double>(size) / 2 / 1.04, middle = static_cast<double>(size) / 2 - 0.5;
  std::string script = script_head(name, 8.6, 6.6) + "\nset multiplot\nunset key\n" + bare_panel({0.2, 0.6, 2.9, 5.8}) +
                       "set xrange [" + std::to_string(middle) + ":" + std::to_string(middle + scale * 1.03) +
                       "]\nset yrange [" + std::to_string(middle - scale * 1.03) + ":" +
                       std::to_string(middle + scale * 1.03) + "]\nplot '" + std::string(name) +
                       "-sphere.png' binary filetype=png with rgbimage\n" + bare_panel({4.4, 1.15, 4, 3.6}) +
                       std::string(axes_style) + R"(
set xrange [0:1]
set yrange [0:1.02]
set xtics ('0°' 0, '30°' 0.5, '60°' sqrt(0.75), '' 1)
set ytics 0.2
set format y '%.1f'
set xlabel 'angle of view {/:Italic θ}, at sin {/:Italic θ}' offset 0, 1.5 - letter
set ylabel 'albedo {/:Italic a}' offset 1.2, 0
set key at screen 4.4/width, screen 6.5/height left top vertical Left reverse samplen 2.5 spacing 1.05
plot data using 'r':'total' with lines linetype 1 title 'both terms', \
     data using 'r':'diffuse' with lines linetype 2 title 'diffuse (eq. 14)', \
     data using 'r':'specular' with lines linetype 3 title 'specular {/:Italic R}', \
     data using 'r':'bound' with lines linetype 4 title 'bound {/:Italic r} of {/:Italic R}'
unset multiplot
unset output
)";
  return {.data = std::move(data),
          .script = std::move(script),
          .unconverged = unconverged,
          .attachments = files_of("sphere", sphere.picture, 0.8, provenance)};
}

}  // namespace albedo::plots
