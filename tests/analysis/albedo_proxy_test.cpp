#include "albedo/proxy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "albedo/core/errors.hpp"
#include "albedo/table_source.hpp"

namespace albedo::analysis {
namespace {

ProxyEntries entries_of(const std::string& model, const Parameters& fixed, const std::vector<TableAxis>& axes,
                        double tolerance) {
  const auto source =
      std::make_shared<const TableSource>(model, fixed, axes, TableOptions{.albedo = {.tolerance = tolerance}});
  return [source](const std::vector<double>& places) {
    ProxySamples samples;
    TableSource::Worker worker(*source);
    const auto dimensions = static_cast<std::ptrdiff_t>(source->axes().size());
    for (auto place = places.begin(); place != places.end(); place += dimensions) {
      const Estimate a = worker.at({place, place + dimensions});
      samples.values.push_back(a.value);
      samples.errors.push_back(a.error);
      samples.evaluations += a.evaluations;
    }
    return samples;
  };
}

/// Entries that a function of two values has, without errors.
template <class Function>
ProxyEntries entries_of(const Function& function) {
  return [=](const std::vector<double>& places) {
    ProxySamples samples;
    for (std::size_t k = 0; k < places.size(); k += 2) samples.values.push_back(function(places[k], places[k + 1]));
    samples.errors.resize(samples.values.size(), 0);
    return samples;
  };
}

std::vector<double> range(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(std::lerp(from, to, i / (count - 1.0)));
  return values;
}

TEST(AlbedoProxy, FillsATableFromFewerIntegrationsThanItHasEntries) {
  const std::vector<TableAxis> axes{{"alpha", range(0.1, 1, 300)}, {"cos_theta", range(0.01, 1, 300)}};
  const ProxyEntries entries = entries_of("ggx", {}, axes, 5e-7);
  const AlbedoProxy proxy(axes, entries, {.tolerance = 1e-5, .verified = 200});
  EXPECT_TRUE(proxy.is_reached()) << proxy.error();
  EXPECT_LT(proxy.integrations(), 90'000U / 100);
  EXPECT_EQ(proxy.verified(), 200U);
  const std::vector<double> filled = proxy.fill(axes);
  ASSERT_EQ(filled.size(), 90'000U);
  for (const std::size_t place : {2'100UL, 2'103UL, 2'300UL, 45'300UL, 45'303UL, 45'500UL}) {
    const double exact = entries({axes[0].values[place / 300], axes[1].values[place % 300]}).values.front();
    EXPECT_NEAR(filled[place], exact, 1e-5);
  }
  EXPECT_EQ(filled, proxy.fill(axes, 3));
  for (const std::vector<double>& outside : {std::vector{1.001, 0.5}, {0.0999, 0.5}, {0.5, 0.0099}, {0.5, NAN}}) {
    EXPECT_THROW(static_cast<void>(proxy(outside)), ParameterError) << outside[0] << ' ' << outside[1];
  }
}

TEST(AlbedoProxy, EntriesDoNotDependOnHowATableIsCut) {
  const std::vector<TableAxis> axes{
      {"alpha", range(0.2, 1, 13)}, {"f0", {0.04, 0.3, 0.9}}, {"cos_theta", range(0.05, 1, 57)}};
  const ProxyEntries entries = entries_of("ggx", {}, axes, 1e-4);
  const AlbedoProxy proxy(axes, entries, {.tolerance = 1e-3, .verified = 20});
  EXPECT_FALSE(proxy.is_series(1));
  EXPECT_TRUE(proxy.is_series(2));
  const std::vector<double> whole = proxy.fill(axes, 2);
  AlbedoProxy::Filler filler(proxy, axes);
  ASSERT_EQ(filler.size(), whole.size());
  for (const std::size_t run : {1UL, 31UL, 57UL, 64UL, 1000UL}) {
    std::vector<double> cut(whole.size());
    AlbedoProxy::Filler own(filler);
    for (std::size_t end = cut.size(); end > 0;) {  // from the last run to the first
      const std::size_t begin = end > run ? end - run : 0;
      own.fill(begin, std::span(cut).subspan(begin, end - begin));
      end = begin;
    }
    EXPECT_EQ(cut, whole) << run;
  }
}

TEST(AlbedoProxy, AzimuthIsFoldedWhereTheAlbedoHasAnEllipsesSymmetry) {
  const std::vector<TableAxis> axes{{"cos_theta", {0.3}}, {"phi", range(-180, 360, 400)}};
  const ProxyEntries entries = entries_of("ggx", {{"alpha_x", 0.1}, {"alpha_y", 0.6}}, axes, 1e-7);
  const AlbedoProxy proxy(axes, entries, {.tolerance = 1e-6, .verified = 100});
  EXPECT_TRUE(proxy.is_reached()) << proxy.error();
  EXPECT_LT(proxy.sizes()[1], 40U);
  // what isn't symmetric gets a series over the whole axis
  const std::vector<TableAxis> plain{{"cos_theta", {0.3}}, {"phi", range(0, 360, 400)}};
  const AlbedoProxy wave(plain, entries_of([](double, double phi) { return 1 + std::sin(phi * 0.0174532925) / 2; }));
  EXPECT_TRUE(wave.is_reached()) << wave.error();
  EXPECT_NEAR(wave({0.3, 270}), 0.5, 1e-6);
}

TEST(AlbedoProxy, AxisWithAKinkIsHeldByItsValues) {
  const std::vector<TableAxis> axes{{"m", range(0.1, 0.6, 200)}, {"cos_theta", range(0.01, 1, 150)}};
  const AlbedoProxy proxy(axes, entries_of([](double m, double c) { return m * m + std::max(c - 0.4, 0.0) / (m + 1); }),
                          {.verified = 50});
  EXPECT_TRUE(proxy.is_reached()) << proxy.error();
  EXPECT_TRUE(proxy.is_series(0));
  EXPECT_FALSE(proxy.is_series(1));
  EXPECT_EQ(proxy.sizes()[1], 150U);
  EXPECT_THROW(static_cast<void>(proxy({0.3, 0.01234})), ParameterError);
}

TEST(AlbedoProxy, WhatIsOnlyIntegratedIsNotVerified) {
  const std::vector<TableAxis> axes{{"m", {0.1, 0.2}}, {"cos_theta", {0.5, 0.7, 1}}};
  const AlbedoProxy proxy(axes, entries_of([](double m, double c) { return m * c; }));
  EXPECT_EQ(proxy.integrations(), 6U);
  EXPECT_EQ(proxy.verified(), 0U);
  EXPECT_EQ(proxy({0.2, 0.7}), 0.2 * 0.7);
}

TEST(AlbedoProxy, SaysSoWhereItDoesNotReachTheTolerance) {
  const std::vector<TableAxis> axes{{"m", range(0.1, 0.6, 400)}, {"cos_theta", range(0.01, 1, 400)}};
  // a ridge that none of the lines at the corners and in the middle crosses
  const ProxyEntries ridge = entries_of([](double m, double c) {
    return 1 + 0.01 * std::max(0.0, 0.1 - std::abs(m - 0.33)) * std::exp(-200 * std::pow(c - 0.6, 2));
  });
  const AlbedoProxy proxy(axes, ridge, {.tolerance = 1e-6, .most_integrations = 5000});
  EXPECT_FALSE(proxy.is_reached());
  EXPECT_GT(proxy.error(), 1e-6);
}

TEST(AlbedoProxy, NaNIsNoSmallError) {
  const std::vector<TableAxis> axes{{"m", range(0.1, 0.6, 400)}, {"cos_theta", range(0.01, 1, 400)}};
  std::size_t calls = 0;
  const ProxyEntries entries = [&calls](const std::vector<double>& places) {
    ProxySamples samples;
    samples.values.resize(places.size() / 2, 1);
    samples.errors.resize(places.size() / 2, 0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (++calls == 4) samples.values[5] = nan;  // lines along both axes, the tensor, the verification
    return samples;
  };
  const AlbedoProxy proxy(axes, entries);
  EXPECT_EQ(calls, 4U);
  EXPECT_TRUE(std::isnan(proxy.error()));
  EXPECT_FALSE(proxy.is_reached());
}

TEST(AlbedoProxy, WhatIntegrationsClaimOfThemselvesIsPartOfTheError) {
  const std::vector<TableAxis> axes{{"m", range(0.1, 0.6, 400)}, {"cos_theta", range(0.01, 1, 400)}};
  const AlbedoProxy proxy(axes, [](const std::vector<double>& places) {
    ProxySamples samples;
    samples.values.resize(places.size() / 2, 0.5);
    samples.errors.resize(places.size() / 2, 1e-5);
    return samples;
  });
  EXPECT_FALSE(proxy.is_reached());
  EXPECT_DOUBLE_EQ(proxy.error(), 2e-5);
}

TEST(AlbedoProxy, HoldsNoInfiniteAlbedo) {
  const std::vector<TableAxis> axes{{"cos_theta", {0, 1}}};
  const AlbedoProxy proxy(axes, entries_of("ward", {{"alpha", 0.3}}, axes, 1e-6), {.verified = 8});
  EXPECT_FALSE(proxy.is_reached());
  EXPECT_TRUE(std::isinf(proxy.error()));
}

TEST(AlbedoProxy, RefusesWrongInput) {
  const ProxyEntries one = entries_of([](double, double) { return 1.0; });
  EXPECT_THROW(AlbedoProxy({{"m", {}}, {"cos_theta", {1}}}, one), ParameterError);
  EXPECT_THROW(AlbedoProxy({{"m", {1}}, {"cos_theta", {1}}}, one, {.tolerance = 0}), ParameterError);
  EXPECT_THROW(AlbedoProxy({{"m", {1, 2, 3}}, {"cos_theta", {0.5, 1}}}, one, {.most_integrations = 5}), ParameterError);
}

}  // namespace
}  // namespace albedo::analysis
