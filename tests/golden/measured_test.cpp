#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "albedo/directional_albedo.hpp"

/// The albedo of RGL's materials against sums written apart from the library, in numpy (derive_measured.py). The files
/// are those of the directory in the environment variable ALBEDO_MEASURED_DIR.
namespace albedo {
namespace {

using nlohmann::json;

TEST(GoldenMeasured, AlbedoIsThatOfTheIndependentSum) {
  const char* directory = std::getenv("ALBEDO_MEASURED_DIR");
  if (directory == nullptr) GTEST_SKIP() << "ALBEDO_MEASURED_DIR isn't set";
  std::ifstream stream(std::string(ALBEDO_GOLDEN_DIR) + "/measured.json");
  const json entries = json::parse(stream);
  ASSERT_EQ(entries.size(), 72U);
  double largest = 0;
  for (const json& entry : entries) {
    const std::string file = (std::filesystem::path(directory) / entry.at("file").get<std::string>()).string();
    const auto model = make_model("measured", {{"file", file}, {"channel", entry.at("channel").get<std::string>()}});
    const double exact = std::stod(entry.at("albedo").get<std::string>());
    const double open = std::abs(exact) * std::pow(10, 1 - entry.at("digits").get<double>());
    const Direction l = Direction::from_degrees(entry.at("theta_deg").get<double>());
    for (const Rule rule : {Rule::gauss, Rule::cubature}) {
      const Estimate e = directional_albedo(*model, l, {.rule = rule, .tolerance = 1e-3});
      EXPECT_LE(std::abs(e.value - exact), e.error + open) << entry.dump() << ": " << e.value << " +- " << e.error;
      EXPECT_LE(std::abs(e.value - exact), 1e-3 * std::abs(exact) + open) << entry.dump() << ": " << e.value;
    }
    largest = std::max(largest, exact);
  }
  EXPECT_NEAR(largest, 1.11, 0.05);  // satin_rosaline at 80 degrees: above 1, and not clamped
}

}  // namespace
}  // namespace albedo
