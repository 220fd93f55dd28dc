#include "scaling/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace albedo::bench {
namespace {

TEST(SimulatedFill, EqualTilesEndInRounds) {
  for (const std::size_t cores : {1U, 3U, 10U, 64U}) {
    const SimulatedFill fill = simulate(std::vector<double>(100, 0.5), cores, {});
    const double rounds = std::ceil(100 / static_cast<double>(cores));
    EXPECT_NEAR(fill.seconds, 0.5 * rounds, 1e-12);
    EXPECT_NEAR(fill.efficiency, 100 / (rounds * static_cast<double>(cores)), 1e-12);
    EXPECT_NEAR(fill.efficiency + fill.idle_end, 1, 1e-12);
  }
}

TEST(SimulatedFill, TheCounterServesOneAfterTheOther) {
  // Tiles that cost nothing: the counter alone is the limit.
  const SimulatedFill fill = simulate(std::vector<double>(1000, 0), 50, {.service = 1e-3});
  EXPECT_NEAR(fill.seconds, 1, 1e-9);
  EXPECT_EQ(fill.efficiency, 0);
}

TEST(SimulatedFill, EveryShareIsCounted) {
  std::vector<double> tiles;
  for (int i = 0; i < 500; ++i) tiles.push_back(1 + 0.5 * std::sin(i));
  const SimulatedFill fill = simulate(tiles, 37, {.round_trip = 0.01, .service = 0.001, .write = 0.1});
  EXPECT_NEAR(fill.efficiency + fill.idle_end + fill.waiting + fill.writing, 1, 1e-12);
  EXPECT_GT(fill.waiting, 500 * 0.011 / (37 * fill.seconds) * (1 - 1e-12));
}

TEST(SimulatedFill, ALongLastTileIsWaitedFor) {
  std::vector<double> tiles(10, 1.0);
  tiles.push_back(5);
  const SimulatedFill fill = simulate(tiles, 10, {});
  EXPECT_NEAR(fill.seconds, 6, 1e-12);
  EXPECT_NEAR(fill.idle_end, 9 * 5 / 60.0, 1e-12);
}

}  // namespace
}  // namespace albedo::bench
