/// @file
/// A rational function of cosθ in factors, as a shader evaluates it.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace albedo {

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

/// What the rational function is one of, for c = cosθ and s = sinθ. All of them rise with c and lose none of its digits
/// towards grazing incidence. Those with s are smooth in θ at normal incidence, where a BRDF with a kink at equal
/// cosines has odd powers of θ in its albedo.
enum class RationalVariable {
  cosine,          ///< c
  square_root,     ///< √c
  fourth_root,     ///< ∜c
  half_elevation,  ///< c/(1 + s) = tan(45° − θ/2)
  cotangent,       ///< c/(c + s)
  shifted_root,    ///< √(c + d)
  scaled_slope,    ///< c/w, w = √(c² + d s²): 1/√(1 + d tan²θ)
  scaled_half,     ///< c/(w + √(d s² w/(w + c))) = 1 − √(1 − c/w)
};

/// c^(power/2) · (gain · P(x)/Q(x))^(1/exponent), in factors: none of them cancels where the albedo is smooth,
/// so that a float loses few of its digits, which it would between the powers of a polynomial with zeros close to
/// grazing incidence.
struct RationalForm {
  RationalVariable variable = RationalVariable::cosine;
  double shift = 0;  ///< d, of those variables that have one
  int exponent = 1;  ///< 1, 2 or 4
  int power = 0;     ///< of √c: what the albedo does at grazing incidence
  double gain = 0;
  RealFactors p{}, q{};

  [[nodiscard]] bool has_shift() const {
    return variable == RationalVariable::shifted_root || variable == RationalVariable::scaled_slope ||
           variable == RationalVariable::scaled_half;
  }

  /// Fitted numbers: the shift is one of them.
  [[nodiscard]] std::size_t coefficients() const {
    return 1 + p.coefficients() + q.coefficients() + (has_shift() ? 1 : 0);
  }

  template <class T>
  [[nodiscard]] T x(T c) const {
    using std::sqrt;
    switch (variable) {
      case RationalVariable::cosine:
        return c;
      case RationalVariable::square_root:
        return sqrt(c);
      case RationalVariable::fourth_root:
        return sqrt(sqrt(c));
      case RationalVariable::half_elevation:
        return c / (1 + sqrt((1 - c) * (1 + c)));
      case RationalVariable::cotangent:
        return c / (c + sqrt((1 - c) * (1 + c)));
      case RationalVariable::shifted_root:
        return sqrt(c + T(shift));
      case RationalVariable::scaled_slope:
        return c / sqrt(c * c + T(shift) * ((1 - c) * (1 + c)));
      case RationalVariable::scaled_half: {
        const T rest = T(shift) * ((1 - c) * (1 + c)), w = sqrt(c * c + rest);
        return c / (w + sqrt(rest * w / (w + c)));
      }
    }
    return c;
  }

  /// c^(power/2)
  template <class T>
  [[nodiscard]] T leading(T c) const {
    using std::sqrt;
    T result = 1;
    for (int i = 0; i < power; ++i) result *= sqrt(c);
    for (int i = 0; i > power; --i) result /= sqrt(c);
    return result;
  }

  /// In the arithmetic of T, as the texts of rational_writer.hpp do it.
  template <class T>
  [[nodiscard]] T operator()(T c) const {
    using std::sqrt;
    T result = p.times(T(gain), x(c)) / q.times(T(1), x(c));
    for (int root = exponent; root > 1; root /= 2) result = sqrt(result);
    return result * leading(c);
  }
};

}  // namespace albedo
