#include <gtest/gtest.h>

#include <cmath>

#include "albedo/combinators/balanced.hpp"
#include "albedo/combinators/compensated.hpp"
#include "albedo/combinators/coupled.hpp"
#include "albedo/core/erased_model.hpp"
#include "albedo/core/errors.hpp"
#include "albedo/directional_albedo.hpp"
#include "albedo/registry.hpp"

namespace albedo {
namespace {

Estimate albedo_at(const Model& model, double theta) {
  return directional_albedo(model, Direction::from_degrees(theta), {.rule = Rule::kronrod, .tolerance = 1e-11});
}

const std::vector<double> angles{0, 10, 30, 45, 60, 75, 85, 89, 89.9, 89.9999, 90};

TEST(Balance, AlbedoIsRho) {
  struct Case {
    const char* model;
    Parameters parameters;
    double rho;
  };
  for (const auto& [name, parameters, rho] : std::vector<Case>{{"phong", {{"n", 20.0}}, 1},
                                                               {"blinn", {{"n", 20.0}}, 0.3},
                                                               {"ggx", {{"alpha", 0.5}}, 1},
                                                               {"ward", {{"alpha", 0.2}}, 1}}) {
    const BalancedModel model(make_model(name, parameters), {.rho = rho});
    EXPECT_EQ(model.balance().status(), Status::converged) << name;
    EXPECT_NEAR(model.balance().rate(), 0.5, 0.02) << name;  // (1 − λ)/2 of a kernel without negative eigenvalues
    for (const double theta : angles) {
      const Estimate a = albedo_at(model, theta);
      EXPECT_LE(a.value - a.error, rho) << name << ' ' << theta;
      EXPECT_GE(a.value + a.error, rho * (1 - model.balance().relative_bound())) << name << ' ' << theta;
    }
    EXPECT_LE(model.balance().relative_bound(), 1e-9) << name;
  }
}

TEST(Balance, OfAConstantIsAConstant) {
  const BalancedModel model(make_model("lambert", {{"rho", 0.25}}), {.rho = 0.64});
  const Direction l = Direction::from_degrees(20), v = Direction::from_degrees(70, 50);
  EXPECT_NEAR(brdf<double>(model, l, v), 0.64 / pi<double>, 1e-9);
  EXPECT_NEAR(std::exp(model.balance().log_s(0.3)), std::sqrt(0.25 / 0.64), 1e-9);
}

TEST(Balance, IsReciprocalAndClaimsEnergy) {
  const BalancedModel model(make_model("ward", {{"alpha", 0.3}}));
  EXPECT_TRUE(model.claims().conserves_energy);
  EXPECT_TRUE(model.claims().reciprocal);
  const Direction l = Direction::from_degrees(20), v = Direction::from_degrees(80, 150);
  EXPECT_NEAR(brdf<double>(model, l, v), brdf<double>(model, v, l), 1e-14 * brdf<double>(model, l, v));
  EXPECT_EQ(std::get<double>(model.parameters()[1].second), 1);
}

/// Light from near N leaves far from it, and the other way round.
struct Crossed {
  static ModelInfo info() { return {.name = "crossed", .title = "Crossed", .source = "none", .deviation = "none"}; }
  static std::vector<Parameter<Crossed>> parameters() { return {}; }
  [[nodiscard]] Claims claims() const { return {}; }
  [[nodiscard]] std::vector<Lobe> lobes() const { return {{.component = 0}}; }
  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    const T l = select(d.cos_theta_l > T(0.75), T(1), T(0)), v = select(d.cos_theta_v > T(0.75), T(1), T(0));
    return (l + v - T(2) * l * v) / pi<T>;
  }
};

// From the larger part, 1 − 0.75² = 0.4375 is all that the smaller one can take: no s makes both albedos 1.
TEST(Balance, SaysWhereThereIsNone) {
  const ModelInfo info = Crossed::info();
  const ErasedModel<Crossed> model(Crossed{}, info);
  const Balance balance(model, {.tolerance = 0.05});
  EXPECT_FALSE(balance.settled());
  EXPECT_EQ(balance.status(), Status::budget_exhausted);
  EXPECT_GT(balance.relative_bound(), 0.05);
}

TEST(Compensated, ReturnsWhatIsLost) {
  for (const double rho : {1.0, 0.4, 0.0}) {
    const CompensatedModel model(make_model("ggx", {{"alpha", 0.6}}), rho);
    EXPECT_EQ(model.claims().reciprocal, false);
    for (const double theta : angles) {
      const double a = albedo_at(model.base(), theta).value;
      EXPECT_NEAR(albedo_at(model, theta).value, a + rho * (1 - a), 3e-8) << theta;
      EXPECT_LE(albedo_at(model, theta).value, 1) << theta;
    }
  }
}

TEST(Compensated, TakesFromWhatCreatesEnergy) {
  const CompensatedModel model(make_model("ward", {{"alpha", 0.2}}));
  EXPECT_TRUE(model.claims().conserves_energy);
  EXPECT_NEAR(albedo_at(model, 89.9999).value, 1, 3e-8);
  EXPECT_FALSE(CompensatedModel(make_model("ward", {{"alpha", 0.2}}), 0.5).claims().conserves_energy);
}

template <class Make>
void expect_refused(const Make& make, const std::string& words) {
  try {
    make();
    ADD_FAILURE() << "not refused: " << words;
  } catch (const ParameterError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(Corrections, RefuseWhatTheyCantCorrect) {
  const auto balanced = [](const std::string& name, const Parameters& parameters, const BalanceOptions& options) {
    return [=] { BalancedModel(make_model(name, parameters), options); };
  };
  expect_refused(balanced("ggx", {}, {.rho = 1.0001}), "rho is 1.0001 and must be within (0, 1]");
  expect_refused(balanced("ggx", {}, {.rho = 0}), "rho is 0");
  expect_refused(balanced("ggx", {}, {.rho = NAN}), "rho is nan");
  expect_refused(balanced("ggx", {}, {.tolerance = 1}), "tolerance is 1");
  expect_refused(balanced("phong_original", {}, {}), "phong_original isn't reciprocal");
  expect_refused(balanced("ggx", {{"alpha_x", 0.2}}, {}), "ggx is anisotropic");
  expect_refused(balanced("lambert", {{"rho", 0.0}}, {}), "the albedo of lambert is 0");
  expect_refused([] { BalancedModel(nullptr); }, "there is no model");
  expect_refused([] { CompensatedModel(make_model("ggx"), -0.1); }, "rho is -0.1");
  expect_refused([] { CompensatedModel(make_model("lambert", {{"rho", 0.0}})); }, "the albedo of lambert is 0");
  expect_refused([] { coupled(make_model("ward")); }, "doesn't claim to conserve energy");
}

}  // namespace
}  // namespace albedo
