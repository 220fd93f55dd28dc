#include <array>
#include <cmath>
#include <limits>

#include "albedo/core/erased_model.hpp"
#include "albedo/core/errors.hpp"
#include "albedo/core/quad.hpp"
#include "property/battery.hpp"
#include "rules/sobol.hpp"
#include "rules/stratified.hpp"
#include "warps/paper.hpp"

/// The samplers published with the models: the direction that is drawn, and the density that is said of it.
namespace albedo {
namespace {

using battery::Case;

struct Samplers : battery::PerModel {};

constexpr std::array thetas{0.0, 35.0, 80.0};

/// Calls check(case, lobe, l) for every lobe of the model's cases.
template <class Check>
void for_lobes(const std::string& name, const Check& check) {
  for (const Case& c : battery::cases_of(name)) {
    const auto model = make_model(c.model, c.parameters);
    for (const Lobe& lobe : model->lobes()) {
      ASSERT_TRUE(model->has_sampler(lobe.component)) << battery::name(c);
      for (const double theta : thetas) {
        const UnitVector<double> l = unit_vector<double>(Direction::from_degrees(theta, c.phi));
        check(*model, lobe, l, battery::name(c, theta) + ", lobe " + std::to_string(lobe.component));
      }
    }
  }
}

/// Points of the square, some of them close to its edges.
std::vector<std::array<double, 2>> places() {
  std::vector<std::array<double, 2>> all;
  for (const double u : {1e-9, 0.03, 0.2, 0.5, 0.77, 0.95, 0.999}) {
    for (const double v : {1e-6, 0.11, 0.24, 0.4, 0.51, 0.66, 0.87, 0.999}) all.push_back({u, v});
  }
  return all;
}

TEST_P(Samplers, DensityIsThatOfTheDirectionDrawn) {
  for_lobes(GetParam(), [](const Model& model, const Lobe& lobe, const UnitVector<double>& l, const std::string& what) {
    int compared = 0;
    for (const auto& [u, v] : places()) {
      const Sampled<double> drawn = model.sample(lobe.component, l, u, v);
      const UnitVector<double> viewer = drawn.viewer();
      EXPECT_NEAR(square(viewer.x) + square(viewer.y) + square(viewer.z), 1, 1e-12) << what;
      EXPECT_GT(drawn.density, 0) << what;
      // L + V loses the digits of H where V is close to −L
      if (drawn.pair.cos_theta_d < 0.01) continue;
      ++compared;
      const double again = model.density(lobe.component, l, viewer);
      EXPECT_NEAR(again, drawn.density, 2e-6 * drawn.density) << what << ", u " << u << ", v " << v;
    }
    EXPECT_GT(compared, 20) << what;
  });
}

TEST_P(Samplers, PairIsThatOfItsDirections) {
  for_lobes(GetParam(), [](const Model& model, const Lobe& lobe, const UnitVector<double>& l, const std::string& what) {
    for (const auto& [u, v] : places()) {
      const DirectionPair<double> d = model.sample(lobe.component, l, u, v).pair;
      EXPECT_EQ(d.cos_theta_l, l.z) << what;
      EXPECT_EQ(d.l_x, l.x) << what;
      EXPECT_EQ(d.l_y, l.y) << what;
      if (d.cos_theta_v < 1e-3) continue;
      const UnitVector<double> viewer{d.v_x, d.v_y, d.cos_theta_v};
      const DirectionPair<double> again = direction_pair(l, viewer, lobe_axis(lobe, l));
      EXPECT_NEAR(d.cos_theta_d, again.cos_theta_d, 1e-12) << what;
      EXPECT_NEAR(d.cos_theta_h, again.cos_theta_h, 1e-12) << what;
      EXPECT_NEAR(d.slope_x, again.slope_x, 1e-9 * (1 + std::abs(d.slope_x))) << what;
      EXPECT_NEAR(d.slope_y, again.slope_y, 1e-9 * (1 + std::abs(d.slope_y))) << what;
      EXPECT_NEAR(d.axis_gap, again.axis_gap, 1e-12) << what;
    }
  });
}

TEST_P(Samplers, SameInDoubleBlockAndQuad) {
  for_lobes(GetParam(), [](const Model& model, const Lobe& lobe, const UnitVector<double>& l, const std::string& what) {
    const UnitVector<Block> l_block{Block(l.x), Block(l.y), Block(l.z)};
    const UnitVector<Quad> l_quad{Quad(l.x), Quad(l.y), Quad(l.z)};
    for (const auto& place : places()) {
      const double u = place[0], v = place[1];  // a lambda below captures them
      const Sampled<double> alone = model.sample(lobe.component, l, u, v);
      const Sampled<Block> block = model.sample(lobe.component, l_block, Block(u), Block(v));
      const Sampled<Quad> exact = model.quad().sample(lobe.component, l_quad, Quad(u), Quad(v));
      const auto expect = [&](double a, const Block& b, const Quad& q, double scale, double digits) {
        EXPECT_NEAR(a, static_cast<double>(q), digits * scale) << what << ", u " << u << ", v " << v;
        for (int i = 0; i < block_width; ++i) EXPECT_NEAR(b[i], a, digits * scale) << what << ", lane " << i;
      };
      expect(alone.pair.v_x, block.pair.v_x, exact.pair.v_x, 1, 1e-12);
      expect(alone.pair.v_y, block.pair.v_y, exact.pair.v_y, 1, 1e-12);
      expect(alone.pair.cos_theta_v, block.pair.cos_theta_v, exact.pair.cos_theta_v, 1, 1e-12);
      if (alone.pair.cos_theta_d < 1e-3) continue;
      expect(alone.density, block.density, exact.density, alone.density, 1e-9);
    }
  });
}

/// Mean over the sphere: of a function of V times the density, and of the function over directions drawn.
class Mean final : public Integrand<double> {
 public:
  using Function = double (*)(const UnitVector<double>&);

  Mean(const Model& model, int component, const UnitVector<double>& l, Function function, bool drawn)
      : model_(model), component_(component), l_(l), function_(function), drawn_(drawn) {
    panels_.resize(1);
    const double planar = std::hypot(l.x, l.y);
    if (planar > 0) right_ = {-l.y / planar, l.x / planar, 0};
    up_ = {l.y * right_.z - l.z * right_.y, l.z * right_.x - l.x * right_.z, l.x * right_.y - l.y * right_.x};
  }

  void points(int, const double* u, const double* v, double* w, int count) const override {
    for (int i = 0; i < count; ++i) {
      if (drawn_) {
        w[i] = function_(model_.sample(component_, l_, u[i], v[i]).viewer());
        continue;
      }
      // around −L, where densities of half vectors are infinite like 1/L·H: by the polar angle, sinγ dγ takes that away
      const double gamma = pi<double> * u[i], phi = 2 * pi<double> * v[i];
      const double along = -std::cos(gamma), x = std::sin(gamma) * std::cos(phi), y = std::sin(gamma) * std::sin(phi);
      const UnitVector<double> viewer{along * l_.x + x * right_.x + y * up_.x, along * l_.y + x * right_.y + y * up_.y,
                                      along * l_.z + x * right_.z + y * up_.z};
      w[i] = 2 * square(pi<double>) * std::sin(gamma) * model_.density(component_, l_, viewer) * function_(viewer);
    }
  }
  void grid(int, const double*, int, const double*, int, double*) const override { FAIL(); }

 private:
  const Model& model_;
  int component_;
  UnitVector<double> l_, right_{1, 0, 0}, up_{};
  Function function_;
  bool drawn_;
};

/// The density integrates to 1 with what is below the horizon, and directions are drawn with it.
TEST_P(Samplers, DirectionsFollowTheDensity) {
  const std::array<Mean::Function, 8> functions{[](const UnitVector<double>&) { return 1.0; },
                                                [](const UnitVector<double>& v) { return v.x; },
                                                [](const UnitVector<double>& v) { return v.y; },
                                                [](const UnitVector<double>& v) { return v.z; },
                                                [](const UnitVector<double>& v) { return v.x * v.x; },
                                                [](const UnitVector<double>& v) { return v.x * v.y; },
                                                [](const UnitVector<double>& v) { return v.z * v.z * v.x; },
                                                [](const UnitVector<double>& v) { return v.z > 0 ? 1.0 : 0.0; }};
  int tested = 0;
  for_lobes(GetParam(),
            [&](const Model& model, const Lobe& lobe, const UnitVector<double>& l, const std::string& what) {
              if (!lobe.is<CosineLobe>() && lobe.widths().narrow < 0.18) return;  // a needle on the sphere
              ++tested;
              for (const Mean::Function function : functions) {
                const RuleOptions options{.tolerance = 1e-9, .budget = 16 * 1024, .seed = 3};
                const Estimate sphere = stratified(Mean(model, lobe.component, l, function, false), options);
                const Estimate drawn = sobol(Mean(model, lobe.component, l, function, true), options);
                ASSERT_NE(sphere.status, Status::non_finite) << what;
                EXPECT_LE(sphere.error, 0.02) << what;
                EXPECT_LE(std::abs(sphere.value - drawn.value), 5 * std::hypot(sphere.error, drawn.error) + 1e-9)
                    << what << ": " << battery::text(sphere) << " and drawn " << battery::text(drawn);
              }
            });
  EXPECT_GT(tested, 0);
}

INSTANTIATE_TEST_SUITE_P(Battery, Samplers, ::testing::ValuesIn(battery::sampled_model_names()),
                         battery::instance_name);

/// Walter's weight (eq. 10) and Kurt's (eq. 21) are what the warp makes of their models.
TEST(PaperWarp, WeightsAreThePapers) {
  const auto ward = make_model("ward", {{"alpha_x", 0.3}, {"alpha_y", 0.1}, {"rho_s", 0.7}});
  const auto kurt = make_model("kurt", {{"m_x", 0.3}, {"m_y", 0.1}, {"k_s", 0.7}, {"exponent", 0.4}});
  const UnitVector<double> l = unit_vector<double>(Direction::from_degrees(50, 20));
  for (const auto& [u, v] : places()) {
    const DirectionPair<double> d = ward->sample(0, l, u, v).pair;
    if (d.cos_theta_v <= 0) continue;
    const double w = ward->evaluate(0, d) * d.cos_theta_v / ward->sample(0, l, u, v).density;
    EXPECT_NEAR(w, 0.7 * d.cos_theta_d * std::pow(d.cos_theta_h, 3) * std::sqrt(d.cos_theta_v / d.cos_theta_l),
                1e-12 * w);
    const double k = kurt->evaluate(0, d) * d.cos_theta_v / kurt->sample(0, l, u, v).density;
    EXPECT_NEAR(k, 0.7 * std::pow(d.cos_theta_v, 0.6) / (d.cos_theta_h * std::pow(d.cos_theta_l, 0.4)), 1e-12 * k);
  }
}

/// What a model's weight f cosθ_V/density is in closed form, where its sampling takes a factor of the formula away.
struct Weight {
  std::string model;
  Parameters parameters;
  double (*expected)(const DirectionPair<double>&);
};

double schlick_weight(const DirectionPair<double>& d) {  // of r = 0.05, p = 0.3: nothing of Z or A is left
  constexpr double r = 0.05, p = 0.3;
  double a = 1, b = p;
  for (int i = 0; i < 6; ++i) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b), a = mean;
  }
  return d.cos_theta_v * d.cos_theta_d * std::sqrt(p) /
         (a * d.cos_theta_h * (r + (1 - r) * d.cos_theta_l) * (r + (1 - r) * d.cos_theta_v));
}

const std::vector<Weight>& weights() {
  using D = DirectionPair<double>;
  static const std::vector<Weight> all{
      {"ward_duer",
       {{"alpha_x", 0.3}, {"alpha_y", 0.1}, {"rho_s", 0.7}},
       [](const D& d) { return 0.7 * d.cos_theta_d * std::pow(d.cos_theta_h, 3) / d.cos_theta_l; }},
      {"ward_bounded",
       {{"alpha_x", 0.3}, {"alpha_y", 0.1}, {"rho_s", 0.7}},
       [](const D& d) { return 1.4 * d.cos_theta_v / (d.cos_theta_l + d.cos_theta_v); }},
      {"ashikhmin_premoze",
       {{"m", 0.6}},
       [](const D& d) {
         return d.cos_theta_d * d.cos_theta_v /
                (d.cos_theta_h * (d.cos_theta_l + d.cos_theta_v - d.cos_theta_l * d.cos_theta_v));
       }},
      {"neumann_stretched",
       {{"n", 3.0}, {"q", 0.4}},
       [](const D& d) { return 1.25 * d.cos_theta_v / std::pow(std::max(d.cos_theta_l, d.cos_theta_v), 0.4); }},
      {"schlick", {{"r", 0.05}, {"p", 0.3}}, schlick_weight},
      {"lambert", {{"rho", 0.3}}, [](const D&) { return 0.3; }},
      {"oren_nayar", {{"sigma", 0.0}, {"rho", 0.3}}, [](const D&) { return 0.3; }},
      {"edwards", {{"n", 1.0}}, [](const D&) { return 1.0; }},
      {"edwards", {{"n", 1e8}, {"radius", 1e-3}}, [](const D&) { return 1.0; }},
  };
  return all;
}

TEST(PaperWarp, WeightsHaveTheirClosedForms) {
  std::vector<std::array<double, 2>> points = places();
  for (const double v : {0.02, 0.25, 0.3, 0.5, 0.9}) points.push_back({1 - 0x1p-53, v});  // the rim of a lump
  for (const Weight& w : weights()) {
    const auto model = make_model(w.model, w.parameters);
    int above = 0;
    for (const double theta : {0.0, 50.0, 89.9}) {
      const UnitVector<double> l = unit_vector<double>(Direction::from_degrees(theta, 20));
      for (const auto& [u, v] : points) {
        const Sampled<double> drawn = model->sample(0, l, u, v);
        if (drawn.pair.cos_theta_v <= 0) continue;
        ++above;
        const double weight = model->evaluate(0, drawn.pair) * drawn.pair.cos_theta_v / drawn.density;
        const double expected = w.expected(drawn.pair);
        EXPECT_NEAR(weight, expected, 2e-12 * expected) << w.model << ", theta " << theta << ", u " << u << ", v " << v;
      }
    }
    EXPECT_GT(above, 50) << w.model;
  }
}

/// Every point of Edwards's disk that is a V above the surface weighs 1, the others nothing: the mean is the part of
/// the lump that is on the disk.
TEST(PaperWarp, EdwardsWeighsOneOrNothing) {
  for (const double theta : {0.0, 40.0, 89.9}) {
    const auto model = make_model("edwards", {{"n", 3.0}, {"radius", 0.8}});
    const Direction l = Direction::from_degrees(theta, 20);
    const PaperWarp<double> warp(*model, model->lobes().front(), l, 1e-8);
    int above = 0;
    constexpr int side = 200;
    for (int i = 0; i < side * side; ++i) {
      const Sample<double> s = warp.point((i / side + 0.5) / side, (i % side + 0.5) / side);
      const double w = model->evaluate(0, s.pair) * s.weight;
      EXPECT_TRUE(w == 0 || std::abs(w - 1) < 1e-12) << w;
      above += w > 0 ? 1 : 0;
    }
    const Estimate truth = directional_albedo(*model, l, {.tolerance = 1e-6});
    EXPECT_NEAR(above / double(side * side), truth.value, 2.0 / side + truth.error) << theta;
    if (theta == 0) {
      EXPECT_EQ(above, side * side);
    }
  }
}

/// A lobe of its own making, without a sampler.
struct Plain {
  double rho = 1;

  static ModelInfo info() { return {.name = "plain", .title = "Plain", .source = "none", .deviation = "none"}; }
  static std::vector<Parameter<Plain>> parameters() { return {reflectance<Plain, &Plain::rho>("rho", "albedo")}; }
  [[nodiscard]] Claims claims() const { return {}; }
  [[nodiscard]] std::vector<Lobe> lobes() const { return {{.component = 0, .weight = rho}}; }
  template <class T>
  T evaluate(int, const DirectionPair<T>&) const noexcept {
    return T(rho) / pi<T>;
  }
};

TEST(PaperWarp, RefusesAModelWithoutASampler) {
  const ModelInfo info = Plain::info();
  const ErasedModel<Plain> model(Plain{}, info);
  const Direction l = Direction::from_degrees(30);
  EXPECT_FALSE(model.has_sampler(0));
  EXPECT_TRUE(std::isnan(model.sample(0, unit_vector<double>(l), 0.5, 0.5).density));
  EXPECT_TRUE(std::isnan(model.density(0, unit_vector<double>(l), unit_vector<double>(l))));
  EXPECT_NEAR(directional_albedo(model, l).value, 1, 1e-10);
  try {
    directional_albedo(model, l, {.warp = Warp::paper});
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_NE(std::string(error.what()).find("plain has no sampler"), std::string::npos) << error.what();
  }
}

/// Where a rule's last cells round to the square's edges, weights are numbers still.
TEST_P(Samplers, EdgesOfTheSquareAreFinite) {
  for_lobes(GetParam(), [](const Model& model, const Lobe& lobe, const UnitVector<double>& l, const std::string& what) {
    const Direction direction = Direction::from_cosine(l.z, std::atan2(l.y, l.x) * 180 / pi<double>);
    const PaperWarp<double> warp(model, lobe, direction, 1e-8);
    const PaperWarp<Block> fast(model, lobe, direction, 1e-8);
    for (const double u : {0.0, 1e-300, 1 - 0x1p-53, 1.0}) {
      for (const double v : {0.0, 0.1, 0.35, 0.6, 0.85, 1.0}) {
        const Sample<double> s = warp.point(u, v);
        EXPECT_TRUE(std::isfinite(model.evaluate(lobe.component, s.pair) * s.weight)) << what << ", " << u << ", " << v;
        const Sample<Block> block = fast.point(Block(u), Block(v));
        const Block w = model.evaluate(lobe.component, block.pair) * block.weight;
        EXPECT_TRUE(std::isfinite(w[0])) << what << ", " << u << ", " << v << " in a block";
      }
    }
  });
}

/// What the lobe's sampling puts below the horizon weighs nothing, and is not asked of the formula.
TEST(PaperWarp, NothingBelowTheHorizon) {
  const auto model = make_model("ward", {{"alpha", 0.5}});
  const Direction l = Direction::from_degrees(85);
  const PaperWarp<double> warp(*model, model->lobes().front(), l, 1e-8);
  int below = 0;
  for (const auto& [u, v] : places()) {
    const Sample<double> sample = warp.point(u, v);
    EXPECT_GT(sample.pair.cos_theta_v, 0);
    EXPECT_TRUE(std::isfinite(model->evaluate(0, sample.pair)));
    EXPECT_GE(sample.weight, 0);
    below += sample.weight == 0 ? 1 : 0;
  }
  EXPECT_GT(below, 10);
}

}  // namespace
}  // namespace albedo
