#pragma once

#include <array>

#include "albedo/core/number.hpp"

namespace albedo {

namespace detail {

/// Powers of t = (x − 3.75)/(x + 3.75), which takes x ≥ 0 to [−1, 1), in (1 + 2x) e^(x²) erfc(x): the Chebyshev series
/// of 40-digit values, cut at 2e-18 and multiplied out (the coefficients' magnitudes add up to 1.8, so nothing
/// cancels).
inline constexpr std::array<double, 25> scaled_erfc_powers{
    1.2375126308378275796,      -0.14024059858554696245,   0.003585415485464429369,     0.082276738490145207683,
    -0.10880393014174885723,    0.09230432116037747776,    -0.058693398589636774061,    0.028362277418956404286,
    -0.0097465795580292755337,  0.0017556258528952953569,  0.00029371366559134481992,   -0.00029015408054084171105,
    0.000051649098892682403449, 0.00002238423915508222982, -0.000011444146237700523373, -9.7355989673677493407e-7,
    1.7516376488490621431e-6,   -5.7218230603224087501e-8, -2.5866850716155885443e-7,   2.3263508708859123732e-8,
    3.8675334242222356816e-8,   -3.7442100809620186444e-9, -5.1739902140113096269e-9,   3.1114333809799251993e-10,
    4.2514714447963897761e-10};

}  // namespace detail

/// e^(x²) erfc(x) in T; core/quad.hpp has that of 113 bits.
template <class T>
struct ScaledErfc {
  static T at(const T& x) {
    constexpr double centre = 3.75;
    const T t = (x - T(centre)) / (x + T(centre));
    const T t2 = square(t);
    const auto power = [](std::size_t k) { return T(static_cast<Scalar<T>>(detail::scaled_erfc_powers[k])); };
    T even = power(24), odd = power(23);
    for (std::size_t k = 22; k > 0; k -= 2) {
      even = even * t2 + power(k);
      odd = odd * t2 + power(k - 1);
    }
    return (even * t2 + power(0) + t * odd) / (x + x + T(1.0));
  }
};

/// The scaled complementary error function e^(x²) erfc(x) for x ≥ 0, to 1e-15 (float: 6e-7), without a branch.
template <class T>
T scaled_erfc(const T& x) {
  return ScaledErfc<T>::at(x);
}

/// Lambert's W on x ≥ 0, the w of w e^w = x: Newton's iteration for w + ln w = ln x from a start that is good to 2e-2
/// [Iacono & Boyd 2017]; relative rounding is that of the logarithm.
template <class T>
T lambert_w(const T& argument) {
  constexpr double least = 1e-37;  // W is its argument there, and a float still holds it
  constexpr int iterations = is_wide<T> ? 5 : 4;
  const T x = max(argument, T(least));
  const T l = log1p(x);
  T w = l * (1 - log1p(l) / (2 + l));
  for (int i = 0; i < iterations; ++i) w = w / (1 + w) * (1 + log(T(x / w)));
  return w;
}

}  // namespace albedo
