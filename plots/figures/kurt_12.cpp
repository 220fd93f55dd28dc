#include "analysis/text/progress.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/pictures.hpp"
#include "plots/render/scenes.hpp"

namespace albedo::plots {

Drawing kurt_12(std::string_view name) {
  constexpr std::size_t size = 320;
  const render::View view = render::sphere_on_plane(
      render::lobes_of(make_model("kurt", {{"m", 0.001}, {"f0", 0.5}, {"exponent", 0.25}, {"equation", "13"}}),
                       render::constant(render::rgb(1, 1, 1))));
  constexpr double exposure = 0.8;
  analysis::ProgressBar progress;
  const render::Rendering rendering =
      render::render(view.scene, view.camera, {.width = size, .height = size, .samples = 324},
                     [&](std::size_t done, std::size_t total) { progress.update(done, total); });
  const std::vector<Panel> panels{{"sphere", rendering}};
  const render::Picture picture = picture_of(rendering, render::first_three);
  nlohmann::ordered_json provenance = provenance_of(name);
  provenance["source"] = "Kurt, Szirmay-Kalos & Krivanek 2010, fig. 12 (a)";
  provenance["model"] = "kurt equation=13 m=0.001 f0=0.5 exponent=0.25 k_s=1 k_d=0";
  provenance["noise"] = noise_text(panels);
  std::string script =
      script_head(name, 8.6, 9.5) + "\nset multiplot\nunset key\n" +
      label_at(4.3, 1.1, "{/:Italic m} = 0.001, {/:Italic f}_0 = 0.5, {/:Italic α} = 0.25, {/:Italic k_s} = 1") +
      label_at(4.3, 0.5, noise_text(panels, true), "center font ',7.5'") +
      placed_picture(name, "scene", picture, {0.3, 1.4, 8, 8}) + "unset multiplot\nunset output\n";
  return {.data = panels_csv(provenance, panels),
          .script = std::move(script),
          .attachments = files_of("scene", picture, exposure, provenance)};
}

}  // namespace albedo::plots
