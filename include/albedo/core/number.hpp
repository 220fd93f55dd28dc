#pragma once

#ifdef __FAST_MATH__
#error "albedo relies on IEEE arithmetic (NaN, infinity, exact differences): build it without -ffast-math"
#endif

// Quad needs nothing of GNU's __float128. Where it is on, in -std=gnu++20, Boost would have every program link
// libquadmath.
#include <boost/config.hpp>
#undef BOOST_HAS_FLOAT128

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <type_traits>

#include "albedo/core/block.hpp"

namespace albedo {

/// 113-bit binary floating point: the arithmetic that true errors are measured in.
using Quad = boost::multiprecision::number<
    boost::multiprecision::backends::cpp_bin_float<113, boost::multiprecision::backends::digit_base_2, void,
                                                   std::int16_t, -16382, 16383>,
    boost::multiprecision::et_off>;

/// The scalar in which a number type's constants are kept: double for a block, the type itself otherwise.
template <class T>
using Scalar = std::conditional_t<std::is_same_v<T, Block>, double, T>;

template <class T>
inline const Scalar<T> pi = boost::math::constants::pi<Scalar<T>>();

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
