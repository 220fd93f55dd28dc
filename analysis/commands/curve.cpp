#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string_view>

#include "albedo/core/errors.hpp"
#include "albedo/curve.hpp"
#include "analysis/commands/checks.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/commands/options.hpp"
#include "analysis/commands/rational_curve.hpp"
#include "analysis/files/atomic_file.hpp"
#include "analysis/files/provenance.hpp"
#include "analysis/text/text.hpp"
#include "analysis/text/value.hpp"
#include "numerics/larger.hpp"
#include "numerics/parallel.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

/// What is written: nodes, or one function.
enum class OutputForm { nodes, rational };
constexpr std::array all_output_forms{OutputForm::nodes, OutputForm::rational};
std::string_view name_of(OutputForm form) { return form == OutputForm::nodes ? "nodes" : "rational"; }

struct Arguments {
  ModelArguments model;
  ComputeOptions options;
  double phi = 0;
  OutputForm form = OutputForm::nodes;
  std::optional<std::size_t> coefficients{};  ///< only of a rational form
  std::string output;
  std::vector<Assertion> assertions;
};

double theta_degrees(double cos_theta) { return Direction::from_cosine(cos_theta).theta_degrees(); }

/// The curve of one channel; its name is empty where there is only one.
struct ChannelCurve {
  std::string channel;
  AlbedoCurve curve;
};

Json describe(const Model& model, const Arguments& arguments, bool several_channels) {
  Json object = model_json(model, several_channels);
  arguments.options.describe(object);
  object["phi_deg"] = arguments.phi;
  return object;
}

Json describe(const AlbedoCurve& curve) {
  Json object;
  object["form"] = curve.form() == CurveForm::rational ? "rational" : "monotone";
  object["node_count"] = curve.nodes().size();
  object["relative_bound"] = curve.relative_bound();
  object["grazing_exponent"] = curve.grazing_exponent();
  object["evaluations"] = curve.evaluations();
  object["status"] = to_string(curve.status());
  return object;
}

/// A curve's own description among what is common to all of them, or one for each channel.
Json describe(Json object, const std::vector<ChannelCurve>& curves) {
  if (curves.size() == 1) {
    object.update(describe(curves.front().curve));
  } else {
    for (const auto& [channel, curve] : curves) object["channels"][channel] = describe(curve);
  }
  return object;
}

Json with_nodes(Json object, const AlbedoCurve& curve) {
  object["nodes"] = Json::array();
  for (const auto& [cos_theta, estimate] : curve.nodes()) {
    object["nodes"].push_back({{"theta_deg", theta_degrees(cos_theta)},
                               {"cos_theta", cos_theta},
                               {"albedo", estimate.value},
                               {"error", estimate.error}});
  }
  return object;
}

Json with_nodes(Json object, const std::vector<ChannelCurve>& curves) {
  if (curves.size() == 1) return with_nodes(std::move(object), curves.front().curve);
  for (const auto& [channel, curve] : curves) {
    object["channels"][channel] = with_nodes(std::move(object["channels"][channel]), curve);
  }
  return object;
}

void write_csv(const Json& provenance, const std::vector<ChannelCurve>& curves, std::ostream& out) {
  for (const auto& [key, item] : provenance.items()) {
    out << "# " << key << ": " << comment_text(item.is_string() ? item : Json(json_text(item))) << '\n';
  }
  out << (curves.size() > 1 ? "channel," : "") << "theta_deg,cos_theta,albedo,error\n";
  for (const auto& [channel, curve] : curves) {
    for (const auto& [cos_theta, estimate] : curve.nodes()) {
      out << channel << (curves.size() > 1 ? "," : "") << number_text(theta_degrees(cos_theta)) << ','
          << number_text(cos_theta) << ',' << number_text(estimate.value) << ',' << number_text(estimate.error) << '\n';
    }
  }
}

/// The nodes as a table over cosθ, for the formats that hold nothing else.
void write_nodes(const Json& provenance, const AlbedoCurve& curve, const std::string& path) {
  TableAxis axis{.name = "cos_theta"};
  std::vector<double> values, errors;
  for (const auto& [cos_theta, estimate] : curve.nodes()) {
    axis.values.push_back(cos_theta);
    values.push_back(estimate.value);
    errors.push_back(estimate.error);
  }
  write_table({.name = provenance["model"].get<std::string>() + "_albedo",
               .axes = {axis},
               .values = values.data(),
               .errors = errors.data(),
               .provenance = provenance},
              path);
}

bool is_text(const std::string& path) {
  const std::string ending = ending_of(path);
  return path == "-" || ending == ".csv" || ending == ".json";
}

void write(const Json& provenance, const std::vector<ChannelCurve>& curves, const std::string& path) {
  if (!is_text(path)) {
    write_nodes(provenance, curves.front().curve, path);
    return;
  }
  AtomicFile file(path);
  if (ending_of(path) == ".json") {
    file.stream() << json_text(with_nodes(provenance, curves)) << '\n';
  } else {
    write_csv(provenance, curves, file.stream());
  }
  file.commit();
}

/// Extremes of the nodes and of the limit at grazing incidence, over all channels; the mean is theirs too.
Facts facts_of(const std::vector<ChannelCurve>& curves) {
  std::vector<double> values;
  Facts facts{
      .at = [&curves](double theta, double) { return curves.front().curve(Direction::from_degrees(theta).cos_theta); }};
  for (const auto& [channel, curve] : curves) {
    values.push_back(curve(0));
    for (const AlbedoCurve::Node& node : curve.nodes()) values.push_back(node.albedo.value);
    facts.mean += curve.average() / static_cast<double>(curves.size());
    keep_larger(facts.error, curve.relative_bound());
    facts.evaluations += static_cast<double>(curve.evaluations());
  }
  const Extent extent = extent_of(values);
  facts.max = extent.max, facts.min = extent.min;
  return facts;
}

int run_rational(const Arguments& arguments, const Model& model, const std::string& output,
                 const std::string& command_line) {
  RationalRequest request{.output = output,
                          .json = arguments.options.json,
                          .assertions = arguments.assertions,
                          .description = describe(model, arguments, false)};
  RationalOptions& options = request.options;
  options.albedo = arguments.options.albedo();
  options.tolerance = arguments.options.tolerance.value_or(options.tolerance);
  options.most_coefficients = arguments.coefficients.value_or(options.most_coefficients);
  options.phi_degrees = arguments.phi;
  options.threads = arguments.options.threads;
  return run_rational_curve(model, request, command_line);
}

int run(const Arguments& arguments, const std::string& command_line) {
  const std::vector<std::string> channels = arguments.model.channels();
  check_one_channel(arguments.assertions, channels);
  std::vector<std::unique_ptr<Model>> models;
  for (const std::string& channel : channels) models.push_back(arguments.model.make(channel));
  const std::string output = arguments.output.empty() && !arguments.options.json ? "-" : arguments.output;
  if (output == "-" && arguments.options.json)
    throw ParameterError("--json and --output - would both use standard output");
  if (arguments.form == OutputForm::rational) {
    if (channels.size() > 1) {
      throw ParameterError("a rational form is that of one channel: give channel=" + channels.front() + " or another");
    }
    return run_rational(arguments, *models.front(), output, command_line);
  }
  if (arguments.coefficients) throw ParameterError("--coefficients is of --form rational only");
  if (arguments.options.threads > 0 && channels.size() == 1) {
    throw ParameterError("--threads is of several channels, or of --form rational: a curve's nodes follow one another");
  }
  check_answerable(
      arguments.assertions, [&](double, double phi) { return phi == arguments.phi; },
      "the curve is that of another --phi");
  if (!output.empty()) check_table_path(output, {{.name = "cos_theta", .values = {1}}});
  if (channels.size() > 1 && !output.empty() && !is_text(output)) {
    throw ParameterError(
        "the curves of several channels have nodes of their own: write a .csv or .json, or give channel=" +
        channels.front());
  }

  CurveOptions options{.albedo = arguments.options.albedo()};
  options.phi_degrees = arguments.phi;
  std::vector<std::optional<AlbedoCurve>> made(channels.size());
  in_parallel(made.size(), arguments.options.threads, [&](std::size_t i) { made[i].emplace(*models[i], options); });
  std::vector<ChannelCurve> curves;
  for (std::size_t i = 0; i < made.size(); ++i) curves.push_back({channels[i], *std::move(made[i])});

  const Json description = describe(describe(*models.front(), arguments, channels.size() > 1), curves);
  if (!output.empty()) {
    Json provenance = begin_provenance(command_line);
    provenance.update(description);
    write(provenance, curves, output);
  }
  if (arguments.options.json) std::cout << json_text(with_nodes(description, curves)) << '\n';
  const auto missed =
      std::ranges::count_if(curves, [](const ChannelCurve& c) { return c.curve.status() != Status::converged; });
  return concluding_exit_code(arguments.assertions, facts_of(curves),
                              {curves.size(), static_cast<std::size_t>(missed)});
}

}  // namespace

Command add_curve(ProgramSyntax& program) {
  const auto arguments = std::make_shared<Arguments>();
  const Syntax app =
      program.subcommand("curve", "the albedo from normal to grazing incidence, with as many nodes as needed");
  add_model_arguments(app, arguments->model);
  add_number(app, "--phi", arguments->phi, "azimuth of L in degrees").type_name("DEG");
  app.text(
         "-o,--output", arguments->output,
         "a .csv, .json, .npy, .exr or .hpp; default: CSV on standard output; of a rational form .hpp, .glsl or .json")
      .type_name("FILE");
  add_choice(app, "--form", all_output_forms, arguments->form,
             "the nodes of a curve, or one rational function of cos_theta, to compile");
  app.parsed(
         "--coefficients",
         [arguments](const std::string& text) {
           const double value = parse_number("--coefficients", text);
           if (!(value >= 3 && value <= 64 && value == std::floor(value))) {
             throw ParameterError("--coefficients is " + text + " and must be a whole number within [3, 64]");
           }
           arguments->coefficients = static_cast<std::size_t>(value);
         },
         "the most of a rational form; default 16")
      .type_name("N");
  add_compute_options(app, arguments->options);
  add_assert_option(app, arguments->assertions);
  app.footer(
      "--assert: max and min are those of the nodes and of the limit at 90 degrees, mean is the albedo under light "
      "from\n"
      "everywhere, error is the relative bound of the curve, evaluations are those of the whole curve.\n"
      "--form rational: a function of at most 16 coefficients over [0, 89.99] degrees, as C++ (.hpp, or - for "
      "standard\n"
      "output), GLSL (.glsl) or .json; --tolerance is its largest relative error, default 1e-6, verified at directions "
      "that\n"
      "were not fitted. The exit code is 3 where that many coefficients don't reach it.\n"
      "Examples: a function for a shader; a curve good to a millionth, and whether it conserves energy:\n"
      "  albedo curve ggx alpha=0.3 --form rational -o ggx.glsl\n"
      "  albedo curve ggx alpha=0.3 --tolerance 1e-6 -o ggx.csv --assert 'max<=1'");
  return {app, [arguments](const std::string& command_line) { return run(*arguments, command_line); }};
}

}  // namespace albedo::analysis
