#include <iostream>
#include <memory>

#include "albedo/core/errors.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/commands/options.hpp"
#include "analysis/commands/text.hpp"
#include "analysis/studies/pumping.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  ModelArguments model;
  PumpOptions options{.times = 10};
  bool json = false;
};

/// The study of one channel; its name is empty where there is only one.
struct ChannelStudy {
  std::string channel;
  std::unique_ptr<Model> model;
  PumpStudy study;
};

Json study_json(const PumpStudy& study) {
  Json object{{"status", to_string(study.status)}, {"worth", nullptr}, {"orders", Json::array()}};
  if (study.worth() >= 0) object["worth"] = study.worth();
  for (std::size_t k = 0; k < study.orders.size(); ++k) {
    const PumpedOrder& order = study.orders[k];
    object["orders"].push_back({{"times", k},
                                {"largest", order.largest},
                                {"smallest", order.smallest},
                                {"average", order.average},
                                {"distance", order.distance},
                                {"relative_bound", order.relative_bound},
                                {"radiance", order.radiance},
                                {"radiance_theta_l_deg", order.theta_l},
                                {"radiance_theta_v_deg", order.theta_v},
                                {"evaluations", order.evaluations},
                                {"seconds", order.seconds}});
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
      object.update(study_json(one.study));
    } else {
      object["channels"][one.channel] = study_json(one.study);
    }
  }
  std::cout << json_text(object) << '\n';
}

void print_text(const ChannelStudy& one) {
  if (!one.channel.empty()) std::cout << "channel " << one.channel << '\n';
  std::vector<std::vector<std::string>> rows{{"times", "largest", "smallest", "average", "distance", "bound",
                                              "radiance", "theta L", "theta V", "evaluations", "ms"}};
  for (std::size_t k = 0; k < one.study.orders.size(); ++k) {
    const PumpedOrder& order = one.study.orders[k];
    rows.push_back({std::to_string(k), number_text(order.largest, 10), number_text(order.smallest, 10),
                    number_text(order.average, 10), number_text(order.distance, 3),
                    number_text(order.relative_bound, 2), number_text(order.radiance, 7), number_text(order.theta_l, 4),
                    number_text(order.theta_v, 4), std::to_string(order.evaluations),
                    number_text(order.seconds * 1000, 3)});
  }
  print_columns(std::cout, rows);
  const int worth = one.study.worth();
  std::cout << "worth pumping: "
            << (worth < 0    ? "every time so far"
                : worth == 0 ? "not at all"
                : worth == 1 ? "once"
                             : std::to_string(worth) + " times")
            << '\n';
}

int run(const Arguments& arguments) {
  std::vector<ChannelStudy> studies;
  for (const std::string& channel : arguments.model.channels()) {
    studies.push_back({channel, arguments.model.make(channel), {}});
    studies.back().study = study_pumping(*studies.back().model, arguments.options);
  }
  if (arguments.json) {
    print_json(arguments, studies);
  } else {
    for (const ChannelStudy& one : studies) print_text(one);
  }
  for (const ChannelStudy& one : studies) {
    if (one.study.status == Status::converged) continue;
    std::cerr << "albedo: the tables did not reach the tolerance; they are upper bounds all the same\n";
    return exit_code::not_converged;
  }
  return exit_code::done;
}

}  // namespace

Command add_pump(CLI::App& program) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* const app =
      program.add_subcommand("pump", "the albedo pumped up again and again: what it gains, and what it costs");
  add_model_arguments(*app, arguments->model, false);
  add_integer(*app, "--times", arguments->options.times, 0, PumpOptions::most_times, "how often; default 10");
  add_pump_kind(*app, arguments->options);
  add_real(*app, "--tolerance", arguments->options.tolerance, 1e-12, 0.1, "relative, of the albedos");
  app->add_flag("--json", arguments->json, "print one JSON object");
  app->footer(
      "largest, smallest: albedo over all angles of L, the limit at 90 degrees included; average: under light from\n"
      "everywhere; distance: largest |albedo - 1|; bound: relative error of these albedos, by which the tables that\n"
      "pumping divides by are raised; radiance: largest output over input radiance, f N.L, in the plane of incidence\n"
      "up to 89.9 degrees, and where. It is worth pumping until the average gains less than 1 %.\n"
      "An anisotropic model's albedo is the largest over the azimuth of L.\n"
      "Example: Phong's and Blinn's models with the floor max(N.L, N.V), which leads to Neumann's eq. 22\n"
      "  albedo pump phong n=20 --times 5 --control total\n"
      "  albedo pump blinn n=20 --times 5 --control total");
  return {app, [arguments](const std::string&) { return run(*arguments); }};
}

}  // namespace albedo::analysis
