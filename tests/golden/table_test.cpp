#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "albedo/directional_albedo.hpp"

namespace albedo {
namespace {

std::vector<std::vector<double>> read_csv(const std::string& file) {
  std::ifstream stream(std::string(ALBEDO_GOLDEN_DIR) + "/" + file);
  EXPECT_TRUE(stream) << file;
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty()) continue;
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(std::stod(field));
  }
  return rows;
}

/// A renderer's table of GGX (separable masking, F = 1), made by somebody else's adaptive cubature; README.md has its
/// source, licence and layout.
TEST(PublishedTable, GgxIsReproducedToSixDigits) {
  constexpr std::size_t size = 32;
  const auto table = read_csv("dsforza_conductors_E.csv");
  ASSERT_EQ(table.size(), size);
  double worst = 0;
  for (std::size_t y = 0; y < size; ++y) {
    ASSERT_EQ(table[y].size(), size) << "line " << y;
    const double roughness = std::max(0.035, static_cast<double>(y) / (size - 1));
    const auto model = make_model("ggx", {{"alpha", roughness * roughness}, {"masking", "separable"}});
    for (std::size_t x = 0; x < size; ++x) {
      const double cosine = std::max(0.02, static_cast<double>(x) / (size - 1));
      const Estimate e = directional_albedo(*model, Direction::from_cosine(cosine), {.tolerance = 1e-9});
      EXPECT_EQ(e.status, Status::converged);
      EXPECT_NEAR(e.value, table[y][x], 1e-6) << "roughness " << roughness << ", cos theta " << cosine;
      worst = std::max(worst, std::abs(e.value - table[y][x]));
    }
  }
  RecordProperty("worst_difference", std::to_string(worst));
}

}  // namespace
}  // namespace albedo
