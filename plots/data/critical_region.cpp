#include "plots/data/critical_region.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "albedo/core/errors.hpp"

namespace albedo::analysis {
namespace {

using Vector = UnitVector<double>;

const double degree = pi<double> / 180;

Vector light(double theta) { return {std::sin(theta * degree), 0, std::cos(theta * degree)}; }

/// The direction at a place of the chart; below the horizon beyond 90.
Vector from_hemisphere(const ChartPoint& point) {
  const double theta = std::hypot(point.x, point.y) * degree, phi = std::atan2(point.y, point.x);
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

double half_vector_angle(const Vector& l, const Vector& v) {
  return std::atan2(std::hypot(l.x + v.x, l.y + v.y), l.z + v.z) / degree;
}

std::vector<Vector> mirrored_cap(const CriticalDomains& domains, double theta_l, int points) {
  const Vector l = light(theta_l);
  const double s = std::sin(domains.cap_angle * degree), c = std::cos(domains.cap_angle * degree);
  std::vector<Vector> outline;
  for (int i = 0; i <= points; ++i) {
    const double psi = 2 * pi<double> * i / points;
    const Vector h{s * std::cos(psi), s * std::sin(psi), c};
    const double twice = 2 * (h.x * l.x + h.y * l.y + h.z * l.z);
    outline.push_back({twice * h.x - l.x, twice * h.y - l.y, twice * h.z - l.z});
  }
  return outline;
}

/// ∮ cosθ dφ around an outline that N isn't in.
double solid_angle_within(const std::vector<Vector>& outline) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const Vector &a = outline[i], &b = outline[i + 1];
    sum += (a.z + b.z) / 2 * std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
  }
  return std::abs(sum);
}

}  // namespace

ChartPoint hemisphere_point(const Vector& direction) {
  const double across = std::hypot(direction.x, direction.y);
  if (across == 0) return {};
  const double theta = std::atan2(across, direction.z) / degree;
  return {theta * direction.x / across, theta * direction.y / across};
}

ChartPoint slope_point(const Vector& l, const Vector& v) {
  return {(l.x + v.x) / (l.z + v.z), (l.y + v.y) / (l.z + v.z)};
}

double furthest_half_vector(const CriticalDomains& domains, const Vector& v) {
  constexpr int steps = 64;  // the furthest is at an end of the arc but for V near N; a grid has both
  double furthest = 0;
  for (int i = 0; i <= steps; ++i) {
    const double theta = domains.first_theta + (90 - domains.first_theta) * i / steps;
    furthest = std::max(furthest, half_vector_angle(light(theta), v));
  }
  return furthest;
}

CriticalRegion critical_region(const CriticalDomains& domains, int points) {
  const double first = domains.first_theta, cap = domains.cap_angle;
  if (!(cap > 0 && cap <= 20)) {
    throw ParameterError("cap_angle is " + std::to_string(cap) + " and must be within (0, 20]");
  }
  if (!(first >= 90 - 8 * cap && first < 90)) {
    throw ParameterError("first_theta is " + std::to_string(first) + " and must be within [" +
                         std::to_string(90 - 8 * cap) + ", 90)");
  }
  CriticalRegion result{.domains = domains,
                        .from_first = mirrored_cap(domains, first, points),
                        .from_last = mirrored_cap(domains, 90, points)};
  // in the plane of incidence H is halfway between N's side and the mirror's: |theta_L - theta_V|/2 is within the cap
  const double nearest = 90 - 2 * cap, furthest = std::min(90.0, first + 2 * cap);
  if (nearest >= furthest) return result;
  const ChartPoint middle{-(nearest + furthest) / 2, 0};
  const auto inside = [&](const ChartPoint& point) {
    const Vector v = from_hemisphere(point);
    return v.z >= 0 && furthest_half_vector(domains, v) <= cap;
  };
  for (int i = 0; i <= points; ++i) {
    const double psi = 2 * pi<double> * i / points;
    double within = 0, beyond = 8 * cap;
    for (int k = 0; k < 40; ++k) {
      const double r = (within + beyond) / 2;
      (inside({middle.x + r * std::cos(psi), middle.y + r * std::sin(psi)}) ? within : beyond) = r;
    }
    result.region.push_back(from_hemisphere({middle.x + within * std::cos(psi), middle.y + within * std::sin(psi)}));
  }
  result.solid_angle = solid_angle_within(result.region);
  return result;
}

}  // namespace albedo::analysis
