#include "integration/lobe_integrand.hpp"

#include <gtest/gtest.h>

#include "warps/half_vector.hpp"
#include "warps/hemisphere.hpp"
#include "warps/mirror_lobe.hpp"

namespace albedo {
namespace {

/// A point's value is the same wherever in a grid, or among scattered points, it is asked for: to the last bit.
template <template <class> class WarpIn>
void check_places(const char* name) {
  const auto model = make_model(name);
  const LobeIntegrand<WarpIn, Block> integrand(*model, model->lobes().front(), Direction::from_degrees(70, 20), 1e-8,
                                               false);
  for (int panel = 0; panel < static_cast<int>(integrand.panels().size()); ++panel) {
    for (int count_v = 1; count_v <= 18; ++count_v) {
      for (const int count_u : {1, 2, 3, 5, 8, 11, 16}) {
        std::vector<double> u, v, grid_u, grid_v;
        for (int i = 0; i < count_u; ++i) u.push_back((i + 0.5) / count_u);
        for (int j = 0; j < count_v; ++j) v.push_back((j + 0.3) / count_v);
        for (const double x : u) {
          for (const double y : v) grid_u.push_back(x), grid_v.push_back(y);
        }
        constexpr double untouched = -7;
        std::vector<double> grid(grid_u.size() + 8, untouched), points(grid_u.size() + 8, untouched);
        integrand.grid(panel, u.data(), count_u, v.data(), count_v, grid.data());
        integrand.points(panel, grid_u.data(), grid_v.data(), points.data(), count_u * count_v);
        EXPECT_EQ(grid, points) << name << ", panel " << panel << ", " << count_u << " × " << count_v;
        EXPECT_EQ(grid[grid_u.size()], untouched);
        EXPECT_NE(grid[grid_u.size() - 1], untouched);
      }
    }
  }
}

TEST(LobeIntegrand, ValuesDependOnTheirPlaceAlone) {
  check_places<HalfVectorWarp>("ward");
  check_places<HalfVectorWarp>("ggx");
  check_places<HalfVectorWarp>("ashikhmin_shirley");
  check_places<HalfVectorWarp>("cook_torrance");
  check_places<MirrorLobeWarp>("phong");
  check_places<HemisphereWarp>("lambert");
}

}  // namespace
}  // namespace albedo
