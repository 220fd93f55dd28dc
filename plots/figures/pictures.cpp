#include "plots/figures/pictures.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "albedo/version.hpp"
#include "analysis/files/study_file.hpp"
#include "analysis/files/table_document.hpp"
#include "analysis/text/progress.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/render/scenes.hpp"

namespace albedo::plots {

using nlohmann::ordered_json;
using render::Picture;
using render::Rendering;

std::string rounded_text(double value) {
  std::ostringstream out;
  out.precision(3);
  out << value;
  return out.str();
}

std::string cm(double length) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(3) << length;
  return out.str();
}

ordered_json provenance_of(std::string_view name) {
  return {{"version", "albedo " + std::string(version)}, {"command", "albedo-figures " + std::string(name)}};
}

std::string comment_lines(const ordered_json& provenance) {
  std::ostringstream out;
  analysis::write_provenance(provenance, out);
  return out.str();
}

std::vector<Attachment> files_of(const std::string& suffix, const Picture& picture, double exposure,
                                 const ordered_json& provenance) {
  ordered_json of_png = provenance;
  of_png["exposure"] = exposure;
  of_png["saturated part"] = render::saturated_part(picture, exposure);
  return {{suffix + ".exr", encode_exr(picture, provenance)}, {suffix + ".png", encode_png(picture, exposure, of_png)}};
}

std::string panels_csv(const ordered_json& provenance, const std::vector<Panel>& panels) {
  std::string csv = comment_lines(provenance);
  csv += "picture,width,height,samples,mean_luminance,mean_standard_error,largest_standard_error\n";
  for (const auto& [label, rendering] : panels) {
    csv += label + "," + std::to_string(rendering.width) + "," + std::to_string(rendering.height) + "," +
           std::to_string(rendering.samples);
    for (const double value : {rendering.mean_luminance(), rendering.mean_error(), rendering.largest_error()}) {
      analysis::append_number(csv += ',', value);
    }
    csv += '\n';
  }
  return csv;
}

std::string noise_text(const std::vector<Panel>& panels, bool two_lines) {
  double mean = 0, largest = 0;
  for (const Panel& panel : panels) {
    mean += panel.rendering.mean_error() / static_cast<double>(panels.size());
    largest = std::max(largest, panel.rendering.largest_error());
  }
  return std::to_string(panels.front().rendering.samples) + " samples a pixel;" + (two_lines ? "\\n" : " ") +
         "standard error of the luminance: mean " + rounded_text(mean) + ", largest " + rounded_text(largest);
}

std::string bare_panel(const Place& place) {
  return "unset border\nunset xtics\nunset ytics\nunset xlabel\nunset ylabel\nset lmargin at screen " + cm(place.left) +
         "/width\nset rmargin at screen " + cm(place.left + place.width) + "/width\nset bmargin at screen " +
         cm(place.bottom) + "/height\nset tmargin at screen " + cm(place.bottom + place.height) + "/height\n";
}

std::string placed_picture(std::string_view name, const std::string& suffix, const Picture& picture,
                           const Place& place) {
  return bare_panel(place) + "set xrange [-0.5:" + std::to_string(picture.width) +
         " - 0.5]\nset yrange [-0.5:" + std::to_string(picture.height) + " - 0.5]\nplot '" + std::string(name) + "-" +
         suffix + ".png' binary filetype=png with rgbimage\n";
}

std::string label_at(double x, double y, const std::string& text, const std::string& how) {
  return "set label \"" + text + "\" at screen " + cm(x) + "/width, screen " + cm(y) + "/height " + how + "\n";
}

std::string exponent_text(double exponent) { return std::to_string(static_cast<int>(exponent)); }

Drawing sphere_grid(std::string_view name, const std::string& what, double exposure,
                    std::vector<render::SurfaceLobe> (*lobes)(double n_u, double n_v)) {
  constexpr std::size_t size = 128;
  constexpr std::uint32_t samples = 256;
  std::vector<Rendering> renderings;
  analysis::ProgressBar progress;
  for (const double n_v : exponents) {
    for (const double n_u : exponents) {
      const render::View view = render::sphere_on_plane(lobes(n_u, n_v));
      const std::size_t before = renderings.size() * size;
      renderings.push_back(render::render(
          view.scene, view.camera, {.width = size, .height = size, .samples = samples, .seed = renderings.size() + 1},
          [&](std::size_t done, std::size_t) { progress.update(before + done, 16 * size); }));
    }
  }
  std::vector<Panel> panels;
  std::vector<Picture> pictures;
  for (std::size_t i = 0; i < renderings.size(); ++i) {
    panels.push_back(
        {"n_u=" + exponent_text(exponents[i % 4]) + " n_v=" + exponent_text(exponents[i / 4]), renderings[i]});
    pictures.push_back(picture_of(renderings[i], render::first_three));
  }
  const Picture picture = mosaic(pictures, 4, 4, 1 / exposure);
  ordered_json provenance = provenance_of(name);
  provenance["source"] = what;
  provenance["noise"] = noise_text(panels);

  const Place place{0.75, 0.75, 8.1, 8.1};
  std::string script = script_head(name, 8.9, 9.35) + "\nset multiplot\nunset key\n" + exponent_labels(place) +
                       label_at(4.8, 0.5, noise_text(panels, true), "center font ',7.5'") +
                       placed_picture(name, "spheres", picture, place) + "unset multiplot\nunset output\n";
  return {.data = panels_csv(provenance, panels),
          .script = std::move(script),
          .attachments = files_of("spheres", picture, exposure, provenance)};
}

std::string exponent_labels(const Place& place) {
  const double step = place.width / 4;
  std::string script;
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    const std::string number = "= " + exponent_text(exponents[i]);
    const double along = (static_cast<double>(i) + 0.5) * step;
    script += label_at(place.left + along, place.bottom + place.height + 0.25, "{/:Italic n}_{/:Italic u} " + number);
    script += label_at(place.left - 0.3, place.bottom + place.height - along, "{/:Italic n}_{/:Italic v} " + number,
                       "center rotate by 90");
  }
  return script;
}

}  // namespace albedo::plots
