// The parts of a plan: what errors show, and the least curves and tables within bounds.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "albedo/table_growth.hpp"
#include "analysis/scenes/plan/requirement.hpp"
#include "analysis/scenes/plan/surface.hpp"
#include "analysis/text/svg.hpp"

#include "albedo/core/errors.hpp"
#include "analysis/helpers.hpp"

namespace albedo::analysis {
namespace {

TEST(PlanRequirement, ThePointLightErrorIsTheLargestOverAllRadiances) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < 200; ++i) {
    const Appearance look{.white_albedo = 0.2 + 1.2 * unit(random),
                          .radiance = unit(random),
                          .peak = 3 * unit(random),
                          .facet_reflectance = unit(random)};
    const double tabulated = 0.2 + 1.2 * unit(random);
    const double k = correction_factor(look.white_albedo, look.facet_reflectance);
    const double used = correction_factor(tabulated, look.facet_reflectance);
    double largest = 0;
    for (int r = 0; r <= 20'000; ++r) {
      const double radiance = look.peak * r / 20'000;
      largest = std::max(largest, std::abs(std::min(1.0, radiance * k) - std::min(1.0, radiance * used)));
    }
    const PictureError error = picture_error(look, tabulated);
    EXPECT_NEAR(error.point, largest, 1e-3);
    EXPECT_GE(error.point, largest - 1e-12);
    EXPECT_NEAR(error.furnace, look.radiance * std::abs(k - used), 1e-15);
  }
}

TEST(PlanRequirement, WhatIsAllowedEndsWhereTheErrorIsTheTolerance) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit;
  constexpr double tolerance = 0.004;
  for (int i = 0; i < 1000; ++i) {
    const Appearance look{.white_albedo = 0.1 + 1.5 * unit(random),
                          .radiance = unit(random),
                          .peak = 2 * unit(random) * unit(random),
                          .facet_reflectance = unit(random)};
    const Allowed range = allowed(look, tolerance);
    EXPECT_LE(range.low, look.white_albedo);
    EXPECT_GE(range.high, look.white_albedo);
    const auto error = [&](double at) { return picture_error(look, at).largest(); };
    if (range.low > 0) {
      EXPECT_NEAR(error(range.low), tolerance, 1e-12);
      EXPECT_GT(error(range.low * 0.99), tolerance);
    }
    if (std::isfinite(range.high)) {
      EXPECT_NEAR(error(range.high), tolerance, 1e-12);
      EXPECT_GT(error(range.high * 1.01), tolerance);
    }
  }
}

TEST(PlanRequirement, NothingIsBrighterThanThePeak) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit;
  for (const auto& [name, parameters] : std::vector<std::pair<std::string, Parameters>>{
           {"ggx", {{"alpha", 0.3}}}, {"ward", {{"alpha", 0.05}}}, {"phong", {{"n", 20.0}}}, {"beckmann", {}}}) {
    const auto model = make_model(name, parameters);
    for (const double theta : {0.0, 30.0, 60.0, 80.0}) {
      const Direction l = Direction::from_degrees(theta);
      const double peak = peak_radiance(*model, l.cos_theta, 0);
      for (int i = 0; i < 3000; ++i) {
        const Direction v = Direction::from_degrees(90 * unit(random), 180 + 20 * (unit(random) - 0.5));
        EXPECT_LE(std::numbers::pi * brdf<double>(*model, l, v) * v.cos_theta, 1.005 * peak) << name << ' ' << theta;
      }
    }
  }
}

/// A smooth curve and what is allowed around it.
Tube tube_around(const CosineGrid& grid, double half_width) {
  Tube tube(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double value = 0.5 + 0.4 * std::sin(5 * grid.cosine(i));
    tube.low[i] = value - half_width, tube.high[i] = value + half_width;
  }
  return tube;
}

/// A lower bound of the number of pieces: those of a curve that may jump between them.
std::size_t fewest_pieces(const Tube& tube, const CosineGrid& grid) {
  const auto is_one_line = [&](std::size_t begin, std::size_t end) {
    // a line within exists if no pair of low points lies above a pair of high ones: lines through two bounds suffice
    for (std::size_t i = begin; i <= end; ++i) {
      for (std::size_t j = begin; j <= end; ++j) {
        if (i == j) continue;
        const double slope = (tube.high[j] - tube.low[i]) / (grid.cosine(j) - grid.cosine(i));
        bool is_within = true;
        for (std::size_t k = begin; k <= end && is_within; ++k) {
          const double value = tube.low[i] + slope * (grid.cosine(k) - grid.cosine(i));
          is_within = value >= tube.low[k] - 1e-12 && value <= tube.high[k] + 1e-12;
        }
        if (is_within) return true;
      }
    }
    return false;
  };
  std::size_t pieces = 0;
  for (std::size_t begin = 0; begin + 1 < grid.size(); ++pieces) {
    std::size_t end = begin + 1;
    while (end + 1 < grid.size() && is_one_line(begin, end + 1)) ++end;
    begin = end;
  }
  return pieces;
}

TEST(PlanTube, TheLeastCurveHasHardlyMorePiecesThanOneThatMayJump) {
  const CosineGrid grid(0, 70);
  for (const double half_width : {0.1, 0.02, 0.005, 0.002}) {
    const Tube tube = tube_around(grid, half_width);
    const auto curve = least_curve(tube, grid, 16);
    ASSERT_TRUE(curve);
    EXPECT_TRUE(is_within(*curve, tube, grid));
    const std::size_t pieces = fewest_pieces(tube, grid);
    EXPECT_GE(curve->values.size() - 1, pieces);
    EXPECT_LE(curve->values.size() - 1, pieces + 1);
  }
}

TEST(PlanTube, ValuesAreWhatTheBitsHold) {
  const CosineGrid grid(0, 85);
  const Tube tube = tube_around(grid, 0.01);
  for (const int bits : {8, 10, 16}) {
    const auto curve = least_curve(tube, grid, bits);
    ASSERT_TRUE(curve);
    const double most = std::exp2(bits) - 1;
    for (const double value : curve->values) EXPECT_NEAR(value * most, std::round(value * most), 1e-9);
    const std::size_t n = curve->values.size();
    EXPECT_EQ(curve->bytes(), (n * (static_cast<std::size_t>(bits) + 8) + 7) / 8);
    EXPECT_TRUE(is_within(*curve, tube, grid));
  }
  const auto floats = least_curve(tube, grid, 32);
  for (const double value : floats->values) EXPECT_EQ(value, static_cast<double>(static_cast<float>(value)));
  EXPECT_FALSE(least_curve(tube_around(grid, 1e-4), grid, 8));  // no multiple of 1/255 is that near
  EXPECT_EQ(smallest_curve(tube_around(grid, 1e-4), grid)->quantisation.bits, 16);
}

TEST(PlanTube, AConstantIsOneNode) {
  const CosineGrid grid(0, 85);
  Tube tube(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) tube.low[i] = 0.3, tube.high[i] = 0.31;
  const auto curve = smallest_curve(tube, grid);
  ASSERT_EQ(curve->values.size(), 1U);
  EXPECT_EQ(curve->bytes(), 1U);
  tube.low[3] = 0.32;
  EXPECT_TRUE(tube.is_empty());
  EXPECT_FALSE(smallest_curve(tube, grid));
}

TEST(PlanSurface, NoPlaceCanBeTakenAway) {
  const CosineGrid grid(0, 85);
  SurfaceReference reference;
  for (int s = 0; s <= 16; ++s) {
    reference.second.push_back(s / 16.0);
    auto& values = reference.values.emplace_back();
    Tube& tube = reference.tubes.emplace_back(grid.size());
    for (std::size_t i = 0; i < grid.size(); ++i) {
      values.push_back(1 - 0.5 * reference.second.back() * std::sin(3 * grid.cosine(i)));
      tube.low[i] = values.back() - 0.01, tube.high[i] = values.back() + 0.01;
    }
  }
  const auto table = least_surface(reference, grid);
  ASSERT_TRUE(table);
  EXPECT_TRUE(is_within(*table, reference, grid));
  EXPECT_EQ(table->second.size(), 2U);  // it is linear along there
  for (std::size_t i = 1; i + 1 < table->cosines.size(); ++i) {
    EXPECT_FALSE(is_within(table->without_cosine(i), reference, grid)) << i;
  }
  for (std::size_t i = 0; i < 2; ++i) EXPECT_FALSE(is_within(table->without_second(i), reference, grid));
  EXPECT_NEAR((*table)(0.5, 0.6), 1 - 0.25 * std::sin(1.8), 0.011);
}

TEST(TableGrowth, PlacesNodesWhereTheyAreNeeded) {
  const TableEntries root = [](const std::vector<TableAxis>& axes) {
    std::vector<double> values;
    for (const double x : axes[0].values) values.push_back(std::sqrt(x));
    return values;
  };
  const GrownTable table = grown({{"cos_theta", {0, 1}}}, root, {.max_error = 1e-3});
  EXPECT_TRUE(table.is_reached);
  EXPECT_LE(table.error, 1e-3);
  const std::vector<double>& nodes = table.axes[0].values;
  EXPECT_LT(nodes[1] - nodes[0], (nodes.back() - nodes[nodes.size() - 2]) / 1000);
  const GrownTable coarse = grown({{"cos_theta", {1, 0}}}, root, {.max_error = 1e-3, .most_entries = 10});
  EXPECT_FALSE(coarse.is_reached);
  EXPECT_GT(coarse.error, 1e-3);
  EXPECT_THROW(grown({{"cos_theta", {0, 1, 0.5}}}, root, {.max_error = 1e-3}), ParameterError);
  EXPECT_THROW(grown({{"cos_theta", {0, 1}}}, root, {.max_error = NAN}), ParameterError);
  EXPECT_FALSE(grown({{"cos_theta", {0, 1}}}, root, {.max_error = 1e-3, .bits = 8}).is_reached);
  const GrownTable held = grown({{"cos_theta", {0, 1}}}, root, {.max_error = 4e-3, .bits = 8});
  EXPECT_TRUE(held.is_reached);
}

TEST(TableGrowth, QuantisedEntriesSayHowFarTheyAreOff) {
  const QuantisedEntries entries = quantised({0, 0.3, 1, infinity}, 8);
  EXPECT_EQ(entries.values[1], std::round(0.3 * 255) / 255);
  EXPECT_NEAR(entries.error, std::abs(entries.values[1] - 0.3), 1e-16);
  EXPECT_EQ(entries.values[3], infinity);
  EXPECT_EQ(quantised({2.5, 0.1}, 10).scale, 2.5);
  EXPECT_EQ(quantised({0.1}, 0).values[0], 0.1);
}

TEST(PlanPage, TextIsEscaped) {
  EXPECT_EQ(escaped("<script>\"a\" & 'b'\x01"), "&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39; ");
  const std::string chart = svg({.title = "<b>", .lines = {{.points = {{0, 0}, {0.5, NAN}, {1, infinity}}}}});
  EXPECT_TRUE(contains(chart, "&lt;b&gt;"));
  EXPECT_FALSE(contains(chart, "nan"));
  EXPECT_FALSE(contains(chart, "inf"));
}

}  // namespace
}  // namespace albedo::analysis
