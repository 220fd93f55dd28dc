#pragma once

#include <Eigen/Core>

namespace albedo {

/// Lanes of a Block. Results don't depend on it beyond rounding (1e-14 relative).
inline constexpr int block_width = 8;

/// A truth value per lane.
struct BlockMask {
  Eigen::Array<bool, block_width, 1> lanes;
};

/// A handful of doubles that are computed together: the number type of the fast path.
///
/// A value type around a fixed-size Eigen array, so that a formula written for `double` runs on it as it stands (`auto`
/// can't capture a dangling expression). Eigen vectorises `exp log log1p expm1 sqrt`; what it doesn't vectorise goes
/// lane by lane here.
struct Block {
  using Lanes = Eigen::Array<double, block_width, 1>;

  Lanes lanes;

  Block() = default;
  Block(double value)
      : lanes(Lanes::Constant(value)) {}  // NOLINT(google-explicit-constructor): constants mix with blocks
  explicit Block(const Lanes& values) : lanes(values) {}
  template <class Derived>
  explicit Block(const Eigen::ArrayBase<Derived>& values) : lanes(values) {}

  static Block load(const double* values) { return Block(Eigen::Map<const Lanes>(values)); }

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

  friend Block operator-(const Block& a) { return Block(-a.lanes); }
  friend Block operator+(const Block& a, const Block& b) { return Block(a.lanes + b.lanes); }
  friend Block operator-(const Block& a, const Block& b) { return Block(a.lanes - b.lanes); }
  friend Block operator*(const Block& a, const Block& b) { return Block(a.lanes * b.lanes); }
  friend Block operator/(const Block& a, const Block& b) { return Block(a.lanes / b.lanes); }

  friend BlockMask operator<(const Block& a, const Block& b) { return {a.lanes < b.lanes}; }
  friend BlockMask operator>(const Block& a, const Block& b) { return {a.lanes > b.lanes}; }
  friend BlockMask operator<=(const Block& a, const Block& b) { return {a.lanes <= b.lanes}; }
  friend BlockMask operator>=(const Block& a, const Block& b) { return {a.lanes >= b.lanes}; }
};

inline Block exp(const Block& x) { return Block(x.lanes.exp()); }
inline Block expm1(const Block& x) { return Block(x.lanes.expm1()); }
inline Block log(const Block& x) { return Block(x.lanes.log()); }
inline Block log1p(const Block& x) { return Block(x.lanes.log1p()); }
inline Block sqrt(const Block& x) { return Block(x.lanes.sqrt()); }
inline Block abs(const Block& x) { return Block(x.lanes.abs()); }
inline Block min(const Block& a, const Block& b) { return Block(a.lanes.min(b.lanes)); }
inline Block max(const Block& a, const Block& b) { return Block(a.lanes.max(b.lanes)); }
inline Block select(const BlockMask& mask, const Block& a, const Block& b) {
  return Block(mask.lanes.select(a.lanes, b.lanes));
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
