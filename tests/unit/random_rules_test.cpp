#include <gtest/gtest.h>

#include <set>

#include "unit/integrands.hpp"

/// The Monte Carlo rules: what their standard error covers, and where their points are.
namespace albedo {
namespace {

constexpr bool is_infinite_variance(std::string_view name) { return name == "1/sqrt at an end"; }

TEST(RandomRules, StandardErrorCovers) {
  for (const NamedRule& rule : rules()) {
    if (!rule.random) continue;
    for (const Known& known : integrands()) {
      if (known.name == "constant") continue;  // has no variance
      if (is_infinite_variance(known.name)) continue;
      const bool slow = rule.name == "monte_carlo";
      int within_one = 0, within_two = 0, within_four = 0;
      constexpr int seeds = 100;
      for (int seed = 0; seed < seeds; ++seed) {
        const auto integrand = formula(known);
        const Estimate e =
            rule.rule(integrand, {.tolerance = slow ? 3e-2 : 1e-2, .seed = static_cast<std::uint64_t>(seed)});
        EXPECT_EQ(e.status, Status::converged) << rule.name << ", " << known.name;
        EXPECT_EQ(e.error_kind, ErrorKind::standard_error);
        EXPECT_EQ(e.evaluations, integrand.calls) << rule.name << ", " << known.name;
        const double sigmas = std::abs(e.value - known.integral) / e.error;
        within_one += sigmas <= 1 ? 1 : 0;
        within_two += sigmas <= 2 ? 1 : 0;
        within_four += sigmas <= 4 ? 1 : 0;
      }
      // 67, 93.6 and 99.9 % of a t distribution with 15 degrees of freedom (68 and 95.4 of a normal one); 50, 83, 85
      // and 97 are 3.6 sigma of 100 trials away
      EXPECT_GE(within_one, 50) << rule.name << ", " << known.name;
      EXPECT_LE(within_one, 85) << rule.name << ", " << known.name;
      EXPECT_GE(within_two, 83) << rule.name << ", " << known.name;
      EXPECT_GE(within_four, seeds - 2) << rule.name << ", " << known.name;
    }
  }
}

/// Together the seeds are as precise as that many more points: a bias would show.
TEST(RandomRules, HaveNoBias) {
  for (const NamedRule& rule : rules()) {
    if (!rule.random) continue;
    for (const Known& known : integrands()) {
      if (!known.smooth || known.name == "constant") continue;
      double sum = 0, variance = 0;
      constexpr int seeds = 200;
      for (int seed = 1; seed <= seeds; ++seed) {
        const Estimate e =
            rule.rule(formula(known), {.tolerance = 0.9, .budget = 4096, .seed = static_cast<std::uint64_t>(seed)});
        sum += e.value;
        variance += e.error * e.error;
      }
      EXPECT_LE(std::abs(sum / seeds - known.integral), 4 * std::sqrt(variance) / seeds)
          << rule.name << ", " << known.name;
    }
  }
}

TEST(RandomRules, InfiniteVarianceIsRarelyBelieved) {
  for (const NamedRule& rule : rules()) {
    if (!rule.random) continue;
    int believed = 0;
    for (const Known& known : integrands()) {
      if (!is_infinite_variance(known.name)) continue;
      for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        const Estimate e = rule.rule(formula(known), {.tolerance = 1e-2, .budget = 200'000, .seed = seed});
        believed += e.status == Status::converged ? 1 : 0;
      }
    }
    EXPECT_LE(believed, 30) << rule.name;
  }
}

TEST(RandomRules, SeedsDifferAndTheSameSeedRepeats) {
  const auto integrand = formula(integrands()[4]);
  for (const NamedRule& rule : rules()) {
    if (!rule.random) continue;
    const auto run = [&](std::uint64_t seed) { return rule.rule(integrand, {.tolerance = 1e-2, .seed = seed}); };
    const Estimate a = run(1), b = run(1), c = run(2), d = run(1ULL + (1ULL << 32));
    EXPECT_EQ(a.value, b.value) << rule.name;
    EXPECT_EQ(a.error, b.error) << rule.name;
    EXPECT_NE(a.value, c.value) << rule.name;
    EXPECT_NE(a.value, d.value) << rule.name << ": the upper half of the seed counts too";
  }
}

/// Replicates of few points all count the same of what is 0 or 1: that they agree is no proof.
TEST(RandomRules, StepsAreNotBelievedBecauseReplicatesAgree) {
  for (const NamedRule& rule : rules()) {
    if (!rule.random) continue;
    for (const double edge : {0.0606, 0.37, 0.5, 0.777, 0.95}) {
      const Formula<double> step([edge](int, double u, double) { return u < edge ? 1.0 : 0.0; });
      for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        const Estimate e = rule.rule(step, {.tolerance = 1e-3, .budget = 16 * 2048, .seed = seed});
        EXPECT_LE(std::abs(e.value - edge), 5 * e.error) << rule.name << ", edge " << edge << ", seed " << seed;
      }
    }
  }
}

/// A constant has no variance: what is left is the counting.
TEST(RandomRules, ConstantsAreExact) {
  const auto integrand = formula(integrands()[0]);
  for (const NamedRule& rule : rules()) {
    if (!rule.random) continue;
    const Estimate e = rule.rule(integrand, {.tolerance = 1e-6});
    EXPECT_NEAR(e.value, 3, 1e-14) << rule.name;
    EXPECT_LE(e.error, 1e-14) << rule.name;
    EXPECT_EQ(e.status, Status::converged) << rule.name;
  }
}

/// Keeps the points it is evaluated at.
class Recorder final : public Integrand<double> {
 public:
  Recorder() { panels_.resize(2); }

  void points(int panel, const double* u, const double* v, double* w, int count) const override {
    for (int i = 0; i < count; ++i) {
      seen[static_cast<std::size_t>(panel)].push_back({u[i], v[i]});
      w[i] = 1 + u[i] * v[i];
    }
  }
  void grid(int, const double*, int, const double*, int, double*) const override {
    FAIL() << "random points are not on a grid";
  }

  mutable std::array<std::vector<std::array<double, 2>>, 2> seen{};
};

/// Every binary box of area 2^−k holds exactly one of 2^k points: each scramble is still a (0, k, 2)-net.
TEST(Sobol, EveryReplicateIsANet) {
  constexpr int k = 6, points = 1 << k;
  const Recorder recorder;
  const Estimate e = sobol(recorder, {.tolerance = 0.5, .budget = std::int64_t{2} * replicate_count * points});
  ASSERT_EQ(e.evaluations, 2 * replicate_count * points);
  for (const auto& seen : recorder.seen) {
    ASSERT_EQ(seen.size(), static_cast<std::size_t>(replicate_count * points));
    for (int replicate = 0; replicate < replicate_count; ++replicate) {
      for (int bits_u = 0; bits_u <= k; ++bits_u) {
        std::set<std::pair<int, int>> boxes;
        for (int i = 0; i < points; ++i) {
          // half of the points of every replicate, then the other half
          const int look = i / (points / 2), first = (look * replicate_count + replicate) * (points / 2);
          const auto& [u, v] = seen[static_cast<std::size_t>(first + i % (points / 2))];
          EXPECT_TRUE(u > 0 && u < 1 && v > 0 && v < 1);
          boxes.insert({static_cast<int>(std::ldexp(u, bits_u)), static_cast<int>(std::ldexp(v, k - bits_u))});
        }
        EXPECT_EQ(boxes.size(), static_cast<std::size_t>(points)) << "replicate " << replicate << ", " << bits_u;
      }
    }
  }
}

/// Scrambled nets: the error falls faster than that of independent points.
TEST(Sobol, ConvergesFasterThanPlainMonteCarlo) {
  const Known& known = integrands()[2];
  const auto error_of = [&](std::int64_t budget) {
    return sobol(formula(known), {.tolerance = 1e-15, .budget = budget}).error;
  };
  EXPECT_LE(error_of(16 * 4096), error_of(16 * 64) / 256);  // 64 times the points: 512 at the rate n^−1.5, 8 at n^−0.5
}

}  // namespace
}  // namespace albedo
