#include "albedo/rational_form.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "albedo/combinators/pumped.hpp"
#include "albedo/core/errors.hpp"
#include "albedo/registry.hpp"
#include "analysis/files/rational_writer.hpp"
#include "approximation/rational_minimax.hpp"

namespace albedo::analysis {
namespace {

/// Errors at places that neither the fit nor its verification know, relative to the albedo.
struct Seen {
  double in_double = 0, in_float = 0;
};
Seen seen_errors(const Model& model, const RationalForm& form) {
  Seen seen;
  constexpr int count = 97;
  for (int i = 0; i < count; ++i) {
    const double theta = 89.99 * (1 - std::pow(1 - (i + 0.3) / count, 3));
    const Direction l = Direction::from_degrees(theta);
    const double a = directional_albedo(model, l, {.tolerance = 1e-9}).value;
    seen.in_double = std::max(seen.in_double, std::abs(form(l.cos_theta) / a - 1));
    seen.in_float =
        std::max(seen.in_float, std::abs(static_cast<double>(form(static_cast<float>(l.cos_theta))) / a - 1));
  }
  return seen;
}

TEST(RationalForm, MeetsItsErrorWhereItWasNotVerified) {
  struct Case {
    std::string model;
    Parameters parameters;
    int pumpings = 0;
  };
  for (const Case& c : {Case{"ggx", {{"alpha", 0.3}}}, Case{"ward", {{"alpha", 0.01}}}, Case{"ward", {{"alpha", 0.3}}},
                        Case{"phong", {{"n", 20.0}}}, Case{"ashikhmin_shirley", {{"n", 200.0}}},
                        Case{"phong", {{"n", 20.0}}, 2}, Case{"phong", {{"n", 5.0}}, 2}}) {
    SCOPED_TRACE(c.model);
    std::unique_ptr<Model> model = make_model(c.model, c.parameters);
    if (c.pumpings > 0) model = std::make_unique<PumpedModel>(std::move(model), PumpOptions{.times = c.pumpings});
    const RationalFit fit = rational_form(*model);
    EXPECT_EQ(fit.status, Status::converged);
    EXPECT_LE(fit.error, 1e-6);
    EXPECT_LE(fit.form.coefficients(), 16U);
    const Seen seen = seen_errors(*model, fit.form);
    EXPECT_LE(seen.in_double, 1.02 * fit.error + 1e-9);
    EXPECT_LE(fit.least, fit.error);
    EXPECT_LE(seen.in_float, 2 * fit.float_error);
    EXPECT_LE(fit.float_error, 2e-6);
  }
}

TEST(RationalMinimax, IsTheKnownOneOfAnExponential) {
  // e^x on [-1, 1] by degrees (1, 1): m! n! / (2^(m+n) (m+n)! (m+n+1)!) = 1/48 asymptotically   [Meinardus]
  MinimaxProblem problem;
  constexpr int count = 2001;
  problem.u = MinimaxProblem::Vector::LinSpaced(count, -1, 1);
  problem.f = problem.u.array().exp();
  problem.s = MinimaxProblem::Vector::Ones(count);
  const Minimax best = rational_minimax(problem, 1, 1, chebyshev_reference(problem, 4));
  EXPECT_TRUE(best.converged);
  EXPECT_EQ(best.reference.size(), 4U);
  EXPECT_LE(best.least, best.error);
  EXPECT_NEAR(best.error, 1.0 / 48, 0.01 / 48);
  double before = 0;
  for (std::size_t k = 0; k < best.reference.size(); ++k) {  // levelled, with signs that alternate
    const MinimaxProblem::Vector u = problem.u.segment(best.reference[k], 1);
    const auto value = static_cast<double>((chebyshev_basis(u, 1) * best.p)[0] / (chebyshev_basis(u, 1) * best.q)[0]);
    const double error = value - std::exp(static_cast<double>(u[0]));
    EXPECT_NEAR(std::abs(error), best.least, 1e-12);
    EXPECT_TRUE(k == 0 || error * before < 0);
    before = error;
  }
}

TEST(RationalMinimax, FindsARationalFunctionItself) {
  MinimaxProblem problem;
  constexpr int count = 300;
  problem.u = MinimaxProblem::Vector::LinSpaced(count, -1, 1);
  problem.f = (problem.u.array() + 3) / (problem.u.array().square() + 0.25L);
  problem.s = problem.f;
  const Minimax best = rational_minimax(problem, 1, 2, chebyshev_reference(problem, 5));
  EXPECT_LE(best.error, 1e-14);
}

TEST(RationalForm, EachVariableIsSmoothAndRises) {
  for (int i = 0; i <= static_cast<int>(RationalVariable::scaled_half); ++i) {
    const RationalForm form{.variable = static_cast<RationalVariable>(i), .shift = 0.01};
    double before = -1;
    for (double theta = 90; theta >= 0; theta -= 0.5) {
      const double c = theta == 90 ? 0 : std::cos(theta * M_PI / 180), x = form.x(c);
      EXPECT_GT(x, before) << i << ' ' << theta;
      EXPECT_NEAR(static_cast<double>(form.x(static_cast<float>(c))), x, 3e-6) << i << ' ' << theta;
      before = x;
    }
  }
}

TEST(RationalForm, SaysSoWhereItDoesNotReachTheTolerance) {
  const auto model = make_model("ggx", {{"alpha", 0.3}});
  const RationalFit fit = rational_form(*model, {.tolerance = 1e-6, .most_coefficients = 5});
  EXPECT_EQ(fit.status, Status::budget_exhausted);
  EXPECT_GT(fit.error, 1e-6);
  EXPECT_LE(fit.form.coefficients(), 5U);
  EXPECT_LE(seen_errors(*model, fit.form).in_double, 1.3 * fit.error);
}

TEST(RationalForm, OfAConstantHasOneCoefficient) {
  const RationalFit fit = rational_form(*make_model("lambert", {{"rho", 0.5}}));
  EXPECT_EQ(fit.form.coefficients(), 1U);
  EXPECT_NEAR(fit.form(0.25), 0.5, 1e-8);
  EXPECT_EQ(rational_form(*make_model("lambert", {{"rho", 0.0}})).form(0.25), 0);
}

TEST(RationalForm, IsTheSameForAnyNumberOfThreads) {
  const auto model = make_model("ward", {{"alpha", 0.2}});
  const auto text = [&](int threads) {
    return rational_json(rational_form(*model, {.tolerance = 1e-4, .threads = threads}).form).dump();
  };
  EXPECT_EQ(text(1), text(3));
}

TEST(RationalForm, RefusesWhatMakesNoSense) {
  const auto model = make_model("lambert", {});
  EXPECT_THROW(rational_form(*model, {.most_coefficients = 2}), ParameterError);
  EXPECT_THROW(rational_form(*model, {.tolerance = 0}), ParameterError);
  EXPECT_THROW(rational_form(*model, {.last_theta = 90}), ParameterError);
}

}  // namespace
}  // namespace albedo::analysis
