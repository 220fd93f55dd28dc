#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "albedo/core/errors.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/commands/options.hpp"
#include "analysis/files/atomic_file.hpp"
#include "analysis/files/provenance.hpp"
#include "analysis/files/study_file.hpp"
#include "analysis/studies/tradeoff.hpp"
#include "analysis/studies/tradeoff_writer.hpp"
#include "analysis/text/progress.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

struct Arguments {
  std::vector<std::string> words;  // MODEL [PARAM=VALUE]..., several times
  MethodOptions options;
  std::vector<double> thetas;
  double phi = 0;
  int repeats = 0;
  bool quick = false;
  std::string output;
};

/// A model with parameters is one material; without, its usual two. Without any, the models of the default set.
std::vector<TradeoffMaterial> materials_of(const std::vector<std::string>& words) {
  const std::vector<ModelArguments> given = split_models(words);
  std::vector<TradeoffMaterial> materials;
  const auto add_usual = [&](const std::string& model) {
    for (TradeoffMaterial& material : usual_materials(model)) materials.push_back(std::move(material));
  };
  if (given.empty()) std::ranges::for_each(tradeoff_models(), add_usual);
  for (const ModelArguments& arguments : given) {
    if (arguments.parameters.empty()) {
      add_usual(arguments.model);
    } else {
      materials.push_back({arguments.model, joined(arguments.parameters, " "), arguments.make()->parameters()});
    }
  }
  return materials;
}

TradeoffRequest request_of(const Arguments& arguments) {
  const MethodOptions& options = arguments.options;
  const double usual = arguments.quick ? 1e-8 : 1e-12, usual_random = arguments.quick ? 1e-3 : 1e-4;
  TradeoffRequest request =
      default_tradeoff(options.tolerance.value_or(usual), options.tolerance.value_or(usual_random));
  request.materials = materials_of(arguments.words);
  if (!arguments.thetas.empty()) request.thetas = arguments.thetas;
  request.phi = arguments.phi;
  if (!options.rules.empty()) request.rules = options.rules;
  if (!options.warps.empty()) request.warps = options.warps;
  request.precision = options.precision;
  request.budget = options.budget;
  request.seed = options.seed;
  request.threads = options.threads;
  if (arguments.quick) {
    constexpr std::int64_t small = 100'000;
    request.budget = std::min(request.budget, small);
    request.repeats = 3;
    request.reference_tolerance = 1e-12;
  }
  if (arguments.repeats > 0) request.repeats = arguments.repeats;
  return request;
}

void write(const nlohmann::ordered_json& provenance, const Tradeoff& study, const std::string& path) {
  AtomicFile file(path);
  if (is_json_path(path)) {
    file.stream() << json_text(with_cells(provenance, study)) << '\n';
  } else {
    write_csv(provenance, study, file.stream());
  }
  file.commit();
}

std::string seconds_text(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  return seconds < 1e-3 ? number_text(seconds * 1e6, 3) + " us" : number_text(seconds * 1e3, 3) + " ms";
}

/// One line a method: the median time to a true error, its ratio to gauss, and how often it was wrong and claimed to
/// have converged.
void print_summary(const Tradeoff& study) {
  std::vector<std::vector<std::string>> rows{{"rule", "warp"}};
  const std::vector<double> targets{1e-2, 1e-4, 1e-6, 1e-8};
  for (const double target : targets) {
    rows[0].insert(rows[0].end(), {"to " + number_text(target, 1), "x gauss", "reached"});
  }
  rows[0].push_back("wrong");
  for (const Method& method : study.methods()) {
    std::vector<std::string>& row = rows.emplace_back();
    row = {name_of(method.rule), name_of(method.warp)};
    for (const double target : targets) {
      const MethodSummary summary = summary_of(study, method, target);
      row.push_back(seconds_text(summary.seconds));
      row.push_back(std::isfinite(summary.ratio) ? number_text(summary.ratio, 2) : "-");
      row.push_back(std::to_string(summary.reached) + "/" + std::to_string(summary.cells));
    }
    std::size_t wrong = 0, claims = 0;
    for (const TradeoffCell& cell : study.cells) {
      for (const TradeoffRun& run : cell.runs) {
        if (run.method != method || run.estimate.status != Status::converged) continue;
        ++claims;
        if (run.wrong(cell.slack())) ++wrong;
      }
    }
    row.push_back(std::to_string(wrong) + "/" + std::to_string(claims));
  }
  print_columns(std::cout, rows);
}

int run(const Arguments& arguments, const std::string& command_line) {
  if (arguments.output == "-" && arguments.options.json)
    throw ParameterError("--json and --output - would both use standard output");
  TradeoffRequest request = request_of(arguments);
  if (!arguments.output.empty()) check_study_path(arguments.output);
  ProgressBar progress;
  request.progress = [&progress](std::size_t done, std::size_t total) { progress.update(done, total); };
  const Tradeoff study = measure_tradeoff(std::move(request));

  nlohmann::ordered_json provenance = begin_provenance(command_line);
  provenance.update(describe(study.request));
  if (!arguments.output.empty()) write(provenance, study, arguments.output);
  if (arguments.options.json) {
    std::cout << json_text(with_cells(provenance, study)) << '\n';
  } else if (arguments.output != "-") {
    print_summary(study);
  }
  if (study.unconverged() == 0) return exit_code::done;
  std::cerr << "albedo: " << study.unconverged() << " of " << study.cells.size()
            << " references did not reach their tolerance\n";
  return exit_code::not_converged;
}

}  // namespace

Command add_tradeoff(ProgramSyntax& program) {
  const auto arguments = std::make_shared<Arguments>();
  const Syntax app =
      program.subcommand("tradeoff", "speed against accuracy: every rule on every warp, and its true error");
  app.texts("MODEL", arguments->words,
            "models, each with its parameters as NAME=VALUE; without parameters a smooth and a rough one; "
            "default: " +
                joined(tradeoff_models(), ", "))
      .type_name("");
  app.parsed(
         "--theta", [arguments](const std::string& text) { arguments->thetas = parse_angles("--theta", text); },
         "polar angles of L in degrees; default: 0,60,85,89.9")
      .type_name("DEG[,DEG]...");
  add_number(app, "--phi", arguments->phi, "azimuth of L in degrees").type_name("DEG");
  add_repeat(app, arguments->repeats);
  app.flag("--quick", arguments->quick, "shorter ladders, budgets and timings");
  app.text("-o,--output", arguments->output, "a .csv or .json with every run").type_name("FILE");
  add_method_options(app, arguments->options);
  app.footer(
      "The summary: for each rule and warp the median time to a true error, its median ratio to gauss on the lobe's\n"
      "warp, in how many directions it gets there, and how many of the runs that claim to have converged are wrong:\n"
      "off by more than they report, or by more than four standard errors.\n"
      "A rule that misses its tolerance is a finding here; the exit code is 3 where a reference misses its own.\n"
      "Example: which way to integrate a rough GGX, and all that was measured:\n"
      "  albedo tradeoff ggx alpha=0.5 --quick -o ggx.csv");
  return {app, [arguments](const std::string& command_line) { return run(*arguments, command_line); }};
}

}  // namespace albedo::analysis
