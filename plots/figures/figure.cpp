#include "plots/figures/figure.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <filesystem>
#include <system_error>

#include "albedo/core/errors.hpp"
#include "albedo/core/model.hpp"
#include "albedo/core/suggestion.hpp"
#include "analysis/files/atomic_file.hpp"
#include "plots/figures/gnuplot.hpp"

namespace albedo::plots {
namespace {

constexpr std::array<std::string_view, 3> format_names{"pdf", "png", "svg"};

void make_directory(const std::string& directory) {
  std::error_code failure;
  std::filesystem::create_directories(directory, failure);
  if (failure) throw analysis::cannot_write(directory, failure.message());
  if (!std::filesystem::is_directory(directory, failure)) {
    throw analysis::cannot_write(directory, std::generic_category().message(ENOTDIR));
  }
}

}  // namespace

const std::vector<Figure>& figures() {
  static const std::vector<Figure> list{
      {"neumann-1",
       "albedo of Phong, He-Torrance, Cook-Torrance and Ward against the angle of incidence (Neumann 1999, fig. 1)",
       neumann_1},
      {"neumann-2", "domains of L, H and V, and the critical region (Neumann 1999, fig. 2)", neumann_2},
      {"neumann-3", "Phong, pumped up to 5 times: albedo and output radiance (Neumann 1999, fig. 3)", neumann_pumped},
      {"neumann-4", "the same of Blinn (Neumann 1999, fig. 4)", neumann_pumped},
      {"neumann-5", "Phong, pumped under control, in both readings (Neumann 1999, fig. 5)", neumann_pumped},
      {"neumann-6", "the same of Blinn (Neumann 1999, fig. 6)", neumann_pumped},
      {"neumann-7", "eq. 22, where controlled pumping ends: albedo and output radiance (Neumann 1999, fig. 7)",
       neumann_7},
      {"walter-6", "bounds of the cosine and of Ward's f cos over a box of directions (Walter 2005, fig. 6)", walter_6},
      {"kurt-1", "albedo of measured materials, from files of the user's (Kurt 2010, fig. 1)", kurt_1, kurt_1_lacks},
      {"kurt-2", "albedo of eq. 9 for several roughnesses (Kurt 2010, fig. 2)", kurt_2},
      {"kurt-3", "albedo of eq. 10 for several roughnesses and exponents (Kurt 2010, fig. 3)", kurt_3},
      {"kurt-7", "polar plots of fits of one material in the plane of incidence (Kurt 2010, fig. 7)", kurt_7},
      {"plausibility", "largest albedo, and where it passes 1: Kurt m and alpha, Ward, Duer and eq. 9 m", plausibility},
      {"tradeoff", "error against time and evaluations, by rule and warp: Ward, smooth and rough", tradeoff},
      {"tradeoff-cook-torrance", "the same for Cook-Torrance", tradeoff},
      {"tradeoff-ashikhmin-shirley", "the same for Ashikhmin-Shirley", tradeoff},
      {"tradeoff-phong", "the same for Phong", tradeoff},
      {"tradeoff-ggx", "the same for GGX", tradeoff},
      {"stability", "where each rule fails on each warp: roughness against incidence", stability},
      {"stability-anisotropic", "the same for lobes 1000 times as wide one way as the other", stability},
      {"stability-float", "digits that a formula keeps in float, from invariants and in textbook form",
       stability_float},
      {"ashikhmin-2", "spheres in a furnace for 16 pairs of exponents, and curves (Ashikhmin & Shirley 2000, fig. 2)",
       ashikhmin_2},
      {"ashikhmin-3", "golden spheres for 16 pairs of exponents (fig. 3)", ashikhmin_3},
      {"ashikhmin-4", "half a diffusely lit sphere, R_s = 0.05, R_d = 1, and its curves (fig. 4)", ashikhmin_4},
      {"ashikhmin-6", "red plastic spheres for 16 pairs of exponents (fig. 6)", ashikhmin_6},
      {"kurt-12", "a nearly ideal mirror with exponent 0.25 (Kurt et al. 2010, fig. 12)", kurt_12},
      {"kurt-13", "two anisotropic spheres (Kurt et al. 2010, fig. 13)", kurt_13},
      {"neumann-8", "golden tank with pyramids of four metals (Neumann 1999, fig. 8)", neumann_8},
      {"walter-3", "Ward's sampling with equal and with right weights in a box (Walter 2005, fig. 3)", walter_3},
      {"furnace", "path-traced spheres of pumped models in a furnace against their albedos", furnace},
      {"furnace-corrected", "the same of balanced models, and after Kulla and Conty, and Turquin", furnace},
  };
  return list;
}

const Figure& find_figure(const std::string& name) {
  const auto found = std::ranges::find(figures(), name, &Figure::name);
  if (found != figures().end()) return *found;
  std::vector<std::string> names;
  for (const Figure& figure : figures()) names.emplace_back(figure.name);
  const std::string close = suggestion(name, names);
  throw ParameterError("unknown figure '" + name + "'; " +
                       (close.empty() ? "--list shows the figures there are" : "did you mean '" + close + "'?"));
}

std::string_view to_string(Format format) { return format_names[static_cast<std::size_t>(format)]; }

Format parse_format(const std::string& text) {
  const auto* const found = std::ranges::find(format_names, text);
  if (found == format_names.end()) throw ParameterError("--format is '" + text + "' and must be pdf, png or svg");
  return static_cast<Format>(found - format_names.begin());
}

std::size_t write_figure(const Figure& figure, const std::string& directory, const std::vector<Format>& formats) {
  make_directory(directory);
  const std::string stem = (std::filesystem::path(directory) / figure.name).string();
  const std::string data_path = stem + ".csv", script_path = stem + ".gp";
  const auto picture_path = [&stem](Format format) { return stem + "." + std::string(to_string(format)); };
  analysis::AtomicFile::check(data_path);
  analysis::AtomicFile::check(script_path);
  for (const Format format : formats) analysis::AtomicFile::check(picture_path(format));

  const Drawing drawing = figure.draw(figure.name);
  std::deque<analysis::AtomicFile> files;
  const auto add = [&files](const std::string& path, const std::string& content) {
    analysis::AtomicFile& file = files.emplace_back(path);
    file.stream() << content;
    file.finish();
  };
  add(data_path, drawing.data);
  add(script_path, drawing.script);
  for (const Attachment& attachment : drawing.attachments) add(stem + "-" + attachment.suffix, attachment.bytes);
  if (!formats.empty()) {
    const std::vector<std::string> pictures = draw_with_gnuplot(std::string(figure.name), drawing, formats);
    for (std::size_t i = 0; i < formats.size(); ++i) add(picture_path(formats[i]), pictures[i]);
  }
  for (analysis::AtomicFile& file : files) file.commit();
  return drawing.unconverged;
}

}  // namespace albedo::plots
