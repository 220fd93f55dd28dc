#include "analysis/studies/honesty.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

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
  for (const ModelInfo& info : model_infos()) models.push_back(info.name);
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

/// At most one miss in a thousand, and never by more than ten times the reported error.
TEST(HonestyStudy, GaussIsHonest) {
  const Honesty honesty = study_honesty({.cases = 400, .seed = 2024, .rules = {Rule::gauss}, .quad_every = 0});
  const RuleHonesty& gauss = of(honesty, Rule::gauss);
  EXPECT_GE(gauss.converged, 380U);
  EXPECT_LE(gauss.converged - gauss.honest, 1U);
  EXPECT_EQ(gauss.far_off, 0U);
  EXPECT_EQ(gauss.non_finite, 0U);
  EXPECT_LE(honesty.without_reference, 8U);
}

TEST(HonestyStudy, OtherDeterministicRulesAreHonest) {
  const Honesty honesty = study_honesty(
      {.cases = 100, .seed = 2024, .rules = {Rule::cubature, Rule::kronrod, Rule::tanh_sinh}, .quad_every = 0});
  for (const RuleHonesty& rule : honesty.rules) {
    EXPECT_GE(rule.converged, 70U);
    EXPECT_LE(rule.converged - rule.honest, 1U);
    EXPECT_EQ(rule.far_off, 0U);
  }
}

/// Within four deviations of the binomial noise from what Student's distribution says.
TEST(HonestyStudy, StandardErrorsCoverWhatTheyShould) {
  const Honesty honesty = study_honesty({.cases = 300, .seed = 2024, .rules = {Rule::stratified}, .quad_every = 0});
  const RuleHonesty& rule = of(honesty, Rule::stratified);
  ASSERT_GE(rule.converged, 200U);
  for (int k = 1; k <= 3; ++k) {
    const double nominal = nominal_coverage(Rule::stratified, k);
    const double count = static_cast<double>(rule.converged);
    const double noise = std::sqrt(nominal * (1 - nominal) / count);
    EXPECT_NEAR(static_cast<double>(rule.covered[static_cast<std::size_t>(k - 1)]) / count, nominal, 4 * noise) << k;
  }
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
