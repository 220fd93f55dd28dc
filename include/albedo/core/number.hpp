#pragma once

#ifdef __FAST_MATH__
#error "albedo relies on IEEE arithmetic (NaN, infinity, exact differences): build it without -ffast-math"
#endif

#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "albedo/core/block.hpp"

namespace albedo {

/// The scalar in which a number type's constants are kept: double for a block, the type itself otherwise.
template <class T>
using Scalar = std::conditional_t<std::is_same_v<T, Block>, double, T>;

/// Whether a number type has more digits than a double: formulas then cut their series later.
template <class T>
inline constexpr bool is_wide = std::numeric_limits<Scalar<T>>::digits > std::numeric_limits<double>::digits;

/// π, by its scalar; core/quad.hpp has that of 113 bits.
template <class S>
inline const S pi_of = std::numbers::pi_v<S>;

template <class T>
inline const Scalar<T>& pi = pi_of<Scalar<T>>;

// What a formula may call beside + − × ÷, for every number type; Block's own versions live in block.hpp.
using std::abs;
using std::exp;
using std::expm1;
using std::log;
using std::log1p;
using std::pow;
using std::sqrt;

/// The smaller of two numbers, without a branch in a block.
template <class T>
requires(!std::is_same_v<T, Block>) T min(const T& a, const T& b) { return b < a ? b : a; }

/// The larger of two numbers, without a branch in a block.
template <class T>
requires(!std::is_same_v<T, Block>) T max(const T& a, const T& b) { return a < b ? b : a; }

/// `a` where the condition holds, `b` elsewhere; both are evaluated.
template <class T>
requires(!std::is_same_v<T, Block>) T select(bool condition, const T& a, const T& b) { return condition ? a : b; }

template <class T>
T square(const T& x) {
  return x * x;
}

/// x⁵, as in Schlick's Fresnel term.
template <class T>
T fifth_power(const T& x) {
  return square(square(x)) * x;
}

}  // namespace albedo
