#pragma once

#include <cstddef>
#include <vector>

namespace albedo {

/// The barycentric rational function through (x_j, f_j), Σ w_j f_j/(t − x_j) / Σ w_j/(t − x_j); x ascends.
double rational(const std::vector<double>& x, const std::vector<double>& f, const std::vector<double>& w, double t);

/// Weights with which the rational function through the points `support` (indices into x, ascending) follows the other
/// points most closely: the least-squares step of the AAA algorithm   [Nakatsukasa, Sète & Trefethen 2018, §3].
///
/// There must be as many other points as support points, at least.
std::vector<double> rational_weights(const std::vector<double>& x, const std::vector<double>& f,
                                     const std::vector<std::size_t>& support);

/// The first j for which the rational function has a pole between x_j and x_{j+1}, or x.size() if it has none.
std::size_t pole(const std::vector<double>& x, const std::vector<double>& w);

/// Slopes with which the piecewise cubic through (x_j, f_j) is monotone wherever the points are   [Fritsch & Butland
/// 1984]; three points at least.
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& f);

/// The piecewise cubic through (x_j, f_j) with these slopes.
double monotone(const std::vector<double>& x, const std::vector<double>& f, const std::vector<double>& slopes,
                double t);

}  // namespace albedo
