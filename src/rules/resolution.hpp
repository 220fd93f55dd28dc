#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "rules/dot.hpp"
#include "rules/nodes.hpp"

namespace albedo {

/// How well an order resolves one axis of a cell, and what another order would do: a parabola through the logarithm of
/// the expansion's coefficients.
template <class S>
struct Resolution {
  S reading{};  // the error that the decay foretells
  bool decays = false;
  double last = 0, log_last = 0, slope = 0,
         curvature = 0;  // at term `last`: logarithm of the coefficient, its derivatives (both ≤ 0)
  double fallen = 0;     // what the logarithm has lost up to there

  [[nodiscard]] double log_coefficient(double term) const {
    const double ahead = term - last;
    return log_last + ahead * (slope + curvature * ahead / 2);
  }

  /// Whether twice the nodes would bring little more than another digit.
  [[nodiscard]] bool slow(double n) const {
    constexpr double little = 3;
    return !decays || log_error(n) - log_error(2 * n) < little;
  }

  /// The logarithm of the error of n nodes, which errs by the coefficients from 2n on. The extrapolation is trusted for
  /// two thirds, and no further than the coefficients have been seen to fall.
  [[nodiscard]] double log_error(double n) const {
    const double known = log_coefficient(n - 2);
    return known + std::max(0.67 * (log_coefficient(2 * n) - known), -1.2 * (fallen + std::max(0.0, log_last - known)));
  }
};

/// Reads the error of n nodes off the decay of the expansion of their values. @param scratch is overwritten
template <class S>
Resolution<S> resolution(const Nodes<S>& nodes, const S* values, std::vector<S>& scratch) {
  const auto n = static_cast<std::size_t>(nodes.terms);
  const std::size_t tail = std::min<std::size_t>(n, 3);
  // envelope: the largest coefficient from a third, from two thirds, and of the last three terms on
  const std::size_t third = n - tail, second = std::min((n / 3 + third) / 2 + 1, third),
                    first = std::min(n / 3, second);
  scratch.assign(n, S(0));
  S* coefficients = scratch.data();
  for (std::size_t i = 0; i < nodes.position.size(); ++i) {
    const S* row = nodes.transform.data() + i * n;
    const S value = values[i];
    for (std::size_t k = first; k < n; ++k) coefficients[k] += row[k] * value;
  }
  const auto largest = [&](std::size_t begin, std::size_t end) {
    S size = 0;
    for (std::size_t k = begin; k < end; ++k) {
      size = std::max<S>(size, coefficients[k] < 0 ? S(-coefficients[k]) : coefficients[k]);
    }
    return size;
  };
  S envelope[3];
  envelope[2] = largest(third, n);
  envelope[1] = std::max<S>(envelope[2], largest(second, third));
  envelope[0] = std::max<S>(envelope[1], largest(first, second));
  Resolution<S> result;
  using std::exp;
  using std::log;
  if (envelope[2] == 0) {
    result.decays = true;
    result.slope = -40;
    result.fallen = 40;
    return result;
  }
  result.reading = 2 * envelope[2];
  if (first == second || second == third || !(2 * envelope[2] < envelope[0])) return result;
  const double l1 = static_cast<double>(log(envelope[0])), l2 = static_cast<double>(log(envelope[1])),
               l3 = static_cast<double>(log(envelope[2]));
  const double x1 = static_cast<double>(first), x2 = static_cast<double>(second), x3 = static_cast<double>(third);
  const double slope1 = (l2 - l1) / (x2 - x1), slope2 = (l3 - l2) / (x3 - x2);
  const double bend = (slope2 - slope1) / ((x3 - x1) / 2);
  result.decays = true;
  result.last = x3 + 1;
  result.log_last = l3;
  result.fallen = l1 - l3;
  if (bend <= 0) {  // geometric, or faster
    result.curvature = bend;
    result.slope = slope2 + bend * (x3 - x2) / 2;
  } else if (slope2 < 0.4 * slope1) {  // nearly geometric
    result.slope = slope2;
  } else {  // slower: as a power of the term
    result.slope = std::max(slope2, (l3 - l1) / std::log((x3 + 1) / (x1 + 1)) / (x3 + 1));
  }
  result.reading = std::min<S>(result.reading, exp(S(result.log_error(static_cast<double>(n)))));
  if (bend > 0) result.reading *= 4;  // a power's tail adds up
  return result;
}

}  // namespace albedo
