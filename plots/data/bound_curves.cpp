#include "plots/data/bound_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "numerics/parallel.hpp"

namespace albedo::analysis {
namespace {

using Point = std::array<double, 3>;

/// The largest function(V) over the directions of a box.
template <class Function>
double largest(const DirectionBox& box, const Function& function) {
  constexpr int steps = 8;
  const Point low{box.x_min, box.y_min, box.z_min}, high{box.x_max, box.y_max, box.z_max};
  const auto value = [&](const Point& p) {
    const double length = std::hypot(p[0], p[1], p[2]);
    return function(UnitVector<double>{p[0] / length, p[1] / length, p[2] / length});
  };
  Point best = low;
  double most = value(low);
  const auto look = [&](const Point& p) {
    const double here = value(p);
    if (here > most) most = here, best = p;
  };
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      for (int k = 0; k <= steps; ++k) {
        const auto along = [&](std::size_t axis, int step) {
          return low[axis] + (high[axis] - low[axis]) * step / steps;
        };
        look({along(0, i), along(1, j), along(2, k)});
      }
    }
  }
  for (double step = 1.0 / steps; step > 1e-9;) {
    const double before = most;
    const Point from = best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        Point p = from;
        p[axis] = std::clamp(p[axis] + sign * step * (high[axis] - low[axis]), low[axis], high[axis]);
        look(p);
      }
    }
    if (!(most > before)) step /= 2;
  }
  return most;
}

BoundedBox bounded_box(const Ward& ward, const Direction& l, double side, double theta) {
  const Direction middle = Direction::from_degrees(std::abs(theta), theta < 0 ? 0 : 180);
  const auto m = unit_vector<double>(middle);
  const double half = side / 2;
  BoundedBox result{.theta = theta, .box = {m.x - half, m.x + half, m.y - half, m.y + half, m.z - half, m.z + half}};
  const auto light = unit_vector<double>(l);
  const auto product = [&](const UnitVector<double>& v) {
    if (!(v.z > 0)) return 0.0;
    const auto pair = direction_pair(light, v, {-light.x, -light.y, light.z});
    return (ward.evaluate(0, pair) + ward.evaluate(1, pair)) * pair.cos_theta_v;
  };
  result.cosine_bound = cosine_bound(result.box);
  result.cosine = largest(result.box, [](const UnitVector<double>& v) { return v.z; });
  result.product_bound = upper_bound(ward, l, result.box);
  result.product = largest(result.box, product);
  result.at_middle = product(m);
  return result;
}

}  // namespace

BoundCurve bound_curve(const Ward& ward, const Direction& l, double side, const std::vector<double>& thetas) {
  BoundCurve curve{.side = side, .boxes = std::vector<BoundedBox>(thetas.size())};
  in_parallel(thetas.size(), 0, [&](std::size_t i) { curve.boxes[i] = bounded_box(ward, l, side, thetas[i]); });
  return curve;
}

}  // namespace albedo::analysis
