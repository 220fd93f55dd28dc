#include <cmath>
#include <iostream>
#include <memory>

#include "albedo/core/errors.hpp"
#include "albedo/grazing.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/commands/options.hpp"
#include "analysis/text/progress.hpp"
#include "analysis/text/text.hpp"
#include "numerics/parallel.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::vector<std::string> words;
  GrazingOptions options;
  int threads = 0;
  bool json = false;
};

struct Case {
  std::unique_ptr<Model> model;
  std::string label;  ///< of what was said about its parameters
  Grazing grazing;
  Crossing crossing;
};

std::vector<Case> cases_of(const std::vector<std::string>& words) {
  std::vector<Case> cases;
  for (const ModelArguments& given : split_models(words)) {
    for (const std::string& channel : given.channels()) {
      std::string label = joined(given.parameters, " ");
      if (!channel.empty()) label += (label.empty() ? "channel=" : " channel=") + channel;
      cases.push_back({given.make(channel), label, {}, {}});
    }
  }
  if (!cases.empty()) return cases;
  for (const ModelInfo& info : model_infos()) {
    if (info.needs_input()) continue;
    cases.push_back({make_model(info.name), "", {}, {}});
    if (info.name == "cook_torrance")
      cases.push_back({make_model(info.name, {{"masking", "none"}}), "masking=none", {}, {}});
  }
  return cases;
}

Json law_json(const PowerLaw& law) {
  return {{"exponent", law.exponent},       {"exponent_error", law.exponent_error},
          {"constant", law.constant},       {"constant_error", law.constant_error},
          {"evaluations", law.evaluations}, {"status", to_string(law.status)}};
}

Json case_json(const Case& one) {
  Json object = model_json(*one.model, false);
  object["limit"] = law_json(one.grazing.limit);
  object["fit"] = law_json(one.grazing.fit);
  object["agree"] = one.grazing.agree();
  if (one.crossing.exists) {
    object["critical"] = {{"theta_deg", Direction::from_cosine(one.crossing.cos_theta).theta_degrees()},
                          {"cos_theta", one.crossing.cos_theta},
                          {"error", one.crossing.error}};
  } else {
    object["critical"] = nullptr;
  }
  return object;
}

void print_text(const std::vector<Case>& cases) {
  std::vector<std::vector<std::string>> rows{
      {"model", "parameters", "p", "fitted", "+-", "C", "fitted", "+-", "agree", "critical angle"}};
  const auto number = [](bool known, double value, int digits) {
    return known ? number_text(value + 0.0, digits) : std::string("-");
  };
  for (const Case& one : cases) {
    const auto& [limit, fit] = one.grazing;
    const bool has_limit = limit.status == Status::converged, has_fit = fit.status == Status::converged;
    rows.push_back(
        {one.model->info().name, one.label, number(has_limit, limit.exponent, 6), number(has_fit, fit.exponent, 6),
         number(has_fit, fit.exponent_error, 1), number(has_limit, limit.constant, 8), number(has_fit, fit.constant, 8),
         number(has_fit, fit.constant_error, 1), one.grazing.agree() ? "yes" : "no",
         one.crossing.exists ? number_text(Direction::from_cosine(one.crossing.cos_theta).theta_degrees(), 10) : "-"});
  }
  print_columns(std::cout, rows);
}

int run(const Arguments& arguments) {
  std::vector<Case> cases = cases_of(arguments.words);
  ProgressBar progress;
  in_parallel(
      cases.size(), arguments.threads,
      [&](std::size_t i) {
        cases[i].grazing = grazing_behaviour(*cases[i].model, arguments.options);
        cases[i].crossing = critical_angle(*cases[i].model, arguments.options);
      },
      [&progress](std::size_t done, std::size_t total) { progress.update(done, total); });
  if (arguments.json) {
    Json object{{"phi_deg", arguments.options.phi_degrees}, {"tolerance", arguments.options.tolerance}};
    object["results"] = Json::array();
    for (const Case& one : cases) object["results"].push_back(case_json(one));
    std::cout << json_text(object) << '\n';
  } else {
    print_text(cases);
  }
  return exit_code::done;
}

}  // namespace

Command add_divergence(ProgramSyntax& program) {
  const auto arguments = std::make_shared<Arguments>();
  const Syntax app =
      program.subcommand("divergence", "what the albedo does towards grazing incidence: a(L) ~ C (N.L)^-p");
  app.texts("MODEL", arguments->words, "models, each with its parameters as NAME=VALUE; default: all").type_name("");
  add_number(app, "--phi", arguments->options.phi_degrees, "azimuth of L in degrees").type_name("DEG");
  add_real(app, "--tolerance", arguments->options.tolerance, 1e-30, 0.5, "relative, of the albedos").type_name("REL");
  add_integer(app, "--threads", arguments->threads, 1, 1024, "default: one a core");
  app.flag("--json", arguments->json, "print one JSON object");
  app.footer(
      "p and C come from the limit of the formula and its integral and, independently, from a straight\n"
      "line through ln a against ln N.L at 89 ... 90-1e-8 degrees, integrated by another rule. '-': there is no such\n"
      "law. The critical angle is where the albedo first passes 1.\n"
      "Example: does Cook-Torrance's model diverge, with its geometry factor and without?\n"
      "  albedo divergence cook_torrance m=0.1 cook_torrance m=0.1 masking=none");
  return {app, [arguments](const std::string&) { return run(*arguments); }};
}

}  // namespace albedo::analysis
