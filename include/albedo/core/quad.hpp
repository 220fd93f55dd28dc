/// @file
/// 113-bit arithmetic, in which true errors are measured. Nothing that computes in double includes it: Boost's numbers
/// are eight megabytes of header.
#pragma once

// Quad needs nothing of GNU's __float128. Where it is on, in -std=gnu++20, Boost would have every program link
// libquadmath.
#include <boost/config.hpp>
#undef BOOST_HAS_FLOAT128

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "albedo/core/model.hpp"
#include "albedo/core/special.hpp"

namespace albedo {

/// 113-bit binary floating point.
using Quad = boost::multiprecision::number<
    boost::multiprecision::backends::cpp_bin_float<113, boost::multiprecision::backends::digit_base_2, void,
                                                   std::int16_t, -16382, 16383>,
    boost::multiprecision::et_off>;

template <>
inline const Quad pi_of<Quad> = boost::math::constants::pi<Quad>();

/// From Boost's erfc or, where that would underflow, the asymptotic series.
template <>
struct ScaledErfc<Quad> {
  static Quad at(const Quad& x) {
    constexpr int far = 50;
    if (x < far) return exp(Quad(x * x)) * boost::math::erfc(x);
    constexpr int terms = 20;  // (2k − 1)!!/(2x²)^k is below 1e-40 there
    Quad sum = 1, term = 1;
    for (int k = 1; k <= terms; ++k) {
      term *= -Quad(2 * k - 1) / (2 * x * x);
      sum += term;
    }
    return sum / (x * sqrt(pi<Quad>));
  }
};

/// A model's formula in 113 bits: the same template that its other number types are made of.
class QuadFormula {
 public:
  virtual ~QuadFormula() = default;

  /// Lobe `component`'s f(L,V) [1/sr].
  [[nodiscard]] virtual Quad evaluate(int component, const DirectionPair<Quad>& pair) const = 0;
  /// The V that lobe `component`'s sampler makes of a point (u, v) of the unit square; NaN without a sampler.
  [[nodiscard]] virtual Sampled<Quad> sample(int component, const UnitVector<Quad>& l, const Quad& u,
                                             const Quad& v) const = 0;
  /// Model::coherent_albedo, before it is rounded: e^(−g) loses digits where g is large.
  [[nodiscard]] virtual Quad coherent_albedo(const Direction& l) const = 0;

 protected:
  QuadFormula() = default;
  QuadFormula(const QuadFormula&) = default;
  QuadFormula& operator=(const QuadFormula&) = default;
};

template <>
Quad brdf<Quad>(const Model&, const Direction&, const Direction&);

}  // namespace albedo
