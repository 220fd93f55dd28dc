// A stranger's first program: find_package(albedo), one include, one number (Ward at alpha = 0.1 and 60 degrees).
#include <albedo/albedo.hpp>
#include <cmath>
#include <cstdio>

int main() {
  const auto model = albedo::make_model("ward", {{"alpha", 0.1}});
  const auto a = albedo::directional_albedo(*model, albedo::Direction::from_degrees(60, 0));
  std::printf("%.17g\n", a.value);
  return std::abs(a.value - 0.488988056485) < 1e-9 ? 0 : 1;
}
