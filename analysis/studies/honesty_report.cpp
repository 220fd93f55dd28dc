#include "analysis/studies/honesty_report.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "analysis/studies/methods.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(part) / static_cast<double>(whole);
}

std::string percent(double share, int digits = 4) {
  return std::isnan(share) ? "-" : number_text(100 * share, digits) + " %";
}

double largest_ratio(const RuleHonesty& rule) { return rule.worst.empty() ? 0 : rule.worst.front().ratio; }

/// "coverage 66.9 % (nominal 66.7 ± 0.5 %)": the noise is that of so many cases.
std::string coverage_text(const RuleHonesty& rule, int k) {
  const double nominal = nominal_coverage(rule.rule, k);
  const double noise = std::sqrt(nominal * (1 - nominal) / static_cast<double>(rule.decidable()));
  return percent(share(rule.covered[static_cast<std::size_t>(k - 1)], rule.decidable())) + " (" + percent(nominal) +
         " +- " + percent(noise, 2) + ")";
}

std::string question_text(const Honesty& honesty, Rule rule, const Worst& worst) {
  const RandomCase question = random_case(honesty.options.seed, worst.index, honesty.options.models);
  return command_of(question, rule, honesty.options);
}

std::string answer_text(const Worst& worst) {
  return "off by " + number_text(worst.ratio, 3) + " reported errors: " + number_text(worst.answer.value, 15) + " +- " +
         number_text(worst.answer.error, 2) + ", true " + number_text(worst.reference.value, 15) + " +- " +
         number_text(worst.reference.error, 2);
}

}  // namespace

void print_honesty(const Honesty& honesty, std::ostream& out) {
  out << "Random cases: " << honesty.options.cases << ", seed " << honesty.options.seed << ", warp "
      << name_of(honesty.options.warp) << ". References that didn't converge: " << honesty.without_reference
      << "; contradicted by kronrod: " << honesty.disputed << "; compared with 113 bits: " << honesty.quad_checks
      << ", refuted: " << honesty.quad_refuted << ".\n\n";
  Rows rows{{"rule", "judged", "converged", "true <= reported", "> 10 x", "largest ratio", "unconverged honest",
             "non-finite"}};
  Rows coverage{{"rule", "answers", "within 1 (nominal)", "within 2", "within 3"}};
  for (const RuleHonesty& rule : honesty.rules) {
    const std::string name(name_of(rule.rule));
    if (is_monte_carlo(rule.rule)) {
      coverage.push_back({name, std::to_string(rule.decidable()), coverage_text(rule, 1), coverage_text(rule, 2),
                          coverage_text(rule, 3)});
    }
    rows.push_back({name, std::to_string(rule.judged), std::to_string(rule.converged),
                    percent(share(rule.honest, rule.converged), 6), std::to_string(rule.far_off),
                    rule.worst.empty() ? "-" : number_text(largest_ratio(rule), 3),
                    percent(share(rule.unconverged_honest, rule.judged - rule.converged)),
                    std::to_string(rule.non_finite)});
  }
  print_columns(out, rows);
  if (coverage.size() > 1) {
    out << "\nStandard errors, of what converged and isn't exact:\n";
    print_columns(out, coverage);
  }
  for (const RuleHonesty& rule : honesty.rules) {
    for (const Worst& worst : rule.worst) {
      out << '\n' << question_text(honesty, rule.rule, worst) << "\n  " << answer_text(worst) << '\n';
    }
  }
  for (const Worst& worst : honesty.disputes) {
    out << '\n'
        << command_of(random_case(honesty.options.seed, worst.index, honesty.options.models))
        << " --tolerance 1e-12\n  reference " << number_text(worst.answer.value, 15) << ", by --rule kronrod "
        << number_text(worst.reference.value, 15) << " +- " << number_text(worst.reference.error, 2) << '\n';
  }
  for (const Worst& worst : honesty.refuted) {
    out << '\n'
        << command_of(random_case(honesty.options.seed, worst.index, honesty.options.models))
        << " --precision quad --tolerance 1e-13\n  reference " << answer_text(worst) << '\n';
  }
}

Json honesty_json(const Honesty& honesty) {
  Json object{{"cases", honesty.options.cases},
              {"seed", honesty.options.seed},
              {"warp", name_of(honesty.options.warp)},
              {"models", honesty.options.models},
              {"without_reference", honesty.without_reference},
              {"disputed", honesty.disputed},
              {"quad_checks", honesty.quad_checks},
              {"quad_refuted", honesty.quad_refuted}};
  object["rules"] = Json::array();
  for (const RuleHonesty& rule : honesty.rules) {
    Json entry{{"rule", name_of(rule.rule)},    {"judged", rule.judged},
               {"converged", rule.converged},   {"honest", rule.honest},
               {"over_10_times", rule.far_off}, {"unconverged_honest", rule.unconverged_honest},
               {"non_finite", rule.non_finite}, {"undecidable", rule.undecidable},
               {"covered", rule.covered}};
    if (is_monte_carlo(rule.rule)) {
      entry["nominal"] = {nominal_coverage(rule.rule, 1), nominal_coverage(rule.rule, 2),
                          nominal_coverage(rule.rule, 3)};
    }
    entry["worst"] = Json::array();
    for (const Worst& worst : rule.worst) {
      entry["worst"].push_back({{"command", question_text(honesty, rule.rule, worst)},
                                {"ratio", worst.ratio},
                                {"albedo", worst.answer.value},
                                {"error", worst.answer.error},
                                {"reference", worst.reference.value},
                                {"reference_error", worst.reference.error}});
    }
    object["rules"].push_back(std::move(entry));
  }
  return object;
}

}  // namespace albedo::analysis
