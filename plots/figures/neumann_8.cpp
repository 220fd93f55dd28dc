#include "albedo/combinators/pumped.hpp"
#include "analysis/text/progress.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/pictures.hpp"
#include "plots/render/colour.hpp"
#include "plots/render/scenes.hpp"

namespace albedo::plots {

Drawing neumann_8(std::string_view name) {
  constexpr std::size_t width = 336, height = 192;
  constexpr double exposure = 0.6;
  analysis::ProgressBar progress;
  std::vector<render::Rendering> renderings;
  for (const bool is_pumped : {false, true}) {
    for (const double n : {20.0, 5000.0}) {
      std::unique_ptr<Model> model = make_model("phong", {{"n", n}});
      if (is_pumped) model = std::make_unique<PumpedModel>(std::move(model));
      const render::View view = render::metal_tank(std::move(model));
      const std::size_t before = renderings.size() * height;
      renderings.push_back(
          render::render(view.scene, view.camera,
                         {.width = width,
                          .height = height,
                          .samples = 256,
                          .seed = renderings.size() + 1,
                          .luminance = render::luminance_of_bands()},
                         [&](std::size_t done, std::size_t) { progress.update(before + done, 4 * height); }));
    }
  }
  const std::vector<Panel> panels{{"phong n=20", renderings[0]},
                                  {"phong n=5000", renderings[1]},
                                  {"pumped once n=20", renderings[2]},
                                  {"pumped once n=5000", renderings[3]}};
  std::vector<render::Picture> pictures;
  for (const render::Rendering& rendering : renderings) {
    pictures.push_back(picture_of(rendering, render::colour_of_bands));
  }
  const render::Picture picture = mosaic(pictures, 2, 6, 1 / exposure);
  nlohmann::ordered_json provenance = provenance_of(name);
  provenance["source"] = "Neumann, Neumann & Szirmay-Kalos 1999, fig. 8; the scene is ours";
  provenance["model"] = "phong times the Fresnel factor of L.H; below pumped once";
  provenance["metals"] = "McPeak et al. 2015 (refractiveindex.info, CC0)";
  provenance["wavelengths [nm]"] = std::vector<double>(render::wavelengths.begin(), render::wavelengths.end());
  provenance["noise"] = noise_text(panels);
  const double picture_height = 16.2 / static_cast<double>(picture.width) * static_cast<double>(picture.height);
  const double top = 0.55 + picture_height;
  std::string script =
      script_head(name, 17.2, top + 0.55) + "\nset multiplot\nunset key\n" +
      label_at(0.8 + 4, top + 0.25, "{/:Italic n} = 20") + label_at(0.8 + 12.2, top + 0.25, "{/:Italic n} = 5000") +
      label_at(0.4, 0.55 + 0.75 * picture_height, "reciprocal Phong", "center rotate by 90") +
      label_at(0.4, 0.55 + 0.25 * picture_height, "pumped once", "center rotate by 90") +
      label_at(8.9, 0.25, noise_text(panels) + "; the sky's is 1", "center font ',7.5'") +
      placed_picture(name, "scene", picture, {0.8, 0.55, 16.2, picture_height}) + "unset multiplot\nunset output\n";
  return {.data = panels_csv(provenance, panels),
          .script = std::move(script),
          .attachments = files_of("scene", picture, exposure, provenance)};
}

}  // namespace albedo::plots
