#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "albedo/bounds.hpp"
#include "albedo/core/errors.hpp"
#include "albedo/core/quad.hpp"

/// Bounds over boxes of directions against the largest value that a search of the box finds.
namespace albedo {
namespace {

using Point = std::array<double, 3>;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double operator()(double from = 0, double to = 1) {
    return from + (to - from) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  /// Log-uniform.
  double decades(double from, double to) { return std::exp((*this)(std::log(from), std::log(to))); }
  Point direction(double least_z) {
    const double z = (*this)(least_z, 1), phi = (*this)(0, 2 * pi<double>), sine = std::sqrt(1 - z * z);
    return {sine * std::cos(phi), sine * std::sin(phi), z};
  }

 private:
  std::mt19937_64 engine_;
};

template <class T>
UnitVector<T> normalised(const std::array<T, 3>& v) {
  const T length = sqrt(T(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
  return {v[0] / length, v[1] / length, v[2] / length};
}

template <class T>
DirectionPair<T> pair_of(const Direction& l, const Point& point) {
  const UnitVector<T> light = unit_vector<T>(l), v = normalised<T>({T(point[0]), T(point[1]), T(point[2])});
  return direction_pair(light, v, {-light.x, -light.y, light.z});
}

/// f cosθ_V, 0 below the surface.
template <class T>
T value(const Ward& ward, const Direction& l, const Point& point) {
  if (point[2] <= 0) return T(0);
  const DirectionPair<T> d = pair_of<T>(l, point);
  return (ward.evaluate(0, d) + ward.evaluate(1, d)) * d.cos_theta_v;
}

Point clamped(const Point& p, const DirectionBox& b) {
  return {std::clamp(p[0], b.x_min, b.x_max), std::clamp(p[1], b.y_min, b.y_max), std::clamp(p[2], b.z_min, b.z_max)};
}

Point centre(const DirectionBox& b) {
  return {(b.x_min + b.x_max) / 2, (b.y_min + b.y_max) / 2, (b.z_min + b.z_max) / 2};
}

/// The largest value that is found: corners, random points, the points next to the mirror direction, and from the best
/// of them steps along the axes until they are a thousandth of the box.
template <class Function>
double largest_found(const Function& f, const Direction& l, const DirectionBox& box, Random& random, Point* at) {
  double best = -std::numeric_limits<double>::infinity();
  Point where{};
  const auto look = [&](const Point& p) {
    if (p[0] == 0 && p[1] == 0 && p[2] == 0) return false;
    const double found = f(p);
    if (!(found > best)) return false;
    best = found, where = p;
    return true;
  };
  for (int corner = 0; corner < 8; ++corner) {
    look({(corner & 1) != 0 ? box.x_max : box.x_min, (corner & 2) != 0 ? box.y_max : box.y_min,
          (corner & 4) != 0 ? box.z_max : box.z_min});
  }
  for (int i = 0; i < 24; ++i) {
    look({random(box.x_min, box.x_max), random(box.y_min, box.y_max), random(box.z_min, box.z_max)});
  }
  const Point c = centre(box);
  const UnitVector<double> light = unit_vector<double>(l);
  const double distance = std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
  for (const double scale : {0.6, 0.8, 0.9, 1.0, 1.1, 1.2, 1.5}) {
    const double r = distance * scale;
    look(clamped({-light.x * r, -light.y * r, light.z * r}, box));
  }
  Point step{box.x_max - box.x_min, box.y_max - box.y_min, box.z_max - box.z_min};
  for (double size = 0.25; size > 1e-3; size /= 2) {
    bool better = true;
    for (int tries = 0; better && tries < 8; ++tries) {
      better = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
          Point p = where;
          p[axis] += sign * size * step[axis];
          better = look(clamped(p, box)) || better;
        }
      }
    }
  }
  if (at != nullptr) *at = where;
  return best;
}

DirectionBox box_around(const Point& centre, const Point& half) {
  return {centre[0] - half[0], centre[0] + half[0], centre[1] - half[1],
          centre[1] + half[1], centre[2] - half[2], centre[2] + half[2]};
}

/// A box whose sides are about `size` times its distance; its centre is anywhere, or close to the mirror direction.
DirectionBox random_box(Random& random, const Direction& l, double size) {
  Point c = random.direction(-0.3);
  if (random() < 0.5) {
    const UnitVector<double> light = unit_vector<double>(l);
    const double off = random.decades(1e-3, 1);
    c = {-light.x + off * random(-1, 1), -light.y + off * random(-1, 1), light.z + off * random(-1, 1)};
  }
  const double distance = random.decades(1e-3, 1e3);
  Point half{};
  for (double& h : half) h = distance * size / 2 * random(0.2, 1);
  for (double& x : c) x *= distance;
  return box_around(c, half);
}

Direction random_light(Random& random) {
  const double grazing = random.decades(1e-6, 1);
  return Direction::from_cosine(random() < 0.7 ? random(0.02, 1) : grazing, random(0, 360));
}

Ward random_ward(Random& random, bool isotropic) {
  Ward ward;
  ward.alpha_x = random.decades(1e-3, 3);
  ward.alpha_y = isotropic ? ward.alpha_x : random.decades(1e-3, 3);
  ward.rho_d = random() < 0.2 ? 0.4 : 0;
  return ward;
}

TEST(WardBound, LargestCosineIsThatOfAPointOfTheBox) {
  Random random(1);
  for (int i = 0; i < 20'000; ++i) {
    const Direction l = random_light(random);
    const DirectionBox box = random_box(random, l, random.decades(1e-4, 4));
    const double bound = cosine_bound(box);
    const auto cosine = [](const Point& p) { return normalised(p).z; };
    const double found = largest_found(cosine, l, box, random, nullptr);
    EXPECT_GE(bound, found);
    const auto end = [&](double low, double high) {
      const bool inside = low <= 0 && high >= 0;
      const double nearest = inside ? 0 : std::abs(low) < std::abs(high) ? low : high;
      return box.z_max >= 0 ? nearest : std::abs(low) > std::abs(high) ? low : high;
    };
    const Point attained{end(box.x_min, box.x_max), end(box.y_min, box.y_max), box.z_max};
    if (attained != Point{}) {
      EXPECT_NEAR(bound, cosine(attained), 1e-13);
    }
  }
}

TEST(WardBound, LargestHalfVectorCosineIsNeverBelow) {
  Random random(2);
  for (int i = 0; i < 20'000; ++i) {
    const Direction l = random_light(random);
    const DirectionBox box = random_box(random, l, random.decades(1e-4, 4));
    const double bound = half_vector_cosine_bound(l, box);
    const auto cosine = [&](const Point& p) { return p[2] > 0 ? pair_of<double>(l, p).cos_theta_h : 0.0; };
    EXPECT_GE(bound, largest_found(cosine, l, box, random, nullptr));
    EXPECT_LE(bound, 1);
  }
}

TEST(WardBound, NeverBelowTheLargestValueOfTheBox) {
  Random random(3);
  int positive = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Ward ward = random_ward(random, i % 2 == 0);
    const Direction l = random_light(random);
    const DirectionBox box = random_box(random, l, random.decades(1e-4, 4));
    const double bound = upper_bound(ward, l, box);
    Point at{};
    const auto f = [&](const Point& p) { return value<double>(ward, l, p); };
    const double found = largest_found(f, l, box, random, &at);
    // f itself loses digits where H is close to N
    ASSERT_GE(bound * (1 + 1e-10), found) << "box " << i;
    if (found <= 0) continue;
    ++positive;
    if (i % 50 == 0) {
      ASSERT_GE(Quad(bound), value<Quad>(ward, l, at)) << "box " << i;
    }
  }
  EXPECT_GT(positive, 60'000);
}

/// Nothing but rounding is between the bound of a single direction and the value there.
TEST(WardBound, SingleDirectionsAreBoundedInExactArithmetic) {
  Random random(4);
  for (int i = 0; i < 5'000; ++i) {
    Ward ward;
    ward.alpha_x = ward.alpha_y = random.decades(1e-6, 100);
    if (i % 3 == 0) ward.alpha_y = random.decades(1e-6, 100);
    const Direction l = Direction::from_cosine(random.decades(1e-12, 1), random(0, 360));
    const double width = std::max(ward.alpha_x, ward.alpha_y);
    const UnitVector<double> light = unit_vector<double>(l);
    Point v = random.direction(1e-12);
    if (i % 2 == 0) v = {-light.x + width * random(-1, 1), -light.y + width * random(-1, 1), light.z};
    const double scale = random.decades(1e-100, 1e100);
    for (double& x : v) x *= scale;
    const double bound = upper_bound(ward, l, {v[0], v[0], v[1], v[1], v[2], v[2]});
    const Quad exact = value<Quad>(ward, l, v);
    ASSERT_GE(Quad(bound), exact) << i;
    if (ward.alpha_x == ward.alpha_y && exact > 1e-280) {
      const double exponent = square(static_cast<double>(sqrt(tan2_theta_h(pair_of<Quad>(l, v)))) / width);
      const DirectionPair<double> d = pair_of<double>(l, v);
      const double of_half_vector = square(width) * square(d.cos_theta_h) * d.cos_theta_h * d.cos_theta_d;
      const double rounding = 1e-12 * (1 + exponent) + 1e-13 / of_half_vector;
      EXPECT_LE(bound, static_cast<double>(exact) * std::exp(rounding) + 1e-300) << i << ", alpha " << width;
    }
  }
}

/// The equations as they are printed: eq. 29 with v_y* over the length of (v_x*, v_y*), or eq. 31 with θ_o* in place of
/// θ_n*, its cosine the upper end of the box's range.
double printed_cos_theta_h(double theta_n, const DirectionBox& star, bool printed_29, bool printed_31) {
  const auto near = [](double low, double high) {
    return low <= 0 && high >= 0 ? 0.0 : std::min(std::abs(low), std::abs(high));
  };
  const auto far = [](double low, double high) { return std::max(std::abs(low), std::abs(high)); };
  const double top = printed_29 ? star.y_max : star.x_max;
  const double rest = printed_29 ? (top >= 0 ? near(star.x_min, star.x_max) : far(star.x_min, star.x_max))
                                 : (top >= 0 ? near(star.y_min, star.y_max) : far(star.y_min, star.y_max));
  const double cos_phi = top == 0 ? 0 : top / std::hypot(top, rest);
  const double planar = std::hypot(near(star.x_min, star.x_max), near(star.y_min, star.y_max));
  const double wide = std::hypot(far(star.x_min, star.x_max), far(star.y_min, star.y_max));
  const double high = star.z_max / std::hypot(star.z_max, star.z_max > 0 ? planar : wide);
  const double low = star.z_min / std::hypot(star.z_min, star.z_min > 0 ? wide : planar);
  const double theta = printed_31 ? std::acos(high) : theta_n;
  const double optimum =
      cos_phi >= 0 ? std::abs(std::cos(theta)) / std::hypot(std::cos(theta), std::sin(theta) * cos_phi) : 1;
  const double cos_h = std::clamp(optimum, std::sqrt((1 + low) / 2), std::sqrt((1 + high) / 2));
  return std::sin(theta_n) * std::sqrt(1 - cos_h * cos_h) * cos_phi + std::cos(theta_n) * cos_h;
}

TEST(WardBound, EquationsAsPrintedAreNoBounds) {
  const auto degrees = [](double angle) { return angle * pi<double> / 180; };
  const Ward ward{.alpha_x = 0.2, .alpha_y = 0.2};
  const double peak = 1 / (4 * pi<double> * 0.04);  // f cosθ_V at the mirror direction
  const auto bound = [&](double cos_h) { return peak * std::exp(-(1 / (cos_h * cos_h) - 1) / 0.04); };
  // L at 45° from N: in the frame around L the mirror direction is the x* axis
  const DirectionBox mirror{1, 1, 0, 0, 0, 0};
  EXPECT_NEAR(bound(printed_cos_theta_h(degrees(45), mirror, false, false)), peak, 1e-12);
  EXPECT_LT(bound(printed_cos_theta_h(degrees(45), mirror, true, false)), 1e-10 * peak);  // eq. 29
  EXPECT_NEAR(printed_cos_theta_h(degrees(45), mirror, true, false), 0.5, 1e-12);
  // V at 45° … 135° from L, in the plane of incidence, the mirror direction in its middle
  const DirectionBox around{1, 1, 0, 0, -1, 1};
  EXPECT_NEAR(bound(printed_cos_theta_h(degrees(45), around, false, false)), peak, 1e-12);
  EXPECT_NEAR(printed_cos_theta_h(degrees(45), around, false, true), 1, 1e-12);  // by chance: θ_o* is θ_n*
  const DirectionBox nearer{1, 1, 0, 0, -1, std::tan(degrees(30))};
  EXPECT_NEAR(bound(printed_cos_theta_h(degrees(45), nearer, false, false)), peak, 1e-12);
  const double printed_31 = printed_cos_theta_h(degrees(45), nearer, false, true);
  EXPECT_NEAR(printed_31, std::cos(degrees(15)), 1e-12);
  EXPECT_NEAR(bound(printed_31) / peak, 0.1662, 1e-4);

  // the same boxes in the surface's frame
  const Direction l = Direction::from_degrees(45);
  const double s = std::sqrt(0.5);
  EXPECT_GE(upper_bound(ward, l, {-s, -s, 0, 0, s, s}), peak);
  EXPECT_GE(upper_bound(ward, l, {-1.2, -0.2, 0, 0, 0.2, 1.2}), peak);
}

/// How often the printed forms fail: random boxes in the frame around L.
TEST(WardBound, EquationsAsPrintedFailOften) {
  Random random(5);
  std::array<int, 4> failures{};
  constexpr int boxes = 20'000;
  for (int i = 0; i < boxes; ++i) {
    const double theta_n = random(0.05, 1.5), size = random.decades(1e-2, 2);
    Point c = random.direction(-0.9);
    const DirectionBox box = box_around(c, {size * random() / 2, size * random() / 2, size * random() / 2});
    double largest = -1;
    for (int k = 0; k < 60; ++k) {
      UnitVector<double> v =
          normalised(Point{random(box.x_min, box.x_max), random(box.y_min, box.y_max), random(box.z_min, box.z_max)});
      const UnitVector<double> h = normalised(Point{v.x, v.y, v.z + 1});
      largest = std::max(largest, std::sin(theta_n) * h.x + std::cos(theta_n) * h.z);
    }
    for (std::size_t form = 0; form < failures.size(); ++form) {
      const double bound = printed_cos_theta_h(theta_n, box, (form & 1U) != 0, (form & 2U) != 0);
      failures[form] += bound < largest - 1e-12 ? 1 : 0;
    }
  }
  std::printf(
      "of %d boxes, N.H exceeds the bound in %d (v_x* and theta_n*), %d (eq. 29 as printed), %d (eq. 31), %d (both)\n",
      boxes, failures[0], failures[1], failures[2], failures[3]);
  EXPECT_EQ(failures[0], 0);
  EXPECT_GT(failures[1], 1000);
  EXPECT_GT(failures[2], 1000);
}

/// Eqs. 27–33 alone, with the larger roughness.
double bound_by_angle(const Ward& ward, const Direction& l, const DirectionBox& box) {
  const double cos_h = half_vector_cosine_bound(l, box), wide = std::max(ward.alpha_x, ward.alpha_y);
  return std::sqrt(cosine_bound(box) / l.cos_theta) * std::exp(-(1 / square(cos_h) - 1) / square(wide)) /
         (4 * pi<double> * ward.alpha_x * ward.alpha_y);
}

struct Ratios {
  explicit Ratios(std::vector<double> all) {
    std::sort(all.begin(), all.end());
    median = all[all.size() / 2], high = all[all.size() * 19 / 20], worst = all.back();
  }
  double median, high, worst;
};

/// bound/largest value, where the value isn't negligible: the table of doc/bounds.md.
TEST(WardBound, Tightness) {
  Random random(6);
  std::printf("                      eqs. 27-33                    with slopes\n");
  std::printf("alpha_x alpha_y size   median   95 %%    worst       median   95 %%    worst\n");
  for (const auto& [alpha_x, alpha_y] :
       std::vector<std::pair<double, double>>{{0.05, 0.05}, {0.2, 0.2}, {0.6, 0.6}, {0.4, 0.1}}) {
    for (const double size : {0.001, 0.01, 0.03, 0.1, 0.3, 1.0}) {
      const Ward ward{.alpha_x = alpha_x, .alpha_y = alpha_y};
      std::vector<double> by_angle, by_both;
      while (by_both.size() < 1000) {
        const Direction l = Direction::from_cosine(random(0.1, 1), random(0, 360));
        const UnitVector<double> light = unit_vector<double>(l);
        // V of a half vector within two widths of N
        const double x = 2 * alpha_x * random(-1, 1), y = 2 * alpha_y * random(-1, 1);
        const UnitVector<double> h = normalised(Point{x, y, 1});
        const double twice = 2 * (light.x * h.x + light.y * h.y + light.z * h.z);
        const Point v{twice * h.x - light.x, twice * h.y - light.y, twice * h.z - light.z};
        if (v[2] < 0.05) continue;
        const DirectionBox box = box_around(v, {size / 2, size / 2, size / 2});
        const auto f = [&](const Point& p) { return value<double>(ward, l, p); };
        const double found = largest_found(f, l, box, random, nullptr);
        by_angle.push_back(bound_by_angle(ward, l, box) / found);
        by_both.push_back(upper_bound(ward, l, box) / found);
      }
      const Ratios angle(by_angle), both(by_both);
      std::printf("%-7g %-7g %-6g %-8.4g %-7.4g %-11.4g %-8.4g %-7.4g %.4g\n", alpha_x, alpha_y, size, angle.median,
                  angle.high, angle.worst, both.median, both.high, both.worst);
      EXPECT_GE(both.median, 1);
      EXPECT_LE(both.worst, angle.worst * (1 + 1e-12));
      EXPECT_LE(both.median, 1.4) << size << ", alpha " << alpha_x << ", " << alpha_y;
      EXPECT_LE(both.worst, 12) << size << ", alpha " << alpha_x << ", " << alpha_y;
    }
  }
}

TEST(WardBound, WholeSphereAndBelowTheSurface) {
  const Ward ward{.alpha_x = 0.3, .alpha_y = 0.2, .rho_s = 0.5, .rho_d = 0.2};
  const Direction l = Direction::from_degrees(60, 20);
  const double peak = 0.5 / (4 * pi<double> * 0.06);
  const double all = upper_bound(ward, l, {-1, 1, -1, 1, -1, 1});
  EXPECT_NEAR(all, 0.2 / pi<double> + peak * std::sqrt(2), 1e-12 * all);
  EXPECT_EQ(half_vector_cosine_bound(l, {-1, 1, -1, 1, -1, 1}), 1);
  EXPECT_EQ(cosine_bound({-1, 1, -1, 1, -1, 1}), 1);
  EXPECT_EQ(upper_bound(ward, l, {-1, 1, -1, 1, -1, -0.5}), 0);
  EXPECT_EQ(upper_bound(ward, l, {-1, 1, -1, 1, -1, 0}), 0);
  EXPECT_EQ(half_vector_cosine_bound(l, {-1, 1, -1, 1, -1, 0}), 0);
  EXPECT_NEAR(cosine_bound({1, 2, -3, 1, -4, -0.5}), -0.5 / std::sqrt(4 + 9 + 0.25), 1e-13);
  const Direction horizon = Direction::from_degrees(90);
  EXPECT_EQ(upper_bound(ward, horizon, {-1, 1, -1, 1, 0.1, 1}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(upper_bound({.rho_s = 0, .rho_d = 1}, horizon, {0, 0, 0, 0, 1, 1}),
            upper_bound({.rho_s = 0, .rho_d = 1}, l, {0, 0, 0, 0, 1, 1}));
}

TEST(WardBound, DoesNotDependOnTheUnitOfLength) {
  const Ward ward{.alpha_x = 0.1, .alpha_y = 0.2};
  const Direction l = Direction::from_degrees(50, 20);
  const double one = upper_bound(ward, l, {-0.9, -0.7, -0.3, -0.2, 0.5, 0.8});
  for (const double unit : {1e-140, 1e140}) {
    EXPECT_NEAR(upper_bound(ward, l, {-0.9 * unit, -0.7 * unit, -0.3 * unit, -0.2 * unit, 0.5 * unit, 0.8 * unit}), one,
                1e-12 * one);
  }
}

TEST(WardBound, RefusesWhatIsNoBox) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto message = [](const DirectionBox& box) {
    try {
      cosine_bound(box);
    } catch (const ParameterError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message({2, 1, 0, 1, 0, 1}), "direction box: x_min is 2 and must be at most x_max, 1");
  EXPECT_NE(message({0, 1, nan, 1, 0, 1}).find("y_min is nan"), std::string::npos);
  EXPECT_NE(message({0, 1, 0, 1, 0, infinity}).find("z_max is inf"), std::string::npos);
  EXPECT_NE(message({1e-200, 1, 0, 1, 0, 1}).find("magnitude within [1e-150, 1e150]"), std::string::npos);
  EXPECT_EQ(message({0, 1, 0, 1, 0, 1}), "");
  EXPECT_THROW(upper_bound(Ward{}, {}, {0, 1, 0, 1, 1, -1}), ParameterError);
  EXPECT_THROW(half_vector_cosine_bound({}, {0, 1, 1, 0, 0, 1}), ParameterError);
}

}  // namespace
}  // namespace albedo
