#include "albedo/combinators/coupled.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "albedo/audit.hpp"
#include "albedo/core/errors.hpp"

namespace albedo {
namespace {

TEST(Coupled, BodyTakesWhatTheSurfaceLeaves) {
  for (const auto& [name, parameters] : {std::pair<const char*, Parameters>{"ggx", {{"alpha", 0.2}, {"f0", 0.04}}},
                                         {"ashikhmin_shirley", {{"n", 40.0}, {"r_s", 0.3}}},
                                         {"ward_bounded", {{"alpha", 0.3}, {"rho_s", 0.5}}},
                                         {"phong", {{"n", 30.0}}}}) {
    const auto surface = make_model(name, parameters);
    for (const double r_m : {1.0, 0.4}) {
      const auto whole = coupled(make_model(name, parameters), r_m);
      for (const double theta : {0.0, 50.0, 85.0, 89.9}) {
        const Direction l = Direction::from_degrees(theta);
        const double r = directional_albedo(*surface, l).value;
        const Estimate a = directional_albedo(*whole, l, {.tolerance = 1e-7});
        EXPECT_EQ(a.status, Status::converged) << name << ' ' << theta;
        EXPECT_NEAR(a.value, r + r_m * (1 - r), a.error + 3e-8) << name << ' ' << theta;
        EXPECT_LE(a.value - a.error, 1) << name << ' ' << theta;
      }
    }
  }
}

TEST(Coupled, IsTheClosedPolynomialForASmoothSurface) {
  // a needle of Schlick's reflectance has R = r₀ + (1 − r₀)(1 − cosθ)⁵ but for its width
  const auto whole = coupled(make_model("ward_bounded", {{"alpha", 1e-3}, {"rho_s", 0.0}}), 0.7);
  EXPECT_NEAR(directional_albedo(*whole, Direction::from_degrees(70)).value, 0.7, 1e-9);  // nothing above: Lambert
  const double r0 = 0.05;
  const auto needle = coupled(make_model("beckmann", {{"alpha", 1e-4}, {"f0", r0}}), 0.7);
  const auto polynomial = make_model("shirley_matte", {{"r0", r0}, {"r_m", 0.7}});
  for (const double theta : {0.0, 30.0, 60.0, 75.0}) {
    const Direction l = Direction::from_degrees(theta), v = Direction::from_degrees(theta / 2 + 20, 130);
    const double r = r0 + (1 - r0) * std::pow(1 - l.cos_theta, 5);
    EXPECT_NEAR(directional_albedo(*needle, l).value, r + directional_albedo(*polynomial, l).value, 1e-6) << theta;
    EXPECT_NEAR(brdf<double>(*needle, l, v), brdf<double>(*polynomial, l, v), 1e-6) << theta;  // V off the needle
  }
}

TEST(Coupled, PassesItsAudit) {
  const auto whole = coupled(make_model("cook_torrance", {{"m", 0.3}, {"f0", 0.1}}), 0.8);
  const Audit found = audit(*whole, {.albedo = {.tolerance = 1e-6}, .grazing = false, .average = false});
  EXPECT_EQ(found.energy.verdict, Verdict::pass);
  EXPECT_EQ(found.reciprocity.verdict, Verdict::pass);
  EXPECT_EQ(found.sampler_verdict(), Verdict::pass);
  EXPECT_EQ(found.samplers.size(), 6U);  // two lobes, three directions
}

TEST(Coupled, RefusesWhatLeavesNothing) {
  EXPECT_THROW(coupled(nullptr), ParameterError);
  EXPECT_THROW(coupled(make_model("ward")), ParameterError);
  EXPECT_THROW(coupled(make_model("ggx", {{"alpha_x", 0.5}})), ParameterError);
  EXPECT_THROW(coupled(make_model("ggx"), 1.5), ParameterError);
  EXPECT_THROW(coupled(make_model("ggx"), std::nan("")), ParameterError);
}

}  // namespace
}  // namespace albedo
