#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "albedo/core/instruction_set.hpp"

#if defined(__SSE2__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

/// The machine's own vector of doubles, through the compiler's vector types, and the elementary functions on it.
///
/// The functions are straight-line code and the same on every machine but for the rounding of fused operations, which
/// they ask for by name. Errors are in units in the last place, as tests/unit/block_test.cpp measures them.
namespace albedo::detail {
inline namespace ALBEDO_INSTRUCTION_SET {

#if defined(__AVX512F__)
inline constexpr int vector_bytes = 64;
#elif defined(__AVX__)
inline constexpr int vector_bytes = 32;
#else
inline constexpr int vector_bytes = 16;
#endif
inline constexpr int vector_width = vector_bytes / 8;

using Vector = double __attribute__((vector_size(vector_bytes)));
using VectorBits = std::uint64_t __attribute__((vector_size(vector_bytes)));
using VectorMask = decltype(Vector{} < Vector{});

/// A number in all lanes.
[[gnu::always_inline]] inline Vector spread(double value) { return value - Vector{}; }

[[gnu::always_inline]] inline VectorBits bits(Vector x) { return std::bit_cast<VectorBits>(x); }
[[gnu::always_inline]] inline Vector from_bits(VectorBits x) { return std::bit_cast<Vector>(x); }
constexpr std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

inline constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63;
inline constexpr int fraction_bits = 52;
inline constexpr int exponent_bias = 1023;
inline constexpr double infinity = std::numeric_limits<double>::infinity();

[[gnu::always_inline]] inline Vector magnitude(Vector x) { return from_bits(bits(x) & ~sign_bit); }

/// √x, correctly rounded.
[[gnu::always_inline]] inline Vector square_root(Vector x) {
#if defined(__AVX512F__)
  return _mm512_sqrt_pd(x);
#elif defined(__AVX__)
  return _mm256_sqrt_pd(x);
#elif defined(__SSE2__)
  return _mm_sqrt_pd(x);
#elif defined(__aarch64__)
  return vsqrtq_f64(x);
#else
  for (int lane = 0; lane < vector_width; ++lane) x[lane] = std::sqrt(x[lane]);
  return x;
#endif
}

/// ab + c, rounded once where the machine can.
[[gnu::always_inline]] inline Vector multiply_add(Vector a, Vector b, Vector c) {
#if defined(__AVX512F__)
  return _mm512_fmadd_pd(a, b, c);
#elif defined(__FMA__)
  return _mm256_fmadd_pd(a, b, c);
#elif defined(__aarch64__)
  return vfmaq_f64(c, a, b);
#else
  return a * b + c;
#endif
}

/// Σ c[k] xᵏ, in pairs, pairs of pairs, ...: log₂ of the degree steps deep.
template <std::size_t N, class C>
[[gnu::always_inline]] inline Vector polynomial(Vector x, const C (&c)[N]) {
  if constexpr (N == 1) {
    return c[0] - Vector{};
  } else {
    Vector pairs[(N + 1) / 2];
    for (std::size_t i = 0; i < N / 2; ++i) {
      pairs[i] = multiply_add(c[2 * i + 1] - Vector{}, x, c[2 * i] - Vector{});
    }
    if constexpr (N % 2 == 1) pairs[N / 2] = c[N - 1] - Vector{};
    return polynomial(x * x, pairs);
  }
}

/// Adding it rounds a number below 2⁵¹ to an integer, which is then in the sum's low bits.
inline constexpr double rounder = 0x1.8p52;

[[gnu::always_inline]] inline Vector round_to_integer(Vector x) { return (x + rounder) - rounder; }

/// 2ⁿ for integers n in [−1022, 1023].
[[gnu::always_inline]] inline Vector power_of_two(Vector n) {
  return from_bits(bits(n + (rounder + exponent_bias)) << fraction_bits);
}

inline constexpr double log2_e = 0x1.71547652b82fep0;
inline constexpr double ln2_high = 0x1.62e42feep-1;  // a product with an exponent is exact
inline constexpr double ln2_low = 0x1.a39ef35793c76p-33;

/// x · 2ⁿ for integers n in [−1076, 1024], rounded once.
[[gnu::always_inline]] inline Vector scaled(Vector x, Vector n) {
#ifdef __AVX512F__
  return _mm512_scalef_pd(x, n);
#else
  const Vector half = round_to_integer(n * 0.5);
  return x * power_of_two(half) * power_of_two(n - half);
#endif
}

/// eˣ = 2ⁿ (1 + rest), |rest| < 0.42.
struct Exponential {
  Vector n, rest;
};

/// For |x| < 1e6.
[[gnu::always_inline]] inline Exponential exponential(Vector x) {
  constexpr double c[] = {1. / 2,     1. / 6,      1. / 24,      1. / 120,      1. / 720,       1. / 5040,
                          1. / 40320, 1. / 362880, 1. / 3628800, 1. / 39916800, 1. / 479001600, 1. / 6227020800};
  const Vector n = round_to_integer(x * log2_e);
  const Vector r = multiply_add(n, spread(-ln2_low), x - n * ln2_high);
  return {n, multiply_add(r * r, polynomial(r, c), r)};
}

inline constexpr double exponential_overflows = 710;  // from somewhere below on

/// eˣ to 1 ulp.
[[gnu::always_inline]] inline Vector exponential_function(Vector x) {
  constexpr double underflows = -746;
  const Exponential e = exponential(x);
  const Vector result = x < underflows ? Vector{} : scaled(1 + e.rest, e.n);
  return x > exponential_overflows ? spread(infinity) : result;
}

/// eˣ − 1 to 2.5 ulp.
[[gnu::always_inline]] inline Vector exponential_minus_one(Vector x) {
  constexpr double minus_one = -50, no_difference = 60;  // where the result is −1, and where 2⁻ⁿ is lost beside 1
  const Exponential e = exponential(x);
  const Vector inverse = e.n > no_difference ? Vector{} : power_of_two(-e.n);
  Vector result = scaled(e.rest + (1 - inverse), e.n);
  result = x < minus_one ? spread(-1) : result;
  result = x > exponential_overflows ? spread(infinity) : result;
  return x == 0 ? x : result;  // keeps −0
}

/// n ln 2 + ln(1 + f) for f in [√½ − 1, √2 − 1], by ln(1 + f) = 2 artanh(f/(2 + f)).
[[gnu::always_inline]] inline Vector logarithm(Vector n, Vector f) {
  constexpr double c[] = {2. / 3,  2. / 5,  2. / 7,  2. / 9,  2. / 11, 2. / 13,
                          2. / 15, 2. / 17, 2. / 19, 2. / 21, 2. / 23};
  const Vector s = f / (2 + f);
  const Vector z = s * s;
  const Vector rest = multiply_add(n, spread(-ln2_low), s * multiply_add(-z, polynomial(z, c), f));
  return multiply_add(n, spread(ln2_high), f - rest);
}

/// The exponent of x's power of two within [√½, √2), biased, as an integer; x > 0 and normal.
[[gnu::always_inline]] inline VectorBits biased_exponent(Vector x) {
  constexpr std::uint64_t to_sqrt_half = bits(1.0) - bits(0x1.6a09e667f3bcdp-1);
  return (bits(x) + to_sqrt_half) >> fraction_bits;
}

/// A small integer as a number.
[[gnu::always_inline]] inline Vector number_of(VectorBits n) { return from_bits(n | bits(0x1p52)) - 0x1p52; }

/// The logarithm's limits: ±∞ and NaN where they belong.
[[gnu::always_inline]] inline Vector with_limits(Vector argument, Vector result) {
  const Vector outside = argument == 0 ? spread(-infinity) : spread(std::numeric_limits<double>::quiet_NaN());
  result = argument > 0 ? result : outside;
  return argument == infinity ? argument : result;
}

/// ln x to 1 ulp.
[[gnu::always_inline]] inline Vector natural_logarithm(Vector x) {
  const VectorMask subnormal = x < std::numeric_limits<double>::min();
  const Vector y = subnormal ? x * 0x1p54 : x;
  const VectorBits e = biased_exponent(y);
  const Vector mantissa = from_bits(bits(y) - ((e - std::uint64_t{exponent_bias}) << fraction_bits));
  const Vector n = number_of(e) - (subnormal ? spread(exponent_bias + 54) : spread(exponent_bias));
  return with_limits(x, logarithm(n, mantissa - 1));
}

/// ln(1 + x) to 2 ulp: with 2ⁿ next to 1 + x, its mantissa less 1 is (2⁻ⁿ − 1) + 2⁻ⁿx, of which only the sum rounds.
[[gnu::always_inline]] inline Vector logarithm_of_one_plus(Vector x) {
  const Vector u = 1 + x;
  const VectorBits e = biased_exponent(u);
  const Vector scale4 = from_bits((std::uint64_t{2 * exponent_bias + 2} - e) << fraction_bits);  // 4·2⁻ⁿ
  const Vector f = (scale4 * 0.25 - 1) + (x * scale4) * 0.25;
  const Vector result = with_limits(u, logarithm(number_of(e) - exponent_bias, f));
  return x == 0 ? x : result;  // keeps −0
}

/// sin(πf/2) and cos(πf/2) to 2 ulp for |f| < 2⁵⁰, exact at integers.
[[gnu::always_inline]] inline void sine_and_cosine(Vector f, Vector& sine, Vector& cosine) {
  constexpr double half_pi = 0x1.921fb54442d18p0;
  constexpr double odd[] = {-1. / 6,        1. / 120,        -1. / 5040,         1. / 362880,
                            -1. / 39916800, 1. / 6227020800, -1. / 1307674368000};
  constexpr double even[] = {-1. / 2,       1. / 24,        -1. / 720,         1. / 40320,
                             -1. / 3628800, 1. / 479001600, -1. / 87178291200, 1. / 20922789888000};
  const Vector rounded = f + rounder;
  const VectorBits quarter = bits(rounded);
  const Vector a = (f - (rounded - rounder)) * half_pi;
  const Vector a2 = a * a;
  const Vector s = multiply_add(a * a2, polynomial(a2, odd), a);
  const Vector c = multiply_add(a2, polynomial(a2, even), spread(1));
  const VectorMask odd_quarter = (quarter & 1) != 0;
  sine = from_bits(bits(odd_quarter ? c : s) ^ ((quarter & 2) << 62));
  cosine = from_bits(bits(odd_quarter ? s : c) ^ (((quarter + 1) & 2) << 62));
}

/// arctan x to 2.5 ulp: x or −1/x, then an eighth of a turn less where that brings it below tan(π/8), then the series.
inline Vector arc_tangent(Vector x) {
  constexpr double quarter_pi = 0x1.921fb54442d18p-1;
  constexpr double tan_pi_8 = 0x1.a827999fcef32p-2;
  constexpr double c[] = {-1. / 3,  1. / 5,   -1. / 7,  1. / 9,   -1. / 11, 1. / 13,  -1. / 15,
                          1. / 17,  -1. / 19, 1. / 21,  -1. / 23, 1. / 25,  -1. / 27, 1. / 29,
                          -1. / 31, 1. / 33,  -1. / 35, 1. / 37,  -1. / 39, 1. / 41};
  const Vector size = magnitude(x);
  const VectorMask steep = size > 1;
  const Vector t = steep ? 1 / size : size;
  const VectorMask wide = t > tan_pi_8;
  const Vector y = wide ? (t - 1) / (t + 1) : t;
  const Vector y2 = y * y;
  const Vector series = multiply_add(y * y2, polynomial(y2, c), y);
  const Vector angle = wide ? quarter_pi + series : series;
  const Vector result = steep ? 2 * quarter_pi - angle : angle;
  return from_bits(bits(result) | (bits(x) & sign_bit));
}

}  // namespace ALBEDO_INSTRUCTION_SET
}  // namespace albedo::detail
