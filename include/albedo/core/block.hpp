#pragma once

#include <cmath>
#include <utility>

#include "albedo/core/vector_math.hpp"

namespace albedo {

/// Lanes of a Block. Results don't depend on how many of them the machine computes at once.
inline constexpr int block_width = 8;

}  // namespace albedo

namespace albedo::detail {
inline namespace ALBEDO_INSTRUCTION_SET {

inline constexpr int block_parts = block_width / vector_width;

/// What a function of the part's index makes of every part; the indices are constants, which keeps parts in registers.
template <class Result, class Function>
[[gnu::always_inline]] inline Result each_part(const Function& function) {
  Result result;
  [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
    ((result.part[I] = function(I)), ...);
  }
  (std::make_integer_sequence<int, block_parts>());
  return result;
}

}  // namespace ALBEDO_INSTRUCTION_SET
}  // namespace albedo::detail

namespace albedo {
inline namespace ALBEDO_INSTRUCTION_SET {

/// A truth value per lane: the result of comparing blocks.
struct BlockMask {
  detail::VectorMask part[detail::block_parts];
};

/// A handful of doubles that are computed together: the number type of the fast path.
///
/// A value type, so that a formula written for `double` runs on it as it stands. It holds as many of the machine's
/// vectors as it needs.
struct alignas(block_width * sizeof(double)) Block {
  detail::Vector part[detail::block_parts];

  Block() = default;
  Block(double value)  // NOLINT(google-explicit-constructor): constants mix with blocks
      : Block(detail::each_part<Block>([=](int) { return detail::spread(value); })) {}

  /// The first block_width values.
  static Block load(const double* values) {
    Block block;
    std::memcpy(block.part, values, sizeof block.part);
    return block;
  }

  /// The first `count` values, the last of them repeated: a partly filled block never evaluates a made-up point.
  static Block load_partial(const double* values, int count) {
    return generate([=](int lane) { return values[lane < count ? lane : count - 1]; });
  }

  /// A number for each lane.
  template <class Function>
  static Block generate(const Function& number) {
    return detail::each_part<Block>([&](int i) {
      return [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
        return detail::Vector{number(i * detail::vector_width + I)...};
      }
      (std::make_integer_sequence<int, detail::vector_width>());
    });
  }

  void store(double* values) const { std::memcpy(values, part, sizeof part); }
  void store(double* values, int count) const {
    std::memcpy(values, part, static_cast<std::size_t>(count) * sizeof(double));
  }

  double operator[](int lane) const { return part[lane / detail::vector_width][lane % detail::vector_width]; }
  void set(int lane, double value) { part[lane / detail::vector_width][lane % detail::vector_width] = value; }

  Block& operator+=(const Block& b) { return *this = *this + b; }
  Block& operator-=(const Block& b) { return *this = *this - b; }
  Block& operator*=(const Block& b) { return *this = *this * b; }
  Block& operator/=(const Block& b) { return *this = *this / b; }

  [[gnu::always_inline]] friend Block operator-(const Block& a) {
    return detail::each_part<Block>([&](int i) { return -a.part[i]; });
  }
  [[gnu::always_inline]] friend Block operator+(const Block& a, const Block& b) {
    return detail::each_part<Block>([&](int i) { return a.part[i] + b.part[i]; });
  }
  [[gnu::always_inline]] friend Block operator-(const Block& a, const Block& b) {
    return detail::each_part<Block>([&](int i) { return a.part[i] - b.part[i]; });
  }
  [[gnu::always_inline]] friend Block operator*(const Block& a, const Block& b) {
    return detail::each_part<Block>([&](int i) { return a.part[i] * b.part[i]; });
  }
  [[gnu::always_inline]] friend Block operator/(const Block& a, const Block& b) {
    return detail::each_part<Block>([&](int i) { return a.part[i] / b.part[i]; });
  }

  [[gnu::always_inline]] friend BlockMask operator<(const Block& a, const Block& b) {
    return detail::each_part<BlockMask>([&](int i) { return a.part[i] < b.part[i]; });
  }
  [[gnu::always_inline]] friend BlockMask operator>(const Block& a, const Block& b) {
    return detail::each_part<BlockMask>([&](int i) { return a.part[i] > b.part[i]; });
  }
  [[gnu::always_inline]] friend BlockMask operator<=(const Block& a, const Block& b) {
    return detail::each_part<BlockMask>([&](int i) { return a.part[i] <= b.part[i]; });
  }
  [[gnu::always_inline]] friend BlockMask operator>=(const Block& a, const Block& b) {
    return detail::each_part<BlockMask>([&](int i) { return a.part[i] >= b.part[i]; });
  }
  [[gnu::always_inline]] friend BlockMask operator==(const Block& a, const Block& b) {
    return detail::each_part<BlockMask>([&](int i) { return a.part[i] == b.part[i]; });
  }
};

}  // namespace ALBEDO_INSTRUCTION_SET
}  // namespace albedo

namespace albedo::detail {
inline namespace ALBEDO_INSTRUCTION_SET {

/// A function of the machine's vector, on every part.
template <Vector (*function)(Vector)>
[[gnu::always_inline]] inline Block apply(const Block& x) {
  Block result;
  [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
    ((result.part[I] = function(x.part[I])), ...);
  }
  (std::make_integer_sequence<int, block_parts>());
  return result;
}

}  // namespace ALBEDO_INSTRUCTION_SET
}  // namespace albedo::detail

namespace albedo {
inline namespace ALBEDO_INSTRUCTION_SET {

/// `a` where the mask holds, `b` elsewhere.
[[gnu::always_inline]] inline Block select(const BlockMask& mask, const Block& a, const Block& b) {
  return detail::each_part<Block>([&](int i) { return mask.part[i] ? a.part[i] : b.part[i]; });
}
[[gnu::always_inline]] inline Block min(const Block& a, const Block& b) { return select(b < a, b, a); }
[[gnu::always_inline]] inline Block max(const Block& a, const Block& b) { return select(a < b, b, a); }
/// Whether a mask holds in every lane.
inline bool all(const BlockMask& mask) {
  const Block held = select(mask, Block(1), Block(0));
  for (int lane = 0; lane < block_width; ++lane) {
    if (held[lane] == 0) return false;
  }
  return true;
}

[[gnu::always_inline]] inline Block abs(const Block& x) { return detail::apply<detail::magnitude>(x); }
[[gnu::always_inline]] inline Block sqrt(const Block& x) { return detail::apply<detail::square_root>(x); }
[[gnu::always_inline]] inline Block exp(const Block& x) { return detail::apply<detail::exponential_function>(x); }
[[gnu::always_inline]] inline Block expm1(const Block& x) { return detail::apply<detail::exponential_minus_one>(x); }
[[gnu::always_inline]] inline Block log(const Block& x) { return detail::apply<detail::natural_logarithm>(x); }
[[gnu::always_inline]] inline Block log1p(const Block& x) { return detail::apply<detail::logarithm_of_one_plus>(x); }
[[gnu::always_inline]] inline Block atan(const Block& x) { return detail::apply<detail::arc_tangent>(x); }

/// sin(πf/2) and cos(πf/2), exact in their zeros.
[[gnu::always_inline]] inline void sincos_quarter(const Block& f, Block& sine, Block& cosine) {
  [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
    (detail::sine_and_cosine(f.part[I], sine.part[I], cosine.part[I]), ...);
  }
  (std::make_integer_sequence<int, detail::block_parts>());
}

/// x^exponent for x ≥ 0, to 1 + 2 |exponent · ln x| ulp.
inline Block pow(const Block& x, double exponent) { return exponent == 0 ? Block(1) : exp(exponent * log(x)); }

// Arguments of any size have no short vector form: lane by lane.
inline Block sin(const Block& x) {
  return Block::generate([&](int lane) { return std::sin(x[lane]); });
}
inline Block cos(const Block& x) {
  return Block::generate([&](int lane) { return std::cos(x[lane]); });
}
inline Block tan(const Block& x) {
  return Block::generate([&](int lane) { return std::tan(x[lane]); });
}

}  // namespace ALBEDO_INSTRUCTION_SET
}  // namespace albedo
