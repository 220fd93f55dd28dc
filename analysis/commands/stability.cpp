#include <iostream>
#include <limits>
#include <memory>

#include "albedo/core/errors.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/files/provenance.hpp"
#include "analysis/files/study_file.hpp"
#include "analysis/studies/atlas_report.hpp"
#include "analysis/studies/honesty_report.hpp"
#include "analysis/studies/methods.hpp"
#include "analysis/text/progress.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

struct Arguments {
  AtlasOptions atlas;
  HonestyOptions honesty;
  std::vector<std::string> models;
  std::string output;
  bool is_honesty = false, json = false;
};

constexpr std::int64_t largest_count = 1'000'000'000;

/// "16x24": directions times widths of the lobe.
void parse_grid(const std::string& text, AtlasOptions& options) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) throw ParameterError("--grid is '" + text + "' and must be NxM, such as 16x16");
  constexpr std::size_t least = 2, most = 1000;
  options.incidences = parse_integer("--grid", text.substr(0, cross), least, most);
  options.widths = parse_integer("--grid", text.substr(cross + 1), least, most);
}

int run_honesty(const Arguments& arguments) {
  if (!arguments.output.empty()) throw ParameterError("--output is of the atlas; --honesty prints, with --json too");
  if (arguments.atlas.warps.size() > 1) throw ParameterError("--honesty studies one --warp at a time");
  if (!arguments.atlas.forms.empty()) throw ParameterError("--honesty is studied in double precision only");
  HonestyOptions options = arguments.honesty;
  options.models = arguments.models;
  options.rules = arguments.atlas.rules;
  if (!arguments.atlas.warps.empty()) options.warp = arguments.atlas.warps.front();
  options.budget = arguments.atlas.budget;
  options.seed = arguments.atlas.seed;
  options.threads = arguments.atlas.threads;
  ProgressBar progress;
  const Honesty honesty =
      study_honesty(options, [&progress](std::size_t done, std::size_t total) { progress.update(done, total); });
  if (arguments.json) {
    std::cout << json_text(honesty_json(honesty)) << '\n';
  } else {
    print_honesty(honesty, std::cout);
  }
  return exit_code::done;
}

int run_atlas(const Arguments& arguments, const std::string& command_line) {
  if (arguments.output == "-" && arguments.json)
    throw ParameterError("--json and --output - would both use standard output");
  if (!arguments.output.empty()) check_study_path(arguments.output);
  AtlasOptions options = arguments.atlas;
  if (!arguments.models.empty()) options.models = arguments.models;
  Atlas atlas;
  {
    ProgressBar progress;
    atlas = compute_atlas(options, [&progress](std::size_t done, std::size_t total) { progress.update(done, total); });
  }
  if (!arguments.output.empty()) write_atlas(atlas, begin_provenance(command_line), arguments.output);
  if (arguments.json) {
    std::cout << json_text(atlas_summary(atlas)) << '\n';
  } else if (arguments.output != "-") {
    print_atlas(atlas, std::cout);
  }
  return exit_code::done;
}

int run(const Arguments& arguments, const std::string& command_line) {
  return arguments.is_honesty ? run_honesty(arguments) : run_atlas(arguments, command_line);
}

}  // namespace

Command add_stability(ProgramSyntax& program) {
  const auto arguments = std::make_shared<Arguments>();
  AtlasOptions& atlas = arguments->atlas;
  const Syntax app = program.subcommand("stability", "where each method fails, and whether its errors can be believed");
  app.texts(
         "MODEL", arguments->models,
         "models with a roughness or an exponent; default: " + joined(atlas.models, " ") + " (--honesty: all models)")
      .type_name("");
  app.text("-o,--output", arguments->output, "every answer, as .csv or .json").type_name("FILE");
  add_choices(app, "--rule", all_rules, atlas.rules, "only these; default: all");
  add_choices(app, "--warp", all_warps, atlas.warps, "only these; default: all");
  add_choices(app, "--precision", all_forms, atlas.forms,
              "of the formula: double; float from invariants; float from directions, as in a textbook");
  app.parsed(
         "--grid", [&atlas](const std::string& text) { parse_grid(text, atlas); },
         "directions x roughnesses (or exponents) of a map")
      .type_name("NxM")
      .default_text(std::to_string(atlas.incidences) + "x" + std::to_string(atlas.widths));
  add_real(app, "--anisotropy", atlas.anisotropy, 1, 1e6,
           "ratio of the roughnesses or exponents in a second map of a model; 1: no such map");
  add_real(app, "--tolerance", atlas.tolerance, 1e-10, 0.1, "relative; asked of the deterministic rules");
  add_real(app, "--random-tolerance", atlas.random_tolerance, 1e-10, 0.1, "the same for the Monte Carlo rules");
  add_integer<std::int64_t>(app, "--budget", atlas.budget, 1, largest_count, "most evaluations for one answer")
      .default_text(std::to_string(atlas.budget));
  add_integer<std::uint64_t>(app, "--seed", atlas.seed, 0, std::numeric_limits<std::uint64_t>::max(),
                             "of the Monte Carlo rules, and of --honesty's cases")
      .default_text(std::to_string(atlas.seed));
  add_integer(app, "--threads", atlas.threads, 1, 1024, "default: one a core");
  const OptionSyntax honesty =
      app.flag("--honesty", arguments->is_honesty,
               "instead: reported against true errors over random models, parameters and directions");
  add_integer<std::uint64_t>(app, "--cases", arguments->honesty.cases, 1, largest_count, "of --honesty")
      .default_text(std::to_string(arguments->honesty.cases))
      .needs(honesty);
  for (const char* const of_atlas : {"--precision", "--grid", "--anisotropy", "--tolerance", "--random-tolerance"}) {
    app.option(of_atlas).excludes(honesty);
  }
  app.flag("--json", arguments->json, "print the summary as one JSON object");
  app.footer(
      "The atlas asks every method at incidences from 0 to 90 - 1e-10 degrees and roughnesses from 1e-5 to 5 "
      "(exponents\n"
      "from 0 to 1e7), and tells what came back: within the tolerance or not (a Monte Carlo rule may be off by " +
      number_text(random_slack, 2) +
      "\n"
      "times its own), said to have converged or not, not a number. The reference is the gauss rule on the lobe warp "
      "at\n"
      "1e-12. --honesty draws each case's tolerance from 1e-4, 1e-6, 1e-8 (3e-2, 1e-2, 3e-3 for Monte Carlo rules) "
      "and\n"
      "prints the worst answers as commands.\n"
      "Examples:\n"
      "  albedo stability --honesty --rule gauss --cases 20000\n"
      "  albedo stability ward --grid 6x6 -o ward.csv");
  return {app, [arguments](const std::string& command_line) { return run(*arguments, command_line); }};
}

}  // namespace albedo::analysis
