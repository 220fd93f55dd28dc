#include "albedo/core/proxy_variable.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace albedo::analysis {
namespace {

TEST(ProxyVariable, ValueAtIsTheInverse) {
  const auto check = [](const std::string& axis, double least, double largest, bool is_elliptic) {
    for (const ProxyVariable& variable : proxy_variables(axis, least, largest, is_elliptic)) {
      for (double u = -1; u <= 1; u += 0.0625) {
        const double value = variable.value_at(u);
        EXPECT_GE(value, least - 1e-12) << axis;
        EXPECT_LE(value, largest + 1e-12) << axis;
        EXPECT_NEAR(variable.of(value), u, 1e-7) << axis << ' ' << u;
      }
    }
  };
  check("alpha", 0.01, 1, false);
  check("alpha", 0.5, 1, false);
  check("f0", 0, 1, false);
  check("cos_theta", 0, 1, false);
  check("cos_theta", 0.02, 1, false);
  check("theta", 0, 90, false);
  check("theta", 10, 80, false);
  check("phi", 0, 45, false);
  check("phi", 0, 90, true);
}

TEST(ProxyVariable, AzimuthIsFolded) {
  for (const auto& [phi, folded] :
       {std::pair{0.0, 0.0}, {90, 90}, {135, 45}, {180, 0}, {270, 90}, {-30, 30}, {350, 10}}) {
    EXPECT_DOUBLE_EQ(folded_azimuth(phi), folded) << phi;
    for (const ProxyVariable& variable : proxy_variables("phi", 0, 360, true)) {
      EXPECT_DOUBLE_EQ(variable.of(phi), variable.of(folded)) << phi;
    }
  }
}

TEST(ProxyVariable, TransformGivesTheCoefficients) {
  for (const std::size_t size : {2UL, 3UL, 6UL, 9UL}) {
    const std::vector<double> points = lobatto_points(size), transform = chebyshev_transform(size);
    for (std::size_t term = 0; term < size; ++term) {
      for (std::size_t k = 0; k < size; ++k) {
        double coefficient = 0;
        for (std::size_t j = 0; j < size; ++j) {
          coefficient += transform[k * size + j] * std::cos(static_cast<double>(term) * std::acos(points[j]));
        }
        EXPECT_NEAR(coefficient, k == term ? 1 : 0, 1e-14) << size << ' ' << term << ' ' << k;
      }
    }
  }
  std::vector<double> terms(5);
  chebyshev(0.3, 5, terms.data());
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(terms[k], std::cos(static_cast<double>(k) * std::acos(0.3)), 1e-15);
}

}  // namespace
}  // namespace albedo::analysis
