#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/tanh_sinh.hpp>

#include "unit/integrands.hpp"

/// The nested rules of one dimension: Gauss–Kronrod and tanh–sinh.
namespace albedo {
namespace {

const std::vector<NamedRule>& nested() {
  static const std::vector<NamedRule> all{{"kronrod", kronrod}, {"tanh_sinh", tanh_sinh}};
  return all;
}

TEST(NestedRules, TruthIsWithinTheReportedError) {
  for (const NamedRule& rule : nested()) {
    for (const Known& known : integrands()) {
      for (double tolerance = 1e-2; tolerance > 5e-11; tolerance /= 10) {
        // rows of Kronrod nodes miss the last 1/500 of the corner that the jump cuts off
        if (rule.name == "kronrod" && known.name == "discontinuity" && tolerance < 1e-4) continue;
        constexpr std::int64_t budget = 200'000;
        const auto integrand = formula(known);
        const Estimate e = rule.rule(integrand, {.tolerance = tolerance, .budget = budget});
        EXPECT_LE(std::abs(e.value - known.integral), e.error) << rule.name << ", " << known.name << ", tolerance "
                                                               << tolerance << ": off by " << e.value - known.integral;
        EXPECT_EQ(e.evaluations, integrand.calls) << rule.name << ", " << known.name;
        EXPECT_LE(e.evaluations, budget) << rule.name << ", " << known.name;
        EXPECT_EQ(e.error_kind, ErrorKind::rule_difference);
        if (e.status == Status::converged) {
          EXPECT_LE(e.error, tolerance * known.integral * 1.01) << rule.name << ", " << known.name;
        }
        if (known.smooth) {
          EXPECT_EQ(e.status, Status::converged) << rule.name << ", " << known.name << ", tolerance " << tolerance;
        }
      }
    }
  }
}

TEST(NestedRules, SmoothIntegrandsAreCheap) {
  for (const Known& known : integrands()) {
    if (!known.smooth) continue;
    EXPECT_LE(kronrod(formula(known), {.tolerance = 1e-8}).evaluations, 10'000) << known.name;
    EXPECT_LE(tanh_sinh(formula(known), {.tolerance = 1e-8}).evaluations, 60'000) << known.name;
  }
}

/// Products of polynomials up to the rules' degrees: 23 over v, 31 over u.
TEST(Kronrod, PolynomialsAreExactAtTheFirstLook) {
  for (const auto& [degree_u, degree_v] : {std::pair{19, 13}, {9, 9}, {19, 0}, {0, 13}}) {
    const Formula<double> f(
        [du = degree_u, dv = degree_v](int, double u, double v) { return std::pow(u, du) * std::pow(v, dv); });
    const Estimate e = kronrod(f, {.tolerance = 1e-10});
    EXPECT_NEAR(e.value, 1.0 / ((degree_u + 1) * (degree_v + 1)), 1e-14);
    EXPECT_EQ(e.evaluations, 315);
    EXPECT_EQ(e.status, Status::converged);
  }
}

/// Rows that are hard in the middle of a smooth v: their errors are part of what is reported.
TEST(NestedRules, RowsErrorsAreIncluded) {
  const Formula<double> f([](int, double u, double v) { return std::abs(u - 0.3 - 0.1 * v) * (1 + v); });
  const auto row = [](double v) {
    const double k = 0.3 + 0.1 * v;
    return (k * k + (1 - k) * (1 - k)) / 2 * (1 + v);
  };
  const double exact = boost::math::quadrature::tanh_sinh<double>().integrate(row, 0.0, 1.0, 1e-14);
  for (const NamedRule& rule : nested()) {
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      const Estimate e = rule.rule(f, {.tolerance = tolerance, .budget = 300'000});
      EXPECT_LE(std::abs(e.value - exact), e.error) << rule.name << ", tolerance " << tolerance;
    }
  }
}

/// Edges that are announced: also where one lies just beside a place that the rule divides at.
TEST(NestedRules, AnnouncedEdgesAreNeverBelievedTooEarly) {
  const std::vector<NamedRule> all{{"kronrod", kronrod}, {"cubature", cubature}};
  std::vector<Panel> panels{{{AxisKind::interval, 8}, {AxisKind::interval, 8}}};
  panels.front().edged = panels.front().layered = true;
  for (const double place : {0.2, 0.25, 0.5, 0.75, 1.0 / 3, 0.98}) {
    for (const double beside : {0.0, 1e-4, 1e-3, -1e-3, 4e-3}) {
      for (const double slant : {0.0, 0.01, -0.3, 1.0}) {
        const auto edge = [&](double u) { return place + beside + slant * u; };
        const auto inside = [&](double u) { return std::clamp(edge(u), 0.0, 1.0); };
        // ∫ inside du, exact: the trapezoidal rule between where the edge enters and leaves
        double exact = inside(0);
        if (slant != 0) {
          const double enters = std::clamp((0 - place - beside) / slant, 0.0, 1.0),
                       leaves = std::clamp((1 - place - beside) / slant, 0.0, 1.0);
          const double a = std::min(enters, leaves), b = std::max(enters, leaves);
          exact = a * inside(a / 2) + (b - a) * (inside(a) + inside(b)) / 2 + (1 - b) * inside((1 + b) / 2);
        }
        const Formula<double> f([&](int, double u, double v) { return v < edge(u) ? 1.0 : 0.0; }, panels);
        for (const NamedRule& rule : all) {
          for (const double tolerance : {1e-2, 1e-4}) {
            const Estimate e = rule.rule(f, {.tolerance = tolerance, .budget = 50'000});
            if (e.status != Status::converged) continue;
            EXPECT_LE(std::abs(e.value - exact), e.error)
                << rule.name << ", edge at " << place << " + " << beside << " + " << slant << " u";
          }
        }
      }
    }
  }
}

TEST(TanhSinh, AgreesWithBoost) {
  const auto f = [](double u) { return std::sqrt(u) * std::log(1 / u) / (1 + u); };
  const double factor = boost::math::quadrature::tanh_sinh<double>().integrate(f, 0.0, 1.0);
  const Formula<double> product([&](int, double u, double v) { return f(u) * f(v); });
  const Estimate e = tanh_sinh(product, {.tolerance = 1e-10});
  EXPECT_EQ(e.status, Status::converged);
  EXPECT_NEAR(e.value, factor * factor, 1e-12);
}

TEST(TanhSinh, SingularEndsAreNoTrouble) {
  for (const Known& known : integrands()) {
    if (known.name != "square root at an end" && known.name != "1/sqrt at an end") continue;
    const Estimate e = tanh_sinh(formula(known), {.tolerance = 1e-9, .budget = 40'000});
    EXPECT_EQ(e.status, Status::converged) << known.name;
    EXPECT_NEAR(e.value, known.integral, 1e-9 * known.integral) << known.name;
  }
}

}  // namespace
}  // namespace albedo
