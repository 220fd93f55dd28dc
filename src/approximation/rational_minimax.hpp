/// @file
/// The rational function of one type that is nearest to given values: the largest error is the least.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace albedo {

/// Values f at abscissas u within [−1, 1], rising, and what errors are relative to, s > 0. In extended precision: a
/// reference of 17 abscissas that crowd at an end takes some digits.
struct MinimaxProblem {
  using Real = long double;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  Vector u, f, s;
};

struct Minimax {
  MinimaxProblem::Vector p{}, q{};  ///< Chebyshev coefficients of numerator and denominator; empty: none was found
  double error = std::numeric_limits<double>::infinity();  ///< the largest |p/q − f|/s
  double least = 0;              ///< no function of this type has a smaller one   [de la Vallée-Poussin 1910]
  std::vector<int> reference{};  ///< indices at which the error alternates
  bool converged = false;        ///< `error` is within 1 % of `least`
};

/// Remez' exchange with a numerator of degree m and a denominator of degree n, from a reference of m + n + 2 rising
/// indices. On a reference the levelled error is an eigenvalue of a symmetric matrix   [Filip, Nakatsukasa, Trefethen &
/// Beckermann 2018, §5], and belongs to the eigenvector whose denominator doesn't change its sign there.
Minimax rational_minimax(const MinimaxProblem& problem, int m, int n, std::vector<int> reference);

/// The indices nearest to the extremes of a Chebyshev polynomial, `size` of them.
std::vector<int> chebyshev_reference(const MinimaxProblem& problem, int size);

/// A reference of another size that is spread alike, for `count` abscissas.
std::vector<int> resized_reference(const std::vector<int>& reference, int size, int count);

/// Chebyshev polynomials T_0 … T_degree at u, one row for each.
Eigen::Matrix<MinimaxProblem::Real, Eigen::Dynamic, Eigen::Dynamic> chebyshev_basis(const MinimaxProblem::Vector& u,
                                                                                    int degree);

}  // namespace albedo
