#include <cmath>

#include "property/battery.hpp"

/// Every pair of methods agrees: seven rules, three warps. The gauss rule on the lobe's own warp is what the others are
/// held against; honesty_test.cpp holds that one against 113 bits.
namespace albedo {
namespace {

using battery::Case;

bool has_samplers(const Model& model) {
  const auto lobes = model.lobes();
  return std::all_of(lobes.begin(), lobes.end(), [&](const Lobe& lobe) { return model.has_sampler(lobe.component); });
}

struct Agreement : battery::PerModel {};

constexpr double most_standard_errors = 4;

Estimate reference(const Model& model, const Direction& l) {
  const Estimate e = directional_albedo(model, l, {.tolerance = 1e-10});
  EXPECT_EQ(e.status, Status::converged);
  return e;
}

/// |difference| over what the two estimates allow.
double disagreement(const Estimate& e, const Estimate& truth) {
  const double sigmas = e.error_kind == ErrorKind::standard_error ? most_standard_errors : 1;
  const double difference = std::abs(e.value - truth.value);
  return difference == 0 ? 0 : difference / (sigmas * e.error + truth.error);
}

TEST_P(Agreement, CubatureAgreesWithGauss) {
  for (const Case& c : battery::cases_of(GetParam())) {
    const auto model = make_model(c.model, c.parameters);
    for (const double theta : battery::thetas) {
      const Direction l = Direction::from_degrees(theta, c.phi);
      const Estimate e = directional_albedo(*model, l, {.rule = Rule::cubature, .tolerance = 1e-5});
      EXPECT_EQ(e.status, Status::converged) << battery::name(c, theta) << ": " << battery::text(e);
      const Estimate truth = reference(*model, l);
      EXPECT_LE(disagreement(e, truth), 1)
          << battery::name(c, theta) << "\n  cubature " << battery::text(e) << "\n  gauss    " << battery::text(truth);
    }
  }
}

TEST_P(Agreement, StratifiedIsWithinFourStandardErrorsOfGauss) {
  for (const Case& c : battery::cases_of(GetParam())) {
    const auto model = make_model(c.model, c.parameters);
    for (const double theta : battery::thetas) {
      const Direction l = Direction::from_degrees(theta, c.phi);
      const Estimate e =
          directional_albedo(*model, l, {.rule = Rule::stratified, .tolerance = 1e-3, .budget = 200'000, .seed = 7});
      const Estimate truth = reference(*model, l);
      EXPECT_NE(e.status, Status::non_finite) << battery::name(c, theta);
      EXPECT_LE(disagreement(e, truth), 1) << battery::name(c, theta) << "\n  stratified " << battery::text(e)
                                           << "\n  gauss      " << battery::text(truth);
    }
  }
}

/// On (θ_V, φ_V) a rule doesn't know where a needle is: it is right, or it says that it has not converged.
TEST_P(Agreement, OnTheHemisphereRulesAreRightOrNotConverged) {
  int converged = 0;
  for (const Case& c : battery::cases_of(GetParam())) {
    const auto model = make_model(c.model, c.parameters);
    for (const double theta : battery::thetas) {
      const Direction l = Direction::from_degrees(theta, c.phi);
      const Estimate truth = reference(*model, l);
      for (const Rule rule : {Rule::gauss, Rule::cubature, Rule::stratified}) {
        const double tolerance = rule == Rule::stratified ? 1e-2 : 1e-4;
        const Estimate e = directional_albedo(
            *model, l, {.rule = rule, .warp = Warp::hemisphere, .tolerance = tolerance, .budget = 100'000, .seed = 11});
        if (e.status != Status::converged) continue;
        ++converged;
        EXPECT_LE(disagreement(e, truth), 1)
            << battery::name(c, theta) << ", rule " << static_cast<int>(rule) << "\n  hemisphere " << battery::text(e)
            << "\n  lobe       " << battery::text(truth);
      }
    }
  }
  RecordProperty("converged", converged);
  EXPECT_GT(converged, 0);
}

/// A model's ordinary cases, or its series, the first two.
std::vector<Case> gentle_cases(const std::string& model) {
  std::vector<Case> found;
  for (const Case& c : battery::cases_of(model)) {
    const bool gentle = c.shape == battery::Shape::ordinary || c.shape == battery::Shape::series;
    if (gentle && found.size() < 2) found.push_back(c);
  }
  return found;
}

TEST_P(Agreement, EveryRuleOnEveryWarpIsRightOrNotConverged) {
  constexpr std::int64_t budget = 30'000;
  int converged = 0;
  for (const Case& c : gentle_cases(GetParam())) {
    const auto model = make_model(c.model, c.parameters);
    for (const double theta : {0.0, 60.0, 85.0, 89.9}) {
      const Direction l = Direction::from_degrees(theta, c.phi);
      const Estimate truth = reference(*model, l);
      for (const Rule rule : {Rule::gauss, Rule::cubature, Rule::kronrod, Rule::tanh_sinh, Rule::stratified,
                              Rule::sobol, Rule::monte_carlo}) {
        for (const Warp warp : {Warp::lobe, Warp::hemisphere, Warp::paper}) {
          if (warp == Warp::paper && !has_samplers(*model)) continue;
          const double tolerance = is_monte_carlo(rule) ? 5e-3 : 1e-5;
          const Estimate e = directional_albedo(
              *model, l, {.rule = rule, .warp = warp, .tolerance = tolerance, .budget = budget, .seed = 17});
          const std::string what = battery::name(c, theta) + ", rule " + std::to_string(static_cast<int>(rule)) +
                                   ", warp " + std::to_string(static_cast<int>(warp)) + "\n  answer " +
                                   battery::text(e) + "\n  truth  " + battery::text(truth);
          EXPECT_NE(e.status, Status::non_finite) << what;
          EXPECT_EQ(e.error_kind == ErrorKind::standard_error, is_monte_carlo(rule)) << what;
          EXPECT_LE(e.evaluations, budget) << what;
          if (e.status == Status::converged) {
            ++converged;
            EXPECT_LE(disagreement(e, truth), 1) << what;
          }
          // heavy tails and rims that no panel knows of take more than this budget
          const bool needs_no_luck = warp == Warp::lobe && rule != Rule::monte_carlo && rule != Rule::tanh_sinh;
          if (needs_no_luck && c.model != "ggx" && c.model != "edwards" && rule != Rule::stratified) {
            EXPECT_EQ(e.status, Status::converged) << what;
          }
        }
      }
    }
  }
  EXPECT_GT(converged, 0);
}

/// Where every lobe can be sampled: the mean of f cosθ_V/density is the albedo.
TEST_P(Agreement, PublishedSamplingHasTheAlbedoAsItsMean) {
  for (const Case& c : battery::cases_of(GetParam())) {
    const auto model = make_model(c.model, c.parameters);
    if (!has_samplers(*model)) continue;
    for (const double theta : {10.0, 70.0}) {
      const Direction l = Direction::from_degrees(theta, c.phi);
      const Estimate e = directional_albedo(
          *model, l, {.rule = Rule::sobol, .warp = Warp::paper, .tolerance = 1e-3, .budget = 16 * 2048, .seed = 5});
      const Estimate truth = reference(*model, l);
      // a tail that no point of the sample met is in no standard error: what is left of it is small
      EXPECT_LE(std::abs(e.value - truth.value), 5 * e.error + 1e-4 * truth.value)
          << battery::name(c, theta) << "\n  paper " << battery::text(e) << "\n  truth " << battery::text(truth);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Battery, Agreement, ::testing::ValuesIn(battery::model_names()), battery::instance_name);

/// Ward at roughness 0.01 and 85° is where an adaptive cubature of the hemisphere has answered 0 and said it converged.
TEST(Needles, NoRuleAnswersConfidentlyWrong) {
  std::vector<Case> needles;
  for (const double alpha : {1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03}) {
    needles.push_back({"ward", {{"alpha", alpha}}});
    needles.push_back({"ggx", {{"alpha", alpha}}});
    needles.push_back({"cook_torrance", {{"m", alpha}}});
    needles.push_back({"kurt", {{"m", alpha}, {"equation", "9"}}});
    needles.push_back({"ward", {{"alpha_x", 30 * alpha}, {"alpha_y", alpha}}, 35});
  }
  for (const double n : {1e3, 1e4, 1e5, 1e6}) {
    for (const char* model : {"phong", "phong_original", "blinn", "blinn_original", "neumann_phong", "lafortune"}) {
      needles.push_back({model, {{"n", n}}});
    }
    needles.push_back({"ashikhmin_shirley", {{"n", n}}});
    needles.push_back({"ashikhmin_shirley", {{"n_u", n / 100}, {"n_v", n}}, 35});
  }
  for (const Case& c : needles) {
    const auto model = make_model(c.model, c.parameters);
    for (const double theta : {0.0, 45.0, 85.0, 89.5}) {
      const Direction l = Direction::from_degrees(theta, c.phi);
      const Estimate truth = reference(*model, l);
      EXPECT_GT(truth.value, 0) << battery::name(c, theta);
      for (const Rule rule : {Rule::gauss, Rule::cubature, Rule::stratified}) {
        for (const Warp warp : {Warp::lobe, Warp::hemisphere}) {
          const Estimate e = directional_albedo(
              *model, l, {.rule = rule, .warp = warp, .tolerance = 1e-2, .budget = 40'000, .seed = 3});
          if (e.status != Status::converged) continue;
          EXPECT_LE(disagreement(e, truth), 1)
              << battery::name(c, theta) << ", rule " << static_cast<int>(rule) << ", warp " << static_cast<int>(warp)
              << "\n  answer " << battery::text(e) << "\n  truth  " << battery::text(truth);
        }
      }
    }
  }
}

TEST(Needles, WardIsFoundOnTheHemisphereWithEnoughBudget) {
  const auto model = make_model("ward", {{"alpha", 0.01}});
  const Direction l = Direction::from_degrees(85);
  for (const Rule rule : {Rule::gauss, Rule::cubature}) {
    const Estimate e =
        directional_albedo(*model, l, {.rule = rule, .warp = Warp::hemisphere, .tolerance = 1e-6, .budget = 2'000'000});
    EXPECT_EQ(e.status, Status::converged) << battery::text(e);
    EXPECT_NEAR(e.value, 0.08741251569902, 1e-6 * 0.0874) << battery::text(e);
  }
}

}  // namespace
}  // namespace albedo
