#include <gtest/gtest.h>

#include <array>

#include "albedo/command_line.hpp"
#include "albedo/registry.hpp"
#include "analysis/studies/audits.hpp"
#include "analysis/subjects/material_table.hpp"
#include "analysis/subjects/materials.hpp"

namespace albedo::analysis {
namespace {

/// Lambert with a constant that is a hundredth too large, and says nothing of it.
struct Boastful {
  double rho = 1;

  static ModelInfo info() { return {.name = "boastful", .title = "Boastful", .source = "none", .deviation = "none"}; }
  static std::vector<Parameter<Boastful>> parameters() {
    return {reflectance<Boastful, &Boastful::rho>("rho", "albedo, says the model")};
  }
  [[nodiscard]] Claims claims() const { return {}; }
  [[nodiscard]] std::vector<Lobe> lobes() const { return {{.component = 0, .weight = rho}}; }
  template <class T>
  T evaluate(int, const DirectionPair<T>&) const noexcept {
    return T(1.01 * rho) / pi<T>;
  }
};

int run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "albedo");
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  return command_line(static_cast<int>(words.size()), words.data());
}

TEST(AuditCommand, ExitsWithOneWhereAClaimIsBroken) {
  register_model<Boastful>();
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_EQ(run({"audit", "boastful"}), 1);
  EXPECT_EQ(run({"audit", "boastful", "rho=0.98"}), 0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "albedo: 1 of 1 breaks what the model claims\n");
  const std::string out = testing::internal::GetCapturedStdout();
  EXPECT_NE(out.find("energy        fails           largest albedo 1.01 +- "), std::string::npos) << out;
  EXPECT_NE(out.find("energy        pass            largest albedo 0.9898 +- "), std::string::npos) << out;
}

TEST(AuditCommand, ScaleAndLambertianPartOfMaterials) {
  const std::string text =
      R"([{"name": "both", "model": "phong", "parameters": {"n": 20}, "scale": [0.5, 0.25, 1], "lambertian": [0.1, 0, 0]},
          {"name": "plain", "model": "phong", "parameters": {"n": 20}}])";
  const std::vector<Material> materials = parse_materials(text, "text");
  ASSERT_EQ(channels_of(materials).size(), 3U);
  const Direction l = Direction::from_degrees(40);
  const double alone = directional_albedo(*make_model("phong", {{"n", 20.0}}), l).value;
  const std::array expected{0.5 * alone + 0.1, 0.25 * alone, alone};
  std::vector<AuditCase> cases;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    auto model = make_material(materials[0], channel, "text");
    EXPECT_EQ(model->info().name, "phong");
    EXPECT_NEAR(directional_albedo(*model, l).value, expected[channel], 1e-7);
    EXPECT_NEAR(directional_albedo(*make_material(materials[1], channel, "text"), l).value, alone, 1e-7);
    cases.push_back({.name = "both",
                     .channel = std::to_string(channel),
                     .model = std::move(model),
                     .options = audit_options({}, {})});
  }
  run_audits(cases, 2);
  const std::vector<AuditSummary> summaries = summaries_of(cases);
  ASSERT_EQ(summaries.size(), 1U);
  EXPECT_EQ(summaries[0].materials, 1U);
  EXPECT_EQ(summaries[0].creating_energy, 0U);
  EXPECT_NEAR(summaries[0].largest, 1, 1e-8);

  EXPECT_THROW(parse_materials(R"([{"name": "a", "model": "phong", "parameters": {}, "scale": "x"}])", "text"),
               std::exception);
  EXPECT_THROW(parse_materials(R"([{"name": "a", "model": "phong", "parameters": {}, "lambertian": [1, 2]}])", "text"),
               std::exception);
}

TEST(AuditSummary, CountsMaterialsOnceAndFindsTheEarliest) {
  std::vector<AuditCase> cases;
  for (const double rho : {0.5, 1.0}) {
    for (const char* channel : {"R", "G"}) {
      cases.push_back({.name = rho < 1 ? "dim" : "bright",
                       .channel = channel,
                       .model = make_model("kurt", {{"m", 2.5}, {"equation", "9"}, {"k_s", rho}}),
                       .options = audit_options({}, {})});
    }
  }
  cases.push_back({.name = "glossy", .model = make_model("ward"), .options = audit_options({}, {})});
  run_audits(cases, 1);
  const std::vector<AuditSummary> summaries = summaries_of(cases);
  ASSERT_EQ(summaries.size(), 2U);
  EXPECT_EQ(summaries[0].materials, 2U);
  EXPECT_EQ(summaries[0].creating_energy, 1U);
  EXPECT_EQ(summaries[0].unbounded, 0U);
  EXPECT_EQ(summaries[0].largest_name, "bright");
  EXPECT_EQ(summaries[1].creating_energy, 1U);
  EXPECT_EQ(summaries[1].unbounded, 1U);
  EXPECT_GT(summaries[1].earliest_degrees, 89.9);
}

}  // namespace
}  // namespace albedo::analysis
