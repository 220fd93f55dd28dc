#include "analysis/scenes/plan/plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "albedo/core/errors.hpp"
#include "analysis/helpers.hpp"
#include "analysis/scenes/plan/verify.hpp"
#include "analysis/scenes/scene.hpp"

namespace albedo::analysis {
namespace {

constexpr double display_step = 1.0 / 255;

SceneMaterial material(const std::string& json) {
  SceneMaterial result;
  result.material = parse_materials("[" + json + "]", "test.json").front();
  result.file = "test.json";
  return result;
}

Scene scene_of(const std::vector<std::string>& list) {
  Scene scene{.path = "test.json", .format = "materials"};
  for (const std::string& json : list) scene.materials.push_back(material(json));
  return scene;
}

/// Metals, plastic, a lobe that creates energy, one without masking, a matte one.
Scene mixed_scene() {
  return scene_of({R"({"name": "gold", "model": "ggx", "parameters": {"alpha": 0.3, "fresnel": "conductor",
                       "eta": [0.14, 0.37, 1.44], "k": [3.98, 2.38, 1.6]}})",
                   R"({"name": "rough", "model": "beckmann", "parameters": {"alpha": 0.8, "f0": 0.9}})",
                   R"({"name": "ward", "model": "ward", "parameters": {"alpha": 0.2, "rho_s": 0.3, "rho_d": 0.2}})",
                   R"({"name": "duer", "model": "ward_duer", "parameters": {"alpha": 0.3, "rho_s": 0.5}})",
                   R"({"name": "clay", "model": "oren_nayar", "parameters": {"sigma": 0.5, "rho": 0.7}})"});
}

/// The worst error of a case over many angles.
double worst_error(const MaterialVariants& variants, const PlannedSurface& table, const Plan& plan, int angles) {
  double worst = 0;
  for (int i = 0; i < angles; ++i) {
    const double theta = std::lerp(plan.options.least_theta, plan.options.largest_theta, (i + 0.5) / angles);
    const CheckedError checked = checked_error(variants, &table, 0, variants.variation().low,
                                               Direction::from_degrees(theta).cos_theta, plan.options.tolerance);
    worst = std::max(worst, checked.error.largest());
  }
  return worst;
}

TEST(Plan, ALambertianWallNeedsNothing) {
  const Scene scene = scene_of({R"({"name": "wall", "model": "lambert", "parameters": {"rho": [0.5, 0.4, 0.3]}})"});
  const Plan plan = plan_scene(scene);
  EXPECT_TRUE(plan.tables.empty());
  EXPECT_EQ(plan.bytes(), 0U);
  ASSERT_EQ(plan.cases.size(), 3U);
  for (const PlanCase& planned : plan.cases) {
    EXPECT_EQ(planned.need, Need::nothing);
    EXPECT_TRUE(contains(planned.reason, "Lambertian"));
  }
  EXPECT_NEAR(plan.cases[0].largest.value, 0.5, 1e-5);
}

/// The errors of random cases at random angles, by another rule than the plan's.
void expect_right_at_random(const Scene& scene, const Plan& plan, int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> cosine(std::cos(85 * std::numbers::pi / 180), 1);
  for (int i = 0; i < count; ++i) {
    const std::size_t number = random() % plan.cases.size();
    const PlanCase& planned = plan.cases[number];
    const MaterialVariants variants(scene.materials[planned.material], planned.channel);
    const PlannedSurface* table = planned.table ? &plan.tables[*planned.table].table : nullptr;
    const CheckedError checked = checked_error(variants, table, i % variants.colour_ends(), variants.variation().low,
                                               cosine(random), display_step);
    EXPECT_TRUE(checked.is_good);
    EXPECT_LE(checked.error.furnace, display_step) << number;
    EXPECT_LE(checked.error.point, display_step) << number;
  }
}

/// Takes every node away in turn; returns how many there are.
int expect_no_node_to_spare(const Scene& scene, const Plan& plan) {
  int nodes = 0;
  for (const PlanTable& table : plan.tables) {
    for (std::size_t i = 0; table.table.cosines.size() > 1 && i < table.table.cosines.size(); ++i, ++nodes) {
      double worst = 0;
      for (const std::size_t number : table.cases) {
        const PlanCase& planned = plan.cases[number];
        const MaterialVariants variants(scene.materials[planned.material], planned.channel);
        worst = std::max(worst, worst_error(variants, table.table.without_cosine(i), plan, 60));
        if (worst > display_step) break;
      }
      EXPECT_GT(worst, display_step) << table.name << " without node " << i;
    }
  }
  return nodes;
}

TEST(Plan, EveryErrorIsBelowTheToleranceAtRandomDirections) {
  const Scene scene = mixed_scene();
  const Plan plan = plan_scene(scene);
  EXPECT_EQ(plan.unknown(), 0U);
  EXPECT_LT(plan.bytes(), plan.usual_bytes() / 1000);
  expect_right_at_random(scene, plan, 1000);
}

TEST(Plan, WithoutAnyNodeACurveIsNotEnough) {
  const Scene scene = mixed_scene();
  EXPECT_GE(expect_no_node_to_spare(scene, plan_scene(scene)), 11);
}

TEST(Plan, PublishedScenes) {
  const char* directory = std::getenv("ALBEDO_SCENES_DIR");
  if (directory == nullptr) GTEST_SKIP() << "ALBEDO_SCENES_DIR isn't set";
  for (const char* const name : {"bathroom", "living-room-2"}) {
    const Scene scene = read_scene(std::string(directory) + "/scenes/mitsuba/" + name + "__scene.xml");
    const Plan plan = plan_scene(scene);
    EXPECT_EQ(plan.unknown(), 0U) << name;
    EXPECT_LE(20 * plan.bytes(), plan.usual_bytes()) << name;
    expect_right_at_random(scene, plan, 10'000);
    EXPECT_GE(expect_no_node_to_spare(scene, plan), 2) << name;
  }
}

TEST(Plan, EqualLobesShareATableWhateverTheirColours) {
  const Plan plan = plan_scene(scene_of(
      {R"({"name": "a", "model": "ggx", "parameters": {"alpha": 0.5, "f0": [0.9, 0.8, 0.5]}})",
       R"({"name": "b", "model": "ggx", "parameters": {"alpha": 0.5, "f0": 1}, "scale": 0.7, "lambertian": 0.1})"}));
  ASSERT_EQ(plan.tables.size(), 1U);
  EXPECT_EQ(plan.tables[0].cases.size(), 4U);
  EXPECT_EQ(plan.tables[0].lobes.size(), 1U);
}

TEST(Plan, TexturedRoughnessAndAnisotropyTakeASecondVariable) {
  Scene scene = scene_of({R"({"name": "worn", "model": "ggx", "parameters": {"alpha": 0.3, "f0": 0.9}})",
                          R"({"name": "brushed", "model": "ggx", "parameters": {"alpha_x": 0.1, "alpha_y": 0.5}})",
                          R"({"name": "tinted", "model": "ggx", "parameters": {"alpha": 0.5}})"});
  scene.materials[0].intervals.push_back({.parameter = "alpha", .low = 0, .high = 1});
  scene.materials[2].intervals.push_back({.parameter = "f0", .low = 0, .high = 1});
  const Plan plan = plan_scene(scene);
  ASSERT_EQ(plan.tables.size(), 3U);
  EXPECT_LE(plan.largest_error().largest(), display_step);
  EXPECT_EQ(plan.tables[*plan.cases[0].table].second, "alpha");
  EXPECT_EQ(plan.tables[*plan.cases[1].table].second, "phi");
  EXPECT_TRUE(plan.cases[1].needs_azimuth);
  EXPECT_EQ(plan.cases[2].need, Need::curve);
  EXPECT_FALSE(plan.cases[2].needs_azimuth);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < 300; ++i) {
    const PlanCase& planned = plan.cases[static_cast<std::size_t>(i % 3)];
    const MaterialVariants variants(scene.materials[planned.material], planned.channel);
    const double second = std::lerp(variants.variation().low, variants.variation().high, unit(random));
    const CheckedError checked = checked_error(variants, &plan.tables[*planned.table].table, i % variants.colour_ends(),
                                               second, std::lerp(0.0872, 1, unit(random)), display_step);
    EXPECT_LE(checked.error.largest(), display_step) << i;
  }
}

TEST(Plan, AWeakAnisotropyNeedsNoAzimuth) {
  const Plan plan = plan_scene(
      scene_of({R"({"name": "a", "model": "ggx", "parameters": {"alpha_x": 0.5, "alpha_y": 0.51, "f0": 0.5}})"}));
  EXPECT_FALSE(plan.cases[0].is_isotropic);
  EXPECT_FALSE(plan.cases[0].needs_azimuth);
  EXPECT_EQ(plan.cases[0].need, Need::curve);
}

TEST(Plan, NganMaterials) {
  struct Count {
    std::size_t in_furnace = 0, at_all = 0;
  };
  Scene scene = read_scene(ALBEDO_MATERIALS_DIR "/ngan_ward.json");
  const auto count = [&](const std::string& model) {
    for (SceneMaterial& one : scene.materials) one.material.model = model;
    const Plan plan = plan_scene(scene, {.largest_theta = 80, .most_pumpings = 0});
    EXPECT_EQ(plan.unknown(), 0U);
    EXPECT_LE(plan.largest_error().largest(), display_step);
    EXPECT_GE(plan.usual_bytes(), 20 * plan.bytes());
    Count result;
    for (const std::vector<std::size_t>& cases : plan.of_material) {
      bool furnace = false, any = false;
      for (const std::size_t i : cases) {
        furnace = furnace || plan.cases[i].uncorrected.furnace > display_step;
        any = any || plan.cases[i].need != Need::nothing;
      }
      result.in_furnace += furnace ? 1 : 0, result.at_all += any ? 1 : 0;
    }
    return result;
  };
  const Count ward = count("ward"), duer = count("ward_duer"), bounded = count("ward_bounded");
  EXPECT_GT(ward.in_furnace, duer.in_furnace);
  EXPECT_GT(ward.at_all, duer.at_all);
  EXPECT_GE(ward.at_all, bounded.at_all);
  EXPECT_EQ(ward.at_all, 86U);
  RecordProperty("ward", std::to_string(ward.in_furnace) + "/" + std::to_string(ward.at_all));
  RecordProperty("ward_duer", std::to_string(duer.in_furnace) + "/" + std::to_string(duer.at_all));
  RecordProperty("ward_bounded", std::to_string(bounded.in_furnace) + "/" + std::to_string(bounded.at_all));
}

TEST(Plan, DoesNotDependOnTheNumberOfThreads) {
  const Scene scene = mixed_scene();
  const Plan one = plan_scene(scene, {.threads = 1}), three = plan_scene(scene, {.threads = 3});
  ASSERT_EQ(one.tables.size(), three.tables.size());
  for (std::size_t i = 0; i < one.tables.size(); ++i) {
    EXPECT_EQ(one.tables[i].table.values, three.tables[i].table.values);
    EXPECT_EQ(one.tables[i].met.furnace, three.tables[i].met.furnace);
  }
}

TEST(Plan, PumpOrdersReachTheTolerance) {
  const Plan plan =
      plan_scene(scene_of({R"({"name": "metal", "model": "ggx", "parameters": {"alpha": 0.3, "f0": 0.9}})",
                           R"({"name": "dim", "model": "ggx", "parameters": {"alpha": 0.3}, "scale": 0.05})"}));
  ASSERT_TRUE(plan.cases[0].pumpings.has_value());
  EXPECT_GT(*plan.cases[0].pumpings, 1);
  ASSERT_TRUE(plan.cases[1].pumpings.has_value());
  EXPECT_LT(*plan.cases[1].pumpings, *plan.cases[0].pumpings);
}

TEST(Plan, RefusesWhatCantBePlanned) {
  const Scene scene = mixed_scene();
  const auto message = [&](const PlanOptions& options) {
    return message_of<ParameterError>([&] { plan_scene(scene, options); });
  };
  EXPECT_TRUE(contains(message({.tolerance = 0}), "error is 0"));
  EXPECT_TRUE(contains(message({.tolerance = NAN}), "error is nan"));
  EXPECT_TRUE(contains(message({.largest_theta = 90}), "89.9"));
  EXPECT_TRUE(contains(message({.least_theta = 50, .largest_theta = 40}), "least angle"));
  Scene bad = scene_of({R"({"name": "a", "model": "ggx", "parameters": {"alpha": 0.3}})"});
  bad.materials[0].intervals.push_back({.parameter = "alpha", .low = NAN, .high = 1});
  EXPECT_TRUE(contains(message_of<FormatError>([&] { plan_scene(bad); }), "alpha"));
  bad.materials[0].intervals = {{.parameter = "roughness", .low = 0, .high = 1}};
  EXPECT_TRUE(contains(message_of<FormatError>([&] { plan_scene(bad); }), "roughness"));
  const Scene unknown = scene_of({R"({"name": "a", "model": "gxx", "parameters": {}})"});
  EXPECT_TRUE(contains(message_of<FormatError>([&] { plan_scene(unknown); }), "ggx"));
}

TEST(Plan, TooManyDifferentReflectancesAreRefused) {
  Scene scene = scene_of({R"({"name": "a", "model": "lambert", "parameters": {}})"});
  scene.materials.assign(10'001, scene.materials[0]);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    scene.materials[i].material.parameters = {{"rho", static_cast<double>(i) / 20'000}};
  }
  EXPECT_TRUE(contains(message_of<FormatError>([&] { plan_scene(scene); }), "10000 different reflectances"));
}

TEST(Plan, ThreeVariablesAreSaidToBeTooMany) {
  Scene scene = scene_of({R"({"name": "a", "model": "ggx", "parameters": {"alpha_x": 0.1, "alpha_y": 0.4}})"});
  scene.materials[0].intervals.push_back({.parameter = "alpha_x", .low = 0.1, .high = 0.2});
  const Plan plan = plan_scene(scene);
  EXPECT_EQ(plan.unknown(), 1U);
  EXPECT_TRUE(contains(plan.cases[0].reason, "three variables"));
}

TEST(Plan, AScenesManyEqualMaterialsAreOneCase) {
  Scene scene;
  const SceneMaterial one = material(R"({"name": "a", "model": "ggx", "parameters": {"alpha": 0.5}})");
  scene.materials.assign(20'000, one);
  const Plan plan = plan_scene(scene);
  EXPECT_EQ(plan.cases.size(), 1U);
  EXPECT_EQ(plan.of_material.size(), 20'000U);
  EXPECT_TRUE(plan_scene(Scene{}).tables.empty());
  scene.materials.assign(100'001, one);
  EXPECT_TRUE(contains(message_of<FormatError>([&] { plan_scene(scene); }), "100001 materials"));
}

}  // namespace
}  // namespace albedo::analysis
