#include <algorithm>
#include <iostream>
#include <memory>

#include "albedo/core/errors.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/commands/options.hpp"
#include "analysis/studies/pumping.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  ModelArguments model;
  PumpOptions options{.times = 10};
  std::vector<Correction> corrections;
  double rho = 1;
  bool json = false;
};

/// The study of one channel; its name is empty where there is only one.
struct ChannelStudy {
  std::string channel;
  std::unique_ptr<Model> model;
  PumpStudy study;
  std::vector<CorrectedModel> corrected{};
};

Json numbers_json(const PumpedOrder& order) {
  return {{"largest", order.largest},
          {"smallest", order.smallest},
          {"average", order.average},
          {"distance", order.distance},
          {"relative_bound", order.relative_bound},
          {"radiance", order.radiance},
          {"radiance_theta_l_deg", order.theta_l},
          {"radiance_theta_v_deg", order.theta_v},
          {"evaluations", order.evaluations},
          {"seconds", order.seconds}};
}

Json study_json(const ChannelStudy& one) {
  const PumpStudy& study = one.study;
  Json object{{"status", to_string(study.status)}, {"worth", nullptr}, {"orders", Json::array()}};
  if (study.worth() >= 0) object["worth"] = study.worth();
  for (std::size_t k = 0; k < study.orders.size(); ++k) {
    Json order{{"times", k}};
    order.update(numbers_json(study.orders[k]));
    object["orders"].push_back(std::move(order));
  }
  for (const CorrectedModel& corrected : one.corrected) {
    Json& entry = object["corrections"][std::string(name_of(corrected.correction))] = numbers_json(corrected.numbers);
    entry["status"] = to_string(corrected.status);
    if (corrected.correction == Correction::balance) {
      entry["iterations"] = corrected.iterations;
      entry["rate"] = corrected.rate;
    }
  }
  return object;
}

void print_json(const Arguments& arguments, const std::vector<ChannelStudy>& studies) {
  Json object = model_json(*studies.front().model, studies.size() > 1);
  object["control"] = name_of(arguments.options.control);
  object["only_up"] = arguments.options.only_up;
  object["tolerance"] = arguments.options.tolerance;
  for (const ChannelStudy& one : studies) {
    if (studies.size() == 1) {
      object.update(study_json(one));
    } else {
      object["channels"][one.channel] = study_json(one);
    }
  }
  std::cout << json_text(object) << '\n';
}

void print_text(const ChannelStudy& one) {
  if (!one.channel.empty()) std::cout << "channel " << one.channel << '\n';
  std::vector<std::vector<std::string>> rows{{"times", "largest", "smallest", "average", "distance", "bound",
                                              "radiance", "theta L", "theta V", "evaluations", "ms"}};
  const auto add = [&](const std::string& name, const PumpedOrder& order) {
    rows.push_back({name, number_text(order.largest, 10), number_text(order.smallest, 10),
                    number_text(order.average, 10), number_text(order.distance, 3),
                    number_text(order.relative_bound, 2), number_text(order.radiance, 7), number_text(order.theta_l, 4),
                    number_text(order.theta_v, 4), std::to_string(order.evaluations),
                    number_text(order.seconds * 1000, 3)});
  };
  for (std::size_t k = 0; k < one.study.orders.size(); ++k) add(std::to_string(k), one.study.orders[k]);
  for (const CorrectedModel& corrected : one.corrected) {
    add(std::string(name_of(corrected.correction)), corrected.numbers);
  }
  print_columns(std::cout, rows);
  for (const CorrectedModel& corrected : one.corrected) {
    if (corrected.correction != Correction::balance) continue;
    std::cout << "balance: " << corrected.iterations << " iterations, the last of them each made the error "
              << number_text(corrected.rate, 2) << " times what it was\n";
  }
  const int worth = one.study.worth();
  std::cout << "worth pumping: "
            << (worth < 0    ? "every time so far"
                : worth == 0 ? "not at all"
                : worth == 1 ? "once"
                             : std::to_string(worth) + " times")
            << '\n';
}

constexpr double curve_tolerance = 1e-7;  // of corrected models' albedos, at best

int run(const Arguments& arguments) {
  std::vector<ChannelStudy> studies;
  for (const std::string& channel : arguments.model.channels()) {
    studies.push_back({channel, arguments.model.make(channel), {}});
    studies.back().study = study_pumping(*studies.back().model, arguments.options);
    for (const Correction correction : arguments.corrections) {
      if (correction == Correction::none) continue;
      studies.back().corrected.push_back(study_correction(arguments.model.make(channel), correction, arguments.rho,
                                                          std::max(arguments.options.tolerance, curve_tolerance)));
    }
  }
  if (arguments.json) {
    print_json(arguments, studies);
  } else {
    for (const ChannelStudy& one : studies) print_text(one);
  }
  for (const ChannelStudy& one : studies) {
    for (const CorrectedModel& corrected : one.corrected) {
      if (corrected.status == Status::converged) continue;
      std::cerr << "albedo: " << name_of(corrected.correction) << " did not reach the tolerance"
                << (corrected.iterations > 0 ? ": the iteration doesn't settle, or the table is too coarse" : "")
                << '\n';
      return exit_code::not_converged;
    }
    if (one.study.status == Status::converged) continue;
    std::cerr << "albedo: the tables did not reach the tolerance; they are upper bounds all the same\n";
    return exit_code::not_converged;
  }
  return exit_code::done;
}

}  // namespace

Command add_pump(ProgramSyntax& program) {
  const auto arguments = std::make_shared<Arguments>();
  const Syntax app =
      program.subcommand("pump", "the albedo pumped up again and again: what it gains, and what it costs");
  add_model_arguments(app, arguments->model, false);
  add_integer(app, "--times", arguments->options.times, 0, PumpOptions::most_times, "how often; default 10");
  add_pump_kind(app, arguments->options);
  add_real(app, "--tolerance", arguments->options.tolerance, 1e-12, 0.1, "relative, of the albedos");
  add_choices(app, "--correct", all_corrections, arguments->corrections,
              "other corrections of the model itself, for comparison, a row each");
  add_real(app, "--rho", arguments->rho, 0, 1, "albedo that balance reaches; share of the lost light for the others");
  app.flag("--json", arguments->json, "print one JSON object");
  app.footer(
      "largest, smallest: albedo over all angles of L, the limit at 90 degrees included; average: under light from\n"
      "everywhere; distance: largest |albedo - 1|; bound: relative error of these albedos, by which the tables that\n"
      "pumping divides by are raised; radiance: largest output over input radiance, f N.L, in the plane of incidence\n"
      "up to 89.9 degrees, and where. It is worth pumping until the average gains less than 1 %.\n"
      "An anisotropic model's albedo is the largest over the azimuth of L. Rows of --correct have their albedos from "
      "a\n"
      "curve of the corrected model, to 1e-7.\n"
      "Example: Phong's and Blinn's models with the floor max(N.L, N.V), which leads to Neumann's eq. 22\n"
      "  albedo pump phong n=20 --times 5 --control total\n"
      "  albedo pump blinn n=20 --times 5 --control total\n"
      "and every way to conserve energy side by side\n"
      "  albedo pump ggx alpha=0.5 --times 3 --correct balance,multiscatter,turquin");
  return {app, [arguments](const std::string&) { return run(*arguments); }};
}

}  // namespace albedo::analysis
