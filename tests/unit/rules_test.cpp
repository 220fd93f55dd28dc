#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "albedo/rules/cubature.hpp"
#include "albedo/rules/gauss.hpp"
#include "albedo/rules/stratified.hpp"

namespace albedo {
namespace {

/// Any function of (panel, u, v) as an integrand.
template <class S>
class Formula final : public Integrand<S> {
 public:
  using Function = std::function<S(int, S, S)>;

  Formula(Function f, std::vector<Panel> panels) : f_(std::move(f)) { this->panels_ = std::move(panels); }
  explicit Formula(Function f, int order = 8)
      : Formula(std::move(f), {{{AxisKind::interval, order}, {AxisKind::interval, order}}}) {}

  void set_truncation(double truncation) { this->truncation_ = truncation; }

  void points(int panel, const S* u, const S* v, S* w, int count) const override {
    for (int i = 0; i < count; ++i) w[i] = f_(panel, u[i], v[i]);
    calls += count;
  }
  void grid(int panel, const S* u, int count_u, const S* v, int count_v, S* w) const override {
    for (int j = 0; j < count_v; ++j) {
      for (int i = 0; i < count_u; ++i) w[j * count_u + i] = f_(panel, u[i], v[j]);
    }
    calls += count_u * count_v;
  }

  mutable std::int64_t calls = 0;

 private:
  Function f_;
};

using Function = std::function<double(double, double)>;

struct Known {
  std::string name;
  Function f;
  double integral;
  bool smooth;         ///< analytic inside the square: gauss meets 1e-10 cheaply
  std::int64_t gauss;  ///< most evaluations at 1e-8
};

double gauss_1d(double centre, double width) {
  const double root_pi_2 = std::sqrt(std::acos(-1.0)) / 2;
  return width * root_pi_2 * (std::erf((1 - centre) / width) + std::erf(centre / width));
}

const std::vector<Known>& integrands() {
  static const double pi_ = std::acos(-1.0);
  static const std::vector<Known> all{
      {"constant", [](double, double) { return 3.0; }, 3, true, 200},
      {"polynomial", [](double x, double y) { return 1 + x * x * x * y + 5 * x * std::pow(y, 6); },
       1 + 1.0 / 8 + 5.0 / 14, true, 400},
      {"exponential", [](double x, double y) { return std::exp(x - 2 * y); },
       (std::exp(1.0) - 1) * (1 - std::exp(-2.0)) / 2, true, 400},
      {"runge", [](double x, double y) { return 1 / ((1 + 25 * x * x) * (1 + y)); }, std::atan(5.0) / 5 * std::log(2.0),
       true, 2000},
      {"wide peak",
       [](double x, double y) { return std::exp(-std::pow((x - 0.4) / 0.3, 2) - std::pow((y - 0.7) / 0.5, 2)); },
       gauss_1d(0.4, 0.3) * gauss_1d(0.7, 0.5), true, 2000},
      {"narrow peak",
       [](double x, double y) { return std::exp(-std::pow((x - 0.37) / 0.03, 2) - std::pow((y - 0.61) / 0.05, 2)); },
       gauss_1d(0.37, 0.03) * gauss_1d(0.61, 0.05), false, 60'000},
      {"oscillating", [](double x, double y) { return 1 + std::cos(20 * x + 9 * y); },
       1 + (std::cos(20.0) + std::cos(9.0) - 1 - std::cos(29.0)) / 180, true, 4000},
      {"kink", [](double x, double y) { return std::abs(x - y); }, 1.0 / 3, false, 2'000'000},
      {"kink off the diagonal", [](double x, double y) { return std::abs(x - 0.3) * (1 + y); }, (0.09 + 0.49) / 2 * 1.5,
       false, 2'000'000},
      {"square root at an end", [](double x, double y) { return std::sqrt(x) * (1 + y); }, 1, false, 2'000'000},
      {"1/sqrt at an end", [](double x, double y) { return (1 + y) / std::sqrt(x); }, 3, false, 2'000'000},
      {"discontinuity", [](double x, double y) { return x + y < 0.8 ? 1.0 : 0.0; }, 0.32, false, 2'000'000},
      {"sign change", [](double x, double y) { return std::sin(2 * pi_ * x) + y; }, 0.5, true, 4000},
  };
  return all;
}

Formula<double> formula(const Known& known) {
  return Formula<double>([f = known.f](int, double u, double v) { return f(u, v); });
}

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

TEST(Stratified, StandardErrorCovers) {
  for (const Known& known : integrands()) {
    if (known.name == "constant") continue;  // has no variance
    int within_one = 0, within_four = 0;
    constexpr int seeds = 100;
    for (int seed = 0; seed < seeds; ++seed) {
      const auto integrand = formula(known);
      const Estimate e = stratified(integrand, {.tolerance = 1e-2, .seed = static_cast<std::uint64_t>(seed)});
      EXPECT_EQ(e.status, Status::converged) << known.name;
      EXPECT_EQ(e.error_kind, ErrorKind::standard_error);
      EXPECT_EQ(e.evaluations, integrand.calls) << known.name;
      within_one += std::abs(e.value - known.integral) <= e.error ? 1 : 0;
      within_four += std::abs(e.value - known.integral) <= 4 * e.error ? 1 : 0;
    }
    // 67 % and 99.9 % of a t distribution with 15 degrees of freedom; 50 and 82 are 3.6 sigma of 100 trials away
    EXPECT_GE(within_one, 50) << known.name;
    EXPECT_LE(within_one, 83) << known.name;
    EXPECT_GE(within_four, seeds - 2) << known.name;
  }
}

TEST(Stratified, SeedsDifferAndTheSameSeedRepeats) {
  const auto integrand = formula(integrands()[4]);
  const Estimate a = stratified(integrand, {.tolerance = 1e-2, .seed = 1}),
                 b = stratified(integrand, {.tolerance = 1e-2, .seed = 1}),
                 c = stratified(integrand, {.tolerance = 1e-2, .seed = 2}),
                 d = stratified(integrand, {.tolerance = 1e-2, .seed = 1ULL + (1ULL << 32)});
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.error, b.error);
  EXPECT_NE(a.value, c.value);
  EXPECT_NE(a.value, d.value) << "the upper half of the seed counts too";
}

/// A constant is found exactly by every stratum: what is left is the counting.
TEST(Stratified, ConstantsAreExact) {
  const auto integrand = formula(integrands()[0]);
  const Estimate e = stratified(integrand, {.tolerance = 1e-6});
  EXPECT_NEAR(e.value, 3, 1e-14);
  EXPECT_LE(e.error, 1e-14);
  EXPECT_EQ(e.status, Status::converged);
}

using AnyRule = std::function<Estimate(const Integrand<double>&, const RuleOptions&)>;

const std::vector<std::pair<std::string, AnyRule>>& rules() {
  static const std::vector<std::pair<std::string, AnyRule>> all{
      {"gauss",
       [](const Integrand<double>& f, const RuleOptions& o) {
         const auto e = gauss<double>(f, o);
         return Estimate{e.value, e.error, ErrorKind::embedded, e.evaluations, e.status};
       }},
      {"cubature", cubature},
      {"stratified", stratified},
  };
  return all;
}

TEST(Rules, NotANumberIsSaidAndNotReplaced) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const Formula<double> everywhere([bad](int, double, double) { return bad; });
    const Formula<double> in_a_part([bad](int, double u, double) { return u > 0.4 && u < 0.8 ? bad : 1.0; });
    for (const auto& [name, rule] : rules()) {
      for (const Formula<double>* f : {&everywhere, &in_a_part}) {
        const Estimate e = rule(*f, {.tolerance = 1e-3, .budget = 100'000});
        EXPECT_EQ(e.status, Status::non_finite) << name;
        EXPECT_FALSE(std::isfinite(e.value)) << name;
      }
    }
  }
}

TEST(Rules, CutBudgetIsBudgetExhaustedAndTheErrorSaysSo) {
  for (const auto& [name, rule] : rules()) {
    for (const Known& known : integrands()) {
      if (known.smooth) continue;
      const auto integrand = formula(known);
      const Estimate e = rule(integrand, {.tolerance = 1e-12, .budget = 5000, .seed = 9});
      if (known.name == "kink off the diagonal" && name == "cubature") continue;  // 5000 points are enough
      EXPECT_EQ(e.status, Status::budget_exhausted) << name << ", " << known.name;
      EXPECT_GT(e.error, 1e-12 * known.integral) << name << ", " << known.name;
      // an infinite integrand is outside of what the product rule reads (warps remove it): it is off by up to four
      // times
      const bool infinite = name == "gauss" && known.name == "1/sqrt at an end";
      const double sigmas = e.error_kind == ErrorKind::standard_error || infinite ? 4 : 1;
      EXPECT_LE(std::abs(e.value - known.integral), sigmas * e.error) << name << ", " << known.name;
    }
  }
}

TEST(Rules, AskedForMoreThanTheArithmeticHas) {
  const Formula<double> f([](int, double u, double v) { return std::exp(u) * std::cos(v); });
  const double exact = (std::exp(1.0) - 1) * std::sin(1.0);
  for (const auto& [name, rule] : rules()) {
    const Estimate e = rule(f, {.tolerance = 1e-16, .budget = 300'000});
    EXPECT_EQ(e.status, name == "stratified" ? Status::budget_exhausted : Status::rounding_limited) << name;
    EXPECT_GT(e.error, 1e-16 * exact) << name;
    EXPECT_LE(std::abs(e.value - exact), 4 * e.error) << name;
  }
}

TEST(Rules, PanelsAreSummed) {
  const std::vector<Panel> panels(3, Panel{{AxisKind::interval, 6}, {AxisKind::interval, 6}});
  const Formula<double> f([](int panel, double u, double v) { return (panel + 1) * u * v; }, panels);
  for (const auto& [name, rule] : rules()) {
    const Estimate e = rule(f, {.tolerance = 1e-3});
    EXPECT_NEAR(e.value, 6.0 / 4, name == "stratified" ? 4 * e.error : 1e-12) << name;
  }
}

TEST(Rules, TruncationIsPartOfTheError) {
  Formula<double> f([](int, double u, double v) { return 2 + u * v; });
  f.set_truncation(1e-3);
  for (const auto& [name, rule] : rules()) {
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
    for (const auto& [name, rule] : rules()) {
      for (const std::int64_t budget : {100, 10'000, 500'000}) {
        const Estimate e = rule(f, {.tolerance = 1e-2, .budget = budget});
        const double sigmas = e.error_kind == ErrorKind::standard_error ? 4 : 1;
        if (e.status == Status::converged) {
          EXPECT_LE(std::abs(e.value - exact), sigmas * e.error) << name << ", width " << width;
        }
        if (budget == 500'000 && name != "stratified") {
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
  for (const auto& [name, rule] : rules()) {
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
