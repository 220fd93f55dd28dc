#include "analysis/studies/pumping.hpp"

#include <gtest/gtest.h>

namespace albedo::analysis {
namespace {

TEST(PumpStudy, WorthIsTheFirstOrderAfterWhichLittleIsGained) {
  PumpStudy study;
  for (const double average : {0.5, 0.8, 0.9, 0.905, 0.95}) study.orders.push_back({.average = average});
  EXPECT_EQ(study.worth(), 2);
  study.orders.resize(3);
  EXPECT_EQ(study.worth(), -1);
}

// Neumann 1999, §3.2: Blinn is worth pumping once. That is so with the floor of the whole divisor, not with eq. 21 at
// every step.
TEST(PumpStudy, BlinnIsWorthOnePumpingWithTheFloorOfTheWholeDivisor) {
  const auto blinn = make_model("blinn", {{"n", 20.0}});
  const PumpStudy total = study_pumping(*blinn, {.times = 3, .control = PumpControl::total, .tolerance = 1e-6});
  EXPECT_EQ(total.worth(), 1);
  EXPECT_EQ(study_pumping(*blinn, {.times = 3, .control = PumpControl::step, .tolerance = 1e-6}).worth(), -1);
  EXPECT_NEAR(total.orders[0].average, 0.549973146, 1e-6);
  EXPECT_NEAR(total.orders[0].largest, 1, 1e-6);
  EXPECT_NEAR(total.orders[0].distance, 1 - total.orders[0].smallest, 1e-6);
}

// §3.1: without control the output radiance grows to an off-specular peak, more for Blinn than for Phong; with the
// floor of the whole divisor it doesn't grow at all.
TEST(PumpStudy, ControlKeepsTheRadianceOfTheMirrorDirection) {
  for (const char* name : {"phong", "blinn"}) {
    const auto model = make_model(name, {{"n", 20.0}});
    const PumpStudy free = study_pumping(*model, {.times = 4, .tolerance = 1e-6});
    const PumpStudy total = study_pumping(*model, {.times = 4, .control = PumpControl::total, .tolerance = 1e-6});
    const double before = free.orders[0].radiance;
    EXPECT_GT(free.orders[4].radiance, 1.7 * before) << name;
    EXPECT_GT(free.orders[4].theta_l, 80) << name;
    for (const PumpedOrder& order : total.orders) EXPECT_NEAR(order.radiance, before, 1e-5 * before) << name;
  }
}

}  // namespace
}  // namespace albedo::analysis
