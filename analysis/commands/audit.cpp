#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "albedo/core/errors.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/commands/options.hpp"
#include "analysis/files/atomic_file.hpp"
#include "analysis/files/provenance.hpp"
#include "analysis/files/study_file.hpp"
#include "analysis/studies/audit_report.hpp"
#include "analysis/studies/audits.hpp"
#include "analysis/subjects/material_table.hpp"
#include "analysis/subjects/materials.hpp"
#include "analysis/text/progress.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  ModelArguments model;
  std::vector<std::string> materials;
  std::vector<Check> checks;
  ComputeOptions options;
  std::string output;
  bool markdown = false;
};

/// What a table that isn't smooth is integrated with where nothing else is asked for.
AlbedoOptions albedo_options(const ComputeOptions& asked, const Model& model) {
  AlbedoOptions options = asked.albedo();
  if (!asked.tolerance && std::ranges::any_of(model.lobes(), &Lobe::is<HalfAnglesLobe>)) {
    options.tolerance = 1e-3;
    if (asked.rule == Rule::gauss) options.rule = Rule::cubature;
  }
  return options;
}

std::vector<AuditCase> cases_of(const Arguments& arguments) {
  const bool is_list = !arguments.materials.empty();
  if (is_list && !arguments.model.model.empty()) {
    throw ParameterError("either a MODEL or --materials is audited, not both");
  }
  std::vector<AuditCase> cases;
  for (const std::string& file : arguments.materials) {
    const std::vector<Material> materials = read_materials(file);
    const std::vector<std::string> channels = channels_of(materials);
    for (const Material& material : materials) {
      for (std::size_t i = 0; i < channels.size(); ++i) {
        cases.push_back({.list = std::filesystem::path(file).stem().string(),
                         .name = material.name,
                         .channel = channels.size() > 1 ? channels[i] : "",
                         .model = make_material(material, i, file)});
      }
    }
  }
  if (!is_list && arguments.model.model.empty()) {
    for (const ModelInfo& info : model_infos()) {
      if (!info.needs_input()) cases.push_back({.model = make_model(info.name)});
    }
  }
  if (!arguments.model.model.empty()) {
    for (const std::string& channel : arguments.model.channels()) {
      cases.push_back({.channel = channel, .model = arguments.model.make(channel)});
    }
  }
  std::vector<Check> checks = arguments.checks;
  if (checks.empty() && is_list) checks = {Check::reciprocity, Check::average};
  if (checks.empty()) checks.assign(all_checks.begin(), all_checks.end());
  for (AuditCase& one : cases) one.options = audit_options(albedo_options(arguments.options, *one.model), checks);
  return cases;
}

void write(const Json& object, const Json& provenance, const std::vector<AuditCase>& cases, const std::string& path) {
  AtomicFile file(path);
  if (is_json_path(path)) {
    file.stream() << json_text(object) << '\n';
  } else {
    write_csv(provenance, cases, file.stream());
  }
  file.commit();
}

int exit_code_of(const std::vector<AuditCase>& cases) {
  const auto count = [&](Verdict verdict) {
    return std::ranges::count_if(cases, [&](const AuditCase& one) { return one.audit.verdict() == verdict; });
  };
  if (const auto failed = count(Verdict::fails)) {
    std::cerr << "albedo: " << failed << " of " << cases.size() << (failed == 1 ? " breaks" : " break")
              << " what the model claims\n";
    return exit_code::check_failed;
  }
  if (const auto undecided = count(Verdict::undecided)) {
    std::cerr << "albedo: " << undecided << " of " << cases.size() << " could not be decided\n";
    return exit_code::not_converged;
  }
  return exit_code::done;
}

int run(const Arguments& arguments, const std::string& command_line) {
  if (arguments.output == "-" && arguments.options.json)
    throw ParameterError("--json and --output - would both use standard output");
  if (arguments.options.warp == Warp::paper) {
    throw ParameterError(
        "--warp is 'paper' and must be 'lobe' or 'hemisphere' in an audit, which looks at samplers anyway");
  }
  std::vector<AuditCase> cases = cases_of(arguments);
  if (!arguments.output.empty()) check_study_path(arguments.output);
  ProgressBar progress;
  run_audits(cases, arguments.options.threads,
             [&progress](std::size_t done, std::size_t total) { progress.update(done, total); });

  Json provenance = begin_provenance(command_line);
  Json object = Json::object();
  arguments.options.describe(object);
  provenance.update(object);
  object = provenance;
  object["audits"] = Json::array();
  for (const AuditCase& one : cases) object["audits"].push_back(audit_json(one));
  if (!arguments.output.empty()) write(object, provenance, cases, arguments.output);
  if (arguments.options.json) {
    std::cout << json_text(object) << '\n';
  } else if (!arguments.materials.empty()) {
    if (arguments.output.empty() && !arguments.markdown) {
      print_rows(std::cout, cases, arguments.markdown);
      std::cout << '\n';
    }
    if (arguments.output != "-") print_summaries(std::cout, summaries_of(cases), arguments.markdown);
  } else if (arguments.output != "-") {
    if (arguments.model.model.empty()) {
      print_rows(std::cout, cases, arguments.markdown);
    } else {
      for (const AuditCase& one : cases) print_checks(std::cout, one);
    }
  }
  return exit_code_of(cases);
}

}  // namespace

Command add_audit(ProgramSyntax& program) {
  const auto arguments = std::make_shared<Arguments>();
  const Syntax app =
      program.subcommand("audit", "what a model claims and whether it is so: energy, reciprocity, facets, samplers");
  add_model_arguments(app, arguments->model);
  app.texts("--materials", arguments->materials, "audit the materials of these files instead")
      .type_name("FILE")
      .one_at_a_time();
  add_choices(app, "--checks", all_checks, arguments->checks,
              "beside the energy; default: all, for --materials reciprocity,average");
  app.text("-o,--output", arguments->output, "a .csv or .json with every audit").type_name("FILE");
  app.flag("--markdown", arguments->markdown, "print the table of models, or that of lists, for a text in Markdown");
  add_compute_options(app, arguments->options);
  app.footer(
      "Without MODEL all models are audited, with their default parameters.\n"
      "Verdicts: 'pass' and 'fails' where the model claims the property for these parameters ('albedo models' lists\n"
      "claims), 'not claimed' where it doesn't; the numbers are given all the same. 'undecided': some albedo missed\n"
      "its tolerance. The exit code is 1 if a claim fails, 3 if one is undecided.\n"
      "An excess over 1 counts where it is larger than its error; below 0.001 a second rule has to find it too.\n"
      "Example: is Ward's model what it claims, and what of 86 materials that were fitted with it?\n"
      "  albedo audit ward alpha=0.2\n"
      "  albedo audit --materials ngan_ward.json -o ward.csv");
  return {app, [arguments](const std::string& command_line) { return run(*arguments, command_line); }};
}

}  // namespace albedo::analysis
