#include "analysis/studies/stability.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "albedo/core/errors.hpp"
#include "analysis/studies/methods.hpp"
#include "analysis/studies/textbook_form.hpp"

namespace albedo::analysis {
namespace {

template <class T>
UnitVector<T> direction(double theta, double phi) {
  return unit_vector<T>(Direction::from_degrees(theta, phi));
}

TEST(TextbookForm, IsTheSamePairWithRoundingErrors) {
  for (const double theta : {0.0, 20.0, 60.0, 85.0}) {
    const auto l = direction<double>(40, 30), v = direction<double>(theta, 200);
    const UnitVector<double> mirror{-l.x, -l.y, l.z};
    const DirectionPair<double> exact = direction_pair(l, v, mirror), book = textbook_pair(l, v, mirror);
    EXPECT_NEAR(book.cos_theta_d, exact.cos_theta_d, 1e-15);
    EXPECT_NEAR(book.cos_theta_h, exact.cos_theta_h, 1e-15);
    EXPECT_NEAR(book.slope_x, exact.slope_x, 1e-13);
    EXPECT_NEAR(book.slope_y, exact.slope_y, 1e-13);
    EXPECT_NEAR(book.axis_gap, exact.axis_gap, 1e-15);
  }
}

TEST(TextbookForm, LosesSmallSlopesInFloat) {
  const auto l = direction<float>(40, 0), v = direction<float>(40.01, 180);
  const UnitVector<float> mirror{-l.x, -l.y, l.z};
  const double slope = std::tan(0.005 * pi<double> / 180);
  const double lost = std::abs(std::abs(double{textbook_pair(l, v, mirror).slope_x}) / slope - 1);
  const double kept = std::abs(std::abs(double{direction_pair(l, v, mirror).slope_x}) / slope - 1);
  EXPECT_LT(kept, 1e-2);
  EXPECT_GT(lost, 1e-1);
}

TEST(TextbookForm, HalfVectorAlongTheNormalIsNotNaN) {
  const auto l = direction<float>(30, 0);
  const UnitVector<float> mirror{-l.x, -l.y, l.z};
  const DirectionPair<float> pair = textbook_pair(l, mirror, mirror);
  EXPECT_TRUE(std::isfinite(pair.slope_x));
  EXPECT_EQ(pair.slope_y, 0);
}

TEST(Verdicts, SayWhatAnAnswerIsWorth) {
  const Estimate truth{.value = 0.5, .error = 1e-12};
  const auto verdict = [&truth](double value, Status status) {
    return judge({.value = value, .error = 1e-5, .status = status}, truth, 1e-4);
  };
  EXPECT_EQ(verdict(0.50004, Status::converged), Verdict::right);
  EXPECT_EQ(verdict(0.49996, Status::budget_exhausted), Verdict::right_unconverged);
  EXPECT_EQ(verdict(0.50006, Status::converged), Verdict::wrong);
  EXPECT_EQ(verdict(0, Status::converged), Verdict::wrong);
  EXPECT_EQ(verdict(0.6, Status::rounding_limited), Verdict::unconverged);
  EXPECT_EQ(verdict(std::numeric_limits<double>::quiet_NaN(), Status::converged), Verdict::non_finite);
  EXPECT_EQ(verdict(std::numeric_limits<double>::infinity(), Status::budget_exhausted), Verdict::non_finite);
  EXPECT_EQ(judge({.value = 0.5}, {.value = 0.5, .error = 1e-3}, 1e-4), Verdict::unknown);
}

TEST(Atlas, SpansWhatItSays) {
  const Atlas atlas = compute_atlas({.models = {"ward", "phong"},
                                     .rules = {Rule::gauss},
                                     .warps = {Warp::lobe},
                                     .forms = {Form::float64},
                                     .incidences = 3,
                                     .widths = 2});
  ASSERT_EQ(atlas.surfaces.size(), 3U);
  EXPECT_EQ(atlas.from_grazing.front(), 90);
  EXPECT_EQ(atlas.from_grazing.back(), 1e-10);
  EXPECT_EQ(atlas.surfaces[0].values, (std::vector<double>{1e-5, 5}));
  EXPECT_EQ(atlas.surfaces[2].values, (std::vector<double>{1e7, 0}));
  EXPECT_EQ(atlas.surfaces[1].parameters(5), (Parameters{{"alpha_x", 5.0}, {"alpha_y", 5e-3}}));
  EXPECT_EQ(atlas.surfaces[1].parameters(1e-5), (Parameters{{"alpha_x", 1e-5}, {"alpha_y", 1e-6}}));  // its range
  EXPECT_EQ(atlas.answers.size(), 18U);
  EXPECT_EQ(std::ranges::count(atlas.answers, Verdict::unknown, &Answer::verdict), 0);
  EXPECT_THROW(compute_atlas({.models = {"lambert"}}), ParameterError);
  EXPECT_THROW(compute_atlas({.models = {"wardd"}}), UnknownModel);
}

struct LobeAtlas : testing::TestWithParam<Rule> {};

/// In double and on the exact domain nothing is silently wrong, whatever the rule.
TEST_P(LobeAtlas, NothingIsSilentlyWrong) {
  const Atlas atlas = compute_atlas(
      {.rules = {GetParam()}, .warps = {Warp::lobe}, .forms = {Form::float64}, .incidences = 7, .widths = 6});
  EXPECT_EQ(atlas.answers.size(), 8U * 7 * 6);
  EXPECT_EQ(std::ranges::count(atlas.answers, Verdict::wrong, &Answer::verdict), 0);
  EXPECT_EQ(std::ranges::count(atlas.answers, Verdict::non_finite, &Answer::verdict), 0);
  EXPECT_EQ(std::ranges::count(atlas.answers, Verdict::unknown, &Answer::verdict), 0);
}
INSTANTIATE_TEST_SUITE_P(Atlas, LobeAtlas,
                         testing::Values(Rule::gauss, Rule::cubature, Rule::stratified, Rule::sobol, Rule::monte_carlo),
                         [](const auto& instance) { return std::string(name_of(instance.param)); });

/// The gauss rule also says that it is right.
TEST(Atlas, CanLeaveOutWhatIsIsotropic) {
  const Atlas atlas = compute_atlas({.models = {"ward", "phong"},
                                     .rules = {Rule::gauss},
                                     .warps = {Warp::lobe},
                                     .forms = {Form::float64},
                                     .isotropic = false,
                                     .incidences = 2,
                                     .widths = 2});
  ASSERT_EQ(atlas.surfaces.size(), 2U);
  EXPECT_EQ(atlas.surfaces[0].anisotropy, 1000);
  EXPECT_EQ(atlas.surfaces[1].model, "phong");
}

TEST(Atlas, GaussIsRightEverywhere) {
  const Atlas atlas = compute_atlas(
      {.rules = {Rule::gauss}, .warps = {Warp::lobe}, .forms = {Form::float64}, .incidences = 7, .widths = 6});
  EXPECT_EQ(std::ranges::count(atlas.answers, Verdict::right, &Answer::verdict), std::ssize(atlas.answers));
}

/// A needle in float: invariants keep what the textbook form loses, and the rule can't know.
TEST(Atlas, SeesWhereTheTextbookFormLosesItsDigits) {
  const Atlas atlas = compute_atlas({.models = {"ward", "cook_torrance", "phong"},
                                     .rules = {Rule::gauss},
                                     .warps = {Warp::lobe},
                                     .anisotropy = 1,
                                     .incidences = 4,
                                     .widths = 4,
                                     .tolerance = 1e-3,
                                     .budget = 20'000});
  const auto normal_incidence = [&atlas](std::size_t surface, std::size_t width, Form form) {
    return atlas.answer(atlas.cell(surface, width, 0), static_cast<std::size_t>(form)).verdict;
  };
  for (std::size_t surface = 0; surface < 3; ++surface) {
    EXPECT_EQ(normal_incidence(surface, 0, Form::float64), Verdict::right) << surface;
    EXPECT_EQ(normal_incidence(surface, 0, Form::float32), Verdict::right) << surface;
    EXPECT_NE(normal_incidence(surface, 0, Form::textbook_float), Verdict::right) << surface;
    EXPECT_EQ(normal_incidence(surface, 3, Form::textbook_float), Verdict::right) << surface;
  }
}

TEST(Atlas, TheSameForAnyNumberOfThreads) {
  AtlasOptions options{.models = {"ggx"}, .incidences = 3, .widths = 3, .budget = 10'000, .threads = 1};
  const Atlas one = compute_atlas(options);
  options.threads = 3;
  const Atlas three = compute_atlas(options);
  for (std::size_t i = 0; i < one.answers.size(); ++i) {
    EXPECT_EQ(one.answers[i].verdict, three.answers[i].verdict) << i;
    EXPECT_EQ(one.answers[i].estimate.evaluations, three.answers[i].estimate.evaluations) << i;
    if (!std::isnan(one.answers[i].estimate.value)) {
      EXPECT_EQ(one.answers[i].estimate.value, three.answers[i].estimate.value) << i;
    }
  }
}

}  // namespace
}  // namespace albedo::analysis
