#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "albedo/core/quad.hpp"
#include "albedo/directional_albedo.hpp"
#include "albedo/microfacet/wave_series.hpp"
#include "golden/entries.hpp"

/// Values that share nothing with the library: closed forms and an independent quadrature. README.md says how they were
/// made.
namespace albedo {
namespace {

using nlohmann::json;

std::string describe(const json& entry) {
  return entry.at("model").get<std::string>() + " " + entry.at("parameters").dump() + " at " +
         entry.at("theta_deg").dump() + ", phi " + entry.at("phi_deg").dump();
}

Direction direction_of(const json& entry) {
  return Direction::from_degrees(entry.at("theta_deg").get<double>(), entry.at("phi_deg").get<double>());
}

struct File {
  const char* name;
  std::size_t entries;
  double quad_tolerance = 1e-15;  // angles and parameters are decimal there: more can't be asked of doubles
};

class Golden : public ::testing::TestWithParam<File> {
 protected:
  /// Calls check(entry, model, direction, exact value) for every entry.
  template <class Check>
  void for_each_entry(const Check& check) {
    const json entries = read(GetParam().name);
    ASSERT_EQ(entries.size(), GetParam().entries);
    for (const json& entry : entries) {
      const auto model = make_model(entry.at("model").get<std::string>(), parameters_of(entry));
      check(entry, *model, direction_of(entry), std::stod(entry.at("albedo").get<std::string>()));
    }
  }
};

/// What the file itself leaves open: its last digit, its rounding to double, and that of the angle, which is a decimal
/// there (89.9 as a double is up to 7e-15 off, and cosθ 90/(90 − θ) times as much; a coherent part e^(−g), g ~ cos²θ,
/// 2g times that).
double uncertainty(const json& entry, double exact) {
  const double digits = entry.value("digits", 30.0), theta = entry["theta_deg"];
  double rounding = theta < 90 ? 2e-16 * std::max(1.0, 90 / (90 - theta)) : 2e-16;
  if (entry["parameters"].value("part", "") == "specular") rounding *= std::max(1.0, -2 * std::log(exact));
  return std::abs(exact) * (std::pow(10, 1 - digits) + rounding);
}

TEST_P(Golden, GaussIsWithinItsError) {
  for_each_entry([](const json& entry, const Model& model, const Direction& l, double exact) {
    for (const double tolerance : {1e-6, 1e-10}) {
      const Estimate e = directional_albedo(model, l, {.tolerance = tolerance});
      // the limit at 90° is approached only so far: its error may say that it isn't known to the tolerance
      EXPECT_TRUE(e.status == Status::converged || l.cos_theta == 0) << describe(entry);
      EXPECT_LE(std::abs(e.value - exact), e.error + uncertainty(entry, exact))
          << describe(entry) << ": " << e.value - exact << " from " << exact << ", error " << e.error;
      if (e.status != Status::converged) continue;
      EXPECT_LE(std::abs(e.value - exact), tolerance * std::abs(exact) + uncertainty(entry, exact)) << describe(entry);
    }
  });
}

TEST_P(Golden, OtherRulesAgree) {
  for_each_entry([](const json& entry, const Model& model, const Direction& l, double exact) {
    const Estimate cubature = directional_albedo(model, l, {.rule = Rule::cubature, .tolerance = 1e-6});
    EXPECT_EQ(cubature.status, Status::converged) << describe(entry);
    EXPECT_LE(std::abs(cubature.value - exact), cubature.error + uncertainty(entry, exact))
        << describe(entry) << ": " << cubature.value << " for " << exact << ", error " << cubature.error;
    const Estimate stratified =
        directional_albedo(model, l, {.rule = Rule::stratified, .tolerance = 1e-2, .budget = 100'000, .seed = 5});
    constexpr double widest = 6;  // standard errors: one of 16 replicates exceeds that in one of 40 000 cases
    EXPECT_LE(std::abs(stratified.value - exact), widest * stratified.error + uncertainty(entry, exact))
        << describe(entry) << ": " << stratified.value << " for " << exact << ", error " << stratified.error;
  });
}

TEST_P(Golden, QuadAsksForMore) {
  const json entries = read(GetParam().name);
  for (std::size_t i = 0; i < entries.size(); i += 9) {
    const json& entry = entries[i];
    if (entry.at("theta_deg").get<double>() >= 89) continue;
    const auto model = make_model(entry.at("model").get<std::string>(), parameters_of(entry));
    const Estimate e = directional_albedo(*model, direction_of(entry),
                                          {.precision = Precision::quad, .tolerance = GetParam().quad_tolerance});
    const double exact = std::stod(entry.at("albedo").get<std::string>());
    EXPECT_EQ(e.status, Status::converged) << describe(entry);
    const double conditioned = 2e-13 * std::abs(exact);
    EXPECT_LE(std::abs(e.value - exact), e.error + uncertainty(entry, exact) + conditioned) << describe(entry);
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Golden,
                         ::testing::Values(File{"closed_forms.json", 187}, File{"independent.json", 65},
                                           File{"more_models.json", 155}, File{"he_torrance.json", 39, 1e-9}),
                         [](const auto& instance) {
                           const std::string file = instance.param.name;
                           return file.substr(0, file.find('.'));
                         });

/// He and Torrance's series against terms added up one by one, in every number type.
TEST(WaveSeries, IsTheSumOfItsTerms) {
  const json entries = read("wave_series.json");
  ASSERT_EQ(entries.size(), 270U);
  for (const json& entry : entries) {
    const double g = entry.at("g").get<double>();
    const Quad b(entry.at("b").get<std::string>()), exact(entry.at("value").get<std::string>());
    const double ratio = static_cast<double>(Quad(b / Quad(g))), value = static_cast<double>(exact);
    const auto what = "g = " + entry.at("g").dump() + ", b = " + entry.at("b").dump();
    // b/g as a double is half a digit off, and so is e^(−b/m)
    const double condition = 4e-16 * static_cast<double>(b) / std::max(g, 1.0);
    EXPECT_NEAR(wave_series(g, ratio), value, (1e-13 + condition) * value) << what;
    const Block block = wave_series(Block(g), Block(ratio));
    for (int lane = 0; lane < block_width; ++lane) EXPECT_NEAR(block[lane], value, (1e-13 + condition) * value) << what;
    const Quad quad = wave_series(Quad(g), Quad(b / Quad(g)));
    EXPECT_LE(static_cast<double>(Quad(abs(Quad(quad / exact - 1)))), 1e-24) << what;
    if (value < 1e-15) continue;
    EXPECT_NEAR(static_cast<double>(wave_series(static_cast<float>(g), static_cast<float>(ratio))), value, 3e-5 * value)
        << what;
  }
}

/// The limits at 90° that exist are in closed_forms.json; these don't.
TEST(Grazing, DivergesWhereThereIsNoLimit) {
  const std::vector<std::pair<const char*, Parameters>> divergent{
      {"ward", {}},
      {"ward", {{"alpha", 1.0}}},
      {"ward", {{"alpha_x", 0.3}, {"alpha_y", 0.05}}},
      {"cook_torrance", {{"masking", "none"}}},
      {"cook_torrance", {{"m", 1.0}, {"masking", "none"}}},
      {"kurt", {{"exponent", 0.1}}},
      {"kurt", {{"exponent", 0.5}, {"equation", "11"}}},
      {"kurt", {{"exponent", 1.5}, {"equation", "13"}}},
      {"ward_duer", {}},
      {"ward_duer", {{"alpha_x", 0.3}, {"alpha_y", 0.05}}},
      {"phong_original", {}},
      {"blinn_original", {}},
  };
  for (const auto& [name, parameters] : divergent) {
    const auto model = make_model(name, parameters);
    for (const Rule rule : {Rule::gauss, Rule::cubature}) {
      const Estimate e = directional_albedo(*model, Direction::from_degrees(90), {.rule = rule, .tolerance = 1e-6});
      EXPECT_EQ(e.status, Status::divergent) << name;
      EXPECT_EQ(e.value, std::numeric_limits<double>::infinity()) << name;
      EXPECT_EQ(e.error, std::numeric_limits<double>::infinity()) << name;
    }
  }
}

TEST(Grazing, LimitsAreAmongTheGoldenValues) {
  std::vector<std::string> models;
  for (const json& entry : read("closed_forms.json")) {
    if (entry.at("theta_deg") != 90.0) continue;
    const std::string model = entry.at("model").get<std::string>();
    if (std::find(models.begin(), models.end(), model) == models.end()) models.push_back(model);
    const Estimate e = directional_albedo(*make_model(model, parameters_of(entry)), direction_of(entry));
    const double exact = std::stod(entry.at("albedo").get<std::string>());
    EXPECT_EQ(e.status, Status::converged) << describe(entry);
    EXPECT_EQ(e.error_kind, ErrorKind::extrapolated) << describe(entry);
    EXPECT_LE(std::abs(e.value - exact), e.error) << describe(entry) << ": " << e.value << " for " << exact;
  }
  for (const char* model : {"lambert", "phong", "ggx"}) {
    EXPECT_NE(std::find(models.begin(), models.end(), model), models.end()) << model;
  }
}

/// Ward near grazing and as a needle: where samplers and cubatures of the hemisphere fail.
TEST(Ward, NeedleAndGrazing) {
  struct Known {
    double alpha, theta, albedo;
  };
  for (const Known& known : {Known{0.1, 0, 0.971051675567},
                             {0.1, 60, 0.488988056485},
                             {0.1, 89, 0.10992891264},
                             {0.1, 89.99, 0.83188124271},
                             {0.01, 85, 0.08741251569902}}) {
    const Estimate e = directional_albedo(*make_model("ward", {{"alpha", known.alpha}}),
                                          Direction::from_degrees(known.theta), {.tolerance = 1e-10});
    EXPECT_EQ(e.status, Status::converged);
    EXPECT_NEAR(e.value, known.albedo, 1e-9 * known.albedo) << known.alpha << " at " << known.theta;
  }
}

}  // namespace
}  // namespace albedo
