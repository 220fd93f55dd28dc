#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "albedo/core/model.hpp"
#include "albedo/microfacet/power_area.hpp"

/// Models that are one another's special cases have the same values.
namespace albedo {
namespace {

void expect_same(const std::string& a, const Parameters& with_a, const std::string& b, const Parameters& with_b) {
  const auto left = make_model(a, with_a), right = make_model(b, with_b);
  std::mt19937_64 engine{5};
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  for (int i = 0; i < 200; ++i) {
    const Direction l = Direction::from_cosine(uniform(), 360 * uniform()),
                    v = Direction::from_cosine(uniform(), 360 * uniform());
    const double f = brdf<double>(*left, l, v), g = brdf<double>(*right, l, v);
    EXPECT_NEAR(f, g, 1e-12 * std::abs(g) + 1e-300) << a << " and " << b;
  }
}

TEST(Relations, StretchedPhongHasPhongAndNeumannAsItsEnds) {
  expect_same("neumann_stretched", {{"n", 15.0}, {"q", 0.0}}, "phong", {{"n", 15.0}});
  expect_same("neumann_stretched", {{"n", 15.0}, {"q", 1.0}}, "neumann_phong", {{"n", 15.0}});
}

TEST(Relations, TheGeneratorIsSmithsSeparableMasking) {
  for (const char* distribution : {"ggx", "beckmann"}) {
    expect_same("microfacet_generator", {{"alpha", 0.4}, {"distribution", distribution}, {"f0", 0.1}}, distribution,
                {{"alpha", 0.4}, {"masking", "separable"}, {"f0", 0.1}});
  }
}

TEST(Relations, SchlicksSlopesAreThoseOfGgx) {
  // r = 1: Z = 1 and G = N·L, so that f is 1/(4π), a quarter of a white matte surface
  expect_same("schlick", {{"r", 1.0}}, "lambert", {{"rho", 0.25}});
}

TEST(Relations, SmoothOrenNayarIsLambert) {
  expect_same("oren_nayar", {{"sigma", 0.0}, {"rho", 0.7}}, "lambert", {{"rho", 0.7}});
}

TEST(Relations, KurtWithoutItsDenominatorAndWardBoundedDifferByTheCosine) {
  const auto kurt = make_model("kurt", {{"m", 0.3}}), bounded = make_model("ward_bounded", {{"alpha", 0.3}});
  const Direction l = Direction::from_degrees(50, 10), v = Direction::from_degrees(35, 170);
  const auto pair = direction_pair(unit_vector<double>(l), unit_vector<double>(v), UnitVector<double>{0, 0, 1});
  EXPECT_NEAR(brdf<double>(*kurt, l, v), brdf<double>(*bounded, l, v) * pair.cos_theta_d, 1e-14);
}

/// A = 1 at normal incidence, and Γ((n+1)/2)/(2√π Γ(n/2+1)) at grazing; n = 0 is (1 + c)/2 and n = 2 is (1 + c)³(3 −
/// c)/16.
TEST(PowerArea, HasItsClosedForms) {
  for (const double n : {0.0, 0.5, 2.0, 20.0, 1e5, 1e8}) {
    const PowerArea area(n);
    EXPECT_NEAR(area(1.0), 1, 1e-14) << n;
    const double z = (n + 1) / 2;  // Stirling's series of Γ(z)/Γ(z+1/2) for large z
    const double ratio =
        n < 100 ? std::tgamma(z) / std::tgamma(z + 0.5) : (1 + 1 / (8 * z) + 1 / (128 * z * z)) / std::sqrt(z);
    const double grazing = ratio / (2 * std::sqrt(std::acos(-1.0)));
    EXPECT_NEAR(area(0.0), grazing, 1e-13 * grazing) << n;
  }
  for (const double c : {0.01, 0.3, 0.8}) {
    EXPECT_NEAR(PowerArea(0)(c), (1 + c) / 2, 1e-14);
    EXPECT_NEAR(PowerArea(2)(c), (1 + c) * (1 + c) / 4, 1e-14);
  }
}

}  // namespace
}  // namespace albedo
