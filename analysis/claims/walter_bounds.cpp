#include "analysis/claims/walter_bounds.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <random>

#include "albedo/bounds.hpp"
#include "analysis/claims/measure.hpp"

namespace albedo::analysis {
namespace {

using Point = std::array<double, 3>;

double uniform(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11) * 0x1p-53; }

struct Interval {
  double low, high;

  [[nodiscard]] double least_square() const { return low <= 0 && high >= 0 ? 0 : std::min(low * low, high * high); }
  [[nodiscard]] double largest_square() const { return std::max(low * low, high * high); }
};

using Box = std::array<Interval, 3>;

constexpr int points = 64;  // looked at in a box

/// A corner, or a point anywhere in a box.
Point point_of(const Box& box, int number, std::mt19937_64& engine) {
  Point p{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double t = number < 8 ? ((number >> k) & 1) : uniform(engine);
    p[k] = box[k].low + t * (box[k].high - box[k].low);
  }
  return p;
}

/// Eq. 27: the largest top/|(top, others...)|
double largest_ratio(const Interval& top, std::initializer_list<Interval> others) {
  double sum = top.high * top.high;
  for (const Interval& other : others) sum += top.high >= 0 ? other.least_square() : other.largest_square();
  return sum > 0 ? top.high / std::sqrt(sum) : 1;
}

double least_ratio(const Interval& top, std::initializer_list<Interval> others) {
  return -largest_ratio({-top.high, -top.low}, others);
}

/// One reading of eqs. 28-31.
struct Reading {
  const char* name;
  bool y_on_top;  ///< eq. 29 as printed, v_y*; otherwise v_x*
  bool theta_o;   ///< eq. 31 as printed, theta_o*; otherwise theta_n*
  int violations = 0;
};

/// The bound of N.H over a box in the frame whose z axis is i and whose y axis is normal to N.
double half_vector_bound(const Box& box, double cos_n, const Reading& reading) {
  const Interval &x = box[0], &y = box[1];
  const double azimuth = std::clamp(reading.y_on_top ? largest_ratio(y, {x}) : largest_ratio(x, {y}), -1.0, 1.0);
  const double most = largest_ratio(box[2], {x, y}), least = least_ratio(box[2], {x, y});
  const double nearest = std::sqrt((1 + most) / 2), farthest = std::sqrt(std::max(1 + least, 0.0) / 2);
  const double c = reading.theta_o ? most : cos_n, c2 = c * c, s2 = 1 - c2;
  const double denominator = c2 + s2 * azimuth * azimuth;
  const double best = azimuth < 0 ? 1 : denominator > 0 ? std::sqrt(c2 / denominator) : 0;
  const double cos_h = std::clamp(best, farthest, nearest), sin_h = std::sqrt(1 - cos_h * cos_h);
  return std::sqrt(1 - cos_n * cos_n) * sin_h * azimuth + cos_n * cos_h;
}

/// Whether f cos theta_V of Ward's model exceeds the toolkit's bound somewhere in a box in the surface's frame.
bool exceeds_library(const Ward& ward, const Direction& l, const Box& box, std::mt19937_64& engine) {
  const double bound =
      upper_bound(ward, l, {box[0].low, box[0].high, box[1].low, box[1].high, box[2].low, box[2].high});
  const auto light = unit_vector<double>(l);
  for (int j = 0; j < points; ++j) {
    const Point p = point_of(box, j, engine);
    const double length = std::hypot(p[0], p[1], p[2]);
    if (!(length > 0) || p[2] <= 0) continue;
    const UnitVector<double> v{p[0] / length, p[1] / length, p[2] / length};
    const auto d = direction_pair(light, v, {-light.x, -light.y, light.z});
    if (ward.evaluate(0, d) * d.cos_theta_v > bound * (1 + 1e-9)) return true;
  }
  return false;
}

}  // namespace

Finding bounds_as_printed(const ModelSource& make) {
  constexpr int boxes = 4000;
  constexpr double slack = 1e-9;
  std::array readings{Reading{"as printed", true, true}, Reading{"eq. 29 with v_x*", false, true},
                      Reading{"eq. 31 with theta_n*", true, false}, Reading{"both corrected", false, false}};
  std::mt19937_64 engine(3);
  int cosine_violations = 0, counted = 0, product_printed = 0, product_corrected = 0, library = 0;
  Worst worst;
  const double alpha = 0.2;
  const auto ward = make("ward", {{"alpha", alpha}});
  for (int i = 0; i < boxes; ++i) {
    const double cos_n = 0.05 + 0.95 * uniform(engine), sin_n = std::sqrt(1 - cos_n * cos_n);
    const Direction l{cos_n, sin_n, 1, 0};
    // frame of i: x* = towards N, so that N = (sin_n, 0, cos_n); the surface's x axis has i at azimuth 0
    const auto to_surface = [&](const Point& p) {
      return Point{-cos_n * p[0] + sin_n * p[2], -p[1], sin_n * p[0] + cos_n * p[2]};
    };
    Box box;
    const double size = std::pow(10, -2 + 2 * uniform(engine));
    for (Interval& side : box) {
      const double middle = 2 * uniform(engine) - 1, half = size * uniform(engine) / 2;
      side = {middle - half, middle + half};
    }
    if (exceeds_library(Ward{.alpha_x = alpha, .alpha_y = alpha}, l, box, engine)) ++library;
    double cosine = -1, half = 0, product = 0;
    for (int j = 0; j < points; ++j) {
      const Point p = point_of(box, j, engine);
      const double length = std::hypot(p[0], p[1], p[2]);
      if (!(length > 0)) continue;
      cosine = std::max(cosine, p[2] / length);
      const Point s = to_surface({p[0] / length, p[1] / length, p[2] / length});
      if (s[2] <= 0) continue;
      const auto light = unit_vector<double>(l);
      const auto d = direction_pair(light, UnitVector<double>{s[0], s[1], s[2]}, {-light.x, -light.y, light.z});
      half = std::max(half, d.cos_theta_h);
      product = std::max(product, ward->evaluate(0, d) * d.cos_theta_v);
    }
    if (cosine > largest_ratio(box[2], {box[0], box[1]}) + slack) ++cosine_violations;
    if (half <= 0) continue;
    ++counted;
    const auto ward_bound = [&](double bound) {  // eqs. 32, 33 with cos theta_o <= 1
      const double c2 = square(std::clamp(bound, 1e-6, 1.0));
      return std::exp(-(1 - c2) / c2 / square(alpha)) / (4 * pi<double> * square(alpha) * std::sqrt(cos_n));
    };
    for (Reading& reading : readings) {
      const double bound = half_vector_bound(box, cos_n, reading);
      if (half > bound + slack) ++reading.violations;
      const bool exceeded = product > ward_bound(bound) * (1 + 1e-6);
      if (&reading == &readings.front() && exceeded) {
        ++product_printed;
        worst.look(half - bound, "N.H = " + show(half, 4) + " where the bound says " + show(bound, 4));
      }
      if (&reading == &readings.back() && exceeded) ++product_corrected;
    }
  }
  Finding finding;
  finding.quantities.push_back({"boxes", static_cast<double>(counted), 0});
  finding.quantities.push_back({"violations of the library's bound", static_cast<double>(library), 0});
  finding.quantities.push_back({"violations of eq. 27", static_cast<double>(cosine_violations), 0});
  std::vector<std::string> parts;
  const auto percent = [&](int violations) { return show(100.0 * violations / counted, 3) + " %"; };
  for (const Reading& reading : readings) {
    finding.quantities.push_back(
        {std::string("violations ") + reading.name, static_cast<double>(reading.violations), 0});
    parts.push_back(std::string(reading.name) + " " + percent(reading.violations));
  }
  const bool first = cosine_violations == 0, second = product_printed == 0, corrected = product_corrected == 0;
  finding.verdict = first && second                                                         ? ClaimVerdict::holds
                    : first && corrected && library == 0 && readings.back().violations == 0 ? ClaimVerdict::holds_if
                                                                                            : ClaimVerdict::fails;
  finding.found = std::to_string(boxes) + " random boxes, 64 points each: eq. 27 is exceeded in " +
                  std::to_string(cosine_violations) + ", the bound of N.H: " + list_of(parts) +
                  "; f cos theta_o (alpha=0.2) as printed in " + percent(product_printed) + ", corrected in " +
                  percent(product_corrected) + "; the library's own bound in " + std::to_string(library);
  if (finding.verdict != ClaimVerdict::holds_if) return finding;
  finding.condition = "eq. 29 has v_x* for v_y* on top and eq. 31 has theta_n* for theta_o*";
  finding.worst = worst.where;
  finding.repair = "these two symbols (doc/bounds.md)";
  return finding;
}

}  // namespace albedo::analysis
