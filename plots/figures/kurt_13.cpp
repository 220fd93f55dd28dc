#include "analysis/text/progress.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/pictures.hpp"
#include "plots/render/scenes.hpp"

namespace albedo::plots {

Drawing kurt_13(std::string_view name) {
  constexpr std::size_t size = 240;
  constexpr double exposure = 0.8;
  analysis::ProgressBar progress;
  std::vector<render::Rendering> renderings;
  for (const double m_x : {0.05, 0.1}) {
    const render::View view = render::sphere_on_plane(render::lobes_of(make_model("kurt", {{"m_x", m_x},
                                                                                           {"m_y", 0.15 - m_x},
                                                                                           {"f0", 0.75},
                                                                                           {"exponent", 0.2},
                                                                                           {"equation", "13"},
                                                                                           {"k_s", 0.85},
                                                                                           {"k_d", 0.15}}),
                                                                       render::constant(render::rgb(1, 1, 1))));
    const std::size_t before = renderings.size() * size;
    renderings.push_back(render::render(
        view.scene, view.camera, {.width = size, .height = size, .samples = 484, .seed = renderings.size() + 1},
        [&](std::size_t done, std::size_t) { progress.update(before + done, 2 * size); }));
  }
  const std::vector<Panel> panels{{"m_x=0.05 m_y=0.1", renderings[0]}, {"m_x=0.1 m_y=0.05", renderings[1]}};
  const render::Picture picture =
      render::mosaic({picture_of(renderings[0], render::first_three), picture_of(renderings[1], render::first_three)},
                     2, 6, 1 / exposure);
  nlohmann::ordered_json provenance = provenance_of(name);
  provenance["source"] = "Kurt, Szirmay-Kalos & Krivanek 2010, fig. 13";
  provenance["model"] = "kurt equation=13 f0=0.75 exponent=0.2 k_s=0.85 k_d=0.15";
  provenance["noise"] = noise_text(panels);
  const double height = 16.4 / static_cast<double>(picture.width) * static_cast<double>(picture.height);
  std::string script = script_head(name, 17, height + 1.1) + "\nset multiplot\nunset key\n" +
                       label_at(4.4, 0.6, "(a) {/:Italic m_x} = 0.05, {/:Italic m_y} = 0.1") +
                       label_at(12.6, 0.6, "(b) {/:Italic m_x} = 0.1, {/:Italic m_y} = 0.05") +
                       label_at(8.5, 0.2, noise_text(panels), "center font ',7.5'") +
                       placed_picture(name, "scene", picture, {0.3, 0.85, 16.4, height}) +
                       "unset multiplot\nunset output\n";
  return {.data = panels_csv(provenance, panels),
          .script = std::move(script),
          .attachments = files_of("scene", picture, exposure, provenance)};
}

}  // namespace albedo::plots
