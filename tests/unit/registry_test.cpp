#include "albedo/registry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "albedo/core/errors.hpp"
#include "albedo/directional_albedo.hpp"

namespace {  // not albedo's: as a user's code is

/// f = ρ (k+1)/(2π) (N·L N·V)^(k−1), whose albedo is ρ (N·L)^(k−1).
struct Darkening {
  enum class Side { both, neither };

  double k = 2, rho = 0.5;
  Side side = Side::both;

  static albedo::ModelInfo info() {
    return {.name = "darkening",
            .title = "Limb darkening",
            .source = "a test",
            .deviation = "none",
            .shorthands = {{"all", {"k"}}}};
  }
  static std::vector<albedo::Parameter<Darkening>> parameters() {
    using M = Darkening;
    return {albedo::number<M, &M::k>("k", {0.1, 10}, "exponent"), albedo::reflectance<M, &M::rho>("rho", "scale"),
            albedo::choice<M, &M::side>("side", {"both", "neither"}, "whether it reflects at all")};
  }
  [[nodiscard]] albedo::Claims claims() const { return {.conserves_energy = k >= 1, .bounded = k >= 1}; }
  [[nodiscard]] std::vector<albedo::Lobe> lobes() const {
    return {{.weight = side == Side::both ? rho : 0, .horizon_exponent = k}};
  }
  template <class T>
  T evaluate(int, const albedo::DirectionPair<T>& d) const noexcept {
    using albedo::pow;
    return T(rho * (k + 1) / 2) / albedo::pi<T> * pow(T(d.cos_theta_l * d.cos_theta_v), albedo::Scalar<T>(k - 1));
  }
};

/// Lambert's with parts that a test replaces.
struct Plain {
  double rho = 1;

  static albedo::ModelInfo info() { return {.name = "plain", .title = "", .source = "", .deviation = ""}; }
  static std::vector<albedo::Parameter<Plain>> parameters() { return {}; }
  [[nodiscard]] albedo::Claims claims() const { return {}; }
  [[nodiscard]] std::vector<albedo::Lobe> lobes() const { return {{}}; }
  template <class T>
  T evaluate(int, const albedo::DirectionPair<T>&) const noexcept {
    return T(rho) / albedo::pi<T>;
  }
};

struct WithoutClaims : Plain {
  void claims() const;
};
struct WithoutLobes : Plain {
  void lobes() const;
};
struct WithoutInfo : Plain {
  static void info();
};
struct WithAnothersParameters : Plain {};
struct OnlyInDouble {
  static albedo::ModelInfo info();
  static std::vector<albedo::Parameter<OnlyInDouble>> parameters();
  [[nodiscard]] albedo::Claims claims() const;
  [[nodiscard]] std::vector<albedo::Lobe> lobes() const;
  double evaluate(int, const albedo::DirectionPair<double>&) const noexcept;
};

static_assert(albedo::ModelStruct<Darkening> && albedo::ModelStruct<Plain>);
static_assert(!albedo::ModelStruct<WithoutClaims> && !albedo::ModelStruct<WithoutLobes>);
static_assert(!albedo::ModelStruct<WithoutInfo> && !albedo::ModelStruct<WithAnothersParameters>);
static_assert(!albedo::ModelStruct<OnlyInDouble> && !albedo::ModelStruct<int>);

albedo::ModelInfo named(const std::string& name) { return {.name = name, .title = "", .source = "", .deviation = ""}; }

/// What a test makes wrong in a model's information.
albedo::ModelInfo next_info;
std::vector<albedo::ParameterInfo> next_parameters;

/// A model with that information; every number is another type.
template <int Number>
struct Next : Plain {
  static albedo::ModelInfo info() { return next_info; }
  static std::vector<albedo::Parameter<Next>> parameters() {
    std::vector<albedo::Parameter<Next>> parameters;
    for (const albedo::ParameterInfo& info : next_parameters) {
      parameters.push_back(albedo::number<Next, &Next::rho>(info.name, info.range, ""));
    }
    return parameters;
  }
};

template <int Number>
std::string refusal(const albedo::ModelInfo& info, const std::vector<albedo::ParameterInfo>& parameters = {}) {
  next_info = info, next_parameters = parameters;
  const std::size_t before = albedo::model_infos().size();
  try {
    albedo::register_model<Next<Number>>();
  } catch (const albedo::ParameterError& error) {
    EXPECT_EQ(albedo::model_infos().size(), before);
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Registry, AStructIsAModelWithoutBeingRegistered) {
  const auto model = albedo::make_model<Darkening>({{"k", 2.5}, {"rho", 0.8}});
  EXPECT_EQ(model->info().name, "darkening");
  EXPECT_EQ(model->info().parameters.size(), 3U);
  EXPECT_EQ(model->info().find("k")->default_value, 2);
  for (const double theta : {0.0, 30.0, 60.0, 85.0, 89.9}) {
    const double exact = 0.8 * std::pow(std::cos(theta * std::acos(-1.0) / 180), 1.5);
    for (const albedo::Precision precision : {albedo::Precision::float64, albedo::Precision::quad}) {
      const albedo::Estimate a =
          albedo::directional_albedo(*model, albedo::Direction::from_degrees(theta), {.precision = precision});
      EXPECT_EQ(a.status, albedo::Status::converged) << theta;
      EXPECT_LE(std::abs(a.value - exact), a.error + 1e-12 * exact) << theta;
    }
  }
  EXPECT_THROW(albedo::make_model<Darkening>({{"kk", 2.0}}), albedo::ParameterError);
  EXPECT_THROW(albedo::make_model<Darkening>({{"k", 11.0}}), albedo::ParameterError);
  EXPECT_THROW(albedo::make_model<Darkening>({{"side", "left"}}), albedo::ParameterError);
}

/// One test, since the registry is the process's: it is left as it was found but for two models.
TEST(Registry, ARegisteredStructIsKnownByItsName) {
  const auto early = albedo::make_model<Darkening>();
  const albedo::ModelInfo& ward = albedo::model_info("ward");
  EXPECT_THROW(albedo::make_model("darkening"), albedo::UnknownModel);
  albedo::register_model<Darkening>();
  albedo::register_model<Plain>();
  EXPECT_EQ(&albedo::model_info("ward"), &ward);
  EXPECT_EQ(&albedo::model_info("darkening"), &early->info());
  EXPECT_EQ(albedo::model_infos().back().get().name, "plain");

  const auto model = albedo::make_model("darkening", {{"all", 3.0}});
  EXPECT_EQ(std::get<double>(model->parameters()[0].second), 3);
  const albedo::Estimate a = albedo::directional_albedo(*model, albedo::Direction::from_degrees(60));
  EXPECT_LE(std::abs(a.value - 0.125), a.error + 1e-15);
  EXPECT_TRUE(albedo::make_model("darkening", {{"side", "neither"}})->lobes().empty());
  EXPECT_EQ(albedo::make_model("plain")->parameters().size(), 0U);
  try {
    albedo::make_model("darkning");
    ADD_FAILURE();
  } catch (const albedo::UnknownModel& error) {
    EXPECT_TRUE(contains(error.what(), "'darkening'")) << error.what();
  }
  try {
    albedo::make_model("plain", {{"rho", 1.0}});
    ADD_FAILURE();
  } catch (const albedo::ParameterError& error) {
    EXPECT_TRUE(contains(error.what(), "it has none")) << error.what();
  }
  EXPECT_THROW(albedo::register_model<Darkening>(), albedo::ParameterError);
}

TEST(Registry, RefusesNamesAndDefaultsThatWouldNotWork) {
  EXPECT_TRUE(contains(refusal<0>(named("ward")), "'ward': the name is taken"));
  EXPECT_TRUE(contains(refusal<1>(named("sum")), "'sum': the name is taken"));
  EXPECT_TRUE(contains(refusal<2>(named("")), "letters, digits and underscores"));
  EXPECT_TRUE(contains(refusal<3>(named("my model")), "letters, digits and underscores"));
  EXPECT_TRUE(contains(refusal<4>(named("9th")), "letters, digits and underscores"));
  EXPECT_TRUE(contains(refusal<5>(named("next"), {{.name = "theta", .range = {0, 1}}}), "'theta'"));
  EXPECT_TRUE(contains(refusal<6>(named("next"), {{.name = "a=b", .range = {0, 1}}}), "'a=b'"));
  const std::string twice = refusal<7>(named("next"), {{.name = "a", .range = {0, 1}}, {.name = "a", .range = {0, 1}}});
  EXPECT_TRUE(contains(twice, "a parameter of next can't be named 'a'")) << twice;
  const std::string outside = refusal<8>(named("next"), {{.name = "a", .range = {2, 3}}});
  EXPECT_EQ(outside, "next: the default of a is 1 and must be within [2, 3]");
  albedo::ModelInfo with_shorthand = named("next");
  with_shorthand.shorthands = {{"b", {"a"}}};
  const std::string nothing = refusal<9>(with_shorthand);
  EXPECT_TRUE(contains(nothing, "the shorthand b sets 'a'")) << nothing;
}

}  // namespace
