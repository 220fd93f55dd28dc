#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <utility>

#include "albedo/core/errors.hpp"
#include "albedo/table_growth.hpp"
#include "analysis/commands/checks.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/commands/options.hpp"
#include "analysis/commands/table_fills.hpp"
#include "analysis/commands/table_request.hpp"
#include "analysis/files/provenance.hpp"
#include "analysis/subjects/material_table.hpp"
#include "analysis/text/progress.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

/// at(θ,φ) has one answer only if the direction is all that the table varies.
void check_at(const std::vector<Assertion>& assertions, const std::vector<TableAxis>& axes, double phi) {
  const auto is_single = [](const TableAxis& axis) { return axis.is_categorical() && axis.size() == 1; };
  const TableAxis& directions = axes.back();
  const bool is_direction = directions.name == "theta" || directions.name == "cos_theta";
  const bool varies_more = !std::all_of(axes.begin(), axes.end() - 1, is_single);
  check_answerable(
      assertions,
      [&](double theta, double asked_phi) {
        if (!is_direction || varies_more || asked_phi != phi) return false;
        const double place = directions.name == "theta" ? theta : Direction::from_degrees(theta).cos_theta;
        const auto [low, high] = std::minmax_element(directions.values.begin(), directions.values.end());
        return *low <= place && place <= *high;
      },
      "it needs a table that varies nothing but theta or cos_theta, around that direction");
}

/// What --max-error asks for: axes that have grown. Returns the largest error met between entries as they are held.
double grow(const TableArguments& arguments, std::vector<TableAxis>& axes, const TableEntries& entries) {
  if (arguments.growth.max_error == 0) return 0;
  GrownTable table = grown(std::move(axes), entries, arguments.growth);
  axes = std::move(table.axes);
  return table.error;
}

int parse_bits(const std::string& text) {
  for (const int bits : {8, 10, 16, 32}) {
    if (text == fmt::format("{}", bits)) return bits;
  }
  throw ParameterError("--bits is '" + text + "' and must be one of 8, 10, 16, 32");
}

/// Everything that can be refused before the work begins.
void check_before(const TableArguments& arguments, const std::vector<TableAxis>& axes, double phi) {
  check_at(arguments.assertions, axes, phi);
  check_table_path(arguments.output, axes);
}

/// Refuses what --fill proxy can't do.
void check_fill(const TableArguments& arguments) {
  if (arguments.fill == Fill::direct) return;
  if (!arguments.materials.empty()) throw ParameterError("--fill proxy is of one model, not of --materials");
  if (arguments.errors) throw ParameterError("--fill proxy knows no errors of single entries: leave out --errors");
  if (arguments.growth.max_error > 0) throw ParameterError("--fill proxy and --max-error exclude each other");
}

void check_proxy(const TableRequest& request) {
  if (request.is_by_channel()) {
    throw ParameterError("--fill proxy is of one channel: give channel=" + request.channels.front());
  }
  for (const TableAxis& axis : request.axes) {
    if (!axis.is_categorical()) continue;
    throw ParameterError(
        fmt::format("--fill proxy interpolates between numbers, and the axis '{}' holds names: give "
                    "one of them, such as {}={}",
                    axis.name, axis.name, axis.labels.front()));
  }
}

int fill_materials(const TableArguments& arguments, TableOptions options, const TableOptions& quiet, Json provenance,
                   const std::function<double()>& seconds) {
  is_tiled(arguments, false);
  const MaterialRequest request = parse_material_request(arguments.model);
  MaterialModels models(read_materials(arguments.materials), arguments.materials);
  std::vector<TableAxis> axes = models.axes();
  axes.push_back(request.directions);
  check_before(arguments, axes, request.phi);
  const Corrections& corrections = arguments.model.corrections;
  if (corrections.any()) {
    models.correct([&](std::unique_ptr<Model> model) { return corrections.applied_to(std::move(model)); },
                   options.threads);
  }
  const double grown_error = grow(arguments, axes, [&](const std::vector<TableAxis>& over) {
    return AlbedoTable(models.source(over.back(), request.phi, quiet)).values();
  });
  const auto most = static_cast<std::size_t>(std::exchange(options.verified_cells, 0));
  const TableSource source = models.source(axes.back(), request.phi, options);
  FilledTable table = filled(axes, AlbedoTable(source));
  const auto value = [&](std::size_t entry) { return table.values[entry]; };
  table.interpolation_error = source.interpolation(value, material_cells(source, most)).error;
  table.worst_entry.reset();
  provenance["materials"] = arguments.materials;
  provenance["phi_deg"] = request.phi;
  return conclude(arguments, std::move(table), grown_error, std::move(provenance), seconds());
}

int fill_models(const TableArguments& arguments, const TableOptions& options, TableOptions quiet, Json provenance,
                const std::function<double()>& seconds) {
  TableRequest request = parse_table_request(arguments.model);
  check_before(arguments, request.document_axes(), request.phi());
  provenance["model"] = request.model.name;
  provenance["parameters"] = parameters_json(request.fixed_parameters());
  for (const TableAxis& axis : request.fixed_directions()) provenance[axis.name] = axis.values.front();
  const bool in_tiles = is_tiled(arguments, request.is_by_channel());
  if (arguments.fill == Fill::proxy) {
    check_proxy(request);
    quiet.progress = options.progress;
    return fill_from_proxy(arguments, request, quiet, in_tiles, std::move(provenance), seconds);
  }
  if (in_tiles) return run_tiled(arguments, request, options, integrated_entries, std::move(provenance), seconds);
  const TableModels models = request.models(arguments.model.corrections);
  const double grown_error = grow(arguments, request.axes, [&](const std::vector<TableAxis>& over) {
    return AlbedoTable(TableSource(models, over, quiet)).values();
  });
  FilledTable table = filled(request.document_axes(), AlbedoTable(TableSource(models, request.axes, options)));
  if (request.is_by_channel()) table.worst_entry.reset();
  return conclude(arguments, std::move(table), grown_error, std::move(provenance), seconds());
}

int run(const TableArguments& arguments, const std::string& command_line) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto seconds = [begin] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  if (arguments.output == "-" && arguments.options.json) {
    throw ParameterError("--json and --output - would both use standard output");
  }
  check_fill(arguments);
  ProgressBar progress;
  const TableOptions options{
      .albedo = arguments.options.albedo(),
      .threads = arguments.options.threads,
      .keep_errors = arguments.errors,
      .progress = [&progress](std::size_t done, std::size_t total) { progress.update(done, total); }};
  TableOptions quiet = options;
  quiet.keep_errors = false, quiet.verified_cells = 0, quiet.progress = nullptr;
  Json provenance = begin_provenance(command_line);
  if (arguments.materials.empty()) return fill_models(arguments, options, quiet, std::move(provenance), seconds);
  return fill_materials(arguments, options, quiet, std::move(provenance), seconds);
}

}  // namespace

Command add_table(ProgramSyntax& program) {
  const auto arguments = std::make_shared<TableArguments>();
  const Syntax app =
      program.subcommand("table", "an N-dimensional table over parameters and directions, or of materials");
  add_model_arguments(app, arguments->model, false);
  add_corrections(app, arguments->model.corrections, std::nullopt);
  app.option("PARAMETERS")
      .description(
          "NAME=VALUE fixes, NAME=FROM:TO:COUNT[:log] or NAME=A,B,... varies; also cos_theta, theta, phi (degrees)");
  app.text("-o,--output", arguments->output, "a .csv, .json, .npy, .exr or .hpp; - is CSV on standard output")
      .type_name("FILE")
      .required();
  app.text("--materials", arguments->materials, R"(instead of MODEL: JSON of {"name", "model", "parameters"})")
      .type_name("FILE");
  add_choice(
      app, "--fill", all_fills, arguments->fill,
      "an integration for every entry, or Chebyshev series made from few, whose cost doesn't grow with the table");
  add_integer(app, "--verify", arguments->verified, 1, 10'000'000,
              "random places at which --fill proxy is compared with integrations");
  add_real(app, "--max-error", arguments->growth.max_error, 1e-7, 1,
           "halve gaps until linear interpolation between the entries is within this, at verified places");
  app.parsed(
         "--bits", [arguments](const std::string& text) { arguments->growth.bits = parse_bits(text); },
         "of an entry, whose value is then one that they hold")
      .type_name("8|10|16|32");
  app.flag("--errors", arguments->errors, "keep the error of every entry too");
  app.flag("--summary", arguments->summary, "print one line of JSON on standard error at the end");
  app.flag("--resume", arguments->resume, "continue an unfinished .npy of the same command, if there is one");
  add_integer(app, "--tile", arguments->tile, 1, 1 << 24,
              "entries of a .npy that are computed, written and recorded at once");
  app.text("--log", arguments->log, "append a line every 30 s to it while a .npy is filled: done, rate, time left")
      .type_name("FILE");
  add_compute_options(app, arguments->options);
  add_assert_option(app, arguments->assertions);
  app.footer(
      "Axes are in the order given, the last one runs fastest. Without cos_theta or theta the last axis is cos_theta "
      "at the 32\n"
      "centres (i + 1/2)/32; for materials it is theta at 0,15,30,45,60,75,80,85,88,89 degrees. --json prints the "
      "summary.\n"
      "--max-error starts from the values given, and the exit code is 3 if 2^20 entries are not enough. --bits: the "
      "file "
      "holds\n"
      "numbers that 8, 10 or 16 bits (multiples of scale/(2^bits - 1), scale 1 or the largest entry) or a float hold.\n"
      "A .npy of one model is written in place: until it is whole it is FILE.part, with FILE.journal of what is "
      "finished.\n"
      "mpirun or srun may start several processes for it, with --threads in each, where the program was built with "
      "MPI.\n"
      "--fill proxy: --tolerance (default 1e-6) is of the entries, relative to the largest; exit code 3 if it isn't "
      "met.\n"
      "--assert: max, min and mean are those of the entries, error is the largest of a finite entry, evaluations are "
      "those of\n"
      "the whole table; at(THETA) interpolates linearly in a table that varies nothing but theta or cos_theta.\n"
      "Examples: a table for a renderer, and one of measured materials:\n"
      "  albedo table ggx alpha=0.05:1:32 --output ggx.exr\n"
      "  albedo table --materials materials.json theta=0:85:18 --output materials.csv --summary");
  return {app, [arguments](const std::string& command_line) { return run(*arguments, command_line); }};
}

}  // namespace albedo::analysis
