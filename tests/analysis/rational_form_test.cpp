#include "analysis/studies/rational_form.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "albedo/core/errors.hpp"
#include "albedo/registry.hpp"
#include "analysis/output/rational_writer.hpp"
#include "analysis/studies/corrections.hpp"

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
  };
  for (const Case& c : {Case{"ggx", {{"alpha", 0.3}}}, Case{"ward", {{"alpha", 0.3}}}, Case{"phong", {{"n", 20.0}}},
                        Case{"ashikhmin_shirley", {{"n", 20.0}}}}) {
    SCOPED_TRACE(c.model);
    const auto model = make_model(c.model, c.parameters);
    const RationalFit fit = rational_form(*model);
    EXPECT_EQ(fit.status, Status::converged);
    EXPECT_LE(fit.error, 1e-6);
    EXPECT_LE(fit.form.coefficients(), 16U);
    const Seen seen = seen_errors(*model, fit.form);
    EXPECT_LE(seen.in_double, 1.3 * fit.error + 1e-9);
    EXPECT_LE(seen.in_float, 2 * fit.float_error);
    EXPECT_LE(fit.float_error, 2e-6);
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
