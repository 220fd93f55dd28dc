#include <algorithm>
#include <functional>
#include <iomanip>
#include <sstream>

#include "analysis/files/table_document.hpp"
#include "analysis/text/progress.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/pictures.hpp"
#include "plots/render/walter.hpp"

namespace albedo::plots {
namespace {

using render::Mean;
using render::Picture;
using render::Rendering;
using render::WalterPictures;

constexpr std::array<double, 6> alphas{0.05, 0.1, 0.15, 0.2, 0.3, 0.5};
constexpr std::size_t size = 160;
constexpr std::uint32_t uniform_samples = 1024, samples = 256;
constexpr double range = 0.3;  // of the shown differences

std::string curves_csv(std::size_t& unconverged) {
  std::string csv = "theta";
  for (const double alpha : alphas) {
    csv += ",albedo_" + rounded_text(alpha) + ",equal_" + rounded_text(alpha) + ",bias_" + rounded_text(alpha);
  }
  csv += '\n';
  for (int half_degrees = 0; half_degrees < 180; ++half_degrees) {
    const double theta = half_degrees / 2.0;
    analysis::append_number(csv, theta);
    for (const double alpha : alphas) {
      const Direction l = Direction::from_degrees(theta);
      const Estimate albedo = render::ward_albedo(alpha, l), equal = render::equal_weights_albedo(alpha, l);
      for (const Estimate& e : {albedo, equal}) {
        if (e.status != Status::converged) ++unconverged;
        analysis::append_number(csv += ',', e.value);
      }
      analysis::append_number(csv += ',', equal.value - albedo.value);
    }
    csv += '\n';
  }
  return csv;
}

nlohmann::ordered_json describe(const Mean& mean) { return {{"value", mean.value}, {"standard error", mean.error}}; }

nlohmann::ordered_json numbers(const WalterPictures& pictures) {
  return {{"pixels of the sphere", pictures.pixels},
          {"mean luminance, uniform sampling", describe(pictures.reference)},
          {"weighted minus uniform", describe(pictures.weighted_minus_reference)},
          {"equal weights minus uniform", describe(pictures.equal_minus_reference)},
          {"the same as the curve predicts", describe(pictures.predicted)}};
}

std::vector<double> difference(const Rendering& a, const Rendering& b) {
  std::vector<double> result(a.luminance.size());
  std::ranges::transform(a.luminance, b.luminance, result.begin(), std::minus{});
  return result;
}

/// A picture of differences, that the script gives colours.
std::string placed_difference(std::string_view name, const std::string& suffix, const Place& place) {
  const std::string last = std::to_string(size) + " - 0.5]\n";
  return bare_panel(place) + "set xrange [-0.5:" + last + "set yrange [-0.5:" + last + "plot '" + std::string(name) +
         "-" + suffix + ".png' binary filetype=png using (range * ($1 / 127.5 - 1)) with image\n";
}

}  // namespace

Drawing walter_3(std::string_view name) {
  analysis::ProgressBar progress;
  const auto report = [&](std::size_t done, std::size_t total) { progress.update(done, total); };
  const WalterPictures box =
      walter_pictures(render::ward_in_box(), render::walter_alpha, size, uniform_samples, samples, 1, report);
  const WalterPictures furnace =
      walter_pictures(render::ward_in_furnace(), render::walter_alpha, 64, uniform_samples, samples, 11);
  const std::vector<Panel> panels{
      {"uniform hemisphere", box.uniform}, {"equal weights", box.equal}, {"weights of eq. 10", box.weighted}};

  nlohmann::ordered_json provenance = provenance_of(name);
  provenance["source"] = "Walter 2005, fig. 3";
  provenance["model"] = "ward alpha=0.15 rho_s=0.75";
  for (const Panel& panel : panels) {
    provenance["picture " + panel.label] = {{"samples", panel.rendering.samples},
                                            {"mean standard error", panel.rendering.mean_error()},
                                            {"largest standard error", panel.rendering.largest_error()}};
  }
  provenance["sphere in the box"] = numbers(box);
  provenance["sphere in a furnace"] = numbers(furnace);
  provenance["curves"] = "albedo, what equal weights make of it, and the difference, for rho_s = 1; by cubature";
  std::size_t unconverged = 0;
  std::string data = comment_lines(provenance) + curves_csv(unconverged);

  std::vector<Attachment> attachments;
  const auto attach = [&](const std::string& suffix, const Rendering& rendering) {
    for (Attachment& file : files_of(suffix, picture_of(rendering, render::first_three), 1, provenance)) {
      attachments.push_back(std::move(file));
    }
  };
  attach("uniform", box.uniform);
  attach("equal", box.equal);
  attach("weighted", box.weighted);
  attachments.push_back({"equal-difference.png",
                         render::encode_png(difference(box.equal, box.uniform), size, -range, range, provenance)});
  attachments.push_back({"weighted-difference.png",
                         render::encode_png(difference(box.weighted, box.uniform), size, -range, range, provenance)});

  const Picture shape(size, size);
  constexpr double edge = 3.9, lower = 1.0, upper = lower + edge + 0.55;
  const auto place = [&](int column, double bottom) { return Place{0.15 + 4.05 * column, bottom, edge, edge}; };
  const auto middle = [&](int column) { return 0.15 + 4.05 * column + edge / 2; };
  const auto line = [&](int number, const std::string& text) {
    return label_at(0.2, lower + 2 - 0.42 * number, text, "left font ',7.5'");
  };
  const auto plus_minus = [](const Mean& mean) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(4) << mean.value << " ± " << mean.error;
    return out.str();
  };
  std::string script =
      script_head(name, 17.8, upper + edge + 0.55) + "\nrange = " + cm(range) + R"(
set multiplot
unset key
set palette defined (-1 '#004D80', -0.5 '#56B4E9', 0 '#FFFFFF', 0.5 '#E69F00', 1 '#A03C00')
set cbrange [-range:range]
unset colorbox
)" + label_at(middle(0), upper + edge + 0.25, "(a) uniform sampling") +
      label_at(middle(1), upper + edge + 0.25, "(b) equal weights") +
      label_at(middle(2), upper + edge + 0.25, "(c) weights of eq. 10") +
      label_at(middle(1), lower + edge + 0.25, "(b) − (a)") + label_at(middle(2), lower + edge + 0.25, "(c) − (a)") +
      label_at(15.6, upper + edge + 0.25, "(d) in a furnace: (b) − (c)") + line(0, "means over the sphere:") +
      line(1, "(a) " + plus_minus(box.reference)) + line(2, "(b) − (a) " + plus_minus(box.equal_minus_reference)) +
      line(3, "  by (d) " + plus_minus(box.predicted)) +
      line(4, "(c) − (a) " + plus_minus(box.weighted_minus_reference)) +
      label_at(6.1, 0.6,
               "samples a pixel: (a) " + std::to_string(uniform_samples) + ", (b), (c) " + std::to_string(samples) +
                   "\\nstandard error of the luminance, mean and largest: (a) " +
                   rounded_text(box.uniform.mean_error()) + ", " + rounded_text(box.uniform.largest_error()) +
                   "; (c) " + rounded_text(box.weighted.mean_error()) + ", " +
                   rounded_text(box.weighted.largest_error()),
               "center font ',7.5'") +
      placed_picture(name, "uniform", shape, place(0, upper)) + "unset label\n" +
      placed_picture(name, "equal", shape, place(1, upper)) + placed_picture(name, "weighted", shape, place(2, upper)) +
      "set colorbox horizontal user origin screen 0.5/width, screen " + cm(lower + 3.1) +
      "/height size screen 3.2/width, screen 0.25/height\nset cbtics 0.3 scale 0.5 offset 0, 0.5\n"
      "set cblabel 'difference' offset 0, 1.2\n" +
      placed_difference(name, "equal-difference", place(1, lower)) + "unset colorbox\n" +
      placed_difference(name, "weighted-difference", place(2, lower)) +
      bare_panel({13.6, lower + 0.2, 4, upper + edge - lower - 0.2}) + std::string(axes_style) + R"(
set xrange [0:90]
set yrange [-0.2:0.9]
set xtics 30
set mxtics 3
set ytics 0.1
set format y '%.1f'
set grid ytics linetype -1 linecolor rgb '#DDDDDD' linewidth 0.4
set xlabel 'angle of view {/:Italic θ} [degrees]' offset 0, 1.5 - letter
set ylabel 'bias of the albedo, {/:Italic ρ_s} = 1' offset 1.7, 0
set key at graph 0.03, graph 0.99 left top Left reverse samplen 2.5 spacing 1.05
plot )";
  for (std::size_t i = 0; i < alphas.size(); ++i) {
    script += std::string(i == 0 ? "" : ", \\\n     ") + "data using 'theta':'bias_" + rounded_text(alphas[i]) +
              "' with lines linetype " + std::to_string(i + 1) + " title '{/:Italic α} = " + rounded_text(alphas[i]) +
              "'";
  }
  script += "\nunset multiplot\nunset output\n";
  return {.data = std::move(data),
          .script = std::move(script),
          .unconverged = unconverged,
          .attachments = std::move(attachments)};
}

}  // namespace albedo::plots
