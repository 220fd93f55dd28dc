#include <cmath>
#include <numbers>

#include "analysis/scene_helpers.hpp"

namespace albedo::analysis {
namespace {

class RadianceScene : public SceneTest {};

/// The reflected part of a coefficient as Radiance's dirnorm() and diraniso() compute it, without the cosine.
double radiance_brdf(double alpha_u, double alpha_v, double specular, double diffuse, const Direction& l,
                     const Direction& v) {
  const UnitVector<double> a = unit_vector<double>(l), b = unit_vector<double>(v);
  const double hx = a.x + b.x, hy = a.y + b.y, hz = a.z + b.z;
  const double exponent = (hx * hx / (alpha_u * alpha_u) + hy * hy / (alpha_v * alpha_v)) / (hz * hz);
  return diffuse / std::numbers::pi + specular * std::exp(-exponent) * (hx * hx + hy * hy + hz * hz) /
                                          (std::numbers::pi * std::pow(hz, 4) * alpha_u * alpha_v);
}

TEST_F(RadianceScene, SixTypesAreWardsModel) {
  const Scene scene = scene_of("scene.rad", R"(# comment
void plastic p 0 0 5 .5 .4 .3 .1 .2
void metal m
0
0
5 .5 .4 .3 .9 .2
void trans t 0 0 7 .5 .4 .3 .1 .2 .25 .5
void plastic2 p2 4 0 0 1 . 0 6 .5 .4 .3 .1 .2 .05
void metal2 m2 4 0 0 1 . 0 6 .5 .4 .3 .9 .2 .05
void trans2 t2 4 0 0 1 . 0 8 .5 .4 .3 .1 .2 .05 .25 .5
)");
  ASSERT_EQ(scene.materials.size(), 6U);
  EXPECT_EQ(scene.declared, 6U);
  struct Expected {
    double alpha_v, specular, diffuse;
  };
  // green of each: plastics have an uncoloured lobe, metals one of their colour; what goes through is lost
  const std::vector<Expected> expected{{.2, .1, .4 * .9},  {.2, .4 * .9, .4 * .1},  {.2, .1, .4 * .9 * .75},
                                       {.05, .1, .4 * .9}, {.05, .4 * .9, .4 * .1}, {.05, .1, .4 * .9 * .75}};
  const Direction l = Direction::from_degrees(40, 10), v = Direction::from_degrees(35, 200);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& [alpha_v, specular, diffuse] = expected[i];
    EXPECT_NEAR(brdf(scene.materials[i], 1, l, v), radiance_brdf(.2, alpha_v, specular, diffuse, l, v), 1e-12) << i;
  }
  EXPECT_TRUE(has_note(scene, "trans2: only what is reflected is modelled"));
}

TEST_F(RadianceScene, SmoothOnesAreMirrors) {
  const Scene scene = scene_of("scene.mat", R"(void plastic wall 0 0 5 .5 .5 .5 0 0
void plastic gloss 0 0 5 .5 .5 .5 .04 0
void metal chrome 0 0 5 .6 .6 .75 1 0.001
void metal brushed 0 0 5 .6 .6 .75 1 0.0011
void plastic bright 0 0 5 1.5 1 1 0 0)");
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.materials[0].material.model, "lambert");
  EXPECT_EQ(scene.materials[1].material.name, "brushed");
  EXPECT_EQ(scene.unmodelled, (std::map<std::string, std::size_t>{{"metal", 1}, {"plastic", 2}}));
  EXPECT_TRUE(has_note(scene, "rho = 1.5 is outside of [0, 1]"));
}

TEST_F(RadianceScene, ModifiersAliasesMixturesAndCommands) {
  const Scene scene = scene_of("scene.rad", R"(!xform -m "a b" -t 0 0 1 \
   void plastic hidden 0 0 5 1 1 1 0 0
void plastic "a b" 0 0 5 .5 .5 .5 0 0
void texfunc bumps 4 1 2 3 . 0 0
bumps brightfunc stripes 2 '1 # not a comment' . 0 1 # a comment
  .5
stripes metal2 brushed 4 0 0 1 . 0 6 .8 .6 .4 .9 .1 .2
inherit alias again brushed
void alias plain brushed
void mixfunc mixed 4 "a b" plain .5 . 0 0
void plastic "a b" 0 0 5 .2 .2 .2 0 0
"a b" sphere s1 0 0 4 0 0 0 1
again sphere s2 0 0 4 0 0 0 1
mixed sphere s3 0 0 4 0 0 0 1
bumps sphere s4 0 0 4 0 0 0 1
nothing sphere s5 0 0 4 0 0 0 1
void glass pane 0 0 3 .9 .9 .9
void light lamp 0 0 3 1 1 1
)");
  ASSERT_EQ(scene.materials.size(), 3U);
  EXPECT_EQ(scene.holders, (std::map<std::string, std::size_t>{{"alias", 2}, {"mixfunc", 1}}));
  EXPECT_EQ(scene.unmodelled, (std::map<std::string, std::size_t>{{"glass", 1}, {"light", 1}}));
  EXPECT_EQ(scene.declared, 8U);
  EXPECT_EQ(scene.materials[0].uses, 1U) << "the mixture's: the name is given anew behind it";
  EXPECT_EQ(scene.materials[1].uses, 2U) << "of an alias, and of the mixture's alias";
  EXPECT_EQ(scene.materials[2].uses, 1U);
  EXPECT_EQ(scene.materials[1].within, (Names{"texfunc", "brightfunc"}));
  EXPECT_FALSE(interval(scene.materials[1], "rho_s").is_known);
  EXPECT_DOUBLE_EQ(interval(scene.materials[1], "rho_s").high, 0.9);
  EXPECT_TRUE(has_note(scene, "the command '!xform -m \"a b\" -t 0 0 1 \\' was not run"));
  EXPECT_TRUE(has_note(scene, "the modifier 'nothing' isn't defined"));
  EXPECT_EQ(scene.materials[0].material.line, 3U);
}

TEST_F(RadianceScene, MalformedTextIsNamedByItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"void plastic", "line 1: the file ends before an object's name; is it cut off?"},
      {"void plastic a\n0\n0\n4 .5 .5 .5 0", "line 1: 'a': plastic takes 5 real arguments, not 4"},
      {"void plastic a 0 0 5 .5 .5 .5", "the file ends before the last of an object's real arguments"},
      {"void plastic a 0 0 5\n.5 .5 .5 0 x", "line 2: argument 5 = 'x' is not a finite number"},
      {"void plastic a 0 0 5 .5 .5 .5 inf 0", "argument 4 = 'inf' is not a finite number"},
      {"void plastic a -1 0 5 .5 .5 .5 0 0", "the number of text arguments isn't a count"},
      {"void plastic a 0.5 0 5 .5 .5 .5 0 0", "the number of text arguments isn't a count"},
      {"void mixfunc a 1 b 0 0", "'a': a mixture names two materials"},
      {"void plastic \"a\n0 0 5", "a quotation mark has no partner"}};
  for (const auto& [text, expected] : cases) {
    const std::string message = refusal_of("scene.rad", text);
    EXPECT_TRUE(message.starts_with("'scene.rad', line ")) << message;
    EXPECT_TRUE(contains(message, expected)) << text << " -> " << message;
  }
}

}  // namespace
}  // namespace albedo::analysis
