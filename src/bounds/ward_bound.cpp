#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "albedo/bounds.hpp"
#include "albedo/core/errors.hpp"

namespace albedo {
namespace {

/// More than any of the short chains of operations below loses to rounding, relative to the largest of their terms.
constexpr double slack = 32 * std::numeric_limits<double>::epsilon();

struct Interval {
  double low, high;

  [[nodiscard]] double nearest_to_zero() const { return low > 0 ? low : high < 0 ? -high : 0; }
  [[nodiscard]] double farthest_from_zero() const { return std::max(std::abs(low), std::abs(high)); }
  [[nodiscard]] Interval widened(double by) const { return {low - by, high + by}; }
};

/// A box along the axes of some frame.
struct Box {
  Interval x, y, z;
};

/// Within what squares and products neither overflow nor underflow.
constexpr double least_coordinate = 1e-150, greatest_coordinate = 1e150;

std::string text(double value) {
  std::ostringstream stream;
  stream.precision(17);
  stream << value;
  return stream.str();
}

Interval checked(double low, double high, char axis) {
  for (const auto& [end, value] : {std::pair("_min", low), std::pair("_max", high)}) {
    const double size = std::abs(value);
    if (value == 0 || (size >= least_coordinate && size <= greatest_coordinate)) continue;
    throw ParameterError(std::string("direction box: ") + axis + end + " is " + text(value) +
                         " and must be 0 or of magnitude within [1e-150, 1e150]");
  }
  if (low > high) {
    throw ParameterError(std::string("direction box: ") + axis + "_min is " + text(low) + " and must be at most " +
                         axis + "_max, " + text(high));
  }
  return {low, high};
}

Box checked(const DirectionBox& box) {
  return {checked(box.x_min, box.x_max, 'x'), checked(box.y_min, box.y_max, 'y'), checked(box.z_min, box.z_max, 'z')};
}

/// The largest a/√(a² + b² + c²): it grows with a, and then with what makes the denominator small where a is positive,
/// large where it is negative   [eqs. 26, 27].
double largest_component(const Interval& a, const Interval& b, const Interval& c) {
  const double top = a.high;
  if (top == 0) return 0;
  if (top > 0) {
    const double rest = std::hypot(b.nearest_to_zero(), c.nearest_to_zero());
    return std::min(1.0, top / std::hypot(top, rest) * (1 + slack));
  }
  return top / std::hypot(top, b.farthest_from_zero(), c.farthest_from_zero()) * (1 - slack);
}

/// The range of a/√(a² + b² + c²).
Interval component(const Interval& a, const Interval& b, const Interval& c) {
  return {-largest_component({-a.high, -a.low}, b, c), largest_component(a, b, c)};
}

/// The range of a_x v_x + a_y v_y + a_z v_z, widened by its rounding and that of the coefficients.
Interval projection(const Box& box, double a_x, double a_y, double a_z) {
  Interval sum{0, 0};
  double size = 0;
  const auto add = [&](double a, const Interval& range) {
    sum.low += std::min(a * range.low, a * range.high);
    sum.high += std::max(a * range.low, a * range.high);
    size += std::abs(a) * range.farthest_from_zero();
  };
  add(a_x, box.x), add(a_y, box.y), add(a_z, box.z);
  return sum.widened(slack * size);
}

/// Its part above the surface: below it f cosθ_V is 0.
Box above(Box box) {
  box.z.low = std::max(box.z.low, 0.0);
  return box;
}

/// Eqs. 28–31 in the frame whose z* axis is L, with N in the half plane y* = 0, x* > 0, where H is at half V's polar
/// angle and at V's azimuth; N's polar angle is L's.
double largest_cos_theta_h(const Direction& l, const Box& box) {
  const double sine = l.sin_theta, cosine = l.cos_theta;
  const Box star{projection(box, -cosine * l.cos_phi, -cosine * l.sin_phi, sine),
                 projection(box, l.sin_phi, -l.cos_phi, 0),
                 projection(box, sine * l.cos_phi, sine * l.sin_phi, cosine)};
  const double cos_phi = largest_component(star.x, star.y, {0, 0});  // eq. 29
  const Interval cos_v = component(star.z, star.x, star.y);
  const auto cosine_h = [](double cos_theta_v) { return std::sqrt((1 + cos_theta_v) / 2); };  // eq. 30
  const auto sine_h = [](double cos_theta_v) { return std::sqrt((1 - cos_theta_v) / 2); };
  const auto at = [&](double cos_theta_v) {  // eq. 28
    return sine * sine_h(cos_theta_v) * cos_phi + cosine * cosine_h(cos_theta_v);
  };
  // at the angle of eq. 31, N·H is √(cos²θ_N + sin²θ_N cos²φ); it falls off on both sides of it
  const double top = cos_phi < 0 ? cosine : std::hypot(cosine, sine * cos_phi);
  const double optimum = top > 0 ? cosine / top : 1;
  double largest = top;
  if (optimum > cosine_h(cos_v.high)) {
    largest = at(cos_v.high);
  } else if (optimum < cosine_h(cos_v.low)) {
    largest = at(cos_v.low);
  }
  return std::clamp(largest + slack, 0.0, 1.0);
}

}  // namespace

double cosine_bound(const DirectionBox& box) {
  const Box b = checked(box);
  return largest_component(b.z, b.x, b.y);
}

double half_vector_cosine_bound(const Direction& l, const DirectionBox& box) {
  const Box b = checked(box);
  return b.z.high <= 0 ? 0 : largest_cos_theta_h(l, above(b));
}

double upper_bound(const Ward& ward, const Direction& l, const DirectionBox& box) {
  Box b = checked(box);
  if (b.z.high <= 0) return 0;
  b = above(b);
  const double cos_v = largest_component(b.z, b.x, b.y);
  const double diffuse = ward.rho_d / pi<double> * cos_v;
  if (ward.rho_s == 0) return diffuse * (1 + slack);
  if (l.cos_theta == 0) return std::numeric_limits<double>::infinity();

  const double cos_h = largest_cos_theta_h(l, b);
  const double tangent = std::sqrt((1 - cos_h) * (1 + cos_h)) / cos_h;  // eq. 33
  const double by_angle = square(tangent / std::max(ward.alpha_x, ward.alpha_y));

  const Interval v_x = component(b.x, b.y, b.z), v_y = component(b.y, b.z, b.x);
  const auto least_sum = [](double l_component, const Interval& v) {
    return Interval{l_component + v.low, l_component + v.high}.widened(slack).nearest_to_zero();
  };
  const double height = l.cos_theta + cos_v;
  const double by_slopes = square(least_sum(l.sin_theta * l.cos_phi, v_x) / (ward.alpha_x * height)) +
                           square(least_sum(l.sin_theta * l.sin_phi, v_y) / (ward.alpha_y * height));

  const double exponent = std::max(by_angle, by_slopes) * (1 - slack);
  const double scale = ward.rho_s / (4 * pi<double> * ward.alpha_x * ward.alpha_y);
  const double specular = scale * std::sqrt(cos_v / l.cos_theta) * std::exp(-exponent);
  // not 0 where the exact value is too small for a double
  return (diffuse + specular) * (1 + slack) + std::numeric_limits<double>::min();
}

}  // namespace albedo
