#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "albedo/core/errors.hpp"
#include "albedo/directional_albedo.hpp"
#include "albedo/models/all.hpp"
#include "albedo/registry.hpp"
#include "measured_files.hpp"

/// make_model of a struct: the same model as that of its name, and the same refusals.
namespace albedo {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// What make_model says to a struct that it refuses.
template <class Error = ParameterError, class M>
std::string refusal(M model) {
  try {
    make_model(std::move(model));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Name, parameters, claims and every lobe's f, to the last bit.
void expect_same(const Model& typed, const Model& named) {
  EXPECT_EQ(&typed.info(), &named.info());
  EXPECT_EQ(typed.parameters(), named.parameters());
  EXPECT_EQ(typed.claims().isotropic, named.claims().isotropic);
  EXPECT_EQ(typed.claims().bounded, named.claims().bounded);
  ASSERT_EQ(typed.lobes().size(), named.lobes().size());
  for (const double phi : {0.0, 70.0}) {
    const Direction l = Direction::from_degrees(50, 20), v = Direction::from_degrees(48, 200 + phi);
    const double f = brdf<double>(named, l, v);
    EXPECT_GT(f, 0);
    EXPECT_EQ(brdf<double>(typed, l, v), f);
    EXPECT_EQ(brdf<float>(typed, l, v), brdf<float>(named, l, v));
  }
}

TEST(TypedModels, AreThoseOfTheirNames) {
  expect_same(*make_model(Ward{.alpha_x = 0.1, .alpha_y = 0.2, .rho_d = 0.3}),
              *make_model("ward", {{"alpha_x", 0.1}, {"alpha_y", 0.2}, {"rho_d", 0.3}}));
  expect_same(*make_model(WardDuer{.alpha_x = 0.2, .rho_s = 0.5}),
              *make_model("ward_duer", {{"alpha_x", 0.2}, {"rho_s", 0.5}}));
  expect_same(*make_model(WardBounded{.alpha_y = 0.2}), *make_model("ward_bounded", {{"alpha_y", 0.2}}));
  expect_same(*make_model(Ggx{.alpha_x = 0.2, .masking = SmithMasking::separable, .fresnel = {.f0 = 0.04}}),
              *make_model("ggx", {{"alpha_x", 0.2}, {"masking", "separable"}, {"f0", 0.04}}));
  expect_same(*make_model(Beckmann{.alpha_y = 0.2, .fresnel = {.kind = FresnelKind::conductor, .eta = 1.5}}),
              *make_model("beckmann", {{"alpha_y", 0.2}, {"fresnel", "conductor"}, {"eta", 1.5}}));
  expect_same(*make_model(HeTorrance{.sigma0 = 0.2, .k_d = 0.1, .fresnel = {.f0 = 0.9}}),
              *make_model("he_torrance", {{"sigma0", 0.2}, {"k_d", 0.1}, {"f0", 0.9}}));
}

TEST(TypedModels, OfEachWayToAskForOne) {
  expect_same(*make_model(Ward{}), *make_model("ward"));
  expect_same(*make_model<Ward>(), *make_model("ward"));
  expect_same(*make_model<Ward>({}), *make_model("ward"));
  expect_same(*make_model<Ward>({{"alpha", 0.2}}), *make_model(Ward{.alpha_x = 0.2, .alpha_y = 0.2}));
}

/// A table that a model makes of its parameters is made here, too.
TEST(TypedModels, LoadWhatTheyNeed) {
  expect_same(*make_model(MicrofacetGenerator{.alpha = 0.4, .distribution = MicrofacetGenerator::Distribution::power}),
              *make_model("microfacet_generator", {{"alpha", 0.4}, {"distribution", "power"}}));

  const test::TemporaryFile file("typed.binary", test::merl_bytes({4, 4, 8}, [](int, int, int, int) { return 0.25; }));
  expect_same(*make_model(Measured{.file = file.path(), .channel = Measured::Channel::g}),
              *make_model("measured", {{"file", file.path()}, {"channel", "G"}}));
}

TEST(TypedModels, AreRefusedWithNameValueAndRange) {
  EXPECT_EQ(refusal(Ward{.alpha_x = 0}), "ward: alpha_x is 0 and must be within [1e-06, 100]");
  EXPECT_EQ(refusal(Ward{.rho_d = 1.5}), "ward: rho_d is 1.5 and must be within [0, 1]");
  EXPECT_EQ(refusal(Ward{.rho_s = nan}), "ward: rho_s is nan and must be within [0, 1e+06]");
  EXPECT_EQ(refusal(Ggx{.fresnel = {.f0 = -0.1}}), "ggx: f0 is -0.1 and must be within [0, 1]");
  EXPECT_EQ(refusal(Beckmann{.masking = static_cast<SmithMasking>(2)}),
            "beckmann: masking is 2 and must be within [0, 1]");
  EXPECT_EQ(refusal(HeTorrance{.tau = nan}), "he_torrance: tau is nan and must be within [0.001, 1e+06]");
  EXPECT_EQ(refusal(Measured{}), "measured: file is not given and must be the path of a .bsdf or .binary file");
  EXPECT_EQ(refusal<FormatError>(Measured{.file = "/nowhere"}), "measured: file '/nowhere' does not exist");
}

}  // namespace
}  // namespace albedo
