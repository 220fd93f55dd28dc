#include "plots/render/furnace.hpp"

#include <algorithm>
#include <sstream>

#include "analysis/files/table_document.hpp"
#include "analysis/text/progress.hpp"
#include "plots/figures/gnuplot.hpp"
#include "plots/figures/pictures.hpp"

namespace albedo::plots {
namespace {

constexpr std::size_t size = 96;
constexpr std::uint32_t samples = 256;
constexpr double exposure = 0.8;  // tells the furnace from the page
constexpr double range = 4;       // of the shown deviations, in standard errors

render::Picture grey(const std::vector<double>& values) {
  render::Picture picture(size, size);
  std::ranges::transform(values, picture.pixels.begin(), [](double value) {
    return render::Colour{value, value, value};
  });
  return picture;
}

/// Without gnuplot's markup, for CSV.
std::string plain(std::string text) {
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"{/:Italic ", ""}, {"}", ""}, {"\\n", " "}, {",", ""}}) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;) text.replace(at, from.size(), to);
  }
  return text;
}

std::string fixed(double value, int digits) {
  std::ostringstream out;
  out.precision(digits);
  out << std::fixed << value;
  return out.str();
}

}  // namespace

Drawing furnace(std::string_view name) {
  const std::vector<render::FurnaceModel>& models =
      name == "furnace" ? render::furnace_models() : render::corrected_furnace_models();
  const std::size_t count = models.size();
  analysis::ProgressBar progress;
  std::vector<render::FurnaceTest> tests;
  for (const render::FurnaceModel& model : models) {
    const std::size_t before = tests.size() * size;
    tests.push_back(
        render::test_in_furnace(model.make(), size, samples, tests.size() + 1,
                                [&](std::size_t done, std::size_t) { progress.update(before + done, count * size); }));
  }

  nlohmann::ordered_json provenance = provenance_of(name);
  provenance["quantity"] =
      "path-traced sphere in a furnace of radiance 1 against the albedo of the direction to the eye";
  provenance["samples a pixel"] = samples;
  std::string data = comment_lines(provenance) +
                     "model,pixels,mean_standard_error,largest_standard_error,mean_difference,its_standard_error,"
                     "rms_deviation,largest_deviation\n";
  std::vector<render::Picture> traced, albedos;
  std::vector<double> deviations;  // of all spheres side by side
  const std::size_t row = count * size;
  deviations.resize(row * size);
  std::size_t unconverged = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const render::FurnaceTest& test = tests[i];
    unconverged += test.unconverged;
    data += plain(models[i].label) + "," + std::to_string(test.pixels);
    for (const double value : {test.traced.mean_error(), test.traced.largest_error(), test.mean_difference,
                               test.mean_error, test.rms_deviation, test.largest_deviation}) {
      analysis::append_number(data += ',', value);
    }
    data += '\n';
    traced.push_back(grey(test.traced.luminance));
    traced.back().error = test.traced.error;
    albedos.push_back(grey(test.albedo));
    for (std::size_t y = 0; y < size; ++y) {
      std::copy_n(test.deviation.begin() + static_cast<std::ptrdiff_t>(y * size), size,
                  deviations.begin() + static_cast<std::ptrdiff_t>(y * row + i * size));
    }
  }
  const render::Picture traced_row = mosaic(traced, count, 0), albedo_row = mosaic(albedos, count, 0);

  const double step = 2.7, width = step * static_cast<double>(count), left = 1.1;
  constexpr double first = 1.75;
  std::string script = script_head(name, left + width + 0.5, first + 3 * step + 1) + "\nrange = " + cm(range) + R"(
set multiplot
unset key
set palette defined (-1 '#004D80', -0.5 '#56B4E9', 0 '#FFFFFF', 0.5 '#E69F00', 1 '#A03C00')
set cbrange [-range:range]
unset colorbox
)";
  for (std::size_t i = 0; i < count; ++i) {
    const double middle = left + (static_cast<double>(i) + 0.5) * step;
    script += label_at(middle, first + 3 * step + 0.65, models[i].label, "center font ',8'");
    script += label_at(middle, first - 0.25,
                       "Δ = " + fixed(1e4 * tests[i].mean_difference, 1) + " ± " + fixed(1e4 * tests[i].mean_error, 1),
                       "center font ',7.5'");
    script += label_at(middle, first - 0.6,
                       "rms " + fixed(tests[i].rms_deviation, 3) + ", max " + fixed(tests[i].largest_deviation, 1),
                       "center font ',7.5'");
  }
  const std::array<const char*, 3> titles{"deviation", "albedo {/:Italic a}(θ)", "path-traced"};
  for (std::size_t i = 0; i < titles.size(); ++i) {
    script += label_at(left - 0.35, first + (static_cast<double>(i) + 0.5) * step, titles[i],
                       "center rotate by 90 font ',7.5'");
  }
  script +=
      label_at(left, 0.65,
               std::to_string(samples) +
                   " samples a pixel. Δ: mean of traced − {/:Italic a} over the sphere and its standard error, in "
                   "10^{−4};\\nrms, max: of the deviations (traced − {/:Italic a})/(standard error of the pixel)",
               "left font ',7.5'");
  script +=
      placed_picture(name, "traced", traced_row, {left, first + 2 * step, width, step}) + "unset label\n" +
      placed_picture(name, "albedo", albedo_row, {left, first + step, width, step}) +
      "set colorbox horizontal user origin screen " + cm(left + width - 2.75) +
      "/width, screen 0.55/height size screen 2.6/width, screen 0.2/height\nset cbtics 2 scale 0.5 offset 0, 0.5\n" +
      bare_panel({left, first, width, step}) + "set xrange [-0.5:" + std::to_string(row) +
      " - 0.5]\nset yrange [-0.5:" + std::to_string(size) + " - 0.5]\nplot '" + std::string(name) +
      "-deviation.png' binary filetype=png using (range * ($1 / 127.5 - 1)) with image\n" +
      "unset multiplot\nunset output\n";
  std::vector<Attachment> attachments = files_of("traced", traced_row, exposure, provenance);
  for (Attachment& file : files_of("albedo", albedo_row, exposure, provenance)) attachments.push_back(std::move(file));
  attachments.push_back({"deviation.png", render::encode_png(deviations, row, -range, range, provenance)});
  return {.data = std::move(data),
          .script = std::move(script),
          .unconverged = unconverged,
          .attachments = std::move(attachments)};
}

}  // namespace albedo::plots
