#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>

#include "albedo/directional_albedo.hpp"
#include "analysis/commands/checks.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/commands/options.hpp"
#include "analysis/commands/progress.hpp"
#include "analysis/commands/text.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  ModelArguments model;
  ComputeOptions options;
  std::vector<double> thetas;
  double phi = 0;
  std::vector<Assertion> assertions;
};

struct Result {
  double theta;
  Estimate estimate;
  double seconds;
};

std::vector<Result> compute(const Model& model, const Arguments& arguments) {
  using Clock = std::chrono::steady_clock;
  std::vector<Result> results;
  ProgressBar progress;
  for (const double theta : arguments.thetas) {
    const auto begin = Clock::now();
    const Estimate estimate =
        directional_albedo(model, Direction::from_degrees(theta, arguments.phi), arguments.options.albedo());
    results.push_back({theta, estimate, std::chrono::duration<double>(Clock::now() - begin).count()});
    progress.update(results.size(), arguments.thetas.size());
  }
  return results;
}

void print_json(const Model& model, const Arguments& arguments, const std::vector<Result>& results) {
  Json object{{"model", model.info().name}, {"parameters", parameters_json(model.parameters())}};
  arguments.options.describe(object);
  object["results"] = Json::array();
  for (const Result& result : results) {
    object["results"].push_back({{"theta_deg", result.theta},
                                 {"phi_deg", arguments.phi},
                                 {"albedo", result.estimate.value},
                                 {"error", result.estimate.error},
                                 {"error_kind", to_string(result.estimate.error_kind)},
                                 {"evaluations", result.estimate.evaluations},
                                 {"status", to_string(result.estimate.status)},
                                 {"seconds", result.seconds}});
  }
  std::cout << json_text(object) << '\n';
}

void print_text(double phi, const std::vector<Result>& results) {
  std::vector<std::vector<std::string>> rows{{"theta", "phi", "albedo", "error", "evaluations", "status"}};
  for (const auto& [theta, estimate, seconds] : results) {
    rows.push_back({number_text(theta, 15), number_text(phi, 15), number_text(estimate.value, 15),
                    number_text(estimate.error, 2), std::to_string(estimate.evaluations),
                    std::string(to_string(estimate.status))});
  }
  print_columns(std::cout, rows);
}

/// Extremes of the results; the error is the largest of a finite albedo.
Facts facts_of(const std::vector<Result>& results) {
  Facts facts;
  std::vector<double> values;
  for (const auto& [theta, estimate, seconds] : results) {
    values.push_back(estimate.value);
    facts.evaluations = std::max(facts.evaluations, static_cast<double>(estimate.evaluations));
    if (estimate.status != Status::divergent && !(estimate.error <= facts.error))
      facts.error = estimate.error;  // keeps NaN
  }
  const Extent extent = extent_of(values);
  facts.max = extent.max;
  facts.min = extent.min;
  facts.mean = extent.mean;
  facts.at = [&results](double theta, double) {
    return std::ranges::find(results, theta, &Result::theta)->estimate.value;
  };
  return facts;
}

int run(const Arguments& arguments) {
  const std::unique_ptr<Model> model = arguments.model.make();
  check_answerable(
      arguments.assertions,
      [&](double theta, double phi) {
        return phi == arguments.phi && std::ranges::find(arguments.thetas, theta) != arguments.thetas.end();
      },
      "that direction is not among those of --theta and --phi");
  const std::vector<Result> results = compute(*model, arguments);
  if (arguments.options.json) {
    print_json(*model, arguments, results);
  } else {
    print_text(arguments.phi, results);
  }
  const auto missed = std::ranges::count_if(results, [](const Result& result) {
    return result.estimate.status != Status::converged && result.estimate.status != Status::divergent;
  });
  return concluding_exit_code(arguments.assertions, facts_of(results),
                              {results.size(), static_cast<std::size_t>(missed)});
}

}  // namespace

Command add_at(CLI::App& program) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* const app = program.add_subcommand("at", "the albedo for one or more directions");
  add_model_arguments(*app, arguments->model);
  app->add_option_function<std::string>(
         "--theta", [arguments](const std::string& text) { arguments->thetas = parse_angles("--theta", text); },
         "polar angles of L in degrees")
      ->type_name("DEG[,DEG]...")
      ->required();
  add_number(*app, "--phi", arguments->phi, "azimuth of L in degrees")->type_name("DEG");
  add_compute_options(*app, arguments->options);
  add_assert_option(*app, arguments->assertions);
  app->footer(
      "An albedo that is infinite (at 90 degrees, for some models) is 'inf', in JSON null, with the status "
      "'divergent'.\n"
      "--assert: max, min and mean are those of the results, error and evaluations the largest of one result.\n"
      "Example: Ward's model, and a check for continuous integration:\n"
      "  albedo at ward alpha=0.1 --theta 0,60,89.9 --assert 'at(60)==0.488988+-1e-6'");
  return {app, [arguments](const std::string&) { return run(*arguments); }};
}

}  // namespace albedo::analysis
