#pragma once

#include <Eigen/Eigenvalues>
#include <array>
#include <atomic>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/special_functions/legendre.hpp>
#include <boost/math/special_functions/legendre_stieltjes.hpp>
#include <memory>
#include <mutex>
#include <vector>

#include "albedo/core/integrand.hpp"

namespace albedo {

/// A one-dimensional rule on [0, 1] (gaussian: for r on [0, ∞)), and the matrix that turns values at its nodes into the
/// coefficients of their expansion: c_k = Σ_i transform[i * terms + k] w_i.
template <class S>
struct Nodes {
  std::vector<S> position;     // those of the rule that this one extends come first
  std::vector<S> weight;       // interval and turn: sums to 1
  int terms = 0;               // it integrates half of its degree of exactness
  std::vector<S> transform{};  // nodes × terms
};

/// The largest order of an axis, extensions included.
constexpr int most_nodes(AxisKind kind) {
  switch (kind) {
    case AxisKind::interval:
      return 128;
    case AxisKind::gaussian:
      return 16;  // more would leave gaussian_reach
    default:
      return 512;
  }
}

namespace detail {

/// P_n′(x)
template <class S>
S legendre_slope(int n, const S& x) {
  return boost::math::legendre_p_prime<S>(n, x);
}

template <class S>
Nodes<S> legendre_rule(int n) {
  Nodes<S> nodes;
  const auto size = static_cast<std::size_t>(n);
  nodes.position.resize(size);
  nodes.weight.resize(size);
  const std::vector<S> zeros = boost::math::legendre_p_zeros<S>(n);  // the non-negative ones, ascending
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    const S x = zeros[i];
    const S slope = legendre_slope<S>(n, x);
    const S weight = 1 / ((1 - x) * (1 + x) * slope * slope);
    const std::size_t up = size - zeros.size() + i, down = zeros.size() - 1 - i;
    nodes.position[up] = (1 + x) / 2;
    nodes.position[down] = (1 - x) / 2;
    nodes.weight[up] = nodes.weight[down] = weight;
  }
  return nodes;
}

/// Joins the zeros of the Legendre–Stieltjes polynomial to Gauss's nodes (Kronrod).
template <class S>
void extend(Nodes<S>& nodes) {
  const int n = static_cast<int>(nodes.position.size());
  const boost::math::legendre_stieltjes<S> stieltjes(static_cast<std::size_t>(n) + 1);
  for (int i = 0; i < n; ++i) {
    const S x = 2 * nodes.position[static_cast<std::size_t>(i)] - 1;
    const S mirrored = x < 0 ? S(-x) : x;  // slope and polynomial are even and odd, or odd and even
    nodes.weight[static_cast<std::size_t>(i)] += 1 / (S(n + 1) * legendre_slope<S>(n, mirrored) * stieltjes(mirrored));
  }
  for (const S& x : stieltjes.zeros()) {  // the non-negative ones
    const S weight = 1 / (S(n + 1) * S(boost::math::legendre_p(n, x)) * stieltjes.prime(x));
    for (const int side : {1, -1}) {
      if (side < 0 && x == 0) continue;
      nodes.position.push_back((1 + side * x) / 2);
      nodes.weight.push_back(weight);
    }
  }
  nodes.terms = n + n / 2;
}

template <class S>
Nodes<S> legendre_nodes(int n, bool extended) {
  Nodes<S> nodes = legendre_rule<S>(n);
  nodes.terms = n;
  if (extended) extend(nodes);
  const std::size_t size = nodes.position.size();
  nodes.transform.resize(static_cast<std::size_t>(nodes.terms) * size);
  for (std::size_t i = 0; i < size; ++i) {
    const S x = 2 * nodes.position[i] - 1;
    S previous = 0, current = 1;  // P_k by its recurrence
    for (int k = 0; k < nodes.terms; ++k) {
      nodes.transform[i * static_cast<std::size_t>(nodes.terms) + static_cast<std::size_t>(k)] =
          S(2 * k + 1) * nodes.weight[i] * current;
      const S next = (S(2 * k + 1) * x * current - S(k) * previous) / S(k + 1);
      previous = current;
      current = next;
    }
  }
  return nodes;
}

/// Midpoints of a turn's n parts, `doublings` times joined by the points between them; cosine terms of half periods
/// (even), or cosine and sine terms of whole ones.
template <class S>
Nodes<S> turn_nodes(int n, int doublings, bool even) {
  using std::cos;
  using std::sin;
  const int parts = doublings > 1 ? n << doublings : 2 * n;  // nodes are multiples of one of these
  std::vector<int> places;
  for (int i = 0; i < n; ++i) places.push_back((2 * i + 1) * (parts / (2 * n)));
  if (doublings > 0) {
    for (int i = 0; i < (even ? n + 1 : n); ++i) places.push_back(i * (parts / n));
  }
  for (int doubling = 1; doubling < doublings; ++doubling) {
    const int halves = 2 * n << doubling;
    for (int i = 1; i < halves; i += 2) places.push_back(i * (parts / halves));
  }
  Nodes<S> nodes;
  nodes.terms = n << doublings;
  for (const int place : places) {
    nodes.position.push_back(S(place) / S(parts));
    nodes.weight.push_back((even && (place == 0 || place == parts) ? S(0.5) : S(1)) / S(nodes.terms));
  }
  const int turn = even ? 2 * parts : parts;
  std::vector<S> cosine, sine;
  for (int i = 0; i < turn; ++i) {
    const S angle = 2 * boost::math::constants::pi<S>() * S(i) / S(turn);
    cosine.push_back(cos(angle)), sine.push_back(sin(angle));
  }
  nodes.transform.reserve(static_cast<std::size_t>(nodes.terms) * places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (int k = 0; k < nodes.terms; ++k) {
      const int harmonic = even ? k : (k + 1) / 2;
      const std::vector<S>& wave = even || k % 2 == 1 || k == 0 ? cosine : sine;
      nodes.transform.push_back((k == 0 ? 1 : 2) * nodes.weight[i] *
                                wave[static_cast<std::size_t>(harmonic * places[i] % turn)]);
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
      nodes.transform[static_cast<std::size_t>(i) * size + static_cast<std::size_t>(k)] =
          S(weight * solver.eigenvectors()(k, i) / first);
    }
  }
  return nodes;
}

}  // namespace detail

/// The rule of n nodes for an axis of that kind, made when first asked for; n ≤ most_nodes(kind).
///
/// An extension joins new nodes to those it had: a turn's double, as often as most_nodes allows, and Gauss's n get
/// Kronrod's n + 1 (once).
template <class S>
const Nodes<S>& nodes_of(AxisKind kind, int n, int extensions = 0) {
  struct Slot {
    std::once_flag once;
    std::unique_ptr<const Nodes<S>> nodes;
    std::atomic<const Nodes<S>*> made = nullptr;  // looking here is all that most calls do
  };
  constexpr std::size_t orders = most_nodes(AxisKind::periodic) + 1, levels = 8;
  static std::array<std::array<std::array<Slot, levels>, orders>, 4> slots;
  Slot& slot = slots[static_cast<std::size_t>(kind)][static_cast<std::size_t>(n)][static_cast<std::size_t>(extensions)];
  if (const Nodes<S>* made = slot.made.load(std::memory_order_acquire)) return *made;
  std::call_once(slot.once, [&] {
    Nodes<S> nodes = kind == AxisKind::interval ? detail::legendre_nodes<S>(n, extensions > 0)
                     : kind == AxisKind::gaussian
                         ? detail::gaussian_nodes<S>(n)
                         : detail::turn_nodes<S>(n, extensions, kind == AxisKind::even_periodic);
    slot.nodes = std::make_unique<const Nodes<S>>(std::move(nodes));
    slot.made.store(slot.nodes.get(), std::memory_order_release);
  });
  return *slot.nodes;
}

}  // namespace albedo
