#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "albedo/core/errors.hpp"
#include "albedo/core/quad.hpp"
#include "property/battery.hpp"
#include "warps/sample.hpp"

/// What a model's formula and its information promise, on random pairs of directions.
namespace albedo {
namespace {

using battery::Case;

struct Models : battery::PerModel {};

template <class T>
DirectionPair<T> converted(const DirectionPair<Quad>& d) {
  const auto to = [](const Quad& x) { return T(static_cast<Scalar<T>>(x)); };
  return {to(d.cos_theta_l), to(d.cos_theta_v), to(d.l_x),     to(d.l_y),     to(d.v_x),     to(d.v_y),
          to(d.cos_theta_d), to(d.cos_theta_h), to(d.slope_x), to(d.slope_y), to(d.axis_gap)};
}

/// Directions that don't repeat and do not depend on the standard library's distributions.
class Directions {
 public:
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  Direction operator()(double lowest_cosine) {
    const double cosine = lowest_cosine + (1 - lowest_cosine) * uniform();
    return Direction::from_cosine(cosine, 360 * uniform());
  }
  /// V within a few widths of a lobe around L's mirror image or of facets around N; may be below the horizon.
  UnitVector<Quad> near(const Lobe& lobe, const UnitVector<Quad>& l) {
    const Quad x = 4 * uniform() - 2, y = 4 * uniform() - 2;
    if (const auto* mirror = lobe.as<MirrorLobe>()) {
      UnitVector<Quad> v = lobe_axis(lobe, l);
      v.x += mirror->width * x, v.y += mirror->width * y;
      return normalised(v);
    }
    const double one = lobe.widths().narrow;
    const SlopeLobe slopes = lobe.is<SlopeLobe>() ? lobe.slopes() : SlopeLobe{Profile::gaussian, one, one};
    const UnitVector<Quad> h = normalised({slopes.width_x * x, slopes.width_y * y, Quad(1)});
    const Quad twice = 2 * (l.x * h.x + l.y * h.y + l.z * h.z);
    return {twice * h.x - l.x, twice * h.y - l.y, twice * h.z - l.z};
  }

 private:
  static UnitVector<Quad> normalised(const UnitVector<Quad>& v) {
    const Quad length = sqrt(Quad(v.x * v.x + v.y * v.y + v.z * v.z));
    return {v.x / length, v.y / length, v.z / length};
  }
  std::mt19937_64 engine_{20'240'501};
};

/// Calls check(component, pair) for pairs of a lobe of the model: half of them anywhere, half of them in the lobe.
template <class Check>
void for_random_pairs(const Model& model, int count, const Check& check) {
  Directions directions;
  for (const Lobe& lobe : model.lobes()) {
    for (int i = 0; i < count; ++i) {
      const auto l = unit_vector<Quad>(directions(0.1));
      const bool anywhere = i % 2 == 0 || lobe.is<CosineLobe>();
      const auto v = anywhere ? unit_vector<Quad>(directions(0.1)) : directions.near(lobe, l);
      if (v.z < 0.05) continue;
      const DirectionPair<Quad> pair = direction_pair(l, v, lobe_axis(lobe, l));
      if (abs(Quad(1 - pair.axis_gap)) < 0.01) continue;  // where (A·V)^n is about to end, its logarithm has few digits
      check(lobe.component, pair);
    }
  }
}

TEST(Battery, HasEveryModel) {
  for (const std::string& name : battery::model_names()) EXPECT_GE(battery::cases_of(name).size(), 2U) << name;
  for (const Case& c : battery::cases()) EXPECT_NO_THROW(make_model(c.model, c.parameters)) << battery::name(c);
}

TEST_P(Models, SameInDoubleBlockFloatAndQuad) {
  int compared = 0, compared_in_float = 0;
  for (const Case& c : battery::cases_of(GetParam())) {
    const auto model = make_model(c.model, c.parameters);
    for_random_pairs(*model, 200, [&](int component, const DirectionPair<Quad>& pair) {
      const Quad exact = model->quad().evaluate(component, pair);
      const double rounded = static_cast<double>(exact);
      if (rounded != 0 && rounded < 1e-30) return;
      const double in_double = model->evaluate(component, converted<double>(pair));
      EXPECT_LE(std::abs(in_double - rounded), 1e-12 * rounded) << battery::name(c) << ": " << rounded;
      const Block block = model->evaluate(component, converted<Block>(pair));
      constexpr double underflow = 1e-290;  // Eigen's exp ends a little above 0
      for (int lane = 0; lane < block_width; ++lane) {
        EXPECT_LE(std::abs(block[lane] - in_double), 1e-13 * rounded + underflow)
            << battery::name(c) << ": " << rounded;
      }
      ++compared;
      if (rounded < 1e-15 || rounded > 1e15) return;
      const float in_float = model->evaluate(component, converted<float>(pair));
      EXPECT_LE(std::abs(static_cast<double>(in_float) - rounded), 1e-4 * rounded)
          << battery::name(c) << ": " << rounded;
      ++compared_in_float;
    });
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(compared_in_float, 100);
}

/// Lanes of a block don't mix.
TEST_P(Models, LanesAreIndependent) {
  for (const Case& c : battery::cases_of(GetParam())) {
    const auto model = make_model(c.model, c.parameters);
    for (const Lobe& lobe : model->lobes()) {
      Directions directions;
      std::vector<DirectionPair<double>> pairs;
      std::vector<double> alone;
      DirectionPair<Block> together{};
      const auto fill = [&](Block DirectionPair<Block>::*to, double DirectionPair<double>::*from) {
        together.*to = Block::generate([&](int i) { return pairs[static_cast<std::size_t>(i)].*from; });
      };
      for (int i = 0; i < block_width; ++i) {
        const auto l = unit_vector<double>(directions(0.1)), v = unit_vector<double>(directions(0.1));
        pairs.push_back(direction_pair(l, v, lobe_axis(lobe, l)));
        alone.push_back(model->evaluate(lobe.component, pairs.back()));
      }
      using D = DirectionPair<double>;
      using B = DirectionPair<Block>;
      fill(&B::cos_theta_l, &D::cos_theta_l), fill(&B::cos_theta_v, &D::cos_theta_v);
      fill(&B::l_x, &D::l_x), fill(&B::l_y, &D::l_y), fill(&B::v_x, &D::v_x), fill(&B::v_y, &D::v_y);
      fill(&B::cos_theta_d, &D::cos_theta_d), fill(&B::cos_theta_h, &D::cos_theta_h);
      fill(&B::slope_x, &D::slope_x), fill(&B::slope_y, &D::slope_y), fill(&B::axis_gap, &D::axis_gap);
      const Block f = model->evaluate(lobe.component, together);
      for (int i = 0; i < block_width; ++i) {
        const double expected = alone[static_cast<std::size_t>(i)];
        EXPECT_NEAR(f[i], expected, 1e-12 * expected + 1e-200) << battery::name(c) << ", lane " << i;
      }
    }
  }
}

TEST_P(Models, ReciprocalIfAndOnlyIfClaimed) {
  for (const Case& c : battery::cases_of(GetParam())) {
    const auto model = make_model(c.model, c.parameters);
    Directions directions;
    double worst = 0;
    for (int i = 0; i < 500; ++i) {
      const Direction l = directions(1e-3), v = directions(1e-3);
      const Quad there = brdf<Quad>(*model, l, v), back = brdf<Quad>(*model, v, l);
      const Quad larger = max(there, back);
      if (larger > 0) worst = std::max(worst, static_cast<double>(Quad(abs(Quad(there - back)) / larger)));
    }
    if (model->claims().reciprocal) {
      EXPECT_LE(worst, 1e-13) << battery::name(c);  // constants are kept in double
    } else {
      EXPECT_GE(worst, 0.1) << battery::name(c);
    }
  }
}

TEST_P(Models, FiniteAndNotNegativeDownToGrazing) {
  for (const Case& c : battery::cases_of(GetParam())) {
    const auto model = make_model(c.model, c.parameters);
    Directions directions;
    const auto pick = [&](int kind) {
      if (kind == 0) return Direction::from_cosine(1);
      if (kind == 1) return Direction::from_cosine(1e-8, 360 * directions.uniform());
      return directions(0);
    };
    for (int i = 0; i < 300; ++i) {
      const Direction l = pick(i % 3), v = pick(i / 3 % 4);
      const double f = brdf<double>(*model, l, v);
      EXPECT_TRUE(std::isfinite(f)) << battery::name(c) << ": " << f;
      EXPECT_GE(f, 0) << battery::name(c);
    }
  }
}

TEST_P(Models, AlbedoIsAtMostOneIfClaimedAndAboveOneSomewhereIfNot) {
  bool claims_less = false, caught = false;
  for (const Case& c : battery::cases_of(GetParam())) {
    const auto model = make_model(c.model, c.parameters);
    std::vector<Direction> directions;
    for (const double theta : battery::thetas) directions.push_back(Direction::from_degrees(theta, c.phi));
    for (const double cosine : {1e-5, 1e-8}) directions.push_back(Direction::from_cosine(cosine, c.phi));
    for (const Direction& l : directions) {
      const Estimate e = directional_albedo(*model, l);
      EXPECT_GE(e.value, 0) << battery::name(c, l.theta_degrees());
      if (model->claims().conserves_energy) {
        EXPECT_LE(e.value, 1 + e.error) << battery::name(c, l.theta_degrees()) << ": " << battery::text(e);
      } else {
        claims_less = true;
        caught = caught || e.value > 1 + e.error;
      }
    }
  }
  EXPECT_EQ(caught, claims_less) << "a model that doesn't claim to conserve energy should be caught at it";
}

TEST_P(Models, BoundedIfAndOnlyIfClaimed) {
  for (const Case& c : battery::cases_of(GetParam())) {
    const auto model = make_model(c.model, c.parameters);
    const Estimate e = directional_albedo(*model, Direction::from_degrees(90, c.phi), {.tolerance = 1e-6});
    if (model->claims().bounded) {
      const bool vanishes = e.value <= e.error;  // nothing is accurate relative to a limit of 0
      EXPECT_TRUE(e.status == Status::converged || vanishes) << battery::name(c) << ": " << battery::text(e);
      EXPECT_TRUE(std::isfinite(e.value)) << battery::name(c);
      const Estimate near = directional_albedo(*model, Direction::from_cosine(1e-11, c.phi), {.tolerance = 1e-6});
      if (vanishes) {
        EXPECT_LE(e.value, near.value + near.error + 1e-9) << battery::name(c);  // slowly, some as a logarithm
      } else {
        EXPECT_NEAR(e.value, near.value, e.error + near.error + 1e-4 * e.value + 1e-9) << battery::name(c);
      }
    } else {
      EXPECT_EQ(e.status, Status::divergent) << battery::name(c) << ": " << battery::text(e);
      EXPECT_EQ(e.value, std::numeric_limits<double>::infinity()) << battery::name(c);
    }
  }
}

TEST_P(Models, IsotropicIfAndOnlyIfClaimed) {
  for (const Case& c : battery::cases_of(GetParam())) {
    const auto model = make_model(c.model, c.parameters);
    double largest = 0;
    for (const double theta : {30.0, 80.0}) {
      const Estimate here = directional_albedo(*model, Direction::from_degrees(theta, 0));
      for (const double phi : {37.0, 90.0, 217.0}) {
        const Estimate there = directional_albedo(*model, Direction::from_degrees(theta, phi));
        const double difference = std::abs(there.value - here.value);
        largest = std::max(largest, difference);
        if (model->claims().isotropic) {
          EXPECT_LE(difference, here.error + there.error) << battery::name(c, theta) << ", phi " << phi;
        }
      }
    }
    if (!model->claims().isotropic) {
      EXPECT_GT(largest, 1e-4) << battery::name(c);
    }
  }
}

TEST_P(Models, InformationIsComplete) {
  const ModelInfo& info = model_info(GetParam());
  EXPECT_FALSE(info.title.empty());
  EXPECT_FALSE(info.source.empty());
  EXPECT_FALSE(info.deviation.empty());
  EXPECT_FALSE(info.parameters.empty());
  std::set<std::string> names;
  for (const ParameterInfo& p : info.parameters) {
    EXPECT_TRUE(names.insert(p.name).second) << p.name << " twice";
    EXPECT_FALSE(p.meaning.empty()) << p.name;
    EXPECT_LT(p.range.minimum, p.range.maximum) << p.name;
    EXPECT_TRUE(p.range.contains(p.default_value)) << p.name;
    if (p.is_choice()) {
      EXPECT_EQ(p.range.maximum, static_cast<double>(p.choices.size() - 1)) << p.name;
    }
  }
  for (const Shorthand& s : info.shorthands) {
    EXPECT_TRUE(names.insert(s.name).second) << s.name << " is also a parameter";
    EXPECT_EQ(info.resolve(s.name), s.parameters);
    for (const std::string& p : s.parameters) EXPECT_NE(info.find(p), nullptr) << p;
  }
  const Parameters defaults = make_model(GetParam())->parameters();
  ASSERT_EQ(defaults.size(), info.parameters.size());
  for (std::size_t i = 0; i < defaults.size(); ++i) {
    const ParameterInfo& p = info.parameters[i];
    EXPECT_EQ(defaults[i].first, p.name);
    if (p.is_choice()) {
      EXPECT_EQ(std::get<std::string>(defaults[i].second), p.choices[static_cast<std::size_t>(p.default_value)]);
    } else {
      EXPECT_EQ(std::get<double>(defaults[i].second), p.default_value);
    }
  }
}

TEST_P(Models, EveryParameterCanBeSetWithinItsRangeOnly) {
  const ModelInfo& info = model_info(GetParam());
  const auto value_of = [&](const Model& model, const std::string& name) {
    for (const auto& [parameter, value] : model.parameters()) {
      if (parameter == name) return value;
    }
    return ParameterValue(std::numeric_limits<double>::quiet_NaN());
  };
  const auto make = [&](const std::string& name, const ParameterValue& value) {
    return make_model(GetParam(), {{name, value}});
  };
  for (const ParameterInfo& p : info.parameters) {
    if (p.is_choice()) {
      for (const std::string& choice : p.choices)
        EXPECT_EQ(value_of(*make(p.name, choice), p.name), ParameterValue(choice));
      EXPECT_THROW(make(p.name, "nonsense"), ParameterError) << p.name;
      continue;
    }
    const double middle = p.range.minimum + 0.37 * (p.range.maximum - p.range.minimum);
    for (const double value : {p.range.minimum, middle, p.range.maximum}) {
      EXPECT_EQ(value_of(*make(p.name, value), p.name), ParameterValue(value)) << p.name;
    }
    for (const double value : {std::nextafter(p.range.minimum, -1e300), std::nextafter(p.range.maximum, 1e300),
                               std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity()}) {
      EXPECT_THROW(make(p.name, value), ParameterError) << p.name << " = " << value;
    }
    EXPECT_THROW(make(p.name, "nonsense"), ParameterError) << p.name;
  }
  for (const Shorthand& s : info.shorthands) {
    const ParameterInfo& first = *info.find(s.parameters.front());
    const double value = first.range.minimum + 0.37 * (first.range.maximum - first.range.minimum);
    const auto model = make(s.name, value);
    for (const std::string& p : s.parameters) EXPECT_EQ(value_of(*model, p), ParameterValue(value)) << s.name;
  }
  EXPECT_THROW(make("no_such_parameter", 1.0), ParameterError);
}

/// A parameter that changes nothing is one that the formula forgot.
TEST_P(Models, EveryNumberMatters) {
  const ModelInfo& info = model_info(GetParam());
  for (const ParameterInfo& p : info.parameters) {
    if (p.is_choice()) continue;
    bool matters = false;
    std::vector<Case> settings = battery::cases_of(GetParam());
    for (const Case& c : settings) {
      const double there = std::clamp(p.default_value * 0.7 + 0.1, p.range.minimum, p.range.maximum);
      Parameters changed = c.parameters;
      changed.emplace_back(p.name, there);
      const auto a = make_model(c.model, c.parameters), b = make_model(c.model, changed);
      const Direction l = Direction::from_degrees(40, 20), v = Direction::from_degrees(35, 195);
      matters = matters || brdf<double>(*a, l, v) != brdf<double>(*b, l, v);
    }
    EXPECT_TRUE(matters) << p.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Battery, Models, ::testing::ValuesIn(battery::model_names()), battery::instance_name);

}  // namespace
}  // namespace albedo
