#include "albedo/combinators/pumped.hpp"
#include "albedo/core/quad.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "albedo/core/errors.hpp"
#include "albedo/directional_albedo.hpp"

namespace albedo {
namespace {

Direction random_direction(std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  return Direction::from_cosine(1 - unit(random), 360 * unit(random));
}

std::unique_ptr<PumpedModel> pumped(const std::string& name, const Parameters& parameters, const PumpOptions& options) {
  return std::make_unique<PumpedModel>(make_model(name, parameters), options);
}

TEST(Pumped, OnceDividesByTheLargerAlbedo) {
  const auto base = make_model("phong");
  const auto once = pumped("phong", {}, {});
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    const Direction l = random_direction(random), v = random_direction(random);
    const double g = std::max(directional_albedo(*base, l).value, directional_albedo(*base, v).value);
    const double f = brdf<double>(*base, l, v) / g;
    EXPECT_NEAR(brdf<double>(*once, l, v), f, 3e-8 * f);
    EXPECT_LE(brdf<double>(*once, l, v), f * (1 + 1e-10));  // the table bounds a from above
    EXPECT_NEAR(brdf<double>(*once, v, l), brdf<double>(*once, l, v), 1e-11 * f);
    EXPECT_NEAR(brdf<float>(*once, l, v), f, 1e-4 * f + 1e-30);
    EXPECT_NEAR(static_cast<double>(brdf<Quad>(*once, l, v)), f, 3e-8 * f);
  }
}

TEST(Pumped, BlocksAreTheirLanes) {
  const auto model = pumped("blinn", {}, {.times = 3, .control = PumpControl::step});
  std::mt19937 random(2);
  const auto l = unit_vector<double>(random_direction(random));
  std::vector<UnitVector<double>> v;
  for (int lane = 0; lane < block_width; ++lane) v.push_back(unit_vector<double>(random_direction(random)));
  const auto component = [&](double UnitVector<double>::*which) {
    return Block::generate([&](int lane) { return v[static_cast<std::size_t>(lane)].*which; });
  };
  const UnitVector<Block> views{component(&UnitVector<double>::x), component(&UnitVector<double>::y),
                                component(&UnitVector<double>::z)};
  const UnitVector<Block> light{Block(l.x), Block(l.y), Block(l.z)};
  const Block f = model->evaluate(0, direction_pair(light, views, views));
  for (int lane = 0; lane < block_width; ++lane) {
    const auto& one = v[static_cast<std::size_t>(lane)];
    const double expected = model->evaluate(0, direction_pair(l, one, one));
    EXPECT_NEAR(f[lane], expected, 1e-12 * expected);
  }
}

TEST(Pumped, ZeroTimesIsTheModelItself) {
  const auto base = make_model("ggx"), same = std::unique_ptr<Model>(pumped("ggx", {}, {.times = 0}));
  std::mt19937 random(3);
  for (int i = 0; i < 5; ++i) {
    const Direction l = random_direction(random), v = random_direction(random);
    EXPECT_EQ(brdf<double>(*same, l, v), brdf<double>(*base, l, v));
  }
  EXPECT_EQ(same->lobes().front().kink_equal_cosines, base->lobes().front().kink_equal_cosines);
}

struct Case {
  const char* name;
  Parameters parameters;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{{"phong", {{"n", 20.0}}},         {"blinn", {{"n", 20.0}}},
                                     {"ggx", {{"alpha", 0.4}}},        {"ward", {{"alpha", 0.3}}},
                                     {"cook_torrance", {{"m", 0.3}}},  {"ashikhmin_shirley", {{"n", 40.0}}},
                                     {"neumann_phong", {{"n", 10.0}}}, {"kurt", {{"m", 0.3}}}};
  return all;
}

TEST(Pumped, ReflectsMoreThanItsBaseAndNoMoreThanItGets) {
  std::mt19937 random(4);
  for (const auto& [name, parameters] : cases()) {
    const auto base = make_model(name, parameters);
    for (const int times : {1, 3}) {
      for (const PumpControl control : {PumpControl::none, PumpControl::step, PumpControl::total}) {
        const auto model = pumped(name, parameters, {.times = times, .control = control, .tolerance = 1e-5});
        EXPECT_TRUE(model->claims().conserves_energy);
        for (int i = 0; i < 3; ++i) {
          const Direction l = random_direction(random);
          const AlbedoOptions options{.rule = Rule::cubature, .tolerance = 1e-4};
          const Estimate a = directional_albedo(*base, l), pumped_a = directional_albedo(*model, l, options);
          EXPECT_LE(pumped_a.value - pumped_a.error, 1) << name << ' ' << times << ' ' << l.theta_degrees();
          EXPECT_GE(pumped_a.value + pumped_a.error, std::min(a.value, 1.0) * (1 - 2e-5 * times))
              << name << ' ' << times << ' ' << l.theta_degrees();
        }
      }
    }
  }
}

TEST(Pumped, IsPlausibleOutright) {  // not only within an error: where a is 1, the table is raised above it
  for (const char* name : {"phong", "blinn", "lambert"}) {
    for (const int times : {1, 2, 5}) {
      const auto model = pumped(name, {}, {.times = times});
      for (const double theta : {0.0, 1.0, 3.0, 40.0}) {
        const Estimate a = directional_albedo(*model, Direction::from_degrees(theta), {.tolerance = 1e-11});
        EXPECT_LE(a.value, 1) << name << ' ' << times << ' ' << theta;
        EXPECT_GT(a.value, theta < 2 ? 0.99 : 0.7) << name << ' ' << times << ' ' << theta;
      }
    }
  }
}

TEST(Pumped, IsWhatTheSequenceSays) {
  for (const std::size_t which : {0U, 1U, 3U, 6U}) {
    const auto& [name, parameters] = cases()[which];
    for (const PumpControl control : {PumpControl::none, PumpControl::total}) {
      const auto base = make_model(name, parameters);
      PumpSequence sequence(*base, control, false, 1e-6);
      sequence.advance();
      sequence.advance();
      const auto model = pumped(name, parameters, {.times = 2, .control = control, .tolerance = 1e-6});
      for (const double theta : {0.0, 50.0, 89.0}) {
        const Direction l = Direction::from_degrees(theta);
        const Estimate a = directional_albedo(*model, l, {.rule = Rule::cubature, .tolerance = 1e-4});
        EXPECT_NEAR(a.value, sequence.albedo(2, l.cos_theta), a.error + sequence.relative_bound(2))
            << name << ' ' << to_string(control) << ' ' << theta;
        EXPECT_LE(sequence.albedo(2, l.cos_theta), sequence.upper(2, l.cos_theta));
      }
    }
  }
}

// Repeated controlled pumping of Phong is said to end at eq. 22, which is the model neumann_phong.
TEST(Pumped, FloorOfTheWholeDivisorLeadsToEquation22) {
  const auto limit = make_model("neumann_phong", {{"n", 20.0}});
  const auto total = pumped("phong", {{"n", 20.0}}, {.times = 10, .control = PumpControl::total});
  std::mt19937 random(5);
  for (int i = 0; i < 40; ++i) {
    const Direction l = random_direction(random), v = random_direction(random);
    const double f = brdf<double>(*limit, l, v);
    EXPECT_NEAR(brdf<double>(*total, l, v), f, 1e-7 * f) << l.theta_degrees() << ' ' << v.theta_degrees();
  }
  const auto base = make_model("phong", {{"n", 20.0}});
  PumpSequence step(*base, PumpControl::step, false, 1e-6), floor(*base, PumpControl::total, false, 1e-6);
  for (int k = 0; k < 20; ++k) step.advance(), floor.advance();
  const double at_60 = directional_albedo(*limit, Direction::from_degrees(60)).value;
  EXPECT_NEAR(at_60, 0.871349397164, 1e-9);
  EXPECT_NEAR(floor.albedo(20, 0.5), at_60, 1e-4);
  EXPECT_GT(step.albedo(20, 0.5), 0.9999);  // the ideal mirror, as without control
}

TEST(Pumped, OnlyUpLeavesAnAlbedoAboveOne) {
  const Direction grazing = Direction::from_degrees(89.99);
  const auto restricted = pumped("ward", {{"alpha", 0.3}}, {.times = 2, .only_up = true});
  const auto free = pumped("ward", {{"alpha", 0.3}}, {.times = 2});
  const double a = directional_albedo(*make_model("ward", {{"alpha", 0.3}}), grazing).value;
  EXPECT_GT(a, 1.5);
  EXPECT_GE(directional_albedo(*restricted, grazing, {.tolerance = 1e-6}).value, a * (1 - 1e-6));
  EXPECT_FALSE(restricted->claims().conserves_energy);
  EXPECT_FALSE(restricted->claims().bounded);
  EXPECT_LE(directional_albedo(*free, grazing, {.tolerance = 1e-6}).value, 1);
  EXPECT_TRUE(free->claims().bounded);
}

TEST(Pumped, EnvelopeOfAnAnisotropicModelIsSafe) {
  const Parameters parameters{{"alpha_x", 0.2}, {"alpha_y", 0.5}};
  const auto model = pumped("ggx", parameters, {.tolerance = 1e-3});
  const auto base = make_model("ggx", parameters);
  EXPECT_FALSE(model->claims().isotropic);
  for (const double theta : {0.0, 40.0, 75.0, 88.0}) {
    for (const double phi : {0.0, 30.0, 45.0, 90.0, 200.0}) {
      const Direction l = Direction::from_degrees(theta, phi);
      const Estimate a = directional_albedo(*model, l, {.rule = Rule::cubature, .tolerance = 1e-4});
      EXPECT_LE(a.value - a.error, 1) << theta << ' ' << phi;
      EXPECT_GT(a.value + a.error, directional_albedo(*base, l).value) << theta << ' ' << phi;
    }
  }
}

TEST(Pumped, AgainIsTwice) {
  PumpedModel again(pumped("blinn", {}, {}), {});
  const auto twice = pumped("blinn", {}, {.times = 2});
  for (const double theta : {0.0, 45.0, 80.0}) {
    const Direction l = Direction::from_degrees(theta);
    const Estimate a = directional_albedo(again, l, {.tolerance = 1e-7});
    EXPECT_NEAR(a.value, directional_albedo(*twice, l, {.tolerance = 1e-7}).value, 1e-7 + 2 * a.error);
  }
  EXPECT_EQ(again.parameters().size(), 4 + 4 + make_model("blinn")->parameters().size());
}

TEST(Pumped, SamplersAreItsBases) {
  const auto model = pumped("blinn", {}, {.times = 2, .control = PumpControl::step});
  for (const double theta : {10.0, 60.0, 85.0}) {
    const Direction l = Direction::from_degrees(theta);
    const double a = directional_albedo(*model, l, {.tolerance = 1e-6}).value;
    const Estimate drawn = directional_albedo(
        *model, l, {.rule = Rule::stratified, .warp = Warp::paper, .tolerance = 1e-3, .budget = 200'000, .seed = 7});
    EXPECT_NEAR(drawn.value, a, 6 * drawn.error) << theta;
  }
}

TEST(Pumped, CoherentPartIsPumpedToo) {
  const Parameters parameters{{"part", std::string("specular")}};
  const auto base = make_model("he_torrance", parameters);
  ASSERT_GT(base->coherent_albedo(Direction::from_degrees(60)), 0);
  const auto model = pumped("he_torrance", parameters, {.tolerance = 1e-4});  // nothing but a delta: a mirror
  for (const double theta : {0.0, 30.0, 60.0}) {
    const Estimate a = directional_albedo(*model, Direction::from_degrees(theta));
    EXPECT_LE(a.value, 1);
    EXPECT_NEAR(a.value, 1, 2e-4) << theta;
  }
}

TEST(PumpSequence, AsksForNoBrdfAgain) {
  const auto lambert = make_model("lambert", {{"rho", 0.5}});
  PumpSequence sequence(*lambert, PumpControl::none, false, 1e-8);
  const std::int64_t before = sequence.evaluations();
  EXPECT_GT(before, 1000);
  for (int k = 0; k < 3; ++k) sequence.advance();
  EXPECT_EQ(sequence.evaluations(), before);
  EXPECT_EQ(sequence.orders(), 4);
  EXPECT_NEAR(sequence.average(0), 0.5, 1e-9);
  EXPECT_NEAR(sequence.average(3), 1, 1e-8);
}

TEST(PumpSequence, WithoutControlIncreasesTowardsTheIdealMirror) {  // Neumann 1999, §3.1
  const auto phong = make_model("phong", {{"n", 20.0}});
  PumpSequence sequence(*phong, PumpControl::none, false, 1e-6);
  for (int k = 0; k < 30; ++k) {
    sequence.advance();
    for (const double theta : {30.0, 60.0, 80.0, 89.0}) {
      const double c = Direction::from_degrees(theta).cos_theta;
      EXPECT_GE(sequence.albedo(k + 1, c), sequence.albedo(k, c) * (1 - 2e-6)) << k << ' ' << theta;
    }
  }
  EXPECT_GT(sequence.albedo(30, Direction::from_degrees(89).cos_theta), 0.98);
}

TEST(Pumped, RefusesWhatCannotBePumped) {
  EXPECT_THROW(PumpedModel(nullptr), ParameterError);
  for (const int times : {-1, 1001, 1'000'000'000}) {
    EXPECT_THROW(pumped("phong", {}, {.times = times}), ParameterError) << times;
  }
  for (const double tolerance : {0.0, -1.0, 0.5, std::nan("")}) {
    EXPECT_THROW(pumped("phong", {}, {.tolerance = tolerance}), ParameterError) << tolerance;
  }
  EXPECT_THROW(pumped("lambert", {{"rho", 0.0}}, {}), ParameterError);
  try {
    pumped("phong_original", {}, {});
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_NE(std::string(error.what()).find("phong_original isn't reciprocal"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace albedo
