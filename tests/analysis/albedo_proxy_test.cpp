#include "analysis/studies/albedo_proxy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "albedo/core/errors.hpp"

namespace albedo::analysis {
namespace {

ProxyEntries entries_of(const std::string& model, const Parameters& fixed, double tolerance) {
  return [=](const std::vector<TableAxis>& axes) {
    const AlbedoTable table(model, fixed, axes, {.albedo = {.tolerance = tolerance}, .verified_cells = 0});
    return ProxySamples{table.values(), table.unconverged(), table.evaluations()};
  };
}

std::vector<double> range(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(std::lerp(from, to, i / (count - 1.0)));
  return values;
}

TEST(AlbedoProxy, FillsATableFromFewerIntegrationsThanItHasEntries) {
  const std::vector<TableAxis> axes{{"alpha", range(0.1, 1, 300)}, {"cos_theta", range(0.01, 1, 300)}};
  const ProxyEntries entries = entries_of("ggx", {}, 1e-8);
  const AlbedoProxy proxy(axes, entries, {.tolerance = 1e-5, .verified = 64});
  EXPECT_TRUE(proxy.is_reached()) << proxy.error();
  EXPECT_LT(proxy.integrations(), 90'000U / 20);
  const std::vector<double> filled = proxy.fill(axes);
  ASSERT_EQ(filled.size(), 90'000U);
  const std::vector<TableAxis> some{{"alpha", {axes[0].values[7], axes[0].values[151]}},
                                    {"cos_theta", {axes[1].values[0], axes[1].values[3], axes[1].values[200]}}};
  const std::vector<double> exact = entries(some).values;
  const std::vector<std::size_t> places{7 * 300, 7 * 300 + 3, 7 * 300 + 200, 151 * 300, 151 * 300 + 3, 151 * 300 + 200};
  for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_NEAR(filled[places[i]], exact[i], 1e-5);
  EXPECT_EQ(filled, proxy.fill(axes, 3));
}

TEST(AlbedoProxy, SaysSoWhereItDoesNotReachTheTolerance) {
  const std::vector<TableAxis> axes{{"m", range(0.1, 0.6, 20)}, {"cos_theta", range(0.01, 1, 20)}};
  const ProxyEntries kinked = [](const std::vector<TableAxis>& grid) {
    ProxySamples samples;
    for (const double m : grid[0].values) {
      for (const double c : grid[1].values) samples.values.push_back(std::abs(c - m));
    }
    return samples;
  };
  const AlbedoProxy proxy(axes, kinked, {.tolerance = 1e-6, .most_integrations = 5000});
  EXPECT_FALSE(proxy.is_reached());
  EXPECT_GT(proxy.error(), 1e-6);
}

TEST(AlbedoProxy, HoldsNoInfiniteAlbedo) {
  const AlbedoProxy proxy({{"cos_theta", {0, 1}}}, entries_of("ward", {{"alpha", 0.3}}, 1e-6), {.verified = 8});
  EXPECT_FALSE(proxy.is_reached());
  EXPECT_TRUE(std::isinf(proxy.error()));
}

}  // namespace
}  // namespace albedo::analysis
