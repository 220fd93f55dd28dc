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
#include "analysis/text/progress.hpp"
#include "analysis/text/text.hpp"
#include "numerics/larger.hpp"
#include "numerics/parallel.hpp"

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
  std::string channel{};  ///< empty where there is only one
  double theta = 0;
  Estimate estimate{};
  double seconds = 0;
  double coherent = 0;  ///< the part of the albedo that is a delta in the mirror direction
};

bool any_coherent(const std::vector<Result>& results) {
  return std::ranges::any_of(results, [](const Result& result) { return result.coherent != 0; });
}

/// A model for each channel.
using Models = std::vector<std::pair<std::string, std::unique_ptr<Model>>>;

std::vector<Result> compute(const Models& models, const Arguments& arguments) {
  using Clock = std::chrono::steady_clock;
  std::vector<Direction> directions;  // refused in the order in which they are given
  for (const double theta : arguments.thetas) directions.push_back(Direction::from_degrees(theta, arguments.phi));
  std::vector<Result> results(models.size() * directions.size());
  ProgressBar progress;
  const auto compute_one = [&](std::size_t i) {
    const auto& [channel, model] = models[i / directions.size()];
    const std::size_t place = i % directions.size();
    const auto begin = Clock::now();
    const Estimate estimate = directional_albedo(*model, directions[place], arguments.options.albedo());
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    results[i] = {channel, arguments.thetas[place], estimate, seconds, model->coherent_albedo(directions[place])};
  };
  in_parallel(results.size(), arguments.options.threads, compute_one,
              [&](std::size_t done, std::size_t total) { progress.update(done, total); });
  return results;
}

void print_json(const Models& models, const Arguments& arguments, const std::vector<Result>& results) {
  Json object = model_json(*models.front().second, models.size() > 1);
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
    if (!result.channel.empty()) object["results"].back()["channel"] = result.channel;
    if (any_coherent(results)) object["results"].back()["coherent_albedo"] = result.coherent;
  }
  std::cout << json_text(object) << '\n';
}

void print_text(double phi, const std::vector<Result>& results) {
  std::vector<std::vector<std::string>> rows{{"theta", "phi", "albedo", "error", "evaluations", "status"}};
  const bool with_coherent = any_coherent(results);
  if (with_coherent) rows.front().emplace_back("coherent");
  const bool with_channel = !results.front().channel.empty();
  if (with_channel) rows.front().insert(rows.front().begin(), "channel");
  for (const auto& [channel, theta, estimate, seconds, coherent] : results) {
    rows.push_back({number_text(theta, 15), number_text(phi, 15), number_text(estimate.value, 15),
                    number_text(estimate.error, 2), std::to_string(estimate.evaluations),
                    std::string(to_string(estimate.status))});
    if (with_coherent) rows.back().push_back(number_text(coherent, 15));
    if (with_channel) rows.back().insert(rows.back().begin(), channel);
  }
  print_columns(std::cout, rows);
}

/// Extremes of the results; the error is the largest of a finite albedo.
Facts facts_of(const std::vector<Result>& results) {
  Facts facts;
  std::vector<double> values;
  for (const auto& [channel, theta, estimate, seconds, coherent] : results) {
    values.push_back(estimate.value);
    facts.evaluations = std::max(facts.evaluations, static_cast<double>(estimate.evaluations));
    if (estimate.status != Status::divergent) keep_larger(facts.error, estimate.error);
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
  const std::vector<std::string> channels = arguments.model.channels();
  check_one_channel(arguments.assertions, channels);
  Models models;
  for (const std::string& channel : channels) models.emplace_back(channel, arguments.model.make(channel));
  check_answerable(
      arguments.assertions,
      [&](double theta, double phi) {
        return phi == arguments.phi && std::ranges::find(arguments.thetas, theta) != arguments.thetas.end();
      },
      "that direction is not among those of --theta and --phi");
  const std::vector<Result> results = compute(models, arguments);
  if (arguments.options.json) {
    print_json(models, arguments, results);
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

Command add_at(ProgramSyntax& program) {
  const auto arguments = std::make_shared<Arguments>();
  const Syntax app = program.subcommand("at", "the albedo for one or more directions");
  add_model_arguments(app, arguments->model);
  app.parsed(
         "--theta", [arguments](const std::string& text) { arguments->thetas = parse_angles("--theta", text); },
         "polar angles of L in degrees")
      .type_name("DEG[,DEG]...")
      .required();
  add_number(app, "--phi", arguments->phi, "azimuth of L in degrees").type_name("DEG");
  add_compute_options(app, arguments->options);
  add_assert_option(app, arguments->assertions);
  app.footer(
      "An albedo that is infinite (at 90 degrees, for some models) is 'inf', in JSON null, with the status "
      "'divergent'.\n"
      "Where a part of the albedo is a delta in the mirror direction (he_torrance), 'coherent' tells how much.\n"
      "--assert: max, min and mean are those of the results, error and evaluations the largest of one result.\n"
      "Example: Ward's model, and a check for continuous integration:\n"
      "  albedo at ward alpha=0.1 --theta 0,60,89.9 --assert 'at(60)==0.488988+-1e-6'\n"
      "A sum of models, each with its parameters behind a colon; weight=0.5 among them halves a part:\n"
      "  albedo at sum lambert:rho=0.2 ward:alpha=0.1,rho_s=0.3 --theta 0,60\n"
      "A polished or rough surface over a matte body that gets what the surface leaves (r_m: the body's reflectance):\n"
      "  albedo at coupled ggx:alpha=0.2,f0=0.04 r_m=0.5 --theta 0,60\n"
      "A measured material, a result for each of its channels or, with channel=R, one; its table isn't smooth:\n"
      "  albedo at measured file=material.bsdf --theta 0,60 --rule cubature --tolerance 1e-3");
  return {app, [arguments](const std::string&) { return run(*arguments); }};
}

}  // namespace albedo::analysis
