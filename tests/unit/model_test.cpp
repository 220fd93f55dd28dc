#include "albedo/core/model.hpp"
#include "albedo/core/suggestion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>

#include "albedo/core/errors.hpp"
#include "albedo/directional_albedo.hpp"
#include "albedo/microfacet/fresnel.hpp"

namespace albedo {
namespace {

const double pi_ = std::acos(-1.0);

double f(const std::string& model, const Parameters& parameters, const Direction& l, const Direction& v) {
  return brdf<double>(*make_model(model, parameters), l, v);
}

Direction at(double theta, double phi = 0) { return Direction::from_degrees(theta, phi); }

template <class Exception, class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Exception& e) {
    return e.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(MakeModel, MisspeltNamesAreSuggested) {
  EXPECT_TRUE(contains(message_of<UnknownModel>([] { make_model("wardd"); }), "'ward'"));
  EXPECT_TRUE(contains(message_of<UnknownModel>([] { make_model("cook_torance"); }), "'cook_torrance'"));
  const std::string unlike = message_of<UnknownModel>([] { make_model("xyzzyxyzzy"); });
  EXPECT_TRUE(contains(unlike, "lambert") && contains(unlike, "ggx")) << unlike;
  EXPECT_TRUE(contains(message_of<ParameterError>([] { make_model("ward", {{"alhpa", 0.1}}); }), "'alpha'"));
  EXPECT_THROW(make_model(""), UnknownModel);
  EXPECT_THROW(make_model("Ward"), UnknownModel);
}

TEST(MakeModel, ErrorsNameTheParameterItsValueAndItsRange) {
  const std::string message = message_of<ParameterError>([] { make_model("ward", {{"alpha", -1.0}}); });
  EXPECT_TRUE(contains(message, "alpha_x") && contains(message, "-1") && contains(message, "[1e-06, 100]")) << message;
  for (const double value :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(make_model("ward", {{"alpha", value}}), ParameterError) << value;
  }
  const std::string choice = message_of<ParameterError>([] { make_model("ggx", {{"masking", "none"}}); });
  EXPECT_TRUE(contains(choice, "correlated, separable")) << choice;
}

TEST(MakeModel, LaterParametersWinAndShorthandsSetAll) {
  const auto model = make_model("ggx", {{"alpha", 0.5}, {"alpha_y", 0.2}});
  EXPECT_FALSE(model->claims().isotropic);
  EXPECT_EQ(std::get<double>(model->parameters()[0].second), 0.5);
  EXPECT_EQ(std::get<double>(model->parameters()[1].second), 0.2);
}

/// Kurt's equations are names that look like numbers.
TEST(MakeModel, AChoiceMayBeGivenAsANumber) {
  const Direction l = at(50), v = at(30, 170);
  EXPECT_EQ(f("kurt", {{"equation", 9.0}}, l, v), f("kurt", {{"equation", "9"}}, l, v));
  EXPECT_THROW(make_model("kurt", {{"equation", 12.0}}), ParameterError);
}

TEST(Suggestion, FindsTheNearestName) {
  const std::vector<std::string> models{"lambert",          "phong", "blinn", "ward", "ggx", "cook_torrance",
                                        "ashikhmin_shirley"};
  const std::vector<std::pair<std::string, std::string>> cases{{"wardd", "ward"},
                                                               {"wrad", "ward"},
                                                               {"war", "ward"},
                                                               {"Ward", "ward"},
                                                               {"GGX", "ggx"},
                                                               {"cook-torrance", "cook_torrance"},
                                                               {"cooktorance", "cook_torrance"},
                                                               {"pohng", "phong"},
                                                               {"ahsikmin_shirley", "ashikhmin_shirley"}};
  for (const auto& [word, expected] : cases) EXPECT_EQ(suggestion(word, models), expected) << word;
  for (const char* const word : {"", "oren_nayar", "xyz", "wxyz", "g"}) EXPECT_EQ(suggestion(word, models), "") << word;
  EXPECT_EQ(suggestion("a", {"k"}), "");
  EXPECT_EQ(suggestion("alhpa", {"alpha_x", "alpha", "alpha_y"}), "alpha");
  EXPECT_EQ(suggestion(std::string(1'000'000, 'w'), models), "");
}

TEST(Fresnel, ConductorAtNormalAndGrazingIncidence) {
  const Fresnel metal{.kind = FresnelKind::conductor, .eta = 0.2, .k = 3};
  EXPECT_NEAR(metal(1.0), (0.8 * 0.8 + 9) / (1.2 * 1.2 + 9), 1e-15);
  EXPECT_NEAR(metal(1e-12), 1, 1e-10);
  // a dielectric: Brewster's angle leaves only the senkrecht half
  const Fresnel glass{.kind = FresnelKind::conductor, .eta = 1.5, .k = 0};
  const double brewster = 1 / std::sqrt(1 + 1.5 * 1.5);
  const double cos_t = std::sqrt(1 - (1 - brewster * brewster) / 2.25);
  const double r_s = (brewster - 1.5 * cos_t) / (brewster + 1.5 * cos_t);
  EXPECT_NEAR(glass(brewster), r_s * r_s / 2, 1e-14);
  EXPECT_NEAR(glass(1.0), 0.04, 1e-15);
}

/// At 60°, with complex arithmetic instead of its real form.
TEST(Fresnel, ConductorIsFresnelsEquations) {
  for (const double cosine : {0.02, 0.3, 0.5, 0.9}) {
    const double eta = 0.4, k = 2.5;
    const std::complex<double> n(eta, k);
    const std::complex<double> g = std::sqrt(n * n - (1 - cosine * cosine));
    const double r_s = std::norm((cosine - g) / (cosine + g));
    const double r_p = std::norm((n * n * cosine - g) / (n * n * cosine + g));
    const Fresnel metal{.kind = FresnelKind::conductor, .eta = eta, .k = k};
    EXPECT_NEAR(metal(cosine), (r_s + r_p) / 2, 1e-14) << cosine;
  }
}

TEST(Fresnel, Schlick) {
  const Fresnel schlick{.kind = FresnelKind::schlick, .f0 = 0.04};
  EXPECT_NEAR(schlick(1.0), 0.04, 1e-16);
  EXPECT_NEAR(schlick(0.0), 1, 1e-16);
  EXPECT_NEAR(schlick(0.5), 0.04 + 0.96 / 32, 1e-16);
  EXPECT_EQ(Fresnel{.kind = FresnelKind::none}(0.3), 1);
  EXPECT_EQ(Fresnel{}(0.3), 1) << "the default is F = 1";
}

// Values of the published formulas worked out by hand, in the mirror configuration (H = N) at 60° unless said
// otherwise: cosines 1/2, L·H = 1/2.

TEST(Formula, Lambert) { EXPECT_NEAR(f("lambert", {{"rho", 0.3}}, at(20), at(70, 100)), 0.3 / pi_, 1e-16); }

TEST(Formula, PhongAndItsRelatives) {
  const Direction l = at(60), mirror = at(60, 180), normal = at(0);
  EXPECT_NEAR(f("phong", {{"n", 20.0}}, l, mirror), 22 / (2 * pi_), 1e-13);
  EXPECT_NEAR(f("phong", {{"n", 3.0}}, l, normal), 5 / (2 * pi_) / 8, 1e-15);  // R·V = 1/2
  EXPECT_EQ(f("phong", {{"n", 3.0}}, l, at(60, 0)), 0) << "R·V < 0";
  EXPECT_NEAR(f("phong_original", {{"n", 20.0}}, l, mirror), 21 / (2 * pi_) / 0.5, 1e-13);
  EXPECT_NEAR(f("neumann_phong", {{"n", 3.0}}, l, normal), 5 / (2 * pi_) / 8, 1e-15);  // max(1/2, 1) = 1
  EXPECT_NEAR(f("neumann_phong", {{"n", 20.0}}, l, mirror), 22 / (2 * pi_) / 0.5, 1e-13);
  EXPECT_NEAR(f("lafortune", {{"n", 20.0}, {"rho", 0.5}}, l, mirror), 11 / (2 * pi_), 1e-13);
  // c = (−1, −1, 1/2): L·C·V = 3/4 + 1/8
  EXPECT_NEAR(f("lafortune", {{"c_z", 0.5}, {"n", 2.0}}, l, mirror), 4 / (2 * pi_) * 0.875 * 0.875, 1e-14);
}

TEST(Formula, BlinnAndItsRelative) {
  const double c = 6.0 * 8 / (8 * pi_ * (0.25 + 4));  // n = 4
  EXPECT_NEAR(f("blinn", {{"n", 4.0}}, at(60), at(60, 180)), c, 1e-14);
  EXPECT_NEAR(f("blinn", {{"n", 4.0}}, at(60), at(0)), c * 9 / 16, 1e-14);  // N·H = √3/2
  EXPECT_NEAR(f("blinn_original", {{"n", 4.0}}, at(60), at(0)), c * 9 / 8, 1e-14);
}

TEST(Formula, Ward) {
  EXPECT_NEAR(f("ward", {{"alpha", 0.1}}, at(60), at(60, 180)), 1 / (4 * pi_ * 0.01 * 0.5), 1e-12);
  // H at 30°, in the plane of x: tan² = 1/3
  EXPECT_NEAR(f("ward", {{"alpha_x", 0.5}, {"alpha_y", 0.1}, {"rho_d", 0.2}}, at(60), at(0)),
              0.2 / pi_ + std::exp(-4.0 / 3) / (4 * pi_ * 0.05 * std::sqrt(0.5)), 1e-13);
  EXPECT_NEAR(f("ward", {{"alpha_x", 0.1}, {"alpha_y", 0.5}}, at(60, 90), at(0)),
              std::exp(-4.0 / 3) / (4 * pi_ * 0.05 * std::sqrt(0.5)), 1e-13);
}

TEST(Formula, CookTorrance) {
  // G = 1 in the mirror configuration up to 60°: 2 · 1 · (1/2)/(1/2) = 2
  EXPECT_NEAR(f("cook_torrance", {{"m", 0.2}}, at(60), at(60, 180)), 1 / (pi_ * 0.04 * 4 * 0.25), 1e-12);
  // L at 80°, V at the normal: H at 40°, G = 2 cos40° cos80°/cos40°
  const double h = 40 * pi_ / 180, cos_l = std::cos(2 * h), tan2 = std::tan(h) * std::tan(h),
               cos4 = std::pow(std::cos(h), 4);
  const double unmasked = std::exp(-tan2 / 0.25) / (pi_ * 0.25 * cos4 * 4 * cos_l);
  EXPECT_NEAR(f("cook_torrance", {{"m", 0.5}, {"masking", "none"}}, at(80), at(0)), unmasked, 1e-13);
  EXPECT_NEAR(f("cook_torrance", {{"m", 0.5}, {"k_s", 2.0}, {"k_d", 0.1}}, at(80), at(0)),
              2 * unmasked * 2 * cos_l + 0.1 / pi_, 1e-13);
}

TEST(Formula, AshikhminShirley) {
  EXPECT_NEAR(f("ashikhmin_shirley", {{"n_u", 3.0}, {"n_v", 8.0}}, at(60), at(60, 180)), 6 / (8 * pi_) / 0.25, 1e-13);
  // H at 30° in the plane of y: the exponent is n_v; F of Schlick with L·H = √3/2
  const double cos_d = std::sqrt(3.0) / 2, fresnel = 0.05 + 0.95 * std::pow(1 - cos_d, 5);
  const double diffuse = 28 * 0.4 / (23 * pi_) * 0.95 * (1 - std::pow(0.75, 5)) * (1 - std::pow(0.5, 5));
  EXPECT_NEAR(f("ashikhmin_shirley", {{"n_u", 3.0}, {"n_v", 8.0}, {"r_s", 0.05}, {"r_d", 0.4}}, at(60, 90), at(0)),
              6 / (8 * pi_) * std::pow(cos_d, 8) * fresnel / cos_d + diffuse, 1e-14);
}

TEST(Formula, Kurt) {
  const double d = 1 / (pi_ * 0.04);
  EXPECT_NEAR(f("kurt", {{"m", 0.2}}, at(60), at(60, 180)), d / (4 * 0.5), 1e-12);
  EXPECT_NEAR(f("kurt", {{"m", 0.2}, {"equation", "9"}}, at(60), at(60, 180)), d / (4 * 0.25), 1e-12);
  EXPECT_NEAR(
      f("kurt", {{"m", 0.2}, {"equation", "11"}, {"exponent", 0.5}, {"k_s", 0.5}, {"k_d", 0.3}}, at(60), at(60, 180)),
      0.3 / pi_ + 0.5 * d / (4 * 0.5 * 0.5), 1e-12);
  const double fresnel = 0.1 + 0.9 / 32;
  EXPECT_NEAR(f("kurt", {{"m", 0.2}, {"equation", "13"}, {"f0", 0.1}, {"k_d", 0.3}}, at(60), at(60, 180)),
              0.3 * (1 - fresnel) / pi_ + fresnel * d / (4 * 0.5), 1e-12);
}

TEST(Formula, Ggx) {
  // s = √(cos² + α² sin²) = √(1/4 + 3/16) for α = 1/2, D = 1/(π α²)
  const double s = std::sqrt(0.25 + 0.25 * 0.75), d = 1 / (pi_ * 0.25);
  EXPECT_NEAR(f("ggx", {{"alpha", 0.5}}, at(60), at(60, 180)), d / (4 * 0.5 * s), 1e-13);
  EXPECT_NEAR(f("ggx", {{"alpha", 0.5}, {"masking", "separable"}}, at(60), at(60, 180)), d / ((0.5 + s) * (0.5 + s)),
              1e-13);
}

TEST(DirectionalAlbedo, WrongOptionsAreNamed) {
  const auto model = make_model("lambert");
  for (const double tolerance : {0.0, -1e-3, 1.0, 1e-31, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(contains(message_of<ParameterError>([&] { directional_albedo(*model, {}, {.tolerance = tolerance}); }),
                         "tolerance"));
  }
  EXPECT_TRUE(contains(message_of<ParameterError>([&] { directional_albedo(*model, {}, {.budget = 0}); }), "budget"));
}

TEST(DirectionalAlbedo, NothingReflectsNothing) {
  const Estimate e = directional_albedo(*make_model("lambert", {{"rho", 0.0}}), at(30));
  EXPECT_EQ(e.value, 0);
  EXPECT_EQ(e.status, Status::converged);
}

/// The float column: a formula as a shader would evaluate it is off by float's digits, not more, for gentle lobes.
TEST(DirectionalAlbedo, FloatIsCloseAndQuadIsCloser) {
  const auto model = make_model("ggx");
  const Estimate exact = directional_albedo(*model, at(60));
  const Estimate rough = directional_albedo(*model, at(60), {.precision = Precision::float32, .tolerance = 1e-4});
  EXPECT_NEAR(rough.value, exact.value, 1e-4);
  EXPECT_NE(rough.value, exact.value);
  for (const Rule rule : {Rule::gauss, Rule::cubature}) {
    const Estimate quad =
        directional_albedo(*model, at(60), {.rule = rule, .precision = Precision::quad, .tolerance = 1e-5});
    EXPECT_NEAR(quad.value, exact.value, quad.error + exact.error);
  }
}

}  // namespace
}  // namespace albedo
