#pragma once

#include <algorithm>
#include <cmath>

#include "albedo/core/number.hpp"

namespace albedo {

/// A map of [0, 1] onto itself that behaves like u^left at 0 and like 1 − (1 − u)^right at 1: it makes an integrand
/// with a fractional power at an end smooth (power 2 for a half-integer, 3 or more for any other: p < 0 at the right
/// end becomes the second power with 3/(p + 1)). Powers are 1 and 2 or 3, which are polynomials, or any.
struct EndMap {
  double left = 1, right = 1;

  /// g(u), 1 − g(u) without cancellation, and g′(u).
  template <class T>
  void at(const T& u, T& g, T& complement, T& slope) const {
    const T v = 1 - u;
    if (right != 1 && right != 2 && right != 3) {
      const Scalar<T> first(right), second(left);
      const T rest = exp(T(first * log(v)));
      const T inner = -expm1(T(first * log1p(T(-u))));
      g = left == 1 ? inner : T(exp(T(second * log(inner))));
      complement = left == 1 ? rest : T(-expm1(T(second * log1p(T(-rest)))));
      slope = first * second * (g / inner) * (rest / v);
    } else if (left == 1 && right == 1) {
      g = u, complement = v, slope = T(1);
    } else if (left == 1) {
      const T last = right == 2 ? v : square(v);
      complement = last * v;
      g = right == 2 ? T(u * (1 + v)) : T(u * (1 + v + square(v)));
      slope = right * last;
    } else if (right == 1) {
      const T last = left == 2 ? u : square(u);
      g = last * u;
      complement = left == 2 ? T(v * (1 + u)) : T(v * (1 + u + square(u)));
      slope = left * last;
    } else if (left == 2 && right == 2) {
      g = square(u) * (1 + 2 * v);
      complement = square(v) * (1 + 2 * u);
      slope = 6 * u * v;
    } else {
      g = u * square(u) * (1 + 3 * v + 6 * square(v));
      complement = v * square(v) * (1 + 3 * u + 6 * square(u));
      slope = 30 * square(T(u * v));
    }
  }
};

/// Where a lobe that falls off like exp(−r²) has ended.
struct Cut {
  double radius;      ///< r
  double truncation;  ///< bounds the rest, relative to the whole
};

/// The end of a lobe for a relative tolerance; the rest is about a tenth of it. @param growth k of an integrand that
/// grows towards the end like r^(2k): its rest is R^k exp(−R)/k! at r² = R
inline Cut lobe_cut(double tolerance, double growth = 1) {
  const double least = 6.5 - std::log(tolerance), factorial = std::lgamma(growth + 1);
  double radius2 = least;
  for (int i = 0; i < 10; ++i) radius2 = std::max(least, least + (growth - 1) * std::log(radius2) - factorial);
  return {std::sqrt(radius2), 2 * std::exp(growth * std::log(radius2) - radius2 - factorial)};
}

/// asinh(x) for x ≥ 0, accurate near 0.
template <class T>
T arsinh(const T& x) {
  return log1p(T(x + square(x) / (1 + sqrt(T(1 + square(x))))));
}

}  // namespace albedo
