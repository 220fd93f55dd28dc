#include <cmath>
#include <cstdlib>
#include <random>

#include "measured_files.hpp"
#include "property/battery.hpp"

/// Measured materials aren't smooth: the rules' errors hold all the same. On a synthetic material, and on the .bsdf
/// files of the directory in the environment variable ALBEDO_MEASURED_DIR.
namespace albedo {
namespace {

using test::rgl_bytes;
using test::RglContent;
using test::TemporaryFile;

/// Of a standard error with 15 degrees of freedom, over hundreds of answers: chance goes beyond in one run of a
/// hundred.
constexpr double most_standard_errors = 6;

/// True errors are within the reported ones, and a tolerance that was missed isn't called met.
void expect_honest(const std::string& file, const std::string& channel) {
  const auto model = make_model("measured", {{"file", file}, {"channel", channel}});
  for (const double theta : {0.0, 30.0, 60.0, 80.0}) {
    const Direction l = Direction::from_degrees(theta);
    const Estimate truth =
        directional_albedo(*model, l, {.rule = Rule::cubature, .tolerance = 1e-5, .budget = 8'000'000});
    const std::string where = file + " " + channel + " at " + std::to_string(theta);
    EXPECT_LE(truth.error, 1e-4 * truth.value) << where << ": " << battery::text(truth);
    for (const Rule rule : {Rule::gauss, Rule::cubature, Rule::kronrod, Rule::tanh_sinh, Rule::stratified, Rule::sobol,
                            Rule::monte_carlo}) {
      for (const double tolerance : {1e-2, 1e-3, 1e-8}) {
        const std::int64_t budget = tolerance < 1e-3 ? 100'000 : 1'000'000;
        const Estimate e =
            directional_albedo(*model, l, {.rule = rule, .tolerance = tolerance, .budget = budget, .seed = 23});
        const double sigmas = is_monte_carlo(rule) ? most_standard_errors : 1;
        EXPECT_LE(std::abs(e.value - truth.value), sigmas * e.error + truth.error)
            << where << ", rule " << static_cast<int>(rule) << ", tolerance " << tolerance << ": " << battery::text(e)
            << " for " << battery::text(truth);
        EXPECT_EQ(e.status == Status::converged, e.error <= tolerance * std::abs(e.value)) << where;
        if (tolerance == 1e-8) {
          EXPECT_NE(e.status, Status::converged) << where << ", rule " << static_cast<int>(rule);
        }
      }
    }
    for (const Rule rule : {Rule::gauss, Rule::cubature, Rule::sobol}) {
      const Estimate e = directional_albedo(*model, l, {.rule = rule, .warp = Warp::hemisphere, .tolerance = 1e-2});
      EXPECT_NE(e.status, Status::converged) << where;
    }
  }
}

/// Tables of independent random numbers: as rough as can be.
TEST(MeasuredHonesty, OnARandomTable) {
  std::mt19937_64 engine(20'240'607);
  const auto random = [&engine](double, double) { return 0.2 + static_cast<double>(engine() >> 11) * 0x1p-53; };
  RglContent content;
  content.thetas = {0, 0.5, 1.1, std::numbers::pi / 2};
  content.ndf = content.sigma = content.vndf = random;
  content.rgb = [&](std::size_t, int, double x, double y) { return random(x, y); };
  const TemporaryFile file("random.bsdf", rgl_bytes(content));
  expect_honest(file.path(), "G");
}

TEST(MeasuredHonesty, OnRealFiles) {
  const char* directory = std::getenv("ALBEDO_MEASURED_DIR");
  if (directory == nullptr) GTEST_SKIP() << "ALBEDO_MEASURED_DIR isn't set";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() != ".bsdf") continue;
    ++files;
    expect_honest(entry.path().string(), "B");
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace albedo
