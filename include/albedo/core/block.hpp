#pragma once

#include <Eigen/Core>
#include <cmath>

namespace albedo {

/// Lanes of a Block. Results don't depend on it beyond rounding (1e-14 relative).
inline constexpr int block_width = 8;

/// A truth value per lane.
struct BlockMask {
  Eigen::Array<bool, block_width, 1> lanes;
};

/// A handful of doubles that are computed together: the number type of the fast path.
///
/// A value type around a fixed-size Eigen array, so that a formula written for `double` runs on it as it stands and
/// `auto` can't capture a dangling expression. Eigen vectorises `exp log sqrt`; what it doesn't is built from those or
/// goes lane by lane here.
struct alignas(64) Block {
  using Lanes = Eigen::Array<double, block_width, 1>;

  Lanes lanes;

  Block() = default;
  Block(double value)  // NOLINT(google-explicit-constructor): constants mix with blocks
      : lanes(Lanes::Constant(value)) {}

  /// Evaluates an Eigen expression.
  template <class Expression>
  [[gnu::always_inline]] static Block from(const Expression& expression) {
    Block block;
    block.lanes = expression;
    return block;
  }

  static Block load(const double* values) { return from(Eigen::Map<const Lanes>(values)); }

  /// The first `count` values, the last of them repeated: a partly filled block never evaluates a made-up point.
  static Block load_partial(const double* values, int count) {
    Block block(values[count - 1]);
    for (int i = 0; i < count; ++i) block.lanes[i] = values[i];
    return block;
  }

  void store(double* values, int count = block_width) const {
    for (int i = 0; i < count; ++i) values[i] = lanes[i];
  }

  double operator[](int lane) const { return lanes[lane]; }

  Block& operator+=(const Block& b) { return *this = *this + b; }
  Block& operator-=(const Block& b) { return *this = *this - b; }
  Block& operator*=(const Block& b) { return *this = *this * b; }
  Block& operator/=(const Block& b) { return *this = *this / b; }

  [[gnu::always_inline]] friend Block operator-(const Block& a) { return from(-a.lanes); }
  [[gnu::always_inline]] friend Block operator+(const Block& a, const Block& b) { return from(a.lanes + b.lanes); }
  [[gnu::always_inline]] friend Block operator-(const Block& a, const Block& b) { return from(a.lanes - b.lanes); }
  [[gnu::always_inline]] friend Block operator*(const Block& a, const Block& b) { return from(a.lanes * b.lanes); }
  [[gnu::always_inline]] friend Block operator/(const Block& a, const Block& b) { return from(a.lanes / b.lanes); }

  friend BlockMask operator<(const Block& a, const Block& b) { return {a.lanes < b.lanes}; }
  friend BlockMask operator>(const Block& a, const Block& b) { return {a.lanes > b.lanes}; }
  friend BlockMask operator<=(const Block& a, const Block& b) { return {a.lanes <= b.lanes}; }
  friend BlockMask operator>=(const Block& a, const Block& b) { return {a.lanes >= b.lanes}; }
  friend BlockMask operator==(const Block& a, const Block& b) { return {a.lanes == b.lanes}; }
};

[[gnu::always_inline]] inline Block exp(const Block& x) { return Block::from(x.lanes.exp()); }
[[gnu::always_inline]] inline Block log(const Block& x) { return Block::from(x.lanes.log()); }
[[gnu::always_inline]] inline Block sqrt(const Block& x) { return Block::from(x.lanes.sqrt()); }
[[gnu::always_inline]] inline Block abs(const Block& x) { return Block::from(x.lanes.abs()); }
[[gnu::always_inline]] inline Block min(const Block& a, const Block& b) { return Block::from(a.lanes.min(b.lanes)); }
[[gnu::always_inline]] inline Block max(const Block& a, const Block& b) { return Block::from(a.lanes.max(b.lanes)); }
[[gnu::always_inline]] inline Block select(const BlockMask& mask, const Block& a, const Block& b) {
  return Block::from(mask.lanes.select(a.lanes, b.lanes));
}

/// ln(1 + x) = x ln(u)/(u − 1) with u = 1 + x as rounded: the rounding of u cancels (Kahan). Eigen has no vector form
/// for doubles.
inline Block log1p(const Block& x) {
  const Block u = 1 + x;
  const Block excess = u - 1;
  const Block corrected = log(u) * (x / excess);
  constexpr double large = 1e16;  // 1 is lost here, and infinity must stay itself
  return select(excess == Block(0.0), x, select(x < Block(large), corrected, log(u)));
}

/// eˣ − 1 = (u − 1) x/ln(u) with u = eˣ as rounded (Kahan).
inline Block expm1(const Block& x) {
  const Block u = exp(x);
  const Block excess = u - 1;
  const Block corrected = excess * (x / log(u));
  constexpr double moderate = 1;
  return select(excess == Block(0.0), x, select(abs(x) < Block(moderate), corrected, excess));
}

namespace detail {
/// A function that has no vector form, lane by lane.
template <class Function>
Block lane_by_lane(const Block& x, Function&& function) {
  Block result;
  for (int i = 0; i < block_width; ++i) result.lanes[i] = function(x.lanes[i]);
  return result;
}
}  // namespace detail

inline Block sin(const Block& x) {
  return detail::lane_by_lane(x, [](double v) { return std::sin(v); });
}
inline Block cos(const Block& x) {
  return detail::lane_by_lane(x, [](double v) { return std::cos(v); });
}
inline Block tan(const Block& x) {
  return detail::lane_by_lane(x, [](double v) { return std::tan(v); });
}
inline Block atan(const Block& x) {
  return detail::lane_by_lane(x, [](double v) { return std::atan(v); });
}
inline Block pow(const Block& x, double exponent) {
  return detail::lane_by_lane(x, [exponent](double v) { return std::pow(v, exponent); });
}

}  // namespace albedo
