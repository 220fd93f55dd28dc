#include "albedo/curve.hpp"
#include "albedo/combinators/scaled.hpp"

#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "albedo/core/errors.hpp"

namespace albedo {
namespace {

using boost::math::double_constants::pi;

/// A diffuse reflector whose albedo is any function of cosθ_L.
class Synthetic final : public ScaledModel {
 public:
  explicit Synthetic(std::function<double(double)> albedo)
      : ScaledModel(make_model("lambert", {{"rho", 1.0}}),
                    {.name = "synthetic", .title = "", .source = "", .deviation = ""}),
        albedo_(std::move(albedo)) {}

  [[nodiscard]] Claims claims() const override { return {}; }

 private:
  [[nodiscard]] double factor_of(double cos_l, double /*cos_v*/) const noexcept override { return albedo_(cos_l); }
  [[nodiscard]] Parameters own_parameters() const override { return {}; }

  std::function<double(double)> albedo_;
};

/// Half of them uniform in θ, half in the logarithm of cosθ down to 1e-12.
std::vector<double> random_cosines(int count) {
  std::mt19937_64 generator(20240229);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> cosines;
  for (int i = 0; i < count; ++i) {
    const double u = uniform(generator);
    cosines.push_back(i % 2 == 0 ? std::cos(u * pi / 2) : std::pow(10, -12 * u));
  }
  return cosines;
}

CurveOptions with_tolerance(double tolerance) { return {.albedo = {.tolerance = tolerance}}; }

/// The largest relative error.
double worst_error(const AlbedoCurve& curve, const std::function<double(double)>& truth) {
  double worst = 0;
  for (const double c : random_cosines(500)) worst = std::max(worst, std::abs(curve(c) / truth(c) - 1));
  return worst;
}

/// a(θ) of Phong's (n+2)/2π (R·V)^n for real n > 0: Mallett & Yuksel 2020, in c = cosθ and s = sinθ.
double phong_albedo(double n, double c) {
  const double s2 = (1 - c) * (1 + c);
  const double tail = boost::math::tgamma_delta_ratio((n + 1) / 2, 0.5) / (2 * std::sqrt(pi));
  return c * (1 + boost::math::ibetac(n / 2 + 1, 0.5, s2)) / 2 + std::pow(s2, n / 2 + 1) * tail;
}

double ggx_albedo_at_one(double c) { return 1 - c * (std::log1p(c) - std::log(c)); }

struct ClosedForm {
  std::string name;
  Parameters parameters;
  std::function<double(double)> albedo;
};

const std::vector<ClosedForm>& closed_forms() {
  static const std::vector<ClosedForm> forms{
      {"lambert", {{"rho", 0.7}}, [](double) { return 0.7; }},
      {"phong", {{"n", 2.0}}, [](double c) { return phong_albedo(2, c); }},
      {"phong", {{"n", 20.0}}, [](double c) { return phong_albedo(20, c); }},
      {"phong", {{"n", 1e5}}, [](double c) { return phong_albedo(1e5, c); }},
      {"ggx", {{"alpha", 1.0}}, ggx_albedo_at_one},
      {"ggx",
       {{"alpha", 1.0}, {"masking", "separable"}},
       [](double c) { return 2 * (1 - boost::math::double_constants::ln_two) / (1 + c); }},
  };
  return forms;
}

TEST(Curve, StaysWithinItsBoundOfClosedFormsAtEveryTolerance) {
  for (const ClosedForm& form : closed_forms()) {
    for (double tolerance = 1e-3; tolerance > 0.9e-9; tolerance /= 10) {
      SCOPED_TRACE(form.name + " at " + std::to_string(std::log10(tolerance)));
      const AlbedoCurve curve(*make_model(form.name, form.parameters), with_tolerance(tolerance));
      EXPECT_EQ(curve.status(), Status::converged);
      EXPECT_EQ(curve.form(), CurveForm::rational);
      EXPECT_LE(curve.relative_bound(), tolerance);
      EXPECT_LE(worst_error(curve, form.albedo), curve.relative_bound());
    }
  }
}

struct Setting {
  std::string name;
  Parameters parameters;
  double phi = 0;
};

const std::vector<Setting>& settings() {
  static const std::vector<Setting> list{
      {"phong", {{"n", 1e6}}},
      {"phong_original", {{"n", 20.0}}},
      {"blinn", {{"n", 20.0}}},
      {"lafortune", {{"c_x", -1.0}, {"c_y", -0.8}, {"c_z", 0.5}, {"n", 5.0}}, 20},
      {"neumann_phong", {{"n", 20.0}}},
      {"ward", {{"alpha", 0.1}}},
      {"ward", {{"alpha", 1e-4}}},
      {"ward", {{"alpha_x", 0.3}, {"alpha_y", 0.05}}, 30},
      {"cook_torrance", {{"m", 0.1}}},
      {"cook_torrance", {{"m", 1e-4}}},
      {"cook_torrance", {{"m", 0.3}, {"masking", "none"}}},
      {"cook_torrance", {{"m", 0.2}, {"f0", 0.05}}},
      {"ashikhmin_shirley", {{"n", 10.0}}},
      {"ashikhmin_shirley", {{"n", 1e5}}},
      {"kurt", {{"m", 0.2}, {"exponent", 0.3}}},
      {"kurt", {{"m", 0.2}, {"equation", "9"}}},
      {"ggx", {{"alpha", 0.1}}},
      {"ggx", {{"alpha", 0.01}, {"masking", "separable"}}},
  };
  return list;
}

TEST(Curve, StaysWithinItsBoundOfTheIntegral) {
  for (const Setting& setting : settings()) {
    SCOPED_TRACE(setting.name);
    const std::unique_ptr<Model> model = make_model(setting.name, setting.parameters);
    CurveOptions options = with_tolerance(1e-7);
    options.phi_degrees = setting.phi;
    const AlbedoCurve curve(*model, options);
    EXPECT_EQ(curve.status(), Status::converged);
    EXPECT_LE(curve.relative_bound(), 1e-7);
    for (const double c : random_cosines(500)) {
      const Estimate truth = directional_albedo(*model, Direction::from_cosine(c, setting.phi), {.tolerance = 1e-10});
      ASSERT_LE(std::abs(curve(c) - truth.value), curve.relative_bound() * truth.value + truth.error)
          << "cos_theta " << c;
      ASSERT_GE(curve.upper(c), truth.value - truth.error) << "cos_theta " << c;
    }
  }
}

TEST(Curve, NeedsFewNodesAndFewIntegrations) {
  for (const Setting& setting : settings()) {
    SCOPED_TRACE(setting.name);
    CurveOptions options = with_tolerance(1e-6);
    options.phi_degrees = setting.phi;
    const AlbedoCurve curve(*make_model(setting.name, setting.parameters), options);
    EXPECT_GE(curve.nodes().size(), 5U);
    EXPECT_LE(curve.nodes().size(), 24U);
    EXPECT_GE(curve.integrations(), 25);
    EXPECT_LE(curve.integrations(), 110);
    EXPECT_GT(curve.evaluations(), 20 * curve.integrations());
  }
}

TEST(Curve, PassesThroughItsNodesFromNormalIncidenceToGrazing) {
  const AlbedoCurve curve(*make_model("ward"));
  EXPECT_EQ(curve.nodes().front().cos_theta, 1);
  EXPECT_NEAR(curve.nodes().back().cos_theta, 1e-10, 1e-20);
  for (std::size_t i = 0; i < curve.nodes().size(); ++i) {
    const AlbedoCurve::Node& node = curve.nodes()[i];
    EXPECT_NEAR(curve(node.cos_theta), node.albedo.value, 1e-12 * node.albedo.value);
    if (i > 0) {
      EXPECT_LT(node.cos_theta, curve.nodes()[i - 1].cos_theta);
    }
  }
}

TEST(Curve, GoesToTheLimitAtGrazing) {
  for (const Setting& setting : settings()) {
    SCOPED_TRACE(setting.name);
    const std::unique_ptr<Model> model = make_model(setting.name, setting.parameters);
    CurveOptions options = with_tolerance(1e-6);
    options.phi_degrees = setting.phi;
    const AlbedoCurve curve(*model, options);
    const Estimate limit = directional_albedo(*model, Direction::from_degrees(90, setting.phi), {.tolerance = 1e-9});
    if (limit.status == Status::divergent) {
      EXPECT_EQ(curve(0), std::numeric_limits<double>::infinity());
      EXPECT_LT(curve.grazing_exponent(), -0.1);
    } else {
      EXPECT_NEAR(curve(0), limit.value, 1e-6 * limit.value);
      EXPECT_NEAR(curve(1e-300), limit.value, 1e-6 * limit.value);
      EXPECT_EQ(curve.grazing_exponent(), 0);
    }
    EXPECT_NEAR(curve(0.99999e-10) / curve(1.00001e-10), 1, 5e-5) << "a step where the power law takes over";
  }
}

TEST(Curve, MeasuresTheGrazingExponent) {
  EXPECT_NEAR(AlbedoCurve(*make_model("ward")).grazing_exponent(), -0.5, 1e-8);
  EXPECT_NEAR(AlbedoCurve(*make_model("phong_original")).grazing_exponent(), -1, 1e-8);
  EXPECT_NEAR(AlbedoCurve(*make_model("kurt", {{"exponent", 0.3}})).grazing_exponent(), -0.3, 1e-8);
}

TEST(Curve, FollowsAnAlbedoThatVanishesAtGrazing) {
  const auto truth = [](double c) { return std::pow(c, 0.37) / (1 + c); };
  const AlbedoCurve curve(Synthetic{truth}, with_tolerance(1e-8));
  EXPECT_EQ(curve.status(), Status::converged);
  EXPECT_NEAR(curve.grazing_exponent(), 0.37, 1e-8);
  EXPECT_EQ(curve(0), 0);
  EXPECT_NEAR(curve(1e-200) / truth(1e-200), 1, 1e-6);
  EXPECT_LE(worst_error(curve, truth), curve.relative_bound());
}

TEST(Curve, FindsAKink) {
  const auto truth = [](double c) { return 0.2 + std::abs(c - 0.3); };
  const AlbedoCurve curve(Synthetic{truth}, with_tolerance(1e-5));
  EXPECT_EQ(curve.status(), Status::converged);
  EXPECT_LE(worst_error(curve, truth), curve.relative_bound());
}

TEST(Curve, FallsBackOnTheMonotoneFormAtAStepAndSaysWhatItMisses) {
  const auto truth = [](double c) { return c > 0.3 ? 0.5 : 0.25; };
  const AlbedoCurve curve(Synthetic{truth}, with_tolerance(1e-6));
  EXPECT_EQ(curve.form(), CurveForm::monotone);
  EXPECT_EQ(curve.status(), Status::budget_exhausted);
  EXPECT_GT(curve.relative_bound(), 0.1);
  for (const double c : random_cosines(500)) {
    EXPECT_GE(curve(c), 0.25 - 1e-12);
    EXPECT_LE(curve(c), 0.5 + 1e-12);
  }
}

TEST(Curve, HoldsZeros) {
  const AlbedoCurve black(*make_model("lambert", {{"rho", 0.0}}));
  EXPECT_EQ(black.status(), Status::converged);
  EXPECT_LE(black.relative_bound(), 1e-14);
  for (const double c : {1.0, 0.5, 1e-6, 1e-20, 0.0}) EXPECT_EQ(black(c), 0);

  const auto truth = [](double c) { return (1 - c) * (1 - c); };  // 0 at normal incidence only
  const AlbedoCurve curve(Synthetic{truth}, with_tolerance(1e-7));
  EXPECT_EQ(curve(1), 0);
  EXPECT_NEAR(curve(0), 1, 1e-7);
  for (const double c : random_cosines(500)) {
    EXPECT_LE(std::abs(curve(c) - truth(c)), curve.relative_bound() * std::max(truth(c), AlbedoCurve::relative_floor));
    EXPECT_GE(curve.upper(c), truth(c));
  }
}

TEST(Curve, TellsThatAModelIsNotANumberSomewhere) {
  const AlbedoCurve curve(
      Synthetic{[](double c) { return c < 0.01 ? std::numeric_limits<double>::quiet_NaN() : 0.5; }});
  EXPECT_EQ(curve.status(), Status::non_finite);
  EXPECT_EQ(curve.relative_bound(), std::numeric_limits<double>::infinity());
}

TEST(Curve, DoesNotClaimWhatItsNodesDoNotHave) {
  CurveOptions options = with_tolerance(1e-9);
  options.albedo.budget = 200;
  const AlbedoCurve curve(*make_model("ward"), options);
  EXPECT_NE(curve.status(), Status::converged);
  EXPECT_GT(curve.relative_bound(), 1e-9);
}

TEST(Curve, RefusesWrongOptions) {
  const std::unique_ptr<Model> model = make_model("lambert");
  EXPECT_THROW(AlbedoCurve(*model, with_tolerance(0)), ParameterError);
  EXPECT_THROW(AlbedoCurve(*model, {.phi_degrees = std::numeric_limits<double>::quiet_NaN()}), ParameterError);
  EXPECT_THROW(AlbedoCurve(*model, {.most_nodes = 3}), ParameterError);
}

}  // namespace
}  // namespace albedo
