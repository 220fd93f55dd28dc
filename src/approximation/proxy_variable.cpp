#include "albedo/core/proxy_variable.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace albedo {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double linear = std::numeric_limits<double>::infinity();

}  // namespace

double folded_azimuth(double phi) { return std::abs(phi - 180 * std::round(phi / 180)); }

ProxyVariable::ProxyVariable(Coordinate coordinate, double least, double largest, double shift)
    : coordinate_(coordinate), least_(0), largest_(0), shift_(shift) {
  if (coordinate == Coordinate::folded) {
    least_ = 0, largest_ = 90;
  } else if (coordinate == Coordinate::cosine_of_twice) {
    least_ = -1, largest_ = 1;
  } else {
    const double a = coordinate_of(least), b = coordinate_of(largest);
    least_ = std::min(a, b), largest_ = std::max(a, b);
  }
}

double ProxyVariable::coordinate_of(double value) const {
  switch (coordinate_) {
    case Coordinate::cosine_of:
      return value == 90 ? 0 : std::cos(value * degree);
    case Coordinate::folded:
      return folded_azimuth(value);
    case Coordinate::cosine_of_twice:
      return std::cos(2 * degree * folded_azimuth(value));
    case Coordinate::value:
      break;
  }
  return value;
}

double ProxyVariable::raw(double coordinate) const {
  return std::isinf(shift_) ? coordinate : std::log(coordinate - least_ + shift_);
}

bool ProxyVariable::contains(double value) const {
  constexpr double rounding = 1e-12;
  const double at = coordinate_of(value), slack = rounding * std::max(std::abs(least_), std::abs(largest_));
  return at >= least_ - slack && at <= largest_ + slack;
}

double ProxyVariable::of(double value) const {
  if (least_ == largest_) return 0;
  const double a = raw(least_), b = raw(largest_);
  return std::clamp((2 * raw(std::max(coordinate_of(value), least_)) - a - b) / (b - a), -1.0, 1.0);
}

double ProxyVariable::value_at(double u) const {
  double coordinate = u <= -1 ? least_ : largest_;
  if (std::abs(u) < 1) {
    const double a = raw(least_), b = raw(largest_), r = a + (b - a) * (1 + u) / 2;
    coordinate = std::clamp(std::isinf(shift_) ? r : std::exp(r) - shift_ + least_, least_, largest_);
  }
  switch (coordinate_) {
    case Coordinate::cosine_of:
      return coordinate == 0 ? 90 : std::acos(coordinate) / degree;
    case Coordinate::cosine_of_twice:
      return std::acos(coordinate) / (2 * degree);
    case Coordinate::folded:
    case Coordinate::value:
      break;
  }
  return coordinate;
}

std::vector<ProxyVariable> proxy_variables(const std::string& axis, double least, double largest, bool is_elliptic) {
  using enum ProxyVariable::Coordinate;
  if (axis == "phi") {
    if (!is_elliptic) return {{value, least, largest, linear}};
    return {{folded, 0, 90, linear}, {cosine_of_twice, 0, 90, linear}};
  }
  std::vector<ProxyVariable> variables;
  const auto add = [&](ProxyVariable::Coordinate coordinate, double shift) {
    variables.emplace_back(coordinate, least, largest, shift);
  };
  const bool is_theta = axis == "theta";
  const double from = is_theta ? std::max(0.0, std::cos(largest * degree)) : least;
  const double to = is_theta ? std::cos(least * degree) : largest;
  const auto coordinate = is_theta ? cosine_of : value;
  if (is_theta || axis == "cos_theta") {
    constexpr double grazing_shift = 1e-4;
    add(coordinate, from + grazing_shift);
  } else {
    add(value, least > 0 && largest >= 4 * least ? least : linear);
  }
  for (const double part : {1e-3, 0.01, 0.03, 0.1, 0.3, 1.0}) add(coordinate, part * (to - from));
  add(coordinate, linear);
  if (is_theta) add(value, linear);
  return variables;
}

std::vector<double> lobatto_points(std::size_t size) {
  std::vector<double> points(size, 0);
  const double n = static_cast<double>(size) - 1;
  for (std::size_t j = 0; size > 1 && j < size; ++j) {
    points[j] = std::sin(std::numbers::pi * (n - 2 * static_cast<double>(j)) / (2 * n));
  }
  return points;
}

std::vector<double> chebyshev_transform(std::size_t size) {
  if (size == 1) return {1};
  const std::size_t n = size - 1;
  std::vector<double> cosine(2 * n), matrix(size * size);
  for (std::size_t k = 0; k < 2 * n; ++k) {
    cosine[k] = std::cos(std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
  }
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t j = 0; j < size; ++j) {
      const double half_ends = (j == 0 || j == n ? 0.5 : 1) * (k == 0 || k == n ? 0.5 : 1);
      matrix[k * size + j] = 2 * half_ends / static_cast<double>(n) * cosine[j * k % (2 * n)];
    }
  }
  return matrix;
}

void chebyshev(double u, std::size_t size, double* out, std::size_t stride) {
  double before = u, now = 1;  // T_{−1} = T_1
  for (std::size_t k = 0; k < size; ++k) {
    out[k * stride] = now;
    const double next = k == 0 ? u : 2 * u * now - before;
    before = now;
    now = next;
  }
}

}  // namespace albedo
