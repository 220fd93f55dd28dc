#include <gtest/gtest.h>
#include <png.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

#include "albedo/core/errors.hpp"
#include "analysis/helpers.hpp"
#include "plots/render/colour.hpp"
#include "plots/render/furnace.hpp"
#include "plots/render/picture.hpp"
#include "plots/render/scenes.hpp"
#include "plots/render/walter.hpp"

namespace albedo::render {
namespace {

RenderSettings small(std::size_t size, std::uint32_t samples) {
  return {.width = size, .height = size, .samples = samples};
}

bool same(const Rendering& a, const Rendering& b) {
  for (std::size_t i = 0; i < a.mean.size(); ++i) {
    for (int band = 0; band < block_width; ++band) {
      if (a.mean[i][band] != b.mean[i][band]) return false;
    }
  }
  return a.error == b.error;
}

TEST(Scenes, AreHitWhereTheyAre) {
  Scene scene;
  scene.add({});
  scene.spheres = {{{0, 5, 0}, 2, 0}};
  scene.facets = {{{-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, 0}, {{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, 0, true}};
  const auto look = [&](double x, double z) { return scene.closest({{x, 0, z}, Vector::UnitY()}); };
  EXPECT_EQ(look(0.2, 0.3)->primitive, 1U);
  EXPECT_DOUBLE_EQ(look(0.2, 0.3)->distance, 1);
  EXPECT_EQ(look(0, 1.5)->primitive, 0U);
  EXPECT_NEAR(look(0, 1.5)->distance, 5 - std::sqrt(4 - 2.25), 1e-15);
  EXPECT_FALSE(look(0, 2.1));
  // of the triangle half a square is left
  EXPECT_EQ(scene.closest({{-0.5, 1.5, -0.6}, Vector::UnitY()})->primitive, 2U);
  EXPECT_EQ(scene.closest({{0.6, 1.5, 0.6}, Vector::UnitY()})->primitive, 0U);
  EXPECT_FALSE(scene.closest({{0.2, 1, 0.3}, -Vector::UnitY()}));

  const Frame frame = look(0.2, 0.3)->frame;
  EXPECT_LT(frame.z.y(), 0) << "the normal is on the side of the ray";
  EXPECT_NEAR(frame.x.cross(frame.y).dot(frame.z), 1, 1e-15);
  const Frame of_sphere = sphere_frame(Vector(0.6, -0.8, 0), Vector::UnitZ());
  EXPECT_NEAR(of_sphere.x.z(), 0, 1e-15) << "x runs along the parallels";
  EXPECT_NEAR(of_sphere.y.z(), 1, 1e-15) << "y along the meridians";
}

TEST(Scenes, RefuseModelsThatCantBeDrawn) {
  EXPECT_TRUE(analysis::contains(
      analysis::message_of<ParameterError>([] { lobes_of(make_model("he_torrance"), constant(Spectrum(1))); }),
      "has a coherent part"));
  EXPECT_TRUE(analysis::contains(
      analysis::message_of<ParameterError>([] { render(Scene{}, furnace_camera(), small(4, 1)); }), "samples is 1"));
}

TEST(PathTracer, BitsDontDependOnThreads) {
  const View view = sphere_on_plane(red_plastic(10, 1000));
  RenderSettings settings = small(12, 8);
  settings.threads = 1;
  const Rendering one = render(view.scene, view.camera, settings);
  settings.threads = 4;
  EXPECT_TRUE(same(one, render(view.scene, view.camera, settings)));
  settings.seed = 2;
  EXPECT_FALSE(same(one, render(view.scene, view.camera, settings)));
}

TEST(PathTracer, ClosedBoxIsDark) {
  Scene scene;
  const std::size_t wall = scene.add({.lobes = lobes_of(make_model("lambert", {{"rho", 0.5}}), constant(Spectrum(1)))});
  scene.add_box({-1, -1, -1}, {1, 1, 1}, wall);
  scene.environment = Spectrum(1);
  const Camera camera = Camera::perspective(Vector(0, -0.9, 0.1), Vector(0, 1, 0), 60);
  EXPECT_EQ(render(scene, camera, small(6, 16)).mean_luminance(), 0);
}

TEST(PathTracer, LambertInAFurnaceHasNoVariance) {
  const Rendering lit = render(furnace(lobes_of(make_model("lambert", {{"rho", 0.5}}), constant(rgb(1, 1, 0.5)))),
                               furnace_camera(), small(8, 4));
  EXPECT_NEAR(lit.mean[8 * 4 + 4][0], 0.5, 1e-12);
  EXPECT_NEAR(lit.mean[8 * 4 + 4][2], 0.25, 1e-12);
  EXPECT_NEAR(lit.error[8 * 4 + 4], 0, 1e-12);
}

/// A cube of albedo ρ below a ceiling of radiance 1, through any number of bounces and the roulette.
TEST(PathTracer, RouletteKeepsTheMean) {
  Scene scene;
  const std::size_t wall = scene.add({.lobes = lobes_of(make_model("lambert", {{"rho", 0.8}}), constant(Spectrum(1)))});
  const std::size_t light = scene.add({.emission = Spectrum(1)});
  scene.add_box({-1, -1, -1}, {1, 1, 1}, wall);
  scene.facets.back().material = light;
  // B = ρ (F_ww B + F_wl) if the walls were evenly bright: the ceiling of 4 sees only walls, of 20, so F_wl = 4/20
  const double to_light = 4.0 / 20, to_walls = 1 - to_light;
  const double even = 0.8 * to_light / (1 - 0.8 * to_walls);
  double sum = 0;
  int count = 0;
  for (const Vector& target : {Vector(1, 0, 0), Vector(-1, 0, 0), Vector(0, 1, 0.01), Vector(0, -1, 0.01)}) {
    sum += render(scene, Camera::perspective(Vector::Zero(), target, 90), small(16, 64)).mean_luminance();
    ++count;
  }
  EXPECT_NEAR(sum / count, even, 0.05 * even) << "they aren't quite";
}

/// A wrong weight or density shows in the mean, one that is right has deviations of a standard error.
TEST(Furnace, EveryModelIsItsAlbedo) {
  std::vector<FurnaceModel> models = furnace_models();
  models.insert(models.end(), corrected_furnace_models().begin(), corrected_furnace_models().end());
  for (const FurnaceModel& model : models) {
    const FurnaceTest test = test_in_furnace(model.make(), 20, 640, 5);
    EXPECT_GT(test.pixels, 200U) << model.label;
    EXPECT_LT(std::abs(test.mean_difference), 4 * test.mean_error) << model.label;
    EXPECT_LT(test.mean_error, 2e-3) << model.label;
    EXPECT_NEAR(test.rms_deviation, 1, 0.15) << model.label;
    EXPECT_LT(test.largest_deviation, 6) << model.label;
    EXPECT_EQ(test.unconverged, 0U) << model.label;
  }
}

/// The test above would not pass with a weight that is off by a percent.
TEST(Furnace, SeesAWrongWeight) {
  FurnaceCase wrong = furnace_models().front().make();
  const AlbedoFunction right = wrong.albedo;
  wrong.albedo = [right](const UnitVector<double>& v) {
    Estimate estimate = right(v);
    estimate.value *= 1.01;
    return estimate;
  };
  const FurnaceTest test = test_in_furnace(wrong, 20, 512, 5);
  EXPECT_GT(std::abs(test.mean_difference), 4 * test.mean_error);
}

TEST(Furnace, SpheresThatAreNotTracedHaveTheAlbedosOfTheLibrary) {
  const auto model = make_model("ashikhmin_shirley", {{"n_u", 10.0}, {"n_v", 100.0}});
  const AlbedoSphere sphere = albedo_sphere(*model, 21, 1e-6);
  EXPECT_EQ(sphere.unconverged, 0U);
  const double centre = directional_albedo(*model, Direction{}).value;
  EXPECT_NEAR(sphere.picture.at(10, 10)[0], centre, 1e-5);
  EXPECT_EQ(sphere.picture.at(0, 0)[0], 1);
  // on the horizontal half-axis the eye is along u, which runs along the parallels
  const double sine = (2 * 15.5 / 21 - 1) * 1.04;
  const Direction along_u = Direction::from_cosine(std::sqrt(1 - sine * sine), 0);
  EXPECT_NEAR(sphere.picture.at(15, 10)[0], directional_albedo(*model, along_u).value, 1e-3);
  const Direction along_v = Direction::from_cosine(std::sqrt(1 - sine * sine), 90);
  EXPECT_NEAR(sphere.picture.at(10, 15)[0], directional_albedo(*model, along_v).value, 1e-3);
  EXPECT_GT(std::abs(sphere.picture.at(15, 10)[0] - sphere.picture.at(10, 15)[0]), 0.01);
}

TEST(Walter, EqualWeightsAreWrongByWhatTheCurveSays) {
  const WalterPictures p = walter_pictures(ward_in_furnace(), walter_alpha, 24, 768, 256, 7);
  EXPECT_GT(p.pixels, 300U);
  EXPECT_LT(p.reference.error, 0.01 * p.reference.value);
  EXPECT_LT(std::abs(p.weighted_minus_reference.value), 4 * p.weighted_minus_reference.error);
  EXPECT_GT(p.equal_minus_reference.value, 20 * p.equal_minus_reference.error) << "the bias is seen";
  EXPECT_NEAR(p.equal_minus_reference.value, p.predicted.value,
              4 * std::hypot(p.equal_minus_reference.error, p.predicted.error));
}

TEST(Walter, TheBoxShowsTheSame) {
  const WalterPictures p = walter_pictures(ward_in_box(), walter_alpha, 24, 512, 128, 3);
  EXPECT_LT(std::abs(p.weighted_minus_reference.value), 4 * p.weighted_minus_reference.error);
  EXPECT_GT(p.equal_minus_reference.value, 8 * p.equal_minus_reference.error);
  // the light isn't even over the lobe: the curve tells the bias to some percent
  EXPECT_NEAR(p.equal_minus_reference.value, p.predicted.value,
              0.1 * p.predicted.value + 4 * p.equal_minus_reference.error);
}

/// ρ_s P is 1 where no sample is lost, and tends to 1/2 at grazing incidence, where half of the lobe is below the
/// horizon; Ward's albedo of a narrow lobe is the cosine.
TEST(Walter, CurvesHaveTheirLimits) {
  EXPECT_NEAR(equal_weights_albedo(0.05, Direction::from_degrees(30)).value, 1, 1e-6);
  EXPECT_NEAR(equal_weights_albedo(0.05, Direction::from_cosine(1e-5)).value, 0.5, 1e-3);
  EXPECT_NEAR(ward_albedo(0.005, Direction::from_degrees(60)).value, 0.5, 1e-4);
}

TEST(Colours, EvenLightIsWhite) {
  const Colour white = colour_of_bands(Spectrum(1));
  for (const double value : white) EXPECT_NEAR(value, 1, 1e-12);
  double sum = 0;
  for (int band = 0; band < block_width; ++band) sum += luminance_of_bands()[band];
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(Colours, MetalsLookLikeThemselves) {
  const auto colour = [](const char* element) { return colour_of_bands(conductor(metal(element))(1)); };
  const Colour silver = colour("Ag"), aluminium = colour("Al"), copper = colour("Cu"), gold = colour("Au");
  for (const double value : silver) EXPECT_NEAR(value, 0.97, 0.03);
  for (const double value : aluminium) EXPECT_NEAR(value, 0.91, 0.03);
  EXPECT_GT(copper[0], copper[1]);
  EXPECT_GT(copper[1], copper[2]);
  EXPECT_GT(gold[0], 0.9);
  EXPECT_LT(gold[2], 0.5);
  EXPECT_GT(gold[1] - gold[2], copper[1] - copper[2]) << "gold is yellower";
  EXPECT_TRUE(analysis::contains(analysis::message_of<ParameterError>([] { metal("Fe"); }), "'Fe' is not known"));
}

/// The bytes back as libpng reads them.
std::vector<unsigned char> decoded(const std::string& png, int format) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, png.data(), png.size()) == 0) return {};
  image.format = static_cast<png_uint_32>(format);
  std::vector<unsigned char> bytes(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr) == 0) return {};
  return bytes;
}

TEST(Pictures, AreEncodedAsTheyAre) {
  Picture picture(2, 1);
  picture.at(0, 0) = {0, 0.2140, 1};
  picture.at(1, 0) = {-0.5, 2, 0.0021};
  const std::string png = encode_png(picture, 1, {{"key", "value"}});
  EXPECT_TRUE(analysis::contains(png, R"({"key": "value"})"));
  EXPECT_EQ(decoded(png, PNG_FORMAT_RGB), (std::vector<unsigned char>{0, 127, 255, 0, 255, 7}));
  EXPECT_EQ(png, encode_png(picture, 1, {{"key", "value"}}));
  EXPECT_EQ(saturated_part(picture, 1), 0.5);
  EXPECT_EQ(decoded(encode_png({-1, 0, 1, 3}, 2, -1, 1, {}), PNG_FORMAT_GRAY),
            (std::vector<unsigned char>{0, 128, 255, 255}));

  const std::string exr = encode_exr(picture, {{"key", "value"}});
  EXPECT_TRUE(exr.starts_with("\x76\x2f\x31\x01"));
  EXPECT_TRUE(analysis::contains(exr, R"({"key": "value"})"));
  EXPECT_EQ(exr, encode_exr(picture, {{"key", "value"}}));

  picture.at(0, 0)[1] = NAN;
  EXPECT_TRUE(
      analysis::contains(analysis::message_of<ParameterError>([&] { encode_png(picture, 1, {}); }), "isn't finite"));
}

TEST(Pictures, AreLaidSideBySide) {
  const Picture black(2, 2), white(2, 2, {1, 1, 1});
  const Picture all = mosaic({black, white, white}, 2, 1, 0.5);
  EXPECT_EQ(all.width, 5U);
  EXPECT_EQ(all.height, 5U);
  EXPECT_EQ(all.at(1, 1)[0], 0);
  EXPECT_EQ(all.at(2, 1)[0], 0.5);
  EXPECT_EQ(all.at(3, 0)[0], 1);
  EXPECT_EQ(all.at(0, 4)[0], 1);
  EXPECT_EQ(all.at(4, 4)[0], 0.5);
}

}  // namespace
}  // namespace albedo::render
