#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>

#include "albedo/combinators/balanced.hpp"
#include "albedo/combinators/pumped.hpp"
#include "property/battery.hpp"

namespace albedo {
namespace {

constexpr double tolerance = 1e-4;  // of tables, and of the measurement

/// Directions for each model and order; a long run asks for more.
int directions() {
  const char* const asked = std::getenv("ALBEDO_CORRECTION_DIRECTIONS");
  return asked != nullptr ? std::atoi(asked) : 2;
}

class Corrections : public ::testing::TestWithParam<std::string> {
 protected:
  /// Cosines from 1 down to 1e-4, half of them near the horizon, and the azimuth of the case.
  Direction direction(double phi) {
    std::uniform_real_distribution<double> unit;
    const double u = unit(random_);
    return Direction::from_cosine(unit(random_) < 0.5 ? 1 - u : std::pow(10.0, -4 * u), phi + 360 * unit(random_));
  }

  /// Reciprocal, and black nowhere, nor in the limit of grazing incidence.
  static bool can_be_corrected(const Model& model) {
    const auto albedo = [&](double cosine) {
      return directional_albedo(model, Direction::from_cosine(cosine), {.tolerance = 1e-3}).value;
    };
    return model.claims().reciprocal && albedo(1) > 0 && albedo(1e-20) > 1e-12;
  }

 private:
  std::mt19937 random_{7};
};

/// a* ≤ 1 as measured by an independent rule, and outright where the table is above by more than that rule's error.
TEST_P(Corrections, PumpingCreatesNoEnergyAndLosesNone) {
  for (const battery::Case& c : battery::cases_of(GetParam())) {
    if (c.shape == battery::Shape::costly || c.shape == battery::Shape::series) continue;
    const auto base = make_model(c.model, c.parameters);
    if (!can_be_corrected(*base)) continue;
    const bool anisotropic = !base->claims().isotropic;
    if (anisotropic && directions() < 10 && c.model != "schlick") continue;  // the others take seconds
    for (const int times : anisotropic ? std::vector{1} : std::vector{1, 2, 4}) {
      const PumpedModel model(make_model(c.model, c.parameters),
                              {.times = times, .tolerance = anisotropic ? 1e-2 : tolerance});
      for (int i = 0; i < directions(); ++i) {
        const Direction l = direction(c.phi);
        const AlbedoOptions options{.rule = Rule::cubature, .tolerance = tolerance};
        const Estimate a = directional_albedo(*base, l, options), pumped = directional_albedo(model, l, options);
        EXPECT_LE(pumped.value - pumped.error, 1) << battery::name(c) << ' ' << times << ' ' << l.theta_degrees();
        if (!base->claims().conserves_energy) continue;  // where g > 1, V may be darker than before
        EXPECT_GE(pumped.value + pumped.error, (a.value - a.error) * (1 - 3 * times * model.options().tolerance))
            << battery::name(c) << ' ' << times << ' ' << l.theta_degrees();
      }
    }
  }
}

TEST_P(Corrections, BalanceReflectsAllAndNoMore) {
  for (const battery::Case& c : battery::cases_of(GetParam())) {
    if (c.shape != battery::Shape::ordinary) continue;
    auto base = make_model(c.model, c.parameters);
    if (!can_be_corrected(*base) || !base->claims().isotropic) continue;
    const BalancedModel model(std::move(base), {.tolerance = tolerance});
    EXPECT_TRUE(model.balance().settled()) << battery::name(c);
    EXPECT_EQ(model.balance().status(), Status::converged) << battery::name(c);
    for (int i = 0; i < directions(); ++i) {
      const Direction l = direction(c.phi);
      const Estimate a = directional_albedo(model, l, {.rule = Rule::cubature, .tolerance = tolerance});
      EXPECT_LE(a.value - a.error, 1) << battery::name(c) << ' ' << l.theta_degrees();
      EXPECT_GE(a.value + a.error, 1 - tolerance) << battery::name(c) << ' ' << l.theta_degrees();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Battery, Corrections, ::testing::ValuesIn(battery::model_names()), battery::instance_name);

}  // namespace
}  // namespace albedo
