#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "unit/integrands.hpp"

#include "albedo/core/quad.hpp"

namespace albedo {
namespace {

TEST(Gauss, TruthIsWithinTheReportedError) {
  for (const Known& known : integrands()) {
    for (double tolerance = 1e-2; tolerance > 5e-12; tolerance /= 10) {
      const auto integrand = formula(known);
      const auto e = gauss<double>(integrand, {.tolerance = tolerance, .budget = 200'000});
      EXPECT_LE(std::abs(e.value - known.integral), e.error)
          << known.name << ", tolerance " << tolerance << ": off by " << e.value - known.integral;
      EXPECT_EQ(e.evaluations, integrand.calls) << known.name;
      EXPECT_LE(e.evaluations, 200'000) << known.name;
      if (e.status == Status::converged) {
        EXPECT_LE(e.error, tolerance * known.integral * 1.01) << known.name;
      }
      if (known.smooth) {
        EXPECT_EQ(e.status, Status::converged) << known.name << ", tolerance " << tolerance;
      }
    }
  }
}

TEST(Gauss, SmoothIntegrandsAreCheap) {
  for (const Known& known : integrands()) {
    const auto integrand = formula(known);
    const auto e = gauss<double>(integrand, {.tolerance = 1e-8});
    EXPECT_LE(e.evaluations, known.gauss) << known.name;
    EXPECT_GE(e.evaluations, 16) << known.name;
  }
}

TEST(Cubature, TruthIsWithinTheReportedError) {
  for (const Known& known : integrands()) {
    for (double tolerance = 1e-2; tolerance > 5e-9; tolerance /= 10) {
      const auto integrand = formula(known);
      const Estimate e = cubature(integrand, {.tolerance = tolerance, .budget = 100'000});
      EXPECT_LE(std::abs(e.value - known.integral), e.error)
          << known.name << ", tolerance " << tolerance << ": off by " << e.value - known.integral;
      EXPECT_EQ(e.evaluations, integrand.calls) << known.name;
      EXPECT_LE(e.evaluations, 100'000) << known.name;
      EXPECT_EQ(e.error_kind, ErrorKind::rule_difference);
      if (e.status == Status::converged) {
        EXPECT_LE(e.error, tolerance * known.integral * 1.01) << known.name;
      }
      if (known.smooth && tolerance >= 1e-6) {
        EXPECT_EQ(e.status, Status::converged) << known.name;
      }
    }
  }
}

TEST(Rules, NotANumberIsSaidAndNotReplaced) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const Formula<double> everywhere([bad](int, double, double) { return bad; });
    const Formula<double> in_a_part([bad](int, double u, double) { return u > 0.4 && u < 0.8 ? bad : 1.0; });
    for (const auto& [name, rule, random, adaptive] : rules()) {
      for (const Formula<double>* f : {&everywhere, &in_a_part}) {
        const Estimate e = rule(*f, {.tolerance = 1e-3, .budget = 100'000});
        EXPECT_EQ(e.status, Status::non_finite) << name;
        EXPECT_FALSE(std::isfinite(e.value)) << name;
      }
    }
  }
}

TEST(Rules, CutBudgetIsBudgetExhaustedAndTheErrorSaysSo) {
  for (const auto& [name, rule, random, adaptive] : rules()) {
    for (const Known& known : integrands()) {
      if (known.smooth) continue;
      const auto integrand = formula(known);
      const Estimate e = rule(integrand, {.tolerance = 1e-12, .budget = 5000, .seed = 9});
      // 5000 points are enough for
      if (known.name == "kink off the diagonal" && name == "cubature") continue;
      if (known.name == "square root at an end" && name == "tanh_sinh") continue;
      if (known.name == "1/sqrt at an end" && name == "tanh_sinh") continue;
      EXPECT_EQ(e.status, Status::budget_exhausted) << name << ", " << known.name;
      EXPECT_GT(e.error, 1e-12 * known.integral) << name << ", " << known.name;
      // an infinite integrand is outside of what the product rule reads (warps remove it): it is off by up to four
      // times
      const bool infinite = name == "gauss" && known.name == "1/sqrt at an end";
      // and a peak that isn't announced lies between the nodes of the rule that can't look closer
      const bool between = name == "tanh_sinh" && known.name == "narrow peak";
      const double sigmas = e.error_kind == ErrorKind::standard_error || infinite || between ? 4 : 1;
      EXPECT_LE(std::abs(e.value - known.integral), sigmas * e.error) << name << ", " << known.name;
    }
  }
}

/// A budget below a rule's first look is kept too; what can't be answered has an infinite error.
TEST(Rules, BudgetHoldsAtTheFirstLook) {
  const std::vector<Panel> panels(3, Panel{{AxisKind::interval, 6}, {AxisKind::interval, 6}});
  const Formula<double> f([](int panel, double u, double v) { return (panel + 1) * std::exp(u * v); }, panels);
  const double exact = 6 * 1.3179021514544038;  // Ei(1) − γ
  for (const auto& [name, rule, random, adaptive] : rules()) {
    if (name == "gauss") continue;  // begins with the order that a panel asks for
    for (const std::int64_t budget : {1, 2, 16, 47, 48, 50, 51, 100, 191, 192, 500, 944, 945, 1200, 3000}) {
      f.calls = 0;
      const Estimate e = rule(f, {.tolerance = 1e-2, .budget = budget});
      EXPECT_LE(e.evaluations, budget) << name;
      EXPECT_EQ(e.evaluations, f.calls) << name << ", budget " << budget;
      EXPECT_LE(std::abs(e.value - exact), (random ? 5 : 1) * e.error) << name << ", budget " << budget;
      if (budget < 48) {
        EXPECT_EQ(e.status, Status::budget_exhausted) << name << ", budget " << budget;
      }
    }
  }
}

TEST(Rules, AskedForMoreThanTheArithmeticHas) {
  const Formula<double> f([](int, double u, double v) { return std::exp(u) * std::cos(v); });
  const double exact = (std::exp(1.0) - 1) * std::sin(1.0);
  for (const auto& [name, rule, random, adaptive] : rules()) {
    const Estimate e = rule(f, {.tolerance = 1e-16, .budget = 300'000});
    EXPECT_EQ(e.status, random ? Status::budget_exhausted : Status::rounding_limited) << name;
    EXPECT_GT(e.error, 1e-16 * exact) << name;
    EXPECT_LE(std::abs(e.value - exact), 4 * e.error) << name;
  }
}

TEST(Rules, PanelsAreSummed) {
  const std::vector<Panel> panels(3, Panel{{AxisKind::interval, 6}, {AxisKind::interval, 6}});
  const Formula<double> f([](int panel, double u, double v) { return (panel + 1) * u * v; }, panels);
  for (const auto& [name, rule, random, adaptive] : rules()) {
    const Estimate e = rule(f, {.tolerance = 1e-3});
    EXPECT_NEAR(e.value, 6.0 / 4, random ? 4 * e.error : 1e-12) << name;
  }
}

TEST(Rules, TruncationIsPartOfTheError) {
  Formula<double> f([](int, double u, double v) { return 2 + u * v; });
  f.set_truncation(1e-3);
  for (const auto& [name, rule, random, adaptive] : rules()) {
    const Estimate e = rule(f, {.tolerance = 1e-2});
    EXPECT_GE(e.error, 1e-3 * e.value) << name;
    EXPECT_NE(rule(f, {.tolerance = 1e-4, .budget = 20'000}).status, Status::converged) << name;
  }
}

/// The needle that only its announcement betrays: no rule may answer without having looked.
TEST(Rules, AnnouncedFeaturesAreFoundOrTheResultIsNotBelieved) {
  for (const double width : {1e-2, 1e-3, 1e-4}) {
    const double u0 = 0.3217, v0 = 0.7193;
    const std::vector<Panel> panels{{{AxisKind::interval, 8}, {AxisKind::interval, 8}, {{u0, v0, width, width}}}};
    const double exact = gauss_1d(u0, width) * gauss_1d(v0, width);
    const Formula<double> f(
        [&](int, double u, double v) {
          return std::exp(-std::pow((u - u0) / width, 2) - std::pow((v - v0) / width, 2));
        },
        panels);
    for (const auto& [name, rule, random, adaptive] : rules()) {
      for (const std::int64_t budget : {100, 10'000, 500'000}) {
        const Estimate e = rule(f, {.tolerance = 1e-2, .budget = budget});
        const double sigmas = e.error_kind == ErrorKind::standard_error ? 4 : 1;
        if (e.status == Status::converged) {
          EXPECT_LE(std::abs(e.value - exact), sigmas * e.error) << name << ", width " << width;
        }
        if (budget == 500'000 && adaptive) {
          EXPECT_EQ(e.status, Status::converged) << name << width;
        }
      }
    }
  }
}

TEST(Gauss, PeriodicAxesNeedFewNodes) {
  const double pi_ = std::acos(-1.0);
  const Formula<double> f([pi_](int, double u, double v) { return u / (2 + std::cos(2 * pi_ * v)); },
                          {{{AxisKind::interval, 6}, {AxisKind::periodic, 8}}});
  const auto e = gauss<double>(f, {.tolerance = 1e-10});
  EXPECT_EQ(e.status, Status::converged);
  EXPECT_LE(std::abs(e.value - 0.5 / std::sqrt(3.0)), e.error);
  EXPECT_LE(e.evaluations, 1500);

  const Formula<double> half([pi_](int, double u, double v) { return u / (2 + std::cos(pi_ * v)); },
                             {{{AxisKind::interval, 6}, {AxisKind::even_periodic, 8}}});
  const auto h = gauss<double>(half, {.tolerance = 1e-10});
  EXPECT_EQ(h.status, Status::converged);
  EXPECT_LE(std::abs(h.value - 0.5 / std::sqrt(3.0)), h.error);
  EXPECT_LE(h.evaluations, 1000);
}

TEST(Gauss, GaussianAxisIntegratesToItsRange) {
  const double range = 6;
  const Formula<double> f(
      [range](int, double u, double v) {
        const double r = range * u;
        return range * 2 * r * std::exp(-r * r) * (1 + r * r) * (1 + v);
      },
      {{{AxisKind::gaussian, 5, range}, {AxisKind::interval, 6}}});
  const auto e = gauss<double>(f, {.tolerance = 1e-10});
  EXPECT_EQ(e.status, Status::converged);
  EXPECT_LE(std::abs(e.value - 3), e.error);
}

/// The same rule in 113 bits.
TEST(Gauss, QuadReachesThirtyDigits) {
  const Formula<Quad> f([](int, Quad u, Quad v) { return Quad(exp(u) / (1 + v)); }, 16);
  const auto e = gauss<Quad>(f, {.tolerance = 1e-28});
  const Quad exact = (exp(Quad(1)) - 1) * log(Quad(2));
  EXPECT_EQ(e.status, Status::converged);
  EXPECT_LE(static_cast<double>(Quad(abs(Quad(e.value - exact)))), static_cast<double>(e.error));
  EXPECT_LE(static_cast<double>(e.error), 2e-28);
}

/// Stretching an axis is a change of names only: the answer and its error are the same numbers.
TEST(Rules, ScaleOfTheIntegrandIsIrrelevant) {
  const Known& known = integrands()[4];
  for (const auto& [name, rule, random, adaptive] : rules()) {
    const auto plain = formula(known);
    const Formula<double> scaled([&](int, double u, double v) { return 0x1p-200 * known.f(u, v); });
    const Estimate a = rule(plain, {.tolerance = 1e-2}), b = rule(scaled, {.tolerance = 1e-2});
    EXPECT_NEAR(b.value * 0x1p200, a.value, 1e-14) << name;
    EXPECT_NEAR(b.error * 0x1p200, a.error, 1e-6 * a.error) << name;
    EXPECT_EQ(b.evaluations, a.evaluations) << name;
    EXPECT_EQ(b.status, a.status) << name;
  }
}

}  // namespace
}  // namespace albedo
