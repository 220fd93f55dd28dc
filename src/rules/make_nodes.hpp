#pragma once

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/legendre.hpp>
#include <boost/math/special_functions/legendre_stieltjes.hpp>
#include <cmath>
#include <vector>

#include "rules/nodes.hpp"

namespace albedo {

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

/// Gauss's rule for the weight r exp(−r²) on [0, ∞), with weights for the integrand that contains it; good to a double.
Nodes<double> gaussian_nodes(int n);

}  // namespace detail

template <class S>
Nodes<S> make_nodes(AxisKind kind, int n, int extensions) {
  if (kind == AxisKind::interval) return detail::legendre_nodes<S>(n, extensions > 0);
  if (kind != AxisKind::gaussian) return detail::turn_nodes<S>(n, extensions, kind == AxisKind::even_periodic);
  const Nodes<double> nodes = detail::gaussian_nodes(n);
  const auto in_s = [](const std::vector<double>& values) { return std::vector<S>(values.begin(), values.end()); };
  return {in_s(nodes.position), in_s(nodes.weight), nodes.terms, in_s(nodes.transform)};
}

}  // namespace albedo
