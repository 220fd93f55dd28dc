#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <sstream>

#include "property/battery.hpp"
#include "warps/sample.hpp"

#include "albedo/core/quad.hpp"

/// No model answers NaN, infinity or less than 0: random parameters over their whole ranges, random directions down to
/// 1e-12 above the horizon, many of them next to L, −L, the mirror direction and the normal.
///
/// Excluded are only cosθ = 0 and V = −L, where f is undefined, and infinities of values that are too large for a
/// double in 113 bits, too; those are counted in the test's properties.
namespace albedo {
namespace {

struct Finite : battery::PerModel {};
struct FiniteSamples : battery::PerModel {};

/// Evaluations a model; ALBEDO_RANDOM_EVALUATIONS raises it.
std::int64_t evaluations() {
  const char* const text = std::getenv("ALBEDO_RANDOM_EVALUATIONS");
  return std::max<std::int64_t>(text == nullptr ? 0 : std::atoll(text), 200'000);
}

class Random {
 public:
  double operator()(double from = 0, double to = 1) {
    return from + (to - from) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double decades(double from, double to) { return std::exp((*this)(std::log(from), std::log(to))); }
  /// In (0, 1), and often close to its ends.
  double unit() {
    switch (below(4)) {
      case 0:
        return decades(1e-19, 1);
      case 1:
        return std::min(1 - decades(0x1p-53, 1), 1 - 0x1p-53);
      default:
        return (*this)(0x1p-54, 1);
    }
  }
  int below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }

  ParameterValue value(const ParameterInfo& p) {
    if (p.is_choice()) return p.choices[static_cast<std::size_t>(below(static_cast<int>(p.choices.size())))];
    switch (below(12)) {
      case 0:
        return p.range.minimum;
      case 1:
        return p.range.maximum;
      case 2:
        return p.default_value;
      case 3:
        return (*this)(p.range.minimum, p.range.maximum);
      default:
        break;
    }
    if (p.range.minimum < 0) {
      const double size = decades(1e-12 * p.range.maximum, p.range.maximum);
      return std::max(below(2) == 0 ? size : -size, p.range.minimum);
    }
    const double least = p.range.minimum > 0 ? p.range.minimum : 1e-12 * p.range.maximum;
    const bool spans_decades = p.range.maximum >= 100 * least && (p.range.minimum > 0 || p.range.maximum > 10);
    const double drawn =
        spans_decades || below(3) == 0 ? decades(least, p.range.maximum) : (*this)(p.range.minimum, p.range.maximum);
    return std::min(std::max(drawn, p.range.minimum), p.range.maximum);
  }

  Parameters parameters(const ModelInfo& info) {
    Parameters values;
    for (const ParameterInfo& p : info.parameters) values.emplace_back(p.name, value(p));
    return values;
  }

  UnitVector<double> direction() {
    switch (below(8)) {
      case 0:
        return {0, 0, 1};
      case 1:
        return with_cosine(1e-12);
      case 2:
        return with_cosine(decades(1e-12, 1));
      case 3:
        return with_sine(decades(1e-12, 1));
      default:
        return with_cosine((*this)(1e-12, 1));
    }
  }

  /// Above the surface, and not −L.
  UnitVector<double> partner(const UnitVector<double>& l) {
    for (;;) {
      UnitVector<double> v = direction();
      const int kind = below(8);
      if (kind == 0) return l;
      if (kind == 1) v = {-l.x, -l.y, l.z};
      if (kind == 2) v = moved(l);
      if (kind == 3) v = moved({-l.x, -l.y, l.z});
      if (kind == 4) v = moved({-l.x, -l.y, -l.z});
      if (kind == 5) v = {-l.x, -l.y, v.z};  // length 1 to within what its cosine is small
      if (kind == 5) v = normalised(v);
      if (v.z >= 1e-12) return v;
      if (v.z > -0.1) return normalised({v.x, v.y, decades(1e-12, 1e-3)});
    }
  }

 private:
  static UnitVector<double> normalised(const UnitVector<double>& v) {
    const double length = std::sqrt(square(v.x) + square(v.y) + square(v.z));
    return {v.x / length, v.y / length, v.z / length};
  }
  UnitVector<double> around(double cosine, double sine) {
    switch (below(6)) {
      case 0:
        return {sine, 0, cosine};
      case 1:
        return {0, -sine, cosine};
      default:
        break;
    }
    const double phi = (*this)(0, 2 * pi<double>);
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
  }
  UnitVector<double> with_cosine(double cosine) { return around(cosine, std::sqrt((1 - cosine) * (1 + cosine))); }
  UnitVector<double> with_sine(double sine) { return around(std::sqrt((1 - sine) * (1 + sine)), sine); }
  UnitVector<double> moved(const UnitVector<double>& v) {
    const double by = decades(1e-16, 1);
    return normalised({v.x + by * (*this)(-1, 1), v.y + by * (*this)(-1, 1), v.z + by * (*this)(-1, 1)});
  }

  std::mt19937_64 engine_{20'260'731};
};

template <class To, class From, class Convert>
DirectionPair<To> converted(const Convert& to, From&& from) {
  using P = DirectionPair<double>;
  return {to(from(&P::cos_theta_l)), to(from(&P::cos_theta_v)), to(from(&P::l_x)),         to(from(&P::l_y)),
          to(from(&P::v_x)),         to(from(&P::v_y)),         to(from(&P::cos_theta_d)), to(from(&P::cos_theta_h)),
          to(from(&P::slope_x)),     to(from(&P::slope_y)),     to(from(&P::axis_gap))};
}

std::string text(const Parameters& parameters, const DirectionPair<double>& d) {
  std::ostringstream stream;
  stream.precision(17);
  for (const auto& [name, value] : parameters) {
    stream << name << '=';
    std::visit([&](const auto& v) { stream << v; }, value);
    stream << ' ';
  }
  stream << "L " << d.l_x << ' ' << d.l_y << ' ' << d.cos_theta_l << ", V " << d.v_x << ' ' << d.v_y << ' '
         << d.cos_theta_v << ", L.H " << d.cos_theta_d << ", N.H " << d.cos_theta_h << ", slopes " << d.slope_x << ' '
         << d.slope_y << ", gap " << d.axis_gap;
  return stream.str();
}

TEST_P(Finite, EverywhereAboveTheSurface) {
  constexpr std::int64_t pairs_a_model = 4 * block_width;
  const ModelInfo& info = model_info(GetParam());
  const std::int64_t wanted = evaluations();
  Random random;
  std::int64_t done = 0, too_large = 0, wrong = 0;
  std::array<DirectionPair<double>, block_width> pairs{};
  while (done < wanted) {
    const Parameters parameters = random.parameters(info);
    const auto model = make_model(info.name, parameters);
    for (const Lobe& lobe : model->lobes()) {
      for (std::int64_t i = 0; i < pairs_a_model; i += block_width) {
        for (DirectionPair<double>& pair : pairs) {
          const UnitVector<double> l = random.direction();
          pair = direction_pair(l, random.partner(l), lobe_axis(lobe, l));
        }
        const auto gathered = [&](double DirectionPair<double>::*member) {
          return Block::generate([&](int lane) { return pairs[static_cast<std::size_t>(lane)].*member; });
        };
        const Block f = model->evaluate(lobe.component, converted<Block>([](const Block& b) { return b; }, gathered));
        const double alone = model->evaluate(lobe.component, pairs[0]);
        done += block_width;
        for (int lane = -1; lane < block_width; ++lane) {
          const double value = lane < 0 ? alone : f[lane];
          if (value >= 0 && value <= std::numeric_limits<double>::max()) continue;
          const DirectionPair<double>& pair = pairs[static_cast<std::size_t>(std::max(lane, 0))];
          const Quad exact = model->quad().evaluate(
              lobe.component, converted<Quad>([](double x) { return Quad(x); },
                                              [&](double DirectionPair<double>::*member) { return pair.*member; }));
          if (value > 0 && exact > std::numeric_limits<double>::max()) {
            ++too_large;
          } else if (++wrong <= 5) {
            ADD_FAILURE() << info.name << ", lobe " << lobe.component << (lane < 0 ? "" : " in a block") << ": "
                          << value << ", in 113 bits " << exact << "\n  " << text(parameters, pair);
          }
        }
      }
    }
    if (model->lobes().empty()) done += block_width;
  }
  EXPECT_EQ(wrong, 0) << "of " << done;
  RecordProperty("evaluations", std::to_string(done));
  RecordProperty("too_large", std::to_string(too_large));
  if (too_large > 0) std::cout << info.name << ": " << too_large << " of " << done << " values exceed 1.8e308\n";
}

/// What is drawn is a direction, its density is no less than 0, and its weight f cosθ_V/density is a number: with that
/// rules are fed.
TEST_P(FiniteSamples, EverywhereInTheSquare) {
  constexpr int draws_a_model = 32;
  const ModelInfo& info = model_info(GetParam());
  const std::int64_t wanted = evaluations() / 2;
  Random random;
  std::int64_t done = 0, wrong = 0;
  while (done < wanted) {
    const Parameters parameters = random.parameters(info);
    const auto model = make_model(info.name, parameters);
    done += model->lobes().empty() ? 1 : 0;
    for (const Lobe& lobe : model->lobes()) {
      for (int i = 0; i < draws_a_model; ++i, ++done) {
        const UnitVector<double> l = random.direction();
        const double u = random.unit(), v = random.unit();
        const Sampled<double> drawn = model->sample(lobe.component, l, u, v);
        const DirectionPair<double>& d = drawn.pair;
        const double length = std::sqrt(square(d.v_x) + square(d.v_y) + square(d.cos_theta_v));
        const bool above = d.cos_theta_v > 0;
        const double f = above ? model->evaluate(lobe.component, d) : 0;
        const double weight = above ? f * (d.cos_theta_v / drawn.density) : 0;
        const double given = above ? model->density(lobe.component, l, drawn.viewer()) : 0;
        if (std::abs(length - 1) < 1e-9 && drawn.density >= 0 && weight >= 0 && weight < 1e300 && given >= 0) continue;
        if (++wrong <= 5) {
          std::ostringstream stream;
          stream.precision(17);
          stream << "u " << u << " v " << v << " density " << drawn.density << ", asked for " << given << ", f " << f
                 << ", weight " << weight;
          ADD_FAILURE() << info.name << ", lobe " << lobe.component << ": " << stream.str() << "\n  "
                        << text(parameters, d);
        }
      }
    }
  }
  EXPECT_EQ(wrong, 0) << "of " << done;
}

INSTANTIATE_TEST_SUITE_P(Battery, Finite, ::testing::ValuesIn(battery::model_names()), battery::instance_name);

INSTANTIATE_TEST_SUITE_P(Battery, FiniteSamples, ::testing::ValuesIn(battery::sampled_model_names()),
                         battery::instance_name);

}  // namespace
}  // namespace albedo
