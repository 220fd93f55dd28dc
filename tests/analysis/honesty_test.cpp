#include "analysis/studies/honesty.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/studies/methods.hpp"

namespace albedo::analysis {
namespace {

const RuleHonesty& of(const Honesty& honesty, Rule rule) {
  for (const RuleHonesty& entry : honesty.rules) {
    if (entry.rule == rule) return entry;
  }
  throw std::out_of_range("rule");
}

TEST(RandomCases, AreTheSameInAnyOrderAndCoverWhatTheyShould) {
  std::vector<std::string> models;
  for (const ModelInfo& info : model_infos()) {
    if (!info.needs_input()) models.push_back(info.name);
  }
  std::size_t grazing = 0, anisotropic = 0, wards = 0;
  std::vector<bool> seen(models.size(), false);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const RandomCase question = random_case(7, i, models);
    EXPECT_NO_THROW(make_model(question.model, question.parameters)) << command_of(question);
    seen[static_cast<std::size_t>(std::ranges::find(models, question.model) - models.begin())] = true;
    EXPECT_GE(question.theta_degrees, 0);
    EXPECT_LT(question.theta_degrees, 90);
    grazing += question.theta_degrees > 89.9 ? 1U : 0U;
    if (question.model != "ward") continue;
    ++wards;
    anisotropic += question.parameters[0].second != question.parameters[1].second ? 1U : 0U;
  }
  EXPECT_EQ(std::ranges::count(seen, false), 0);
  EXPECT_NEAR(static_cast<double>(grazing) / 2000, 0.5 * 9 / 11.95, 0.05);
  EXPECT_NEAR(static_cast<double>(anisotropic) / static_cast<double>(wards), 0.5, 0.25);
  EXPECT_EQ(command_of(random_case(7, 1234, models)), command_of(random_case(7, 1234, models)));
  EXPECT_NE(command_of(random_case(7, 1234, models)), command_of(random_case(8, 1234, models)));
}

/// The beginning of the sample that `albedo stability --honesty` takes.
Honesty sample(const std::vector<Rule>& rules, std::int64_t budget = HonestyOptions{}.budget) {
  return study_honesty({.cases = 2000, .seed = 1, .rules = rules, .budget = budget, .quad_every = 0});
}

std::string worst_of(const RuleHonesty& rule, const HonestyOptions& options) {
  std::string text;
  for (const Worst& worst : rule.worst) {
    const std::string command = command_of(random_case(options.seed, worst.index, options.models), rule.rule, options);
    text.append("\n").append(command).append(": ratio ").append(std::to_string(worst.ratio));
  }
  return text;
}

/// At most one miss in a thousand, and never by more than ten times the reported error.
void expect_true_errors(const std::vector<Rule>& rules) {
  const Honesty honesty = sample(rules);
  EXPECT_LE(honesty.without_reference, 20U);
  EXPECT_LE(honesty.disputed, 1U);  // a subnormal albedo
  for (const RuleHonesty& rule : honesty.rules) {
    const std::string context = name_of(rule.rule) + worst_of(rule, honesty.options);
    EXPECT_GE(rule.judged, 1980U) << context;
    EXPECT_GE(rule.converged, 1800U) << context;
    EXPECT_GE(static_cast<double>(rule.honest), 0.999 * static_cast<double>(rule.converged)) << context;
    EXPECT_EQ(rule.far_off, 0U) << context;
    EXPECT_EQ(rule.non_finite, 0U) << context;
  }
}

TEST(HonestyStudy, GaussAndKronrodReportErrorsThatAreTrue) { expect_true_errors({Rule::gauss, Rule::kronrod}); }
TEST(HonestyStudy, CubatureReportsErrorsThatAreTrue) { expect_true_errors({Rule::cubature}); }
TEST(HonestyStudy, TanhSinhReportsErrorsThatAreTrue) { expect_true_errors({Rule::tanh_sinh}); }

/// Within four deviations of the binomial noise from what Student's or the normal distribution says. The error of sobol
/// is the standard error or a quarter of that of half the points, whichever is larger: it may cover more.
TEST(HonestyStudy, StandardErrorsCoverWhatTheyShould) {
  const Honesty honesty = sample({Rule::stratified, Rule::sobol, Rule::monte_carlo}, 100'000);
  for (const RuleHonesty& rule : honesty.rules) {
    const std::string context = name_of(rule.rule) + worst_of(rule, honesty.options);
    EXPECT_GE(rule.decidable(), 1000U) << context;
    EXPECT_EQ(rule.non_finite, 0U) << context;
    const auto count = static_cast<double>(rule.decidable());
    for (int k = 1; k <= 3; ++k) {
      const double nominal = nominal_coverage(rule.rule, k);
      const double noise = std::sqrt(nominal * (1 - nominal) / count);
      const double covered = static_cast<double>(rule.covered[static_cast<std::size_t>(k - 1)]) / count;
      EXPECT_GE(covered, nominal - 4 * noise) << k << " standard errors, " << context;
      if (rule.rule == Rule::sobol) continue;
      EXPECT_LE(covered, nominal + 4 * noise) << k << " standard errors, " << context;
    }
  }
}

/// What every rule gets exactly says nothing of standard errors.
TEST(HonestyStudy, BlackIsUndecidable) {
  const std::vector<std::string> models{"lambert"};
  const Honesty honesty = study_honesty({.cases = 200, .rules = {Rule::stratified}, .models = models, .quad_every = 0});
  std::uint64_t black = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    if (random_case(1, i, models).parameters == Parameters{{"rho", 0.0}}) ++black;
  }
  EXPECT_GT(black, 10U);
  EXPECT_EQ(of(honesty, Rule::stratified).undecidable, black);
}

TEST(HonestyStudy, NominalCoverageIsStudents) {
  EXPECT_NEAR(nominal_coverage(Rule::stratified, 1), 0.66683, 1e-5);  // tables of t with 15 degrees of freedom
  EXPECT_NEAR(nominal_coverage(Rule::monte_carlo, 2), 0.9544997, 1e-7);
}

TEST(HonestyStudy, TheSameForAnyNumberOfThreads) {
  const HonestyOptions one{.cases = 40, .rules = {Rule::gauss, Rule::sobol}, .budget = 50'000, .threads = 1};
  HonestyOptions three = one;
  three.threads = 3;
  const Honesty a = study_honesty(one), b = study_honesty(three);
  for (std::size_t i = 0; i < a.rules.size(); ++i) {
    EXPECT_EQ(a.rules[i].converged, b.rules[i].converged);
    EXPECT_EQ(a.rules[i].covered, b.rules[i].covered);
  }
}

}  // namespace
}  // namespace albedo::analysis
