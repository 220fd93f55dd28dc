/// @file
/// The albedo over cosθ as one small rational function, for renderers that want no texture.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "albedo/directional_albedo.hpp"

namespace albedo::analysis {

/// The factors x − r of real roots, and (x − u)² + v² of pairs of complex ones.
struct RealFactors {
  struct Pair {
    double u, v2;
  };
  std::vector<double> roots{};
  std::vector<Pair> pairs{};

  [[nodiscard]] std::size_t coefficients() const { return roots.size() + 2 * pairs.size(); }

  template <class T>
  [[nodiscard]] T times(T product, T x) const {
    for (const double root : roots) product *= x - T(root);
    for (const Pair& pair : pairs) product *= (x - T(pair.u)) * (x - T(pair.u)) + T(pair.v2);
    return product;
  }
};

/// gain · x^power · P(x)/Q(x) of x = cosθ^(1/root), in factors: none of them cancels where the albedo is smooth, so
/// that a float loses few of its digits, which it would between the powers of a polynomial with zeros close to grazing
/// incidence.
struct RationalForm {
  int root = 2;   ///< 1, 2 or 4
  int power = 0;  ///< of x: what the albedo does at grazing incidence, to the nearest whole power
  double gain = 0;
  RealFactors p{}, q{};

  [[nodiscard]] std::size_t coefficients() const { return 1 + p.coefficients() + q.coefficients(); }

  /// In the arithmetic of T, as the texts of rational_text.hpp do it.
  template <class T>
  [[nodiscard]] T operator()(T cos_theta) const {
    T x = cos_theta;
    if (root >= 2) x = std::sqrt(x);
    if (root == 4) x = std::sqrt(x);
    T result = p.times(T(gain), x) / q.times(T(1), x);
    for (int i = 0; i < power; ++i) result *= x;
    for (int i = 0; i > power; --i) result /= x;
    return result;
  }
};

struct RationalOptions {
  AlbedoOptions albedo{};  ///< of the integrations, whose tolerance is lowered to a hundredth of that of the form
  double tolerance = 1e-6;
  std::size_t most_coefficients = 16;
  double phi_degrees = 0;
  double last_theta = 89.99;  ///< degrees
  int threads = 0;
};

/// Errors are relative to the albedo, or to a thousandth of its largest value where it is less than that.
struct RationalFit {
  RationalForm form;
  double error = 0;        ///< the largest at verified places, which the fit has not seen, and at those it has
  double float_error = 0;  ///< the same, evaluated in float
  double worst_theta = 0;  ///< degrees, of `error`
  double smallest = 0, largest = 0;  ///< albedos that were integrated
  int fitted = 0, verified = 0;      ///< directions integrated for either
  std::int64_t evaluations = 0;
  Status status = Status::converged;  ///< of the worst integration; budget_exhausted where the tolerance isn't met
};

/// The rational form with the fewest coefficients that meets the tolerance, or the best there is. Its denominator has
/// no zero on the interval.
/// @throws ParameterError unless there may be 3 coefficients or more, the tolerance is positive, and last_theta within
/// [1, 90)
RationalFit rational_form(const Model& model, const RationalOptions& options = {});

}  // namespace albedo::analysis
