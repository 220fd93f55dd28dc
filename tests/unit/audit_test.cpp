#include "albedo/audit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "albedo/core/erased_model.hpp"
#include "albedo/core/errors.hpp"
#include "albedo/microfacet/distribution.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {
namespace {

Audit audit_of(const char* name, const Parameters& parameters = {}) { return audit(*make_model(name, parameters)); }

TEST(Audit, WardIsReciprocalAndUnbounded) {
  const auto model = make_model("ward", {{"alpha", 0.2}});
  const Audit found = audit(*model);
  EXPECT_EQ(found.energy.verdict, Verdict::not_claimed);
  EXPECT_EQ(found.energy.bounded, Verdict::not_claimed);
  EXPECT_TRUE(std::isinf(found.energy.largest.value));
  EXPECT_EQ(found.energy.theta_degrees, 90);
  EXPECT_EQ(found.reciprocity.verdict, Verdict::pass);
  EXPECT_EQ(found.distribution.verdict, Verdict::pass);
  EXPECT_EQ(found.masking.verdict, Verdict::not_applicable);
  EXPECT_EQ(found.sampler_verdict(), Verdict::pass);
  EXPECT_EQ(found.verdict(), Verdict::pass);
  ASSERT_TRUE(found.energy.critical);
  const double critical = found.energy.critical->cos_theta;
  EXPECT_NEAR(directional_albedo(*model, Direction::from_cosine(critical)).value, 1, 1e-7);
  EXPECT_LT(directional_albedo(*model, Direction::from_cosine(critical * 1.001)).value, 1);
}

TEST(Audit, LargestAlbedoIsThatOfAFineScan) {
  for (const auto& [name, parameters] : {std::pair<const char*, Parameters>{"oren_nayar", {{"sigma", 0.2}}},
                                         {"he_torrance", {}},
                                         {"kurt", {{"m", 2.0}, {"equation", "9"}}}}) {
    const auto model = make_model(name, parameters);
    const EnergyAudit energy = audit(*model, {.grazing = false, .reciprocity = false, .samplers = false}).energy;
    double largest = 0;
    for (int i = 0; i <= 180; ++i) {
      largest = std::max(largest, directional_albedo(*model, Direction::from_degrees(i * 0.5)).value);
    }
    EXPECT_GE(energy.largest.value, largest - 1e-8) << name;
    EXPECT_LE(energy.largest.value, largest + 1e-3) << name;
    EXPECT_GT(energy.largest.value, 1) << name;
  }
}

TEST(Audit, AnisotropicModelsAreTurned) {
  const auto model = make_model("kurt", {{"m_x", 0.3}, {"m_y", 2.5}, {"equation", "9"}});
  const EnergyAudit energy = audit(*model, {.grazing = false, .reciprocity = false, .samplers = false}).energy;
  double largest = 0, largest_in_plane = 0;
  for (double theta = 0; theta <= 90; theta += 5) {
    for (double phi = 0; phi <= 180; phi += 7.5) {
      const double a = directional_albedo(*model, Direction::from_degrees(theta, phi)).value;
      largest = std::max(largest, a);
      if (phi == 0) largest_in_plane = std::max(largest_in_plane, a);
    }
  }
  EXPECT_GT(largest, largest_in_plane + 0.005);
  EXPECT_GE(energy.largest.value, largest - 1e-8);
  EXPECT_LE(energy.largest.value, largest + 1e-2);
  EXPECT_NEAR(directional_albedo(*model, Direction::from_degrees(energy.theta_degrees, energy.phi_degrees)).value,
              energy.largest.value, 1e-9);
}

TEST(Audit, FacetsOfClosedForm) {
  const Audit ggx = audit_of("ggx", {{"alpha", 1.0}});  // D = 1/π
  EXPECT_NEAR(ggx.distribution.projected.value, 1, 1e-9);
  EXPECT_NEAR(ggx.distribution.solid_angle.value, 2, 1e-9);
  EXPECT_EQ(ggx.distribution.verdict, Verdict::pass);
  EXPECT_EQ(ggx.masking.verdict, Verdict::pass);

  const double n = 2 / (0.3 * 0.3);
  const Audit power = audit_of("microfacet_generator", {{"alpha", 0.3}, {"distribution", "power"}});
  EXPECT_NEAR(power.distribution.solid_angle.value, (n + 2) / (n + 1), 1e-9);
  EXPECT_EQ(power.masking.verdict, Verdict::pass);

  const Audit paper = audit_of("ashikhmin_shirley", {{"n_u", 3.0}, {"n_v", 80.0}});
  EXPECT_NEAR(paper.distribution.solid_angle.value, 1, 1e-9);
  EXPECT_LT(paper.distribution.projected.value, 0.99);
  EXPECT_EQ(paper.distribution.verdict, Verdict::pass);

  const Audit anisotropic = audit_of("beckmann", {{"alpha_x", 0.7}, {"alpha_y", 0.05}});
  EXPECT_EQ(anisotropic.distribution.verdict, Verdict::pass);
  EXPECT_EQ(anisotropic.masking.verdict, Verdict::pass);

  const Audit cavities = audit_of("cook_torrance", {{"m", 0.6}});
  EXPECT_EQ(cavities.masking.verdict, Verdict::pass);
  const Audit unmasked = audit_of("cook_torrance", {{"m", 0.6}, {"masking", "none"}});
  EXPECT_EQ(unmasked.masking.verdict, Verdict::not_claimed);
  EXPECT_GT(std::abs(unmasked.masking.furthest.value - 1), 0.1);
  EXPECT_EQ(audit_of("schlick").masking.verdict, Verdict::not_claimed);
}

TEST(Audit, AverageOfClosedForm) {
  EXPECT_NEAR(audit_of("lambert", {{"rho", 0.18}}).average.albedo.value, 0.18, 1e-12);
  const AverageAudit matte = audit_of("shirley_matte", {{"r0", 0.1}, {"r_m", 0.5}}).average;
  EXPECT_NEAR(matte.albedo.value, 0.5 * 0.9 * 20 / 21, 1e-8);
  EXPECT_LE(std::abs(matte.albedo.value - 0.5 * 0.9 * 20 / 21), matte.albedo.error);
}

TEST(Grazing, LawsOfClosedForm) {
  // a(90°) = 1/(n + 2^(−n/2)) for Blinn; the original divides by N·L and has n + 1 for its n + 2
  const double n = 20;
  const Grazing blinn = grazing_behaviour(*make_model("blinn", {{"n", n}}));
  EXPECT_EQ(blinn.limit.exponent, 0);
  EXPECT_NEAR(blinn.limit.constant, 1 / (n + std::exp2(-n / 2)), 1e-9);
  EXPECT_TRUE(blinn.agree());
  const Grazing phong = grazing_behaviour(*make_model("phong", {{"n", n}}));
  const Grazing original = grazing_behaviour(*make_model("phong_original", {{"n", n}}));
  EXPECT_NEAR(original.limit.exponent, 1, 1e-9);
  EXPECT_NEAR(original.limit.constant, phong.limit.constant * (n + 1) / (n + 2), 1e-8);
  EXPECT_TRUE(original.agree());
  // r_m (1 − R) falls like 5 (1 − r₀) N·L
  const Grazing matte = grazing_behaviour(*make_model("shirley_matte", {{"r0", 0.1}, {"r_m", 0.5}}));
  EXPECT_NEAR(matte.limit.exponent, -1, 1e-9);
  EXPECT_NEAR(matte.limit.constant, 5 * 0.9 * 0.5, 1e-7);
  EXPECT_TRUE(matte.agree());
}

TEST(Grazing, CookTorranceDivergesWithoutItsGeometryFactorOnly) {
  const Grazing masked = grazing_behaviour(*make_model("cook_torrance"));
  EXPECT_EQ(masked.limit.exponent, 0);
  EXPECT_NEAR(masked.limit.constant, 1, 1e-8);
  EXPECT_TRUE(masked.agree());
  const Grazing unmasked = grazing_behaviour(*make_model("cook_torrance", {{"masking", "none"}}));
  EXPECT_NEAR(unmasked.limit.exponent, 1, 1e-9);
  EXPECT_TRUE(unmasked.agree());
  const Grazing ward = grazing_behaviour(*make_model("ward"));
  EXPECT_NEAR(ward.limit.exponent, 0.5, 1e-9);
  EXPECT_TRUE(ward.agree());
}

TEST(Grazing, NoLawWhereThereIsNone) {  // He–Torrance falls slower than any power
  const Grazing he = grazing_behaviour(*make_model("he_torrance"), {.tolerance = 1e-6});
  EXPECT_NE(he.limit.status, Status::converged);
  EXPECT_FALSE(he.agree());
}

TEST(CriticalAngle, WhereTheAlbedoPassesOne) {
  EXPECT_FALSE(critical_angle(*make_model("ggx")).exists);
  EXPECT_EQ(critical_angle(*make_model("lambert", {{"rho", 1.0}})).exists, false);
  // a faint lobe of Ward's passes 1 next to 90 degrees: a ~ C ρ_s (N·L)^(−1/2)
  const auto faint = make_model("ward", {{"rho_s", 1e-6}});
  const Crossing crossing = critical_angle(*faint);
  ASSERT_TRUE(crossing.exists);
  const double constant = grazing_behaviour(*faint).limit.constant;
  EXPECT_NEAR(crossing.cos_theta / (constant * constant), 1, 1e-5);
}

TEST(Audit, RefusesNonsense) {
  const auto model = make_model("lambert");
  EXPECT_THROW(audit(*model, {.significance = 0}), ParameterError);
  EXPECT_THROW(audit(*model, {.significance = std::nan("")}), ParameterError);
  EXPECT_THROW(audit(*model, {.albedo = {.tolerance = 2}}), ParameterError);
  EXPECT_THROW(grazing_behaviour(*model, {.phi_degrees = HUGE_VAL}), ParameterError);
}

/// Beckmann's facets without masking, with a fault of each kind: what it claims, it breaks.
enum class Fault { none, energy, reciprocity, distribution, masking, density, quadrant, lying_density, no_number };

template <Fault fault>
struct Faulty {
  double alpha_x = 0.4, alpha_y = 0.2;

  static ModelInfo info() { return {.name = "faulty", .title = "Faulty", .source = "none", .deviation = "none"}; }
  static std::vector<Parameter<Faulty>> parameters() {
    return {number<Faulty, &Faulty::alpha_x>("alpha_x", roughness_range, "roughness along x")};
  }
  [[nodiscard]] Claims claims() const {
    return {.isotropic = false,
            .distribution = Measure::projected,
            .consistent_masking = fault == Fault::masking || fault == Fault::no_number};
  }
  [[nodiscard]] std::vector<Lobe> lobes() const { return {slope_lobe(0, Profile::gaussian, alpha_x, alpha_y)}; }

  /// [Kelemen & Szirmay-Kalos 2001], which conserves energy
  template <class T>
  T evaluate(int, const DirectionPair<T>& d) const noexcept {
    const T f = beckmann(d, alpha_x, alpha_y) / (4 * square(d.cos_theta_d));
    if constexpr (fault == Fault::energy) return T(f * T(1.01));
    if constexpr (fault == Fault::no_number) return select(d.slope_x > T(0.5), T(f / T(0.0) * T(0.0)), f);
    if constexpr (fault == Fault::reciprocity) return T(f * (T(0.5) + d.cos_theta_l / 2));
    return f;
  }
  template <class T>
  T facet_distribution(const DirectionPair<T>& d) const noexcept {
    return beckmann(d, alpha_x, alpha_y) * T(fault == Fault::distribution ? 0.999 : 1.0);
  }
  template <class T>
  T facet_masking(const DirectionPair<T>& d) const noexcept {
    return fault == Fault::no_number ? T(d.cos_theta_l / T(0.0) * T(0.0)) : d.cos_theta_l;
  }
  template <class T>
  Sampled<T> sample(int, const UnitVector<T>& l, const T& u, const T& v) const noexcept {
    Sampled<T> drawn = sample_beckmann(l, alpha_x, alpha_y, u, fault == Fault::quadrant ? T(v * T(0.75)) : v);
    if constexpr (fault == Fault::no_number) drawn.pair.v_x = drawn.pair.v_x / T(0.0) * T(0.0);
    if constexpr (fault == Fault::lying_density) drawn.density = drawn.density * T(1.05);
    return drawn;
  }
  template <class T>
  T density(int, const UnitVector<T>& l, const UnitVector<T>& v) const noexcept {
    return beckmann_density(half_vector_pair(l, v), alpha_x, alpha_y) * T(fault == Fault::density ? 1.02 : 1.0);
  }
};

template <Fault fault>
Audit audit_of_fault() {
  static const ModelInfo info = Faulty<fault>::info();
  const ErasedModel<Faulty<fault>> model(Faulty<fault>{}, info);
  return audit(model, {.grazing = false, .average = false});
}

TEST(Audit, FaultsAreFound) {
  const Audit sound = audit_of_fault<Fault::none>();
  EXPECT_EQ(sound.verdict(), Verdict::pass);
  EXPECT_EQ(sound.energy.verdict, Verdict::pass);
  EXPECT_EQ(sound.sampler_verdict(), Verdict::pass);
  EXPECT_EQ(sound.masking.verdict, Verdict::not_claimed);

  EXPECT_EQ(audit_of_fault<Fault::energy>().energy.verdict, Verdict::fails);
  EXPECT_EQ(audit_of_fault<Fault::reciprocity>().reciprocity.verdict, Verdict::fails);
  EXPECT_EQ(audit_of_fault<Fault::distribution>().distribution.verdict, Verdict::fails);
  EXPECT_EQ(audit_of_fault<Fault::masking>().masking.verdict, Verdict::fails);
  EXPECT_EQ(audit_of_fault<Fault::density>().sampler_verdict(), Verdict::fails);
  EXPECT_EQ(audit_of_fault<Fault::lying_density>().sampler_verdict(), Verdict::fails);
  EXPECT_EQ(audit_of_fault<Fault::quadrant>().verdict(), Verdict::fails);
  const Audit no_number = audit_of_fault<Fault::no_number>();
  EXPECT_NE(no_number.energy.verdict, Verdict::pass);
  EXPECT_EQ(no_number.reciprocity.verdict, Verdict::fails);
  EXPECT_EQ(no_number.masking.verdict, Verdict::fails);
  EXPECT_EQ(no_number.sampler_verdict(), Verdict::fails);
  for (const SamplerAudit& sampler : audit_of_fault<Fault::quadrant>().samplers) EXPECT_LT(sampler.p_value, 1e-6);
}

}  // namespace
}  // namespace albedo
