#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <string_view>

#include "albedo/core/errors.hpp"
#include "albedo/core/larger.hpp"
#include "analysis/commands/checks.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/commands/options.hpp"
#include "analysis/commands/progress.hpp"
#include "analysis/commands/provenance.hpp"
#include "analysis/commands/table_request.hpp"
#include "analysis/commands/text.hpp"
#include "analysis/material_table.hpp"
#include "analysis/studies/albedo_proxy.hpp"
#include "analysis/studies/table_growth.hpp"
#include "analysis/tiles/tiled_table.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

/// Where entries come from: an integration each, or series that few of them make.
enum class Fill { direct, proxy };
constexpr std::array all_fills{Fill::direct, Fill::proxy};
std::string_view name_of(Fill fill) { return fill == Fill::direct ? "direct" : "proxy"; }

struct Arguments {
  ModelArguments model;
  ComputeOptions options;
  std::string materials, output;
  bool summary = false, errors = false, resume = false;
  Fill fill = Fill::direct;
  int verified = 1000;                 ///< random places at which a proxy is compared with integrations
  TableGrowth growth{.max_error = 0};  ///< 0: the table doesn't grow
  std::vector<Assertion> assertions;
};

/// What is known of a table, wherever its entries are.
struct Known {
  std::vector<Axis> axes;
  std::size_t entries;
  double worst_error, interpolation_error;
  std::size_t unconverged, divergent;
  std::int64_t evaluations;
};

/// What an AlbedoTable and a MaterialTable have in common, once filled. The entries stay where they are.
struct Filled : Known {
  std::vector<double> values;
  const std::vector<double>& errors;

  template <class Table>
  Filled(std::vector<Axis> of_document, const Table& table)
      : Known{.axes = std::move(of_document),
              .entries = table.values().size(),
              .worst_error = table.worst_error(),
              .interpolation_error = table.interpolation_error(),
              .unconverged = table.unconverged(),
              .divergent = table.divergent(),
              .evaluations = table.evaluations()},
        values(table.values()),
        errors(table.errors()) {}
};

using EntryAt = std::function<double(std::size_t entry)>;

/// Tables of the same axes, one after the other.
class StackedTables {
 public:
  void add(const AlbedoTable& table) {
    values_.insert(values_.end(), table.values().begin(), table.values().end());
    errors_.insert(errors_.end(), table.errors().begin(), table.errors().end());
    keep_larger(worst_error_, table.worst_error());
    interpolation_error_ = std::max(interpolation_error_, table.interpolation_error());
    unconverged_ += table.unconverged();
    divergent_ += table.divergent();
    evaluations_ += table.evaluations();
  }

  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  [[nodiscard]] const std::vector<double>& errors() const { return errors_; }
  [[nodiscard]] double worst_error() const { return worst_error_; }
  [[nodiscard]] double interpolation_error() const { return interpolation_error_; }
  [[nodiscard]] std::size_t unconverged() const { return unconverged_; }
  [[nodiscard]] std::size_t divergent() const { return divergent_; }
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

 private:
  std::vector<double> values_, errors_;
  double worst_error_ = 0, interpolation_error_ = 0;
  std::size_t unconverged_ = 0, divergent_ = 0;
  std::int64_t evaluations_ = 0;
};

/// A table filled from a proxy.
class ProxyTable {
 public:
  ProxyTable(const AlbedoProxy& proxy, const std::vector<TableAxis>& axes, double node_error, int threads)
      : proxy_(proxy), values_(proxy.fill(axes, threads)) {
    double largest = 0;
    for (const double value : values_) keep_larger(largest, std::abs(value));
    worst_error_ = (proxy.error() + node_error) * std::max(proxy.largest(), largest);
    interpolation_error_ = albedo::analysis::interpolation_error(
        axes, values_, [&](const std::vector<TableAxis>& over) { return proxy.fill(over, 1); });
  }

  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  [[nodiscard]] const std::vector<double>& errors() const { return errors_; }
  [[nodiscard]] double worst_error() const { return worst_error_; }
  [[nodiscard]] double interpolation_error() const { return interpolation_error_; }
  [[nodiscard]] std::size_t unconverged() const { return proxy_.unconverged(); }
  [[nodiscard]] std::size_t divergent() const { return 0; }
  [[nodiscard]] std::int64_t evaluations() const { return proxy_.evaluations(); }

 private:
  const AlbedoProxy& proxy_;
  std::vector<double> values_, errors_;
  double worst_error_ = 0, interpolation_error_ = 0;
};

/// The table at one direction, linearly interpolated along its only axis. The axis is `theta` or `cos_theta`, in any
/// order.
double interpolated(const Axis& axis, const EntryAt& value, double theta) {
  const double place = axis.name == "theta" ? theta : Direction::from_degrees(theta).cos_theta;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    if (axis.values[i] == place) return value(i);
    if (i + 1 == axis.size() || (axis.values[i] < place) == (axis.values[i + 1] < place)) continue;
    return std::lerp(value(i), value(i + 1), (place - axis.values[i]) / (axis.values[i + 1] - axis.values[i]));
  }
  return NAN;  // unreachable after check_at()
}

/// at(θ,φ) has one answer only if the direction is all that the table varies.
void check_at(const std::vector<Assertion>& assertions, const std::vector<Axis>& axes, double phi) {
  const auto is_single = [](const Axis& axis) { return axis.is_categorical() && axis.size() == 1; };
  const Axis& directions = axes.back();
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
double grow(const Arguments& arguments, std::vector<TableAxis>& axes, const TableEntries& entries) {
  if (arguments.growth.max_error == 0) return 0;
  GrownTable table = grown(std::move(axes), entries, arguments.growth);
  axes = std::move(table.axes);
  return table.error;
}

/// What --bits asks for, and --max-error: the entries as they are held, and what is said of them.
void hold(const Arguments& arguments, Filled& table, double grown_error, Json& provenance) {
  if (arguments.growth.bits != 0) {
    QuantisedEntries entries = quantised(std::move(table.values), arguments.growth.bits);
    table.values = std::move(entries.values);
    provenance["bits"] = arguments.growth.bits;
    if (arguments.growth.bits < 32) provenance["scale"] = entries.scale;
    provenance["quantisation_error"] = entries.error;
    table.worst_error += entries.error;
    if (arguments.growth.max_error == 0) table.interpolation_error += entries.error;
  }
  if (arguments.growth.max_error == 0) return;
  provenance["max_error"] = arguments.growth.max_error;
  keep_larger(table.interpolation_error, grown_error);  // which is met with the entries as they are held
}

/// Whether --max-error is met; says so if not.
bool complain_of_growth(const Arguments& arguments, const Known& table) {
  const double allowed = arguments.growth.max_error;
  if (allowed == 0 || (table.interpolation_error <= allowed && table.divergent == 0)) return true;
  std::cerr << "albedo: --max-error " << number_text(allowed, 3) << " isn't met: ";
  if (table.divergent > 0) {
    std::cerr << "an albedo is infinite, and nothing is interpolated towards it\n";
  } else {
    const int bits = arguments.growth.bits;
    const double rounding = bits == 0 || bits == 32 ? 0 : 0.5 / (std::exp2(bits) - 1);
    std::cerr << "interpolation is off by up to " << number_text(table.interpolation_error, 3) << " with "
              << table.entries << " entries"
              << (rounding > allowed ? ", and " + std::to_string(bits) + " bits alone by " + number_text(rounding, 3)
                                     : "")
              << '\n';
  }
  return false;
}

/// How the entries were computed, and what is known of them.
void complete(Json& provenance, const Arguments& arguments, const Known& table) {
  provenance["axes"] = describe_axes(table.axes);
  if (arguments.model.corrections.any()) provenance["corrections"] = corrections_json(arguments.model.corrections);
  arguments.options.describe(provenance);
  provenance["largest_error"] = table.worst_error;
  provenance["interpolation_error"] = table.interpolation_error;
  provenance["unconverged"] = table.unconverged;
  provenance["divergent"] = table.divergent;
  provenance["evaluations"] = table.evaluations;
}

/// Says what was asked for of a table that is written.
int report(const Arguments& arguments, const Known& table, const EntryAt& value, const Json& provenance,
           double seconds) {
  Json summary{{"entries", table.entries},
               {"worst_error", table.worst_error},
               {"interpolation_error", table.interpolation_error},
               {"unconverged", table.unconverged},
               {"divergent", table.divergent},
               {"evaluations", table.evaluations},
               {"seconds", seconds},
               {"output", arguments.output}};
  if (provenance.contains("proxy")) summary["proxy"] = provenance["proxy"];
  if (arguments.options.json) std::cout << json_text(summary) << '\n';
  if (arguments.summary) std::cerr << json_text(summary) << '\n';
  const bool is_reached = complain_of_growth(arguments, table);
  const int unreached = is_reached ? exit_code::done : exit_code::not_converged;
  if (arguments.assertions.empty() && table.unconverged == 0) return unreached;

  const Extent extent = extent_of(table.entries, value);
  const Facts facts{.at = [&](double theta, double) { return interpolated(table.axes.back(), value, theta); },
                    .max = extent.max,
                    .min = extent.min,
                    .mean = extent.mean,
                    .error = table.worst_error,
                    .evaluations = static_cast<double>(table.evaluations)};
  const int code = concluding_exit_code(arguments.assertions, facts, {table.entries, table.unconverged});
  return code == exit_code::done ? unreached : code;
}

/// Writes the table and says what was asked for.
int conclude(const Arguments& arguments, Filled table, double grown_error, Json provenance, double seconds) {
  hold(arguments, table, grown_error, provenance);
  complete(provenance, arguments, table);
  const std::string name = provenance.value("model", "materials") + "_albedo";
  write_table({.name = name,
               .axes = table.axes,
               .values = table.values.data(),
               .errors = table.errors.empty() ? nullptr : table.errors.data(),
               .provenance = provenance},
              arguments.output);
  return report(
      arguments, table, [&](std::size_t i) { return table.values[i]; }, provenance, seconds);
}

/// Whether the entries go to their places in a file instead of memory.
bool is_tiled(const Arguments& arguments, bool by_channel) {
  const bool is_plain = arguments.materials.empty() && !arguments.errors && !by_channel &&
                        arguments.growth.max_error == 0 && arguments.growth.bits == 0;
  const bool result = is_plain && can_be_tiled(arguments.output);
  if (arguments.resume && !result) {
    throw ParameterError(
        "--resume continues a .npy file of one model and channel, without --errors, --max-error, --bits and "
        "--materials");
  }
  return result;
}

/// Computes and writes the table tile by tile, and says what was asked for.
int run_tiled(const Arguments& arguments, const TableRequest& request, const TableOptions& options, Json provenance,
              const std::function<double()>& seconds) {
  const TableSource source(request.model, request.fixed, request.axes, options);
  Json computation = provenance;
  computation.erase("command");
  computation["compiler"] = __VERSION__;
  if (arguments.model.corrections.any()) computation["corrections"] = corrections_json(arguments.model.corrections);
  arguments.options.describe(computation);
  computation["budget"] = arguments.options.budget;
  if (const Json files = checksums_of_files(model_info(request.model), request.fixed); !files.empty()) {
    computation["files"] = files;
  }
  TiledTable table(source, request.document_axes(), arguments.output,
                   {.command = provenance["command"].get<std::string>(),
                    .computation = std::move(computation),
                    .resume = arguments.resume,
                    .progress = options.progress});
  LocalClaims claims(table.tiles());
  table.fill(claims);
  if (table.damaged() > 0) {
    std::cerr << "albedo: " << table.damaged() << " finished tiles had a wrong checksum and were computed again\n";
  }
  const EntryAt value = [&](std::size_t entry) { return table.value(entry); };
  const TableSource::Interpolation interpolation = source.interpolation(value);
  const TableTally& tally = table.tally();
  const Known known{.axes = request.document_axes(),
                    .entries = source.size(),
                    .worst_error = std::max(tally.worst_error, 0.0),
                    .interpolation_error = interpolation.error,
                    .unconverged = tally.unconverged,
                    .divergent = tally.divergent,
                    .evaluations = tally.evaluations + interpolation.evaluations};
  provenance["command"] = table.command();
  complete(provenance, arguments, known);
  table.commit({.axes = known.axes, .provenance = provenance});
  return report(arguments, known, value, provenance, seconds());
}

int parse_bits(const std::string& text) {
  for (const int bits : {8, 10, 16, 32}) {
    if (text == std::to_string(bits)) return bits;
  }
  throw ParameterError("--bits is '" + text + "' and must be one of 8, 10, 16, 32");
}

/// Everything that can be refused before the work begins.
void check_before(const Arguments& arguments, const std::vector<Axis>& axes, double phi) {
  check_at(arguments.assertions, axes, phi);
  check_table_path(arguments.output, axes);
}

/// What --fill proxy does, after everything is checked. `options` are those of its integrations.
int fill_from_proxy(const Arguments& arguments, const TableRequest& request, TableOptions options, Json provenance,
                    const std::function<double()>& seconds) {
  constexpr double share = 20;  // of the tolerance
  const double tolerance = arguments.options.tolerance.value_or(ProxyOptions{}.tolerance);
  options.albedo.tolerance = is_monte_carlo(options.albedo.rule) ? tolerance : std::max(tolerance / share, 1e-13);
  const ProxyEntries entries = [&](const std::vector<TableAxis>& over) {
    const AlbedoTable table(request.model, request.fixed, over, options);
    return ProxySamples{table.values(), table.unconverged(), table.evaluations()};
  };
  const AlbedoProxy proxy(request.axes, entries,
                          {.tolerance = tolerance,
                           .verified = static_cast<std::size_t>(arguments.verified),
                           .seed = arguments.options.seed,
                           .threads = arguments.options.threads});
  if (!std::isfinite(proxy.largest())) {
    throw ParameterError(
        "--fill proxy needs finite albedos, and one within these axes is not: keep away from grazing "
        "incidence, or fill directly");
  }
  const ProxyTable table(proxy, request.axes, options.albedo.tolerance, arguments.options.threads);
  Json worst = Json::object();
  for (std::size_t i = 0; i < request.axes.size() && !proxy.worst_place().empty(); ++i) {
    worst[request.axes[i].name] = proxy.worst_place()[i];
  }
  provenance["proxy"] = {{"tolerance", tolerance},
                         {"coefficients", proxy.sizes()},
                         {"integrations", proxy.integrations()},
                         {"verified_places", arguments.verified},
                         {"relative_error", proxy.error()},
                         {"worst_place", worst},
                         {"is_reached", proxy.is_reached()}};
  const int code = conclude(arguments, Filled(request.document_axes(), table), 0, std::move(provenance), seconds());
  if (proxy.is_reached()) return code;
  std::cerr << "albedo: --fill proxy is off by up to " << number_text(proxy.error(), 3)
            << " of the largest albedo; asked for were " << number_text(tolerance, 3) << '\n';
  return code == exit_code::done ? exit_code::not_converged : code;
}

/// Refuses what --fill proxy can't do.
void check_fill(const Arguments& arguments) {
  if (arguments.fill == Fill::direct) return;
  if (!arguments.materials.empty()) throw ParameterError("--fill proxy is of one model, not of --materials");
  if (arguments.errors) throw ParameterError("--fill proxy knows no errors of single entries: leave out --errors");
  if (arguments.growth.max_error > 0) throw ParameterError("--fill proxy and --max-error exclude each other");
}

int run(const Arguments& arguments, const std::string& command_line) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto seconds = [begin] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  if (arguments.output == "-" && arguments.options.json) {
    throw ParameterError("--json and --output - would both use standard output");
  }
  check_fill(arguments);
  ProgressBar progress;
  TableOptions options{.albedo = arguments.options.albedo(),
                       .threads = arguments.options.threads,
                       .keep_errors = arguments.errors,
                       .progress = [&progress](std::size_t done, std::size_t total) { progress.update(done, total); }};
  const Corrections& corrections = arguments.model.corrections;
  if (corrections.any()) {
    options.correction = [&](std::unique_ptr<Model> model) { return corrections.applied_to(std::move(model)); };
  }
  TableOptions quiet = options;
  quiet.keep_errors = false, quiet.verified_cells = 0, quiet.progress = nullptr;
  Json provenance = begin_provenance(command_line);

  if (!arguments.materials.empty()) {
    is_tiled(arguments, false);
    MaterialRequest request = parse_material_request(arguments.model);
    const std::vector<Material> materials = read_materials(arguments.materials);
    MaterialTable table(materials, arguments.materials);
    std::vector<Axis> axes = table.label_axes();
    axes.push_back(document_axis(request.directions));
    check_before(arguments, axes, request.phi);
    std::vector<TableAxis> directions{request.directions};
    const double grown_error = grow(arguments, directions, [&](const std::vector<TableAxis>& over) {
      MaterialTable trial(materials, arguments.materials);
      trial.fill(over.front(), request.phi, quiet);
      return trial.values();
    });
    axes.back() = document_axis(directions.front());
    table.fill(directions.front(), request.phi, options);
    provenance["materials"] = arguments.materials;
    provenance["phi_deg"] = request.phi;
    return conclude(arguments, Filled(axes, table), grown_error, std::move(provenance), seconds());
  }

  TableRequest request = parse_table_request(arguments.model);
  std::vector<Axis> axes = request.document_axes();
  const bool by_channel = request.channels.size() > 1;
  if (by_channel) axes.insert(axes.begin(), Axis{.name = "channel", .labels = request.channels});
  check_before(arguments, axes, request.phi());
  provenance["model"] = request.model;
  provenance["parameters"] = parameters_json(request.fixed_parameters());
  for (const TableAxis& axis : request.fixed_directions()) provenance[axis.name] = axis.values.front();
  if (arguments.fill == Fill::proxy) {
    if (by_channel) throw ParameterError("--fill proxy is of one channel: give channel=" + request.channels.front());
    return fill_from_proxy(arguments, request, quiet, std::move(provenance), seconds);
  }
  if (is_tiled(arguments, by_channel)) return run_tiled(arguments, request, options, std::move(provenance), seconds);
  const auto in_channel = [&](const std::string& channel) {
    Parameters fixed = request.fixed;
    if (by_channel) fixed.emplace_back(model_info(request.model).channel()->name, channel);
    return fixed;
  };
  const double grown_error = grow(arguments, request.axes, [&](const std::vector<TableAxis>& over) {
    std::vector<double> entries;
    for (const std::string& channel : request.channels) {
      const AlbedoTable trial(request.model, in_channel(channel), over, quiet);
      entries.insert(entries.end(), trial.values().begin(), trial.values().end());
    }
    return entries;
  });
  axes = request.document_axes();
  if (by_channel) axes.insert(axes.begin(), Axis{.name = "channel", .labels = request.channels});
  if (!by_channel) {
    const AlbedoTable table(request.model, request.fixed, request.axes, options);
    return conclude(arguments, Filled(axes, table), grown_error, std::move(provenance), seconds());
  }
  StackedTables tables;
  for (const std::string& channel : request.channels) {
    tables.add(AlbedoTable(request.model, in_channel(channel), request.axes, options));
  }
  return conclude(arguments, Filled(axes, tables), grown_error, std::move(provenance), seconds());
}

}  // namespace

Command add_table(CLI::App& program) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* const app =
      program.add_subcommand("table", "an N-dimensional table over parameters and directions, or of materials");
  add_model_arguments(*app, arguments->model, false);
  add_corrections(*app, arguments->model.corrections, nullptr);
  app->get_option("PARAMETERS")
      ->description(
          "NAME=VALUE fixes, NAME=FROM:TO:COUNT[:log] or NAME=A,B,... varies; also cos_theta, theta, phi (degrees)");
  app->add_option("-o,--output", arguments->output, "a .csv, .json, .npy, .exr or .hpp; - is CSV on standard output")
      ->type_name("FILE")
      ->required();
  app->add_option("--materials", arguments->materials, R"(instead of MODEL: JSON of {"name", "model", "parameters"})")
      ->type_name("FILE");
  add_choice(
      *app, "--fill", all_fills, arguments->fill,
      "an integration for every entry, or Chebyshev series made from few, whose cost doesn't grow with the table");
  add_integer(*app, "--verify", arguments->verified, 1, 10'000'000,
              "random places at which --fill proxy is compared with integrations");
  add_real(*app, "--max-error", arguments->growth.max_error, 1e-7, 1,
           "halve gaps until linear interpolation between the entries is within this, at verified places");
  app->add_option_function<std::string>(
         "--bits", [arguments](const std::string& text) { arguments->growth.bits = parse_bits(text); },
         "of an entry, whose value is then one that they hold")
      ->type_name("8|10|16|32");
  app->add_flag("--errors", arguments->errors, "keep the error of every entry too");
  app->add_flag("--summary", arguments->summary, "print one line of JSON on standard error at the end");
  app->add_flag("--resume", arguments->resume, "continue an unfinished .npy of the same command, if there is one");
  add_compute_options(*app, arguments->options);
  add_assert_option(*app, arguments->assertions);
  app->footer(
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
