#include <iostream>
#include <memory>

#include "albedo/core/errors.hpp"
#include "albedo/shader_tables.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/commands/options.hpp"
#include "analysis/commands/table_request.hpp"
#include "analysis/files/provenance.hpp"
#include "analysis/text/text.hpp"
#include "core/text.hpp"
#include "numerics/larger.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  ModelArguments model;
  std::size_t resolution = 0;
  double error = 1e-6;
  std::string output;
  bool json = false;
};

/// Every combination of the axes' values, the last axis fastest.
std::vector<std::vector<double>> places_of(const std::vector<TableAxis>& axes) {
  std::vector<std::vector<double>> places(entry_count(axes), std::vector<double>(axes.size()));
  for (std::size_t entry = 0; entry < places.size(); ++entry) {
    std::size_t rest = entry;
    for (std::size_t i = axes.size(); i-- > 0; rest /= axes[i].size()) {
      places[entry][i] = axes[i].number(rest % axes[i].size());
    }
  }
  return places;
}

/// The parameters' axes of a request for a table, whose last one is that of cosθ unless a direction is given.
std::vector<TableAxis> parameter_axes(const ModelArguments& arguments, const TableRequest& request) {
  const auto [model, assignments] = arguments.varied_composition();
  for (const Assignment& assignment : assignments) {
    if (assignment.name != "theta" && assignment.name != "cos_theta" && assignment.name != "phi") continue;
    throw ParameterError(assignment.name + " is given, but a shader's tables are over all of cos_theta");
  }
  return {request.axes.begin(), request.axes.end() - 1};
}

int run(const Arguments& arguments, const std::string& command_line) {
  if (!arguments.model.corrections.any()) {
    throw ParameterError("nothing is to be corrected; give --pump K, --correct balance|multiscatter|turquin, or both");
  }
  if (arguments.output == "-" && arguments.json) {
    throw ParameterError("--json and --output - would both use standard output");
  }
  const TableRequest request = parse_table_request(arguments.model);
  if (request.is_by_channel()) {
    throw ParameterError(fmt::format("{}: there are several channels; channel={} is one of them", request.model.name,
                                     request.channels.front()));
  }
  const std::vector<TableAxis> axes = parameter_axes(arguments.model, request);

  const auto make = request.plain_models();
  const std::vector<std::vector<double>> places = places_of(axes);
  TableAxis names{.name = "function"};
  for (const auto& [name, value] : shader_functions(make(places.front()), arguments.model.corrections)) {
    names.labels.push_back(name);
  }
  std::vector<TableAxis> document{names};
  document.insert(document.end(), axes.begin(), axes.end());
  document.push_back({.name = "cos_theta", .values = {0, 1}});
  check_table_path(arguments.output, document);

  std::vector<std::vector<ShaderFunction>> functions;
  std::size_t size = arguments.resolution;
  for (const std::vector<double>& place : places) {
    functions.push_back(shader_functions(make(place), arguments.model.corrections));
    if (arguments.resolution == 0) size = std::max(size, tabulate(functions.back(), 0, arguments.error).size);
  }
  std::vector<double> values(names.size() * places.size() * size);
  double error = 0;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const ShaderTable table = tabulate(functions[p], size, arguments.error);
    keep_larger(error, table.error);
    for (std::size_t f = 0; f < names.size(); ++f) {
      std::copy_n(table.values.begin() + static_cast<std::ptrdiff_t>(f * size), size,
                  values.begin() + static_cast<std::ptrdiff_t>((f * places.size() + p) * size));
    }
  }
  document.back().values.clear();
  for (std::size_t i = 0; i < size; ++i) document.back().values.push_back(shader_node(i, size));

  Json provenance = begin_provenance(command_line);
  provenance["model"] = request.model.name;
  provenance["parameters"] = parameters_json(request.fixed_parameters());
  provenance["corrections"] = corrections_json(arguments.model.corrections);
  provenance["axes"] = describe_axes(document);
  provenance["interpolated"] = "linearly in sqrt(cos_theta)";
  provenance["interpolation_error"] = error;
  write_table({.name = request.model.name + "_shader",
               .quantity = "factor",
               .axes = document,
               .values = values.data(),
               .provenance = provenance},
              arguments.output);
  if (arguments.json) {
    std::cout << json_text({{"functions", names.labels},
                            {"resolution", size},
                            {"interpolation_error", error},
                            {"output", arguments.output}})
              << '\n';
  } else if (arguments.output != "-") {
    std::cout << names.size() << " function" << (names.size() > 1 ? "s" : "") << " of cos_theta at " << size
              << " nodes, interpolation error " << number_text(error, 2) << " of the largest value\n";
  }
  if (error <= arguments.error || arguments.resolution > 0) return exit_code::done;
  std::cerr << "albedo: linear interpolation is off by " << number_text(error, 2) << " at " << size << " nodes\n";
  return exit_code::not_converged;
}

}  // namespace

Command add_shader(ProgramSyntax& program) {
  const auto arguments = std::make_shared<Arguments>();
  const Syntax app =
      program.subcommand("shader", "what a shader needs to evaluate a pumped or corrected model, as tables");
  add_model_arguments(app, arguments->model);
  app.option("PARAMETERS").description("NAME=VALUE fixes, NAME=FROM:TO:COUNT[:log] or NAME=A,B,... varies");
  add_integer(app, "--resolution", arguments->resolution, std::size_t{2}, std::size_t{1048576},
              "nodes over cos_theta; default: the least power of two that --error needs");
  add_real(app, "--error", arguments->error, 1e-9, 1, "of linear interpolation, relative to the largest value");
  app.text("-o,--output", arguments->output, "a .csv, .json, .npy, .exr or .hpp; - is CSV on standard output")
      .type_name("FILE")
      .required();
  app.flag("--json", arguments->json, "print one JSON object");
  app.footer(
      "A function of one cosine for each step: 1/a_0, 1/a_1, ... of pumping, 1/s of balance, m of multiscatter, 1/a "
      "of\n"
      "turquin. The nodes are cos_theta = (i/(N-1))^2, to interpolate linearly in sqrt(cos_theta); doc/corrections.md "
      "has\n"
      "the C++ and GLSL that evaluate them. Axes: function, the parameters that vary, cos_theta.\n"
      "Examples:\n"
      "  albedo shader phong n=20 --pump 3 -o phong.hpp\n"
      "  albedo shader ggx alpha=0.1:1:16 --correct balance --resolution 64 -o balance.exr");
  return {app, [arguments](const std::string& command_line) { return run(*arguments, command_line); }};
}

}  // namespace albedo::analysis
