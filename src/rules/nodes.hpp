#pragma once

#include <Eigen/Eigenvalues>
#include <array>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/special_functions/legendre.hpp>
#include <memory>
#include <mutex>
#include <vector>

#include "albedo/core/integrand.hpp"

namespace albedo {

/// A one-dimensional rule on [0, 1] (gaussian: for r on [0, ∞)), and the matrix that turns values at its nodes into the
/// coefficients of their expansion.
template <class S>
struct Nodes {
  std::vector<S> position;
  std::vector<S> weight;  // interval and turn: sums to 1
  int terms = 0;
  std::vector<S> transform;  // terms × nodes
};

/// Where raising the order ends and bisection begins.
constexpr int most_nodes(AxisKind kind) {
  switch (kind) {
    case AxisKind::interval:
      return 128;
    case AxisKind::gaussian:
      return 16;
    default:
      return 256;
  }
}

namespace detail {

template <class S>
Nodes<S> legendre_nodes(int n) {
  Nodes<S> nodes;
  const auto size = static_cast<std::size_t>(n);
  nodes.position.resize(size);
  nodes.weight.resize(size);
  const std::vector<S> zeros = boost::math::legendre_p_zeros<S>(n);  // the non-negative ones, ascending
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    const S x = zeros[i];
    const S slope = boost::math::legendre_p_prime<S>(n, x);
    const S weight = 1 / ((1 - x) * (1 + x) * slope * slope);
    const std::size_t up = size - zeros.size() + i, down = zeros.size() - 1 - i;
    nodes.position[up] = (1 + x) / 2;
    nodes.position[down] = (1 - x) / 2;
    nodes.weight[up] = nodes.weight[down] = weight;
  }
  nodes.terms = n;
  nodes.transform.resize(size * size);
  for (std::size_t i = 0; i < size; ++i) {
    const S x = 2 * nodes.position[i] - 1;
    S previous = 1, current = x;
    for (std::size_t k = 0; k < size; ++k) {
      const S p = k == 0 ? S(1) : current;
      nodes.transform[k * size + i] = S(2 * k + 1) * nodes.weight[i] * p;
      if (k == 0) continue;
      const S next = (S(2 * k + 1) * x * current - S(k) * previous) / S(k + 1);
      previous = current;
      current = next;
    }
  }
  return nodes;
}

/// Midpoints; cosine terms of half periods (even), or cosine and sine terms of whole ones.
template <class S>
Nodes<S> turn_nodes(int n, bool even) {
  using std::cos;
  using std::sin;
  Nodes<S> nodes;
  const auto size = static_cast<std::size_t>(n);
  for (int i = 0; i < n; ++i) {
    nodes.position.push_back(S(2 * i + 1) / S(2 * n));
    nodes.weight.push_back(S(1) / S(n));
  }
  nodes.terms = n;
  nodes.transform.resize(size * size);
  const S turn = boost::math::constants::pi<S>() * (even ? 1 : 2);
  for (std::size_t k = 0; k < size; ++k) {
    const S harmonic = S(even ? k : (k + 1) / 2);
    for (std::size_t i = 0; i < size; ++i) {
      const S angle = turn * harmonic * nodes.position[i];
      nodes.transform[k * size + i] =
          (k == 0 ? 1 : 2) * nodes.weight[i] * (even || k % 2 == 1 || k == 0 ? cos(angle) : sin(angle));
    }
  }
  return nodes;
}

/// Gauss's rule for the weight r exp(−r²) on [0, ∞), with weights for the integrand that contains it.
///
/// Recurrence coefficients from the moments Γ(k/2 + 1)/2 (Chebyshev's algorithm), which takes more digits than are
/// kept; then the eigenvalues of the Jacobi matrix (Golub and Welsch).
template <class S>
Nodes<S> gaussian_nodes(int n) {
  using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;
  const auto size = static_cast<std::size_t>(n);
  std::vector<Wide> previous(2 * size, Wide(0)), current(2 * size), next(2 * size);
  for (std::size_t k = 0; k < 2 * size; ++k) current[k] = boost::math::tgamma(Wide(k) / 2 + 1) / 2;
  Eigen::VectorXd diagonal(n), below(n - 1);
  Wide alpha = current[1] / current[0], beta = 0;
  diagonal[0] = static_cast<double>(alpha);
  for (std::size_t k = 1; k < size; ++k) {
    for (std::size_t l = k; l < 2 * size - k; ++l) next[l] = current[l + 1] - alpha * current[l] - beta * previous[l];
    beta = next[k] / current[k - 1];
    alpha = next[k + 1] / next[k] - current[k] / current[k - 1];
    diagonal[static_cast<Eigen::Index>(k)] = static_cast<double>(alpha);
    below[static_cast<Eigen::Index>(k) - 1] = static_cast<double>(sqrt(beta));
    std::swap(previous, current);
    std::swap(current, next);
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, below);
  Nodes<S> nodes;
  nodes.terms = n;
  nodes.transform.resize(size * size);
  for (int i = 0; i < n; ++i) {
    const double r = solver.eigenvalues()[i], first = solver.eigenvectors()(0, i);
    const double weight = first * first / 2 / (r * std::exp(-r * r));
    nodes.position.push_back(S(r));
    nodes.weight.push_back(S(weight));
    for (int k = 0; k < n; ++k) {
      nodes.transform[static_cast<std::size_t>(k) * size + static_cast<std::size_t>(i)] =
          S(weight * solver.eigenvectors()(k, i) / first);
    }
  }
  return nodes;
}

}  // namespace detail

/// The rule of n nodes for an axis of that kind, 2 ≤ n ≤ most_nodes(kind); made when first asked for.
template <class S>
const Nodes<S>& nodes_of(AxisKind kind, int n) {
  struct Slot {
    std::once_flag made;
    std::unique_ptr<const Nodes<S>> nodes;
  };
  static std::array<std::array<Slot, most_nodes(AxisKind::periodic) + 1>, 4> slots;
  Slot& slot = slots[static_cast<std::size_t>(kind)][static_cast<std::size_t>(n)];
  std::call_once(slot.made, [&] {
    Nodes<S> made = kind == AxisKind::interval   ? detail::legendre_nodes<S>(n)
                    : kind == AxisKind::gaussian ? detail::gaussian_nodes<S>(n)
                                                 : detail::turn_nodes<S>(n, kind == AxisKind::even_periodic);
    slot.nodes = std::make_unique<const Nodes<S>>(std::move(made));
  });
  return *slot.nodes;
}

}  // namespace albedo
