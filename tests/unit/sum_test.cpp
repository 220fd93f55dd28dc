#include "albedo/combinators/sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "albedo/core/errors.hpp"
#include "albedo/directional_albedo.hpp"
#include "albedo/reference.hpp"

namespace albedo {
namespace {

struct Term {
  double weight;
  const char* model;
  Parameters parameters{};
};

SumModel sum_of(const std::vector<Term>& terms) {
  std::vector<SumModel::Part> parts;
  for (const Term& term : terms) parts.push_back({term.weight, make_model(term.model, term.parameters)});
  return SumModel(std::move(parts));
}

/// Every shape of lobe, mirror axes of their own, several components to a part, and a delta.
const std::vector<std::vector<Term>>& sums() {
  static const std::vector<std::vector<Term>> all{
      {{1, "lambert", {{"rho", 0.2}}}, {1, "ward", {{"alpha", 0.1}, {"rho_s", 0.3}}}},
      {{0.5, "ggx", {{"alpha", 0.05}}}, {0.25, "phong", {{"n", 50.0}}}, {0.25, "oren_nayar"}},
      {{0.3, "lafortune", {{"c_z", 1.1}, {"n", 20.0}}}, {0.3, "phong", {{"n", 1000.0}}}, {0.4, "blinn"}},
      {{0.7, "ashikhmin_shirley", {{"n_u", 10.0}, {"n_v", 300.0}, {"r_s", 0.05}, {"r_d", 1.0}}},
       {0.2, "kurt", {{"m", 0.2}, {"equation", "13"}, {"f0", 0.2}, {"k_d", 0.5}}},
       {0.0, "ward"}},
      {{2, "he_torrance", {{"sigma0", 0.02}, {"tau", 0.5}}}, {0.1, "lambert"}},
  };
  return all;
}

TEST(Sum, AlbedoIsTheSumOfItsPartsAlbedos) {
  for (const auto& terms : sums()) {
    const SumModel sum = sum_of(terms);
    for (const double theta : {0.0, 40.0, 75.0, 89.5}) {
      const Direction l = Direction::from_degrees(theta, 25);
      for (const Rule rule : {Rule::gauss, Rule::cubature}) {
        const AlbedoOptions options{.rule = rule, .tolerance = rule == Rule::gauss ? 1e-9 : 1e-5};
        double value = 0, error = 0;
        for (const Term& term : terms) {
          const Estimate part = directional_albedo(*make_model(term.model, term.parameters), l, options);
          value += term.weight * part.value;
          error += term.weight * part.error;
        }
        const Estimate whole = directional_albedo(sum, l, options);
        EXPECT_EQ(whole.status, Status::converged) << sum.info().title << " at " << theta;
        EXPECT_NEAR(whole.value, value, whole.error + error) << sum.info().title << " at " << theta;
      }
    }
  }
}

TEST(Sum, ValueIsTheSumOfItsPartsValuesInEveryNumberType) {
  const Direction l = Direction::from_degrees(50, 20), v = Direction::from_degrees(45, 195);
  for (const auto& terms : sums()) {
    const SumModel sum = sum_of(terms);
    Quad exact = 0;
    for (const Term& term : terms)
      exact += Quad(term.weight) * brdf<Quad>(*make_model(term.model, term.parameters), l, v);
    const double rounded = static_cast<double>(exact);
    EXPECT_LE(std::abs(static_cast<double>(Quad(brdf<Quad>(sum, l, v) - exact))), 1e-28 * rounded) << sum.info().title;
    EXPECT_NEAR(brdf<double>(sum, l, v), rounded, 1e-13 * rounded) << sum.info().title;
    EXPECT_NEAR(static_cast<double>(brdf<float>(sum, l, v)), rounded, 1e-4 * rounded) << sum.info().title;
  }
}

/// Kurt et al. 2010, eq. 14, written out: k_d/π + Σ k_sl F_l D_l/(4 L·H (N·L N·V)^α_l).
TEST(Sum, IsKurtsModelOfSeveralLobes) {
  struct SpecularLobe {
    double k_s, f0, m_x, m_y, exponent;
  };
  const std::vector<SpecularLobe> lobes{{0.3, 0.9, 0.035, 0.129, 0.005}, {0.2, 0.05, 0.4, 0.3, 0.2}};
  constexpr double k_d = 0.15;
  std::vector<Term> terms{{1, "lambert", {{"rho", k_d}}}};
  for (const SpecularLobe& lobe : lobes) {
    terms.push_back(
        {1,
         "kurt",
         {{"k_s", lobe.k_s}, {"f0", lobe.f0}, {"m_x", lobe.m_x}, {"m_y", lobe.m_y}, {"exponent", lobe.exponent}}});
  }
  const SumModel sum = sum_of(terms);
  constexpr double pi_ = std::numbers::pi;
  for (const double phi : {10.0, 100.0, 186.0, 250.0}) {
    const UnitVector<double> l = unit_vector<double>(Direction::from_degrees(40, 0)),
                             v = unit_vector<double>(Direction::from_degrees(47, phi));
    const double w[3] = {l.x + v.x, l.y + v.y, l.z + v.z};
    const double length = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]), cos_h = w[2] / length;
    double expected = k_d / pi_;
    for (const SpecularLobe& lobe : lobes) {
      const double slope2 = std::pow(w[0] / w[2] / lobe.m_x, 2) + std::pow(w[1] / w[2] / lobe.m_y, 2);
      const double d = std::exp(-slope2) / (pi_ * lobe.m_x * lobe.m_y * std::pow(cos_h, 4));
      const double fresnel = lobe.f0 + (1 - lobe.f0) * std::pow(1 - length / 2, 5);
      expected += lobe.k_s * fresnel * d / (4 * length / 2 * std::pow(l.z * v.z, lobe.exponent));
    }
    EXPECT_NEAR(brdf<double>(sum, Direction::from_degrees(40, 0), Direction::from_degrees(47, phi)), expected,
                1e-12 * expected);
  }
  EXPECT_FALSE(sum.claims().isotropic);
  EXPECT_FALSE(sum.claims().bounded);
}

TEST(Sum, ClaimsWhatItsPartsClaimTogether) {
  const std::vector<Term> halves{{0.5, "lambert"}, {0.5, "ggx"}};
  EXPECT_TRUE(sum_of(halves).claims().conserves_energy);
  EXPECT_TRUE(sum_of(halves).claims().reciprocal);
  EXPECT_FALSE(sum_of({{0.6, "lambert"}, {0.5, "ggx"}}).claims().conserves_energy);
  EXPECT_FALSE(sum_of({{0.5, "lambert"}, {0.5, "ward"}}).claims().conserves_energy);
  EXPECT_FALSE(sum_of({{0.5, "lambert"}, {0.5, "ward"}}).claims().bounded);
  EXPECT_FALSE(sum_of({{0.5, "lambert"}, {0.5, "edwards"}}).claims().reciprocal);
  EXPECT_TRUE(sum_of({{1.0, "lambert"}, {0.0, "ward"}}).claims().bounded) << "a weight of 0 switches a part off";
}

TEST(Sum, NamesItsPartsParameters) {
  const SumModel sum = sum_of({{0.25, "lambert", {{"rho", 0.2}}}, {1, "cook_torrance", {{"masking", "none"}}}});
  EXPECT_EQ(sum.info().name, "sum");
  EXPECT_EQ(sum.info().title, "Sum of lambert + cook_torrance");
  const Parameters values = sum.parameters();
  ASSERT_EQ(values.size(), sum.info().parameters.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i].first, sum.info().parameters[i].name);
  const auto value_of = [&](const std::string& name) {
    for (const auto& [parameter, value] : values) {
      if (parameter == name) return value;
    }
    return ParameterValue("none such");
  };
  EXPECT_EQ(value_of("1.model"), ParameterValue("lambert"));
  EXPECT_EQ(value_of("1.weight"), ParameterValue(0.25));
  EXPECT_EQ(value_of("1.rho"), ParameterValue(0.2));
  EXPECT_EQ(value_of("2.masking"), ParameterValue("none"));
}

TEST(Sum, AddsCoherentParts) {
  const Direction l = Direction::from_degrees(30);
  const auto part = make_model("he_torrance", {{"sigma0", 0.02}});
  EXPECT_GT(part->coherent_albedo(l), 0.5);
  const SumModel sum = sum_of({{0.25, "he_torrance", {{"sigma0", 0.02}}}, {0.5, "lambert"}});
  EXPECT_EQ(sum.coherent_albedo(l), 0.25 * part->coherent_albedo(l));
}

TEST(Sum, CoherentPartIsInTheReferenceToo) {
  const Direction l = Direction::from_cosine(0.5);
  const SumModel sum = sum_of({{0.5, "he_torrance", {{"part", "specular"}}}, {0.25, "lambert"}});
  const EstimateIn<Quad> reference = reference_albedo(sum, l);
  EXPECT_EQ(reference.status, Status::converged);
  EXPECT_GT(sum.coherent_albedo(l), 0.01);
  EXPECT_LE(abs(Quad(reference.value - sum.quad().coherent_albedo(l) - 0.25)), reference.error + Quad(1e-30));
}

TEST(Sum, LobesKeepTheirSamplers) {
  const SumModel sampled = sum_of({{0.5, "lambert"}, {0.3, "ward", {{"alpha", 0.1}, {"rho_d", 0.2}}}});
  const AlbedoOptions options{.rule = Rule::sobol, .warp = Warp::paper, .tolerance = 1e-3};
  for (const double theta : {0.0, 50.0}) {
    const Direction l = Direction::from_degrees(theta);
    const Estimate e = directional_albedo(sampled, l, options);
    EXPECT_EQ(e.status, Status::converged);
    EXPECT_NEAR(e.value, directional_albedo(sampled, l).value, 4 * e.error) << theta;
  }
  const SumModel partly = sum_of({{0.5, "lambert"}, {0.5, "he_torrance"}});
  EXPECT_TRUE(partly.has_sampler(0));
  EXPECT_FALSE(partly.has_sampler(1));
  EXPECT_THROW(directional_albedo(partly, Direction::from_degrees(10), options), ParameterError);
}

TEST(Sum, RefusesWhatIsNoSum) {
  EXPECT_THROW(SumModel({}), ParameterError);
  for (const double weight : {-0.1, 2e6, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(sum_of({{weight, "lambert"}}), ParameterError) << weight;
  }
  std::vector<SumModel::Part> parts(1);
  EXPECT_THROW(SumModel(std::move(parts)), ParameterError);
}

}  // namespace
}  // namespace albedo
