#pragma once

#include <array>
#include <boost/math/special_functions/cos_pi.hpp>

#include "albedo/pumping.hpp"

namespace albedo {

/// The i-th of a panel's extreme points of the last Chebyshev polynomial; the ends are among them, exactly.
inline double lobatto(double begin, double end, int i) {
  if (i == 0) return begin;
  if (i == PumpDivisor::terms - 1) return end;
  const double share = (1 - boost::math::cos_pi(static_cast<double>(i) / (PumpDivisor::terms - 1))) / 2;
  return begin + (end - begin) * share;
}

/// The coefficients of the polynomial through values at these points.
inline std::array<double, PumpDivisor::terms> chebyshev_expansion(
    const std::array<double, PumpDivisor::terms>& values) {
  constexpr int n = PumpDivisor::terms - 1;
  static const auto transform = [] {
    std::array<std::array<double, n + 1>, n + 1> matrix;
    for (int k = 0; k <= n; ++k) {
      for (int i = 0; i <= n; ++i) {  // cos(kπ(n − i)/n), since the points ascend; halved at the ends of either index
        const double half_i = i == 0 || i == n ? 0.5 : 1, half_k = k == 0 || k == n ? 0.5 : 1;
        matrix[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] =
            2.0 / n * half_i * half_k * boost::math::cos_pi(static_cast<double>(k * (n - i) % (2 * n)) / n);
      }
    }
    return matrix;
  }();
  std::array<double, n + 1> coefficients{};
  for (std::size_t k = 0; k <= n; ++k) {
    for (std::size_t i = 0; i <= n; ++i) coefficients[k] += transform[k][i] * values[i];
  }
  return coefficients;
}

}  // namespace albedo
