#include "albedo/reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "albedo/core/errors.hpp"
#include "albedo/directional_albedo.hpp"
#include "warps/sample.hpp"

namespace albedo {
namespace {

/// ∫ f cosθ_V dω_V by another route than the library's: polar coordinates of V, the trapezoidal rule on the half turn,
/// and the trapezoidal rule in t of θ_V = π/2/(1 + exp(−π sinh t)).
Quad by_double_exponential(const Model& model, const Direction& direction, int steps, int half_turn) {
  const UnitVector<Quad> l = unit_vector<Quad>(direction);
  const Quad h = Quad(4.25) / steps;
  Quad sum = 0;
  for (int i = -steps; i <= steps; ++i) {
    const Quad t = i * h;
    const Quad e = exp(-pi<Quad> * sinh(t));
    const Quad theta = pi<Quad> / 2 / (1 + e), to_horizon = pi<Quad> / 2 * e / (1 + e);
    const Quad slope = pi<Quad> / 2 * pi<Quad> * cosh(t) * e / ((1 + e) * (1 + e));
    const Quad sine = sin(theta), cosine = sin(to_horizon);
    Quad ring = 0;
    for (int k = 0; k <= half_turn; ++k) {
      const Quad phi = pi<Quad> * k / half_turn;
      const UnitVector<Quad> v{sine * cos(phi), sine * sin(phi), cosine};
      const Quad weight = k == 0 || k == half_turn ? Quad(0.5) : Quad(1);
      for (const Lobe& lobe : model.lobes()) {
        ring += weight * model.quad().evaluate(lobe.component, direction_pair(l, v, lobe_axis(lobe, l)));
      }
    }
    sum += ring * sine * cosine * slope;
  }
  return sum * h * 2 * pi<Quad> / half_turn;
}

struct Rough {
  std::string model;
  Parameters parameters;
  double theta;
};

class Reference : public ::testing::TestWithParam<Rough> {};

TEST_P(Reference, HasTwentyDigitsOfAnotherRoute) {
  const auto model = make_model(GetParam().model, GetParam().parameters);
  const Direction l = Direction::from_degrees(GetParam().theta);
  const EstimateIn<Quad> a = reference_albedo(*model, l);
  EXPECT_EQ(a.status, Status::converged);
  EXPECT_LE(a.error, Quad(1e-20) * a.value);
  const Quad other = by_double_exponential(*model, l, 56, 64), coarse = by_double_exponential(*model, l, 48, 56);
  EXPECT_LE(abs(other - coarse), Quad(1e-20) * other) << "the other route itself: " << other - coarse;
  EXPECT_LE(abs(a.value - other), Quad(1e-20) * other) << a.value - other;
}

INSTANTIATE_TEST_SUITE_P(Routes, Reference,
                         ::testing::Values(Rough{"ward", {{"alpha", 1.3}}, 30},
                                           Rough{"ward_duer", {{"alpha", 1.5}}, 20}, Rough{"ggx", {{"alpha", 0.7}}, 30},
                                           Rough{"ggx", {{"alpha", 0.9}, {"masking", "separable"}}, 10}),
                         [](const auto& entry) { return entry.param.model + "_" + std::to_string(entry.index); });

TEST(ReferenceAlbedo, IsTheSameForAnyTighterTolerance) {
  const auto model = make_model("cook_torrance", {{"m", 0.3}});
  const Direction l = Direction::from_degrees(60);
  const EstimateIn<Quad> coarse = reference_albedo(*model, l, {.tolerance = 1e-12});
  const EstimateIn<Quad> usual = reference_albedo(*model, l);
  EXPECT_LT(coarse.evaluations, usual.evaluations);
  EXPECT_LE(abs(coarse.value - usual.value), coarse.error + usual.error);
  EXPECT_GT(abs(coarse.value - usual.value), Quad(1e-30));  // other nodes
  EXPECT_NE(Quad(static_cast<double>(usual.value)), usual.value) << "rounded to double";
}

TEST(ReferenceAlbedo, SaysWhatItCouldNotReach) {
  const auto model = make_model("ward", {{"alpha", 0.1}});
  const EstimateIn<Quad> cut = reference_albedo(*model, Direction::from_degrees(80), {.budget = 3000});
  EXPECT_EQ(cut.status, Status::budget_exhausted);
  EXPECT_LE(cut.evaluations, 3000);
  EXPECT_GT(cut.error, Quad(1e-20) * cut.value);

  const EstimateIn<Quad> infinite = reference_albedo(*model, Direction::from_degrees(90), {.tolerance = 1e-6});
  EXPECT_EQ(infinite.status, Status::divergent);
  const auto lambert = make_model("lambert", {{"rho", 0.18}});
  const EstimateIn<Quad> limit = reference_albedo(*lambert, Direction::from_degrees(90));
  EXPECT_EQ(limit.status, Status::rounding_limited);
  EXPECT_GT(limit.error, Quad(1e-20) * limit.value);
  EXPECT_LE(abs(limit.value - Quad(0.18)), limit.error);
}

TEST(ReferenceAlbedo, RefusesWhatNoRuleTakes) {
  const auto model = make_model("lambert");
  EXPECT_THROW(reference_albedo(*model, {}, {.tolerance = 1e-31}), ParameterError);
  EXPECT_THROW(reference_albedo(*model, {}, {.budget = 0}), ParameterError);
}

}  // namespace
}  // namespace albedo
