#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include "albedo/core/errors.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/files/provenance.hpp"
#include "analysis/scenes/plan/plan_files.hpp"
#include "analysis/scenes/plan/plan_report.hpp"
#include "analysis/text/progress.hpp"
#include "analysis/text/text.hpp"
#include "analysis/text/value.hpp"

namespace albedo::analysis {
namespace {

struct Arguments {
  std::string scene, directory;
  PlanOptions options;
  bool json = false;
};

/// A number, or a fraction such as 1/255.
double parse_error(const std::string& text) {
  const std::size_t slash = text.find('/');
  const double above = parse_number("--error", text.substr(0, slash));
  if (slash == std::string::npos) return above;
  const double below = parse_number("--error", text.substr(slash + 1));
  if (below == 0) throw ParameterError("--error is '" + text + "' and must not divide by 0");
  return above / below;
}

void parse_angles_of(const std::string& text, PlanOptions& options) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw ParameterError("--angles is '" + text + "' and must be FROM:TO in degrees");
  options.least_theta = parse_number("--angles", text.substr(0, colon));
  options.largest_theta = parse_number("--angles", text.substr(colon + 1));
}

int run(const Arguments& arguments, const std::string& command_line) {
  if (arguments.scene.empty()) throw ParameterError("SCENE is missing: a file with materials is to be planned");
  check_plan_options(arguments.options);
  if (!arguments.directory.empty()) check_plan_directory(arguments.directory);
  const Scene scene = read_scene(arguments.scene);
  ProgressBar progress;
  PlanOptions options = arguments.options;
  options.progress = [&progress](std::size_t done, std::size_t total) { progress.update(done, total); };
  const Plan plan = plan_scene(scene, options);

  nlohmann::ordered_json object = begin_provenance(command_line);
  object.update(plan_json(scene, plan));
  if (!arguments.directory.empty()) write_plan(scene, plan, object, arguments.directory);
  if (arguments.json) {
    std::cout << json_text(object) << '\n';
  } else {
    print_plan(std::cout, scene, plan);
  }
  if (plan.unknown() > 0 || plan.largest_error().largest() > options.tolerance) {
    std::cerr << "albedo: "
              << (plan.unknown() > 0 ? "no table was found for " + std::to_string(plan.unknown()) + " of " +
                                           std::to_string(plan.cases.size()) + " reflectances"
                                     : "an error of " + number_text(plan.largest_error().largest(), 3) +
                                           " was met between nodes, more than is allowed")
              << '\n';
    return exit_code::not_converged;
  }
  return exit_code::done;
}

}  // namespace

Command add_plan(ProgramSyntax& program) {
  const auto arguments = std::make_shared<Arguments>();
  const Syntax app = program.subcommand("plan", "the energy tables that a scene needs, and no more");
  app.text("SCENE", arguments->scene, "a Mitsuba .xml, pbrt-v4 .pbrt, Radiance .rad or .mat, or materials .json")
      .type_name("FILE");
  app.parsed(
         "--error", [arguments](const std::string& text) { arguments->options.tolerance = parse_error(text); },
         "of a radiance, where white is 1: a number or a fraction")
      .type_name("E")
      .default_text("1/255");
  app.parsed(
         "--angles", [arguments](const std::string& text) { parse_angles_of(text, arguments->options); },
         "from the normal, in degrees")
      .type_name("FROM:TO")
      .default_text("0:85");
  app.text("-o,--output", arguments->directory,
           "write plan.html, plan.json and every table as .exr, .npy and .hpp there")
      .type_name("DIR");
  add_integer(app, "--pumpings", arguments->options.most_pumpings, 0, 64,
              "how far to look for an order of pumping that does as well; default: 8");
  add_integer(app, "--threads", arguments->options.threads, 1, 1024, "default: one a core");
  app.flag("--json", arguments->json, "print one JSON object");
  app.footer(
      "For each material: what its model claims, the largest albedo over the angles, what its lobe would lose and "
      "make\n"
      "if it were white, the error without a correction in a white furnace and under a point light, and the least "
      "that\n"
      "keeps both below --error: nothing, a constant, a curve over cos_theta or a table (doc/plan.md). 'pumpings' is\n"
      "the order of albedo pumping that does as well in a furnace. The exit code is 3 if something has no table.\n"
      "Example: the tables of a scene that are right to one step of a display\n"
      "  albedo plan scene.xml --error 1/255 --angles 0:85 -o plan");
  return {app, [arguments](const std::string& command_line) { return run(*arguments, command_line); }};
}

}  // namespace albedo::analysis
