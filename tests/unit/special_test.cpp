#include "albedo/core/special.hpp"
#include "albedo/core/quad.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace albedo {
namespace {

/// From rounding's edge to far beyond the argument at which erfc underflows.
std::vector<double> arguments() {
  std::vector<double> xs{0};
  for (double x = 1e-10; x < 1e12; x *= 1.07) xs.push_back(x);
  return xs;
}

TEST(ScaledErfc, IsThatOf113BitsInEveryNumberType) {
  for (const double x : arguments()) {
    const double exact = static_cast<double>(scaled_erfc(Quad(x)));
    EXPECT_NEAR(scaled_erfc(x), exact, 1e-15 * exact) << x;
    EXPECT_NEAR(static_cast<double>(scaled_erfc(static_cast<float>(x))), exact, 6e-7 * exact) << x;
    const Block block = scaled_erfc(Block(x));
    for (int i = 0; i < block_width; ++i) EXPECT_NEAR(block[i], exact, 1e-15 * exact) << x;
  }
}

/// e^(x²) erfc(x) with the standard library's erfc, where its exponential doesn't lose digits.
TEST(ScaledErfc, IsTheScaledErrorFunction) {
  for (const double x : {0.0, 0.1, 0.5, 1.0, 2.0, 5.0}) {
    const double known = std::exp(x * x) * std::erfc(x);
    EXPECT_NEAR(scaled_erfc(x), known, 1e-14 * known) << x;
    EXPECT_NEAR(static_cast<double>(scaled_erfc(Quad(x))), known, 1e-14 * known) << x;
  }
}

TEST(ScaledErfc, TheTwoFormsIn113BitsMeet) {
  const Quad below("49.99999999999999999999999999999999"), above(50);
  EXPECT_LE(static_cast<double>(Quad(abs(Quad(scaled_erfc(below) / scaled_erfc(above) - 1)))), 1e-31);
}

/// w e^w = x, the definition, in 113 bits; and every number type agrees with that one.
TEST(LambertW, IsTheInverseOfWTimesItsExponential) {
  for (double x = 1e-36; x < 1e36; x *= 3.7) {
    const Quad w = lambert_w(Quad(x));
    EXPECT_LE(static_cast<double>(Quad(abs(Quad(w * exp(w) / x - 1)))), 1e-30) << x;
    const double exact = static_cast<double>(w);
    EXPECT_NEAR(lambert_w(x), exact, 2e-15 * exact) << x;
    EXPECT_NEAR(static_cast<double>(lambert_w(static_cast<float>(x))), exact, 1e-6 * exact) << x;
    EXPECT_NEAR(lambert_w(Block(x))[3], exact, 2e-15 * exact) << x;
  }
  EXPECT_LE(lambert_w(0.0), 1e-36);
}

}  // namespace
}  // namespace albedo
