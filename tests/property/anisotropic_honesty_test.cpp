#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "albedo/albedo.hpp"

namespace albedo {
namespace {

double within(std::mt19937_64& random, double from, double to) {
  return std::lerp(from, to, static_cast<double>(random() >> 11) * 0x1p-53);
}

/// Masking that turns with the viewer's azimuth makes narrow layers: the default rule's claims, over random roughnesses
/// and directions.
class AnisotropicHonesty : public testing::TestWithParam<std::string> {};

TEST_P(AnisotropicHonesty, ErrorIsWithinTheClaim) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 400; ++k) {
    const double least = k % 2 == 0 ? 0.1 : 0.02;
    const double alpha_x = within(random, least, 1), alpha_y = within(random, least, 1),
                 cosine = within(random, 0.02, 1), phi = within(random, 0, 90);
    const auto model = make_model(GetParam(), {{"alpha_x", alpha_x}, {"alpha_y", alpha_y}});
    const Direction l = Direction::from_cosine(cosine, phi);
    const Estimate exact = directional_albedo(*model, l, {.tolerance = 1e-10});
    for (const double tolerance : {1e-3, 1e-4, 1e-6}) {
      const Estimate a = directional_albedo(*model, l, {.tolerance = tolerance});
      EXPECT_EQ(a.status, Status::converged);
      EXPECT_LE(std::abs(a.value - exact.value), a.error + exact.error)
          << alpha_x << ' ' << alpha_y << ' ' << cosine << ' ' << phi << ' ' << tolerance;
    }
  }
}

TEST_P(AnisotropicHonesty, EvaluationsAreFew) {
  std::mt19937_64 random(8);
  std::int64_t evaluations = 0;
  constexpr int cases = 200;
  for (int k = 0; k < cases; ++k) {
    const double alpha_x = within(random, 0.1, 1), alpha_y = within(random, 0.1, 1), cosine = within(random, 0.02, 1),
                 phi = within(random, 0, 90);
    const auto model = make_model(GetParam(), {{"alpha_x", alpha_x}, {"alpha_y", alpha_y}});
    evaluations += directional_albedo(*model, Direction::from_cosine(cosine, phi), {.tolerance = 1e-6}).evaluations;
  }
  EXPECT_LE(evaluations / cases, 3500);
}

INSTANTIATE_TEST_SUITE_P(Models, AnisotropicHonesty, testing::Values("ggx", "beckmann"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace albedo
