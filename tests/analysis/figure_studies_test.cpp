#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>
#include <numbers>

#include "albedo/core/errors.hpp"
#include "analysis/helpers.hpp"
#include "analysis/studies/pumping.hpp"
#include "plots/data/bound_curves.hpp"
#include "plots/data/critical_region.hpp"
#include "plots/data/lobe_fit.hpp"
#include "plots/data/plausibility.hpp"
#include "plots/data/pumped_curves.hpp"

namespace albedo::analysis {
namespace {

constexpr double pi_v = std::numbers::pi;

TEST(CriticalRegion, IsTheSetOfDirectionsWhoseHalfVectorsAreInTheCap) {
  const CriticalRegion found = critical_region({.first_theta = 70, .cap_angle = 12});
  ASSERT_FALSE(found.region.empty());
  // its solid angle by counting, in equal parts of cosθ and of the azimuth
  constexpr int rows = 400, columns = 400;
  int inside = 0;
  for (int i = 0; i < rows; ++i) {
    const double c = (i + 0.5) / rows * 0.5, s = std::sqrt(1 - c * c);
    for (int j = 0; j < columns; ++j) {
      const double phi = pi_v + ((j + 0.5) / columns - 0.5);
      if (furthest_half_vector(found.domains, {s * std::cos(phi), s * std::sin(phi), c}) <= 12) ++inside;
    }
  }
  EXPECT_NEAR(found.solid_angle, inside * 0.5 / (rows * columns), 0.003 * found.solid_angle);
  for (const auto& v : found.region) EXPECT_LE(furthest_half_vector(found.domains, v), 12 + 1e-9);
}

TEST(CriticalRegion, EndsWhereTheArcIsFourCapsLong) {
  EXPECT_TRUE(critical_region({.first_theta = 50 - 1e-6, .cap_angle = 10}).region.empty());
  EXPECT_FALSE(critical_region({.first_theta = 50 + 1e-3, .cap_angle = 10}).region.empty());
  EXPECT_EQ(critical_region({.first_theta = 40, .cap_angle = 10}).solid_angle, 0);
}

TEST(CriticalRegion, SlopesInThePlaneOfIncidenceAreTangentsOfHalfTheDifference) {
  const auto at = [](double theta, double phi) { return unit_vector<double>(Direction::from_degrees(theta, phi)); };
  const ChartPoint slope = slope_point(at(70, 0), at(50, 180));
  EXPECT_NEAR(slope.x, std::tan(10 * pi_v / 180), 1e-15);
  EXPECT_NEAR(slope.y, 0, 1e-15);
  const ChartPoint place = hemisphere_point(at(50, 90));
  EXPECT_NEAR(place.x, 0, 1e-12);
  EXPECT_NEAR(place.y, 50, 1e-12);
}

TEST(CriticalRegion, SaysWhichDomainsItCantHave) {
  EXPECT_EQ(message_of<ParameterError>([] { static_cast<void>(critical_region({.first_theta = 70, .cap_angle = 0})); }),
            "cap_angle is 0.000000 and must be within (0, 20]");
  EXPECT_EQ(message_of<ParameterError>([] { static_cast<void>(critical_region({.first_theta = 5, .cap_angle = 10})); }),
            "first_theta is 5.000000 and must be within [10.000000, 90)");
}

TEST(PumpedCurves, HaveThePeaksThatTheStudyFinds) {
  const auto blinn = make_model("blinn", {{"n", 20.0}});
  const PumpOptions options{.times = 2, .tolerance = 1e-6};
  const PumpedCurves curves = pumped_curves(*blinn, options, {45});
  const PumpStudy study = study_pumping(*blinn, options);
  for (std::size_t k = 0; k <= 2; ++k) {
    const double peak = *std::ranges::max_element(curves.peak[k]);  // at steps of half a degree of L
    EXPECT_LE(peak, study.orders[k].radiance * (1 + 1e-6)) << k;
    EXPECT_GE(peak, study.orders[k].radiance * 0.99) << k;
  }
  // before pumping: f cosθ_L
  const Direction l = Direction::from_degrees(45);
  EXPECT_NEAR(curves.radiance[0][0][180 + 60], brdf<double>(*blinn, l, Direction::from_degrees(30, 180)) * l.cos_theta,
              1e-15);
  EXPECT_NEAR(curves.radiance[0][0][180 - 60], brdf<double>(*blinn, l, Direction::from_degrees(30)) * l.cos_theta,
              1e-15);
}

TEST(Plausibility, IsWhatTheClaimsFound) {
  const auto critical_theta = [](const Plausibility& one) {
    return 90 - std::asin(one.critical.cos_theta) * 180 / pi_v;
  };
  const std::vector<Plausibility> found = plausibility_map({{"", "ward", {{"m", 0.1}}},
                                                            {"", "ward_duer", {{"m", 0.1}}},
                                                            {"", "kurt", {{"m", 0.3}, {"exponent", 0.5}}},
                                                            {"", "kurt", {{"m", 1.8}, {"equation", "9"}}},
                                                            {"", "kurt", {{"m", 3.0}, {"equation", "9"}}}},
                                                           89, 1e-7);
  EXPECT_NEAR(critical_theta(found[0]), 89.9931, 1e-4);
  EXPECT_NEAR(critical_theta(found[1]), 85.5913, 1e-4);
  EXPECT_NEAR(critical_theta(found[2]), 83.177, 1e-3);
  EXPECT_FALSE(found[3].critical.exists);
  EXPECT_TRUE(found[4].critical.exists);
  EXPECT_NEAR(found[0].largest, 0.971051675567, 1e-7);
  EXPECT_EQ(found[0].theta, 0);
  EXPECT_EQ(found[2].theta, 89);
  EXPECT_GT(found[2].largest, 1);
  for (const std::size_t divergent : {0U, 1U, 2U}) EXPECT_TRUE(std::isinf(found[divergent].grazing)) << divergent;
  EXPECT_LT(found[3].grazing, 1);
  EXPECT_GT(found[4].grazing, 1);
  for (const Plausibility& one : found) EXPECT_EQ(one.unconverged, 0);
}

TEST(BoundCurve, OfAPointIsItsValue) {
  const Ward ward{.alpha_x = 0.2, .alpha_y = 0.2};
  const BoundCurve curve = bound_curve(ward, Direction::from_degrees(45), 1e-9, {-30, 20, 45, 70});
  for (const BoundedBox& box : curve.boxes) {
    EXPECT_NEAR(box.product_bound, box.at_middle, 1e-6 * box.at_middle + 1e-12) << box.theta;
    EXPECT_NEAR(box.cosine_bound, std::cos(box.theta * pi_v / 180), 1e-8) << box.theta;
  }
}

TEST(LobeFit, FindsAModelOfTheSameKind) {
  const auto target = make_model("ward", {{"alpha", 0.17}, {"rho_s", 0.3}, {"rho_d", 0.1}});
  const LobeFit fit = fit_lobe(*target, "ward", {}, {{"alpha", 0.02, 1, {0.1, 0.4}}}, {"rho_s", "rho_d"});
  ASSERT_EQ(fit.parameters.size(), 3U);
  EXPECT_NEAR(std::get<double>(fit.parameters[0].second), 0.17, 1e-4);
  EXPECT_NEAR(fit.scale, 0.3, 1e-3);
  EXPECT_NEAR(fit.diffuse, 0.1, 1e-4);
  EXPECT_LT(fit.error, 1e-4);
}

}  // namespace
}  // namespace albedo::analysis
