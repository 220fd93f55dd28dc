#include <cmath>

#include "analysis/scene_helpers.hpp"
#include "analysis/scenes/interfaces.hpp"

namespace albedo::analysis {
namespace {

class PbrtScene : public SceneTest {};

TEST_F(PbrtScene, MaterialsAndUses) {
  write("parts/more.pbrt", "MakeNamedMaterial \"more\" \"string type\" \"diffuse\" # \"rgb reflectance\" [ 0 0 0 ]\n");
  const Scene scene = scene_of("scene.pbrt", R"(LookAt 0 1.5 -1e3 0 1 0 0 1 0
WorldBegin
AttributeBegin
  NamedMaterial "late" Shape "sphere" "float radius" 1
  AttributeBegin
    Material "diffuse" "rgb reflectance" [ 0.1 0.2 0.3 ]
    Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 2]
    Shape "sphere"
  AttributeEnd
  Shape "sphere"
AttributeEnd
Shape "sphere"
MakeNamedMaterial "late" "string type" [ "diffuse" ] "float reflectance" 0.25
Import "parts/more.pbrt"
MakeNamedMaterial "both" "string type" "mix" "string materials" [ "late" "more" ] "float amount" 0.5
NamedMaterial "both" Shape "disk"
Material "dielectric" Material "interface"
)");
  EXPECT_EQ(scene.format, "pbrt");
  EXPECT_EQ(scene.declared, 6U);
  EXPECT_EQ(scene.unmodelled, (std::map<std::string, std::size_t>{{"dielectric", 1}, {"interface", 1}}));
  EXPECT_EQ(scene.holders, (std::map<std::string, std::size_t>{{"mix", 1}}));
  ASSERT_EQ(scene.materials.size(), 3U);
  EXPECT_EQ(scene.materials[0].material.name, "diffuse at line 6");
  EXPECT_EQ(rgb(scene.materials[0], "rho"), (Rgb3{0.1, 0.2, 0.3}));
  EXPECT_EQ(scene.materials[0].uses, 2U);
  EXPECT_EQ(number(scene.materials[1], "rho"), 0.25);
  EXPECT_EQ(scene.materials[1].uses, 3U) << "two shapes, and one of the mix";
  EXPECT_EQ(number(scene.materials[2], "rho"), 0.5);
  EXPECT_EQ(scene.materials[2].uses, 1U);
  EXPECT_EQ(scene.materials[2].file, path("parts/more.pbrt"));
  EXPECT_TRUE(has_note(scene, "a shape has no material"));
}

TEST_F(PbrtScene, Conductors) {
  const Scene scene = scene_of("scene.pbrt", R"(
Material "conductor" "float roughness" 0.09
Material "conductor" "float roughness" 0.09 "bool remaproughness" false "spectrum eta" "metal-Ag-eta" "spectrum k" "metal-Ag-k"
Material "conductor" "float uroughness" 0.04 "float vroughness" 0.25 "rgb eta" [ 0.2 0.9 1.1 ] "rgb k" [ 3.9 2.4 2.2 ]
Material "conductor" "float roughness" 0.5 "rgb reflectance" [ 0.5 0.6 0.7 ]
Material "conductor"
Material "conductor" "float roughness" 0.1 "spectrum eta" "metal-CuZn-eta" "spectrum k" "metal-CuZn-k"
)");
  ASSERT_EQ(scene.materials.size(), 4U);
  EXPECT_EQ(scene.unmodelled.at("conductor"), 2U);
  EXPECT_TRUE(has_note(scene, "it is smooth"));
  EXPECT_TRUE(has_note(scene, "aren't known here"));
  const SceneMaterial &copper = scene.materials[0], &silver = scene.materials[1], &given = scene.materials[2];
  EXPECT_EQ(copper.material.model, "ggx");
  EXPECT_DOUBLE_EQ(number(copper, "alpha_x"), 0.3) << "remapped by default: the square root";
  EXPECT_EQ(choice(copper, "masking"), "correlated");
  EXPECT_EQ(rgb(copper, "eta"), metal_index("Cu")->eta);
  EXPECT_EQ(number(silver, "alpha_x"), 0.09);
  EXPECT_EQ(rgb(silver, "k"), metal_index("Ag")->k);
  EXPECT_DOUBLE_EQ(number(given, "alpha_x"), 0.2);
  EXPECT_DOUBLE_EQ(number(given, "alpha_y"), 0.5);
  EXPECT_EQ(rgb(given, "eta"), (Rgb3{0.2, 0.9, 1.1}));
  // an index of 1 with this extinction reflects what was asked for at normal incidence: k²/(4 + k²)
  for (std::size_t i = 0; i < 3; ++i) {
    const double k = rgb(scene.materials[3], "k")[i];
    EXPECT_NEAR(k * k / (4 + k * k), 0.5 + 0.1 * static_cast<double>(i), 1e-12);
  }
}

TEST_F(PbrtScene, CoatedDiffuse) {
  const Scene scene = scene_of("scene.pbrt", R"(
Material "coateddiffuse" "float roughness" 0.04 "rgb reflectance" [ 0.2 0.2 0.8 ]
Material "coateddiffuse" "float roughness" 0.04 "spectrum eta" "glass-BK7"
Material "coateddiffuse")");
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.unmodelled.at("coateddiffuse"), 1U) << "its roughness is 0 by default";
  EXPECT_EQ(number(scene.materials[0], "eta"), 1.5);
  EXPECT_EQ(number(scene.materials[0], "k"), 0);
  const double out = mean_fresnel(1.5), in = mean_fresnel(1 / 1.5);
  EXPECT_NEAR(std::get<Rgb3>(scene.materials[0].material.lambertian)[2], 0.8 * (1 - out) * (1 - in) / (1 - 0.8 * in),
              1e-12);
  EXPECT_TRUE(has_note(scene, "the coat's index isn't a number"));
}

TEST_F(PbrtScene, TexturesGiveIntervals) {
  const Scene scene = scene_of("scene.pbrt", R"(
Texture "image" "spectrum" "imagemap" "string filename" "a.png"
Texture "constant" "spectrum" "constant" "rgb value" [ 0.2 0.4 0.6 ]
Texture "scaled" "spectrum" "scale" "texture tex" "constant" "float scale" 0.5
Texture "mixed" "spectrum" "mix" "texture tex1" "constant" "rgb tex2" [ 0.9 0.1 0.1 ]
Texture "board" "float" "checkerboard" "float tex1" 0.04 "float tex2" 0.25
Material "diffuse" "texture reflectance" "image"
Material "diffuse" "texture reflectance" "constant"
Material "diffuse" "texture reflectance" "scaled"
Material "diffuse" "texture reflectance" "mixed"
Material "conductor" "texture roughness" "board"
Material "diffuse" "texture reflectance" "nothing"
Material "diffuse" "spectrum reflectance" [ 400 0.1 500 0.3 700 0.2 ]
)");
  ASSERT_EQ(scene.materials.size(), 7U);
  EXPECT_FALSE(interval(scene.materials[0], "rho").is_known);
  EXPECT_TRUE(scene.materials[1].intervals.empty());
  EXPECT_EQ(rgb(scene.materials[2], "rho"), (Rgb3{0.1, 0.2, 0.3}));
  EXPECT_EQ(rgb(scene.materials[3], "rho"), (Rgb3{0.9, 0.4, 0.6}));
  EXPECT_EQ(interval(scene.materials[3], "rho").low, 0.1);
  EXPECT_DOUBLE_EQ(interval(scene.materials[4], "alpha_x").low, 0.2);
  EXPECT_DOUBLE_EQ(interval(scene.materials[4], "alpha_y").high, 0.5);
  EXPECT_TRUE(interval(scene.materials[4], "alpha_y").is_known);
  EXPECT_FALSE(interval(scene.materials[5], "rho").is_known);
  EXPECT_TRUE(has_note(scene, "the texture 'nothing' isn't defined"));
  EXPECT_EQ(interval(scene.materials[6], "rho").high, 0.3);
}

TEST_F(PbrtScene, MalformedTextIsNamedByItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"\n0.5", "line 2: a directive is expected, not '0.5'"},
      {"Material \"diff", "line 1: a quotation mark has no partner"},
      {"Material \"diffuse\"\n\"rgb reflectance\" [ 0.1", "line 2: the parameter 'rgb reflectance' has no end"},
      {"Material \"diffuse\" \"rgb reflectance\" [ 0.1 0.2 ]", "takes three numbers"},
      {"Material \"diffuse\" \"rgb reflectance\" [ 0.1 0.2 x ]", "reflectance = 'x' is not a finite number"},
      {"Material \"diffuse\" \"rgb reflectance\" []", "has no value"},
      {"Material \"diffuse\" \"point3 reflectance\" [ 1 2 3 ]", "is of no type"},
      {"Material", "Material takes a name"},
      {"MakeNamedMaterial \"a\"", "'a' has no \"type\""},
      {"AttributeBegin\nAttributeEnd\nAttributeEnd", "line 3: AttributeEnd ends what hasn't begun"}};
  for (const auto& [text, expected] : cases) {
    const std::string message = refusal_of("scene.pbrt", text);
    EXPECT_TRUE(message.starts_with("'scene.pbrt', line ")) << message;
    EXPECT_TRUE(contains(message, expected)) << text << " -> " << message;
  }
}

}  // namespace
}  // namespace albedo::analysis
