#include <cmath>
#include <numbers>

#include "analysis/scene_helpers.hpp"
#include "analysis/scenes/interfaces.hpp"

namespace albedo::analysis {
namespace {

class MitsubaScene : public SceneTest {
 protected:
  [[nodiscard]] Scene old_scene(const std::string& inside) const {
    return scene_of("old.xml", "<scene version=\"0.6.0\">\n" + inside + "\n</scene>");
  }
  [[nodiscard]] Scene new_scene(const std::string& inside) const {
    return scene_of("new.xml", "<scene version=\"3.0.0\">\n" + inside + "\n</scene>");
  }
  /// The only material of a scene.
  static SceneMaterial only(const Scene& scene) {
    EXPECT_EQ(scene.materials.size(), 1U);
    return scene.materials.empty() ? SceneMaterial{} : scene.materials[0];
  }
};

TEST_F(MitsubaScene, HoldersCountAndAreNamed) {
  const Scene scene = old_scene(R"(<bsdf type="mask" id="Rug">
    <texture name="opacity" type="bitmap"><string name="filename" value="m.png"/></texture>
    <bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.1, 0.2 0.3"/></bsdf></bsdf></bsdf>
  <bsdf type="bumpmap"><texture name="map" type="bitmap"/><bsdf type="twosided" id="Floor"><bsdf type="phong"/></bsdf></bsdf>
  <bsdf type="blendbsdf" id="Blend"><float name="weight" value="0.5"/><bsdf type="diffuse"/><ref id="Floor"/></bsdf>
  <bsdf type="coating" id="Coat"><bsdf type="roughconductor"/></bsdf>
  <bsdf type="dielectric"/>
  <shape type="obj"><ref id="Rug"/></shape><shape type="obj"><ref id="Floor"/></shape>
  <shape type="obj"><ref id="Blend"/><emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>
  <shape type="obj"><bsdf type="diffuse"/></shape><shape type="obj"/>)");
  EXPECT_EQ(scene.format, "mitsuba");
  EXPECT_EQ(scene.declared, 12U);
  ASSERT_EQ(scene.materials.size(), 5U);
  EXPECT_EQ(scene.holders,
            (std::map<std::string, std::size_t>{{"blendbsdf", 1}, {"bumpmap", 1}, {"mask", 1}, {"twosided", 2}}));
  EXPECT_EQ(scene.unmodelled, (std::map<std::string, std::size_t>{{"coating", 1}, {"dielectric", 1}}));
  const SceneMaterial& rug = scene.materials[0];
  EXPECT_EQ(rug.material.name, "Rug");
  EXPECT_EQ(rug.type, "diffuse");
  EXPECT_EQ(rug.material.model, "lambert");
  EXPECT_EQ(rug.material.line, 4U);
  EXPECT_EQ(rug.file, scene.path);
  EXPECT_EQ(rug.within, (Names{"mask", "twosided"}));
  EXPECT_EQ(rgb(rug, "rho"), (Rgb3{0.1, 0.2, 0.3}));
  EXPECT_EQ(scene.materials[1].material.name, "Floor");
  EXPECT_EQ(scene.materials[1].uses, 2U) << "a shape's, and the blend's";
  EXPECT_EQ(scene.materials[2].material.name, "Blend");
  EXPECT_EQ(scene.materials[3].within, (Names{"coating"}));
  EXPECT_EQ(scene.materials[4].uses, 1U);
  EXPECT_TRUE(has_note(scene, "a shape has no BSDF"));
}

TEST_F(MitsubaScene, ReferencesAreToTexturesOrBsdfs) {
  const Scene scene = old_scene(R"(<bsdf type="bumpmap" id="a"><ref id="map"/><ref name="nested" id="b"/></bsdf>
    <texture type="bitmap" id="map"/><bsdf type="diffuse" id="b"/>
    <bsdf type="something" id="c"><bsdf type="diffuse"/><bsdf type="twosided"><bsdf type="phong"/></bsdf></bsdf>
    <shape type="obj"><ref id="a"/><ref id="c"/><ref id="medium"/></shape>)");
  EXPECT_EQ(scene.declared, 6U);
  ASSERT_EQ(scene.materials.size(), 3U) << "also those in a plugin that isn't known";
  EXPECT_EQ(scene.unmodelled, (std::map<std::string, std::size_t>{{"something", 1}}));
  for (const SceneMaterial& material : scene.materials) EXPECT_EQ(material.uses, 1U) << material.material.name;
  EXPECT_EQ(refusal_of("a.xml", R"(<scene version="0.6.0"><bsdf type="twosided"><ref id="x"/></bsdf></scene>)"),
            "'a.xml', line 1: it refers to 'x', which isn't in the scene");
}

TEST_F(MitsubaScene, RoughConductor) {
  const SceneMaterial old = only(old_scene(R"(<bsdf type="roughconductor"/>)"));
  EXPECT_EQ(old.material.model, "beckmann");
  EXPECT_EQ(number(old, "alpha_x"), 0.1);
  EXPECT_EQ(choice(old, "masking"), "separable");
  EXPECT_EQ(choice(old, "fresnel"), "conductor");
  EXPECT_DOUBLE_EQ(rgb(old, "eta")[0], metal_index("Cu")->eta[0] / 1.000277) << "0.6 divides by air's";

  const SceneMaterial recent = only(new_scene(R"(<bsdf type="roughconductor"/>)"));
  EXPECT_EQ(choice(recent, "fresnel"), "none") << "a perfect mirror's facets are Mitsuba 3's default";

  const SceneMaterial given = only(new_scene(R"(<bsdf type="roughconductor"><string name="distribution" value="GGX"/>
    <float name="alpha_u" value="0.05"/><float name="alpha_v" value="0.3"/>
    <rgb name="eta" value="0.2, 0.9, 1.1"/><rgb name="k" value="3.9, 2.4, 2.2"/>
    <rgb name="specular_reflectance" value="0.5"/></bsdf>)"));
  EXPECT_EQ(given.material.model, "ggx");
  EXPECT_EQ(number(given, "alpha_x"), 0.05);
  EXPECT_EQ(number(given, "alpha_y"), 0.3);
  EXPECT_EQ(rgb(given, "eta"), (Rgb3{0.2, 0.9, 1.1}));
  EXPECT_EQ(rgb(given, "k"), (Rgb3{3.9, 2.4, 2.2}));
  EXPECT_EQ(given.material.scale, ParameterValue(0.5));

  const Scene unknown = new_scene(R"(<bsdf type="roughconductor"><string name="material" value="W"/></bsdf>
    <bsdf type="roughconductor"><string name="distribution" value="phong"/></bsdf>
    <bsdf type="roughconductor"><float name="alpha" value="-1"/></bsdf>)");
  EXPECT_EQ(unknown.unmodelled.at("roughconductor"), 3U);
  EXPECT_TRUE(has_note(unknown, "the metal 'W' aren't known"));
  EXPECT_TRUE(has_note(unknown, "distribution 'phong'"));
  EXPECT_TRUE(has_note(unknown, "alpha_x = -1 is outside of [1e-06, 100]"));
}

TEST_F(MitsubaScene, ReflectancesAboveOneAndUnknownSpectra) {
  const std::string bright = R"(<bsdf type="diffuse"><rgb name="reflectance" value="0.5 1 2"/></bsdf>
    <bsdf type="roughconductor"><spectrum name="eta" filename="a.spd"/><spectrum name="k" filename="b.spd"/></bsdf>)";
  const Scene old = old_scene(bright), recent = new_scene(bright);
  EXPECT_EQ(rgb(only(old), "rho"), (Rgb3{0.99 * 0.5 / 2, 0.99 * 1 / 2, 0.99 * 2 / 2}));
  EXPECT_TRUE(has_note(old, "a reflectance exceeds 1"));
  EXPECT_EQ(recent.unmodelled, (std::map<std::string, std::size_t>{{"diffuse", 1}, {"roughconductor", 1}}));
  EXPECT_TRUE(has_note(recent, "rho = 2 is outside of [0, 1]"));
  EXPECT_TRUE(has_note(recent, "the numbers of its spectra aren't known"));
}

TEST_F(MitsubaScene, NegativeIndexAndSmallRoughness) {
  const Scene scene = old_scene(R"(<bsdf type="roughconductor"><float name="alpha" value="0"/>
    <float name="extEta" value="1"/><rgb name="eta" value="-0.05, 0.1, 0.2"/><rgb name="k" value="3"/></bsdf>)");
  EXPECT_EQ(rgb(only(scene), "eta"), (Rgb3{0.05, 0.1, 0.2}));
  EXPECT_EQ(number(only(scene), "alpha_x"), 1e-4);
  EXPECT_TRUE(has_note(scene, "negative index"));
  EXPECT_TRUE(has_note(scene, "raised to 1e-4"));
}

TEST_F(MitsubaScene, RoughPlastic) {
  const SceneMaterial plain = only(old_scene(R"(<bsdf type="roughplastic"/>)"));
  EXPECT_EQ(plain.material.model, "beckmann");
  EXPECT_DOUBLE_EQ(number(plain, "eta"), 1.49 / 1.000277);
  EXPECT_EQ(number(plain, "k"), 0);
  const double outside = mean_fresnel(1.49 / 1.000277);
  EXPECT_NEAR(std::get<double>(plain.material.lambertian), 0.5 * (1 - outside), 1e-12) << "linear by default";

  const SceneMaterial named = only(new_scene(R"(<bsdf type="roughplastic"><string name="int_ior" value="BK7"/>
    <string name="ext_ior" value="water"/><boolean name="nonlinear" value="true"/>
    <rgb name="diffuse_reflectance" value="0.2 0.4 0.8"/></bsdf>)"));
  EXPECT_DOUBLE_EQ(number(named, "eta"), 1.5046 / 1.3330);
  const double eta = 1.5046 / 1.3330, out = mean_fresnel(eta), in = mean_fresnel(1 / eta);
  const auto lambertian = std::get<Rgb3>(named.material.lambertian);
  for (std::size_t i = 0; i < 3; ++i) {
    const double rho = std::array{0.2, 0.4, 0.8}[i];
    EXPECT_NEAR(lambertian[i], rho * (1 - out) * (1 - in) / (1 - rho * in), 1e-12);
  }
}

TEST_F(MitsubaScene, PhongIsWhatTheRendererEvaluates) {
  const Scene scene = old_scene(R"(<bsdf type="phong"/>
    <bsdf type="phong"><float name="exponent" value="7"/><spectrum name="diffuseReflectance" value="0.3"/>
      <srgb name="specularReflectance" value="#808000"/></bsdf>
    <bsdf type="phong"><rgb name="diffuseReflectance" value="0.9"/><rgb name="specularReflectance" value="0.6"/></bsdf>)");
  ASSERT_EQ(scene.materials.size(), 3U);
  EXPECT_EQ(number(scene.materials[0], "n"), 30);
  EXPECT_EQ(scene.materials[0].material.scale, ParameterValue(0.2));
  EXPECT_EQ(scene.materials[0].material.lambertian, ParameterValue(0.5));

  // (n + 2)/2π (R·V)^n k_s + k_d/π, as phong.cpp has it
  const Direction l = Direction::from_degrees(50, 20), v = Direction::from_degrees(30, 170);
  const double degree = std::numbers::pi / 180;
  const double r_dot_v = std::cos(50 * degree) * std::cos(30 * degree) -
                         std::sin(50 * degree) * std::sin(30 * degree) * std::cos(150 * degree);
  const double green = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);
  EXPECT_NEAR(brdf(scene.materials[1], 1, l, v),
              green * 9 / (2 * std::numbers::pi) * std::pow(r_dot_v, 7) + 0.3 / std::numbers::pi, 1e-12);

  EXPECT_NEAR(std::get<double>(scene.materials[2].material.scale), 0.99 * 0.6 / 1.5, 1e-15);
  EXPECT_NEAR(std::get<double>(scene.materials[2].material.lambertian), 0.99 * 0.9 / 1.5, 1e-15);
  EXPECT_TRUE(has_note(scene, "exceed 1 together"));
}

TEST_F(MitsubaScene, WardHasThreeVariants) {
  const Scene scene = old_scene(R"(<bsdf type="ward"><string name="variant" value="ward"/></bsdf>
    <bsdf type="ward"><string name="variant" value="ward-duer"/><float name="alphaU" value="0.2"/></bsdf>
    <bsdf type="ward"/><bsdf type="ward"><string name="variant" value="other"/></bsdf>)");
  ASSERT_EQ(scene.materials.size(), 3U);
  EXPECT_EQ(scene.materials[0].material.model, "ward");
  EXPECT_EQ(scene.materials[1].material.model, "ward_duer");
  EXPECT_EQ(number(scene.materials[1], "alpha_x"), 0.2);
  EXPECT_EQ(number(scene.materials[1], "alpha_y"), 0.1);
  EXPECT_EQ(scene.materials[2].material.model, "ward_bounded");
  EXPECT_EQ(number(scene.materials[2], "rho_s"), 0.2);
  EXPECT_EQ(number(scene.materials[2], "rho_d"), 0.5);
  EXPECT_EQ(scene.unmodelled.at("ward"), 1U);
}

TEST_F(MitsubaScene, TexturesGiveIntervals) {
  const Scene scene = old_scene(R"(<texture type="bitmap" id="Image"/>
    <texture type="checkerboard" id="Board"><rgb name="color0" value="0.1, 0.5, 0.3"/></texture>
    <bsdf type="diffuse" id="a"><ref name="reflectance" id="Image"/></bsdf>
    <bsdf type="diffuse" id="b"><ref name="reflectance" id="Board"/></bsdf>
    <bsdf type="diffuse" id="c"><texture name="reflectance" type="scale"><ref id="Board"/>
      <float name="scale" value="0.5"/></texture></bsdf>
    <bsdf type="roughconductor" id="d"><texture name="alpha" type="bitmap"/><string name="material" value="none"/></bsdf>
    <bsdf type="diffuse" id="e"><spectrum name="reflectance" value="400:0.1, 500:0.3, 700:0.2"/></bsdf>
    <bsdf type="diffuse" id="f"><ref name="reflectance" id="Nothing"/></bsdf>)");
  ASSERT_EQ(scene.materials.size(), 6U);
  const std::vector<std::array<double, 3>> expected{{0, 1, 0},    {0.1, 0.5, 1}, {0.05, 0.25, 1},
                                                    {1e-4, 1, 0}, {0.1, 0.3, 1}, {0, 1, 0}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const ParameterInterval found = interval(scene.materials[i], i == 3 ? "alpha_x" : "rho");
    EXPECT_EQ((std::array{found.low, found.high, found.is_known ? 1.0 : 0.0}), expected[i]) << i;
  }
  EXPECT_EQ(rgb(scene.materials[1], "rho"), (Rgb3{0.2, 0.5, 0.3})) << "the upper end";
  EXPECT_EQ(number(scene.materials[3], "alpha_y"), 1);
  EXPECT_TRUE(has_note(scene, "nothing is known of the texture of 'rho': it takes the whole of its interval (2 times"));
  EXPECT_TRUE(has_note(scene, "the texture 'Nothing' isn't defined"));
}

TEST_F(MitsubaScene, IncludesAndVariables) {
  write("materials/metal.xml", R"(<scene version="0.6.0"><default name="a" value="0.9"/>
    <bsdf type="ward" id="$id"><float name="alphaU" value="0.$a"/></bsdf></scene>)");
  const Scene scene = old_scene(R"(<default name="a" value="25"/><default name="id" value="Metal"/>
    <default name="directory" value="materials"/><include filename="$directory/metal.xml"/>
    <shape type="obj"><ref id="Metal"/></shape>)");
  const SceneMaterial metal = only(scene);
  EXPECT_EQ(metal.material.name, "Metal");
  EXPECT_EQ(number(metal, "alpha_x"), 0.25) << "the first of two defaults counts";
  EXPECT_EQ(metal.uses, 1U);
  EXPECT_EQ(metal.file, path("materials/metal.xml"));
  EXPECT_EQ(metal.material.line, 2U);
  EXPECT_EQ(refusal_of("open.xml", "<scene version=\"0.6.0\">\n<bsdf type=\"$kind\"/></scene>"),
            "'open.xml', line 2: the variable in '$kind' has no value; the scene expects it on the command line");
}

TEST(Interfaces, MeanFresnel) {
  // Walsh 1926: closed form of 2 ∫ F μ dμ
  const auto walsh = [](double n) {
    const double n2 = n * n, n4 = n2 * n2;
    return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
           n2 * (n2 - 1) * (n2 - 1) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) -
           2 * n2 * n * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
           8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * std::log(n);
  };
  for (const double eta : {1.05, 1.33, 1.5, 2.0, 3.0}) {
    EXPECT_NEAR(mean_fresnel(eta), walsh(eta), 1e-7) << eta;
    // what gets in gets out: étendue
    EXPECT_NEAR(1 - mean_fresnel(1 / eta), (1 - mean_fresnel(eta)) / (eta * eta), 1e-7) << eta;
  }
}

}  // namespace
}  // namespace albedo::analysis
