#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "rules/gauss.hpp"
#include "warps/half_vector.hpp"
#include "warps/hemisphere.hpp"
#include "warps/mirror_lobe.hpp"
#include "warps/near_mirror.hpp"

#include "albedo/core/quad.hpp"

namespace albedo {
namespace {

/// What a warp is tested on: a lobe and a direction of L.
struct Setting {
  std::string name;
  Lobe lobe;
  Direction l;
};

std::vector<Direction> directions() {
  std::vector<Direction> all;
  for (const double cosine : {1.0, 0.8, 0.3, 1e-3, 1e-6}) {
    for (const double phi : {0.0, 28.0, 90.0, 130.0}) all.push_back(Direction::from_cosine(cosine, phi));
  }
  return all;
}

Lobe with(Lobe lobe, const std::function<void(Lobe&)>& change) {
  change(lobe);
  return lobe;
}

std::vector<Setting> settings(const std::vector<std::pair<std::string, Lobe>>& lobes) {
  std::vector<Setting> all;
  for (const auto& [name, lobe] : lobes) {
    for (const Direction& l : directions()) {
      all.push_back(
          {name + ", cos theta " + std::to_string(l.cos_theta) + ", sin phi " + std::to_string(l.sin_phi), lobe, l});
    }
  }
  return all;
}

std::vector<Setting> half_vector_settings() {
  return settings({
      {"gaussian 0.2", slope_lobe(0, Profile::gaussian, 0.2, 0.2)},
      {"gaussian 1", slope_lobe(0, Profile::gaussian, 1, 1)},
      {"needle", slope_lobe(0, Profile::gaussian, 1e-4, 1e-4)},
      {"root at the horizon",
       with(slope_lobe(0, Profile::gaussian, 0.3, 0.3), [](Lobe& lobe) { lobe.horizon_exponent = 0.5; })},
      {"anisotropic", slope_lobe(0, Profile::gaussian, 0.3, 0.05)},
      {"v-cavity", with(slope_lobe(0, Profile::gaussian, 0.5, 0.5), [](Lobe& lobe) { lobe.kink_v_cavity = true; })},
      {"ggx 0.3", with(slope_lobe(0, Profile::ggx, 0.3, 0.3), [](Lobe& lobe) { lobe.horizon_layer = true; })},
      {"ggx anisotropic", slope_lobe(0, Profile::ggx, 1, 0.01)},
      {"power 20", power_lobe(0, 20, 20)},
      {"power 1e6", power_lobe(0, 1e6, 1e6)},
      {"max of cosines", with(power_lobe(0, 10, 1000), [](Lobe& lobe) { lobe.kink_equal_cosines = true; })},
  });
}

std::vector<Setting> mirror_settings() {
  return settings({
      {"n 0", mirror_lobe(0, 0)},
      {"n 20", mirror_lobe(0, 20)},
      {"n 1e6", mirror_lobe(0, 1e6)},
      {"max of cosines", with(mirror_lobe(0, 20), [](Lobe& lobe) { lobe.kink_equal_cosines = true; })},
      {"off-specular", mirror_lobe(0, 5, {-1, -0.8, 0.5})},
  });
}

std::vector<Setting> hemisphere_settings() {
  return settings(
      {{"diffuse", Lobe{}}, {"mirror", mirror_lobe(0, 20)}, {"slopes", slope_lobe(0, Profile::gaussian, 0.2, 0.1)}});
}

std::vector<Setting> near_mirror_settings() {
  const auto lobe = [](double width, double facets) {
    return Lobe{.shape = NearMirrorLobe{.width = width, .facet_width = facets}};
  };
  return settings({{"wide", lobe(2, 1)}, {"diffraction", lobe(0.05, 0.01)}, {"facets", lobe(1e-3, 1e-3)}});
}

constexpr double tolerance = 1e-12;

template <class S>
UnitVector<S> viewer(const DirectionPair<S>& d) {
  return {d.v_x, d.v_y, d.cos_theta_v};
}

double relative(const Quad& a, const Quad& b) {
  if (a == b) return 0;
  return static_cast<double>(Quad(abs(Quad(a - b)) / max(Quad(abs(a)), Quad(abs(b)))));
}

/// Calls check(setting, panel, u, v) at random places of every panel, some of them close to its edges.
template <class WarpOfT, class Check>
void for_random_places(const std::vector<Setting>& all, const Check& check) {
  std::mt19937_64 engine(42);
  const auto uniform = [&] { return static_cast<double>((engine() >> 11) + 1) * 0x1p-53 * (1 - 0x1p-40); };
  for (const Setting& setting : all) {
    const WarpOfT warp(setting.lobe, setting.l, tolerance);
    ASSERT_FALSE(warp.panels().empty()) << setting.name;
    for (int panel = 0; panel < static_cast<int>(warp.panels().size()); ++panel) {
      for (int i = 0; i < 6; ++i) {
        double u = uniform();
        if (i == 4) u *= 1e-6;
        if (i == 5) u = 1 - 0x1p-20 * u;
        check(setting, warp, panel, u, uniform());
      }
    }
  }
}

/// The invariants of a pair are those of its own two vectors.
template <template <class> class WarpIn>
void check_pairs_are_consistent(const std::vector<Setting>& all) {
  for_random_places<WarpIn<Quad>>(all, [](const Setting& s, const WarpIn<Quad>& warp, int panel, double u, double v) {
    const Sample<Quad> sample = warp.point(panel, warp.line(panel, Quad(v)), Quad(u));
    const DirectionPair<Quad>& d = sample.pair;
    const UnitVector<Quad> l = unit_vector<Quad>(s.l);
    const DirectionPair<Quad> again = direction_pair(l, viewer(d), lobe_axis(s.lobe, l));
    const double length = static_cast<double>(Quad(square(d.v_x) + square(d.v_y) + square(d.cos_theta_v) - 1));
    EXPECT_LE(std::abs(length), 1e-25) << s.name;
    EXPECT_GE(d.cos_theta_v, 0) << s.name;
    EXPECT_LE(relative(d.cos_theta_l, again.cos_theta_l), 1e-25) << s.name;
    EXPECT_LE(relative(d.l_x, again.l_x), 1e-25) << s.name;
    EXPECT_LE(relative(d.l_y, again.l_y), 1e-25) << s.name;
    EXPECT_LE(relative(d.cos_theta_d, again.cos_theta_d), 1e-12) << s.name << " u " << u << " v " << v;
    EXPECT_LE(relative(d.cos_theta_h, again.cos_theta_h), 1e-12) << s.name << " u " << u << " v " << v;
    const Quad slope = sqrt(tan2_theta_h(d)), recomputed = 1e-27;
    EXPECT_LE(abs(Quad(d.slope_x - again.slope_x)), 1e-12 * slope + recomputed) << s.name << " u " << u << " v " << v;
    EXPECT_LE(abs(Quad(d.slope_y - again.slope_y)), 1e-12 * slope + recomputed) << s.name << " u " << u << " v " << v;
    EXPECT_LE(relative(d.axis_gap, again.axis_gap), 1e-12) << s.name << " u " << u << " v " << v;
    EXPECT_GE(sample.weight, 0) << s.name;
  });
}

TEST(HalfVectorWarp, PairsAreConsistent) { check_pairs_are_consistent<HalfVectorWarp>(half_vector_settings()); }
TEST(MirrorLobeWarp, PairsAreConsistent) { check_pairs_are_consistent<MirrorLobeWarp>(mirror_settings()); }
TEST(HemisphereWarp, PairsAreConsistent) { check_pairs_are_consistent<HemisphereWarp>(hemisphere_settings()); }
TEST(NearMirrorWarp, PairsAreConsistent) { check_pairs_are_consistent<NearMirrorWarp>(near_mirror_settings()); }

/// In double nothing is lost that the formulas of the lobe need: slopes and cosines to 12 digits, or the gap to the
/// axis.
template <template <class> class WarpIn>
void check_double_keeps_its_digits(const std::vector<Setting>& all, bool half_vector) {
  for_random_places<WarpIn<double>>(
      all, [half_vector](const Setting& s, const WarpIn<double>& warp, int panel, double u, double v) {
        const WarpIn<Quad> exact_warp(s.lobe, s.l, tolerance);
        const Sample<double> sample = warp.point(panel, warp.line(panel, v), u);
        const Sample<Quad> exact = exact_warp.point(panel, exact_warp.line(panel, Quad(v)), Quad(u));
        const DirectionPair<double>& d = sample.pair;
        // the V-cavity's edges lose digits near grazing: they are places to divide at, and may move
        const double digits = s.lobe.kink_v_cavity && s.l.cos_theta < 0.1 ? 1e-8 : 1e-12;
        const DirectionPair<Quad>& e = exact.pair;
        const std::string where =
            s.name + ", panel " + std::to_string(panel) + ", u " + std::to_string(u) + ", v " + std::to_string(v);
        EXPECT_LE(relative(Quad(d.cos_theta_l), e.cos_theta_l), 1e-15) << where;
        // α near 90° is taken from 1 − cosα: absolute digits, and no lobe of this kind divides by cosθ_V alone
        const double absolute = half_vector ? 0 : 4e-15;
        EXPECT_LE(abs(Quad(d.cos_theta_v - e.cos_theta_v)), digits * e.cos_theta_v + absolute) << where;
        EXPECT_LE(abs(Quad(sample.weight - exact.weight)), digits * exact.weight + 4 * pi<double> * absolute) << where;
        EXPECT_NEAR(d.v_x, static_cast<double>(e.v_x), digits) << where;
        EXPECT_NEAR(d.v_y, static_cast<double>(e.v_y), digits) << where;
        if (half_vector) {
          EXPECT_LE(relative(Quad(d.cos_theta_d), e.cos_theta_d), digits) << where;
          EXPECT_LE(relative(Quad(d.cos_theta_h), e.cos_theta_h), digits) << where;
          const double slope = std::sqrt(tan2_theta_h(d));
          EXPECT_NEAR(d.slope_x, static_cast<double>(e.slope_x), digits * slope) << where;
          EXPECT_NEAR(d.slope_y, static_cast<double>(e.slope_y), digits * slope) << where;
        } else {
          EXPECT_LE(relative(Quad(d.axis_gap), e.axis_gap), digits) << where;
        }
      });
}

TEST(HalfVectorWarp, DoubleKeepsItsDigits) {
  check_double_keeps_its_digits<HalfVectorWarp>(half_vector_settings(), true);
}
TEST(MirrorLobeWarp, DoubleKeepsItsDigits) { check_double_keeps_its_digits<MirrorLobeWarp>(mirror_settings(), false); }

/// weight = cosθ_V |∂V/∂u × ∂V/∂v|, twice that where half of the domain stands for all of it.
template <template <class> class WarpIn>
void check_jacobian(const std::vector<Setting>& all, const std::function<int(const Setting&)>& multiplicity) {
  for_random_places<WarpIn<Quad>>(all, [&](const Setting& s, const WarpIn<Quad>& warp, int panel, double u, double v) {
    if (u < 1e-4 || u > 1 - 1e-4 || v < 1e-4 || v > 1 - 1e-4) return;
    const Quad h = 1e-9;
    const auto at = [&](const Quad& x, const Quad& y) {
      return viewer(warp.point(panel, warp.line(panel, y), x).pair);
    };
    const auto derivative = [&](const UnitVector<Quad>& a, const UnitVector<Quad>& b) {
      return UnitVector<Quad>{(b.x - a.x) / (2 * h), (b.y - a.y) / (2 * h), (b.z - a.z) / (2 * h)};
    };
    const UnitVector<Quad> du = derivative(at(u - h, v), at(u + h, v)), dv = derivative(at(u, v - h), at(u, v + h));
    const Quad x = du.y * dv.z - du.z * dv.y, y = du.z * dv.x - du.x * dv.z, z = du.x * dv.y - du.y * dv.x;
    const Sample<Quad> sample = warp.point(panel, warp.line(panel, Quad(v)), Quad(u));
    const Quad expected = sample.pair.cos_theta_v * sqrt(Quad(square(x) + square(y) + square(z))) * multiplicity(s);
    EXPECT_LE(relative(sample.weight, expected), 1e-9) << s.name << ", panel " << panel << ", u " << u << ", v " << v;
  });
}

TEST(HalfVectorWarp, WeightIsTheJacobian) {
  check_jacobian<HalfVectorWarp>(half_vector_settings(),
                                 [](const Setting& s) { return mirror_symmetric(s.lobe, s.l) ? 2 : 1; });
}
TEST(MirrorLobeWarp, WeightIsTheJacobian) {
  check_jacobian<MirrorLobeWarp>(mirror_settings(), [](const Setting&) { return 2; });
}
TEST(NearMirrorWarp, WeightIsTheJacobian) {
  check_jacobian<NearMirrorWarp>(near_mirror_settings(), [](const Setting&) { return 2; });
}
TEST(HemisphereWarp, WeightIsTheJacobian) {
  check_jacobian<HemisphereWarp>(hemisphere_settings(), [](const Setting& s) {
    return s.lobe.is<CosineLobe>() || mirror_symmetric(s.lobe, s.l) ? 2 : 1;
  });
}

/// The weight alone: ∫ cosθ dω over what a warp covers.
template <class WarpOfDouble>
class Coverage final : public Integrand<double> {
 public:
  explicit Coverage(const Setting& s) : warp_(s.lobe, s.l, tolerance) { panels_ = warp_.panels(); }

  void points(int panel, const double* u, const double* v, double* w, int count) const override {
    for (int i = 0; i < count; ++i) w[i] = warp_.point(panel, warp_.line(panel, v[i]), u[i]).weight;
  }
  void grid(int panel, const double* u, int count_u, const double* v, int count_v, double* w) const override {
    for (int j = 0; j < count_v; ++j) {
      const auto line = warp_.line(panel, v[j]);
      for (int i = 0; i < count_u; ++i) w[i * count_v + j] = warp_.point(panel, line, u[i]).weight;
    }
  }

 private:
  WarpOfDouble warp_;
};

/// A lobe that nothing but the horizon ends covers the hemisphere: ∫ cosθ dω = π.
TEST(HalfVectorWarp, CoversTheHemisphere) {
  std::vector<Setting> all = settings({{"ggx 0.3", slope_lobe(0, Profile::ggx, 0.3, 0.3)},
                                       {"ggx anisotropic", slope_lobe(0, Profile::ggx, 1, 0.2)},
                                       {"ggx along y", slope_lobe(0, Profile::ggx, 0.2, 1)},
                                       {"huge gaussian", slope_lobe(0, Profile::gaussian, 50, 50)}});
  for (const Setting& s : all) {
    if (s.l.cos_theta < 0.1) continue;  // slopes up to tan of almost 90°: the lobe that covers them must be wider still
    const auto e = gauss<double>(Coverage<HalfVectorWarp<double>>(s), {.tolerance = 1e-8});
    EXPECT_EQ(e.status, Status::converged) << s.name;
    EXPECT_NEAR(e.value, pi<double>, e.error) << s.name;
  }
}

/// Panels divided at kinks leave no gap and don't overlap.
TEST(HalfVectorWarp, KinksOnlyDivideIt) {
  for (const Direction& l : directions()) {
    if (l.cos_theta < 0.1) continue;
    const auto area = [&](Lobe lobe) {
      const auto e = gauss<double>(Coverage<HalfVectorWarp<double>>({"", lobe, l}), {.tolerance = 1e-9});
      EXPECT_EQ(e.status, Status::converged);
      return e.value;
    };
    for (const double width : {0.2, 0.7, 3.0}) {
      const Lobe plain = slope_lobe(0, Profile::gaussian, width, width);
      const double whole = area(plain);
      EXPECT_NEAR(area(with(plain, [](Lobe& lobe) { lobe.kink_equal_cosines = true; })), whole, 1e-8 * whole) << width;
      EXPECT_NEAR(area(with(plain, [](Lobe& lobe) { lobe.kink_v_cavity = true; })), whole, 1e-8 * whole) << width;
      EXPECT_NEAR(area(with(plain, [](Lobe& lobe) { lobe.horizon_exponent = 0.5; })), whole, 1e-8 * whole) << width;
      EXPECT_NEAR(area(with(plain, [](Lobe& lobe) { lobe.horizon_layer = true; })), whole, 1e-8 * whole) << width;
    }
  }
}

TEST(HemisphereWarp, CoversTheHemisphere) {
  for (const Setting& s : hemisphere_settings()) {
    const auto e = gauss<double>(Coverage<HemisphereWarp<double>>(s), {.tolerance = 1e-8, .budget = 1'000'000});
    EXPECT_NEAR(e.value, pi<double>, 1e-10) << s.name;
  }
}

TEST(NearMirrorWarp, CoversTheHemisphere) {
  for (const Setting& s : near_mirror_settings()) {
    const auto e = gauss<double>(Coverage<NearMirrorWarp<double>>(s), {.tolerance = 1e-8, .budget = 1'000'000});
    EXPECT_EQ(e.status, Status::converged) << s.name;
    EXPECT_NEAR(e.value, pi<double>, e.error) << s.name;
  }
}

/// Near R, where L + V is a small difference, its slopes keep their digits.
TEST(NearMirrorWarp, SlopesKeepTheirDigitsAtTheMirrorDirection) {
  for (const Setting& s : near_mirror_settings()) {
    const NearMirrorWarp<double> warp(s.lobe, s.l, tolerance);
    const NearMirrorWarp<Quad> exact_warp(s.lobe, s.l, tolerance);
    for (int panel = 1; panel < static_cast<int>(warp.panels().size()); ++panel) {
      for (const double place : {1e-9, 1e-6, 1e-3, 0.1}) {
        const DirectionPair<double> d = warp.point(panel, warp.line(panel, place), place).pair;
        const DirectionPair<Quad> e = exact_warp.point(panel, exact_warp.line(panel, Quad(place)), Quad(place)).pair;
        const double exact = static_cast<double>(Quad(sqrt(tan2_theta_h(e))));
        EXPECT_NEAR(std::sqrt(tan2_theta_h(d)), exact, 1e-12 * exact) << s.name << ", panel " << panel << ", " << place;
        EXPECT_LE(relative(Quad(d.cos_theta_v), e.cos_theta_v), 1e-12)
            << s.name << ", panel " << panel << ", " << place;
      }
    }
  }
}

/// The hemisphere around the axis, seen from the surface: ∫ cosθ_V dω = π(1 + cosθ_A)/2.
TEST(MirrorLobeWarp, CoversTheHemisphereAroundItsAxis) {
  for (const Setting& s :
       settings({{"n 0", mirror_lobe(0, 0)},
                 {"max of cosines", with(mirror_lobe(0, 0), [](Lobe& lobe) { lobe.kink_equal_cosines = true; })}})) {
    const auto e = gauss<double>(Coverage<MirrorLobeWarp<double>>(s), {.tolerance = 1e-8});
    EXPECT_EQ(e.status, Status::converged) << s.name;
    EXPECT_NEAR(e.value, pi<double> * (1 + s.l.cos_theta) / 2, e.error + 1e-11) << s.name;
  }
}

/// Blocks do what one point at a time does.
TEST(HalfVectorWarp, BlockIsTheSameAsDouble) {
  for (const Setting& s : half_vector_settings()) {
    const HalfVectorWarp<double> warp(s.lobe, s.l, tolerance);
    const HalfVectorWarp<Block> blocks(s.lobe, s.l, tolerance);
    ASSERT_EQ(warp.panels().size(), blocks.panels().size()) << s.name;
    for (int panel = 0; panel < static_cast<int>(warp.panels().size()); ++panel) {
      const bool other_map =
          blocks.panels()[static_cast<std::size_t>(panel)].u.kind == AxisKind::gaussian && s.lobe.horizon_exponent != 1;
      if (other_map) continue;  // needs no map at its end
      const Block u = Block::generate([](int i) { return (i + 0.5) / block_width; });
      const Block v = Block::generate([](int i) { return 0.9 - 0.1 * i; });
      const Sample<Block> together = blocks.point(panel, blocks.line(panel, v), u);
      for (int i = 0; i < block_width; ++i) {
        const Sample<double> alone = warp.point(panel, warp.line(panel, v[i]), u[i]);
        EXPECT_LE(relative(Quad(together.weight[i]), Quad(alone.weight)), 1e-12) << s.name;
        EXPECT_LE(relative(Quad(together.pair.cos_theta_v[i]), Quad(alone.pair.cos_theta_v)), 1e-12) << s.name;
      }
    }
  }
}

}  // namespace
}  // namespace albedo
