#pragma once

#include <algorithm>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <complex>
#include <vector>

#include "albedo/core/number.hpp"
#include "core/integrand.hpp"

namespace albedo {

/// sin(πf/2) and cos(πf/2), exact in their zeros; a block has its own.
template <class T>
void sincos_quarter(const T& f, T& sine, T& cosine) {
  using std::cos;
  using std::round;
  using std::sin;
  const T turns = round(f);
  const T angle = (f - turns) * boost::math::constants::half_pi<T>();
  const T s = sin(angle), c = cos(angle);
  switch (static_cast<int>(turns) & 3) {
    case 0:
      sine = s, cosine = c;
      return;
    case 1:
      sine = c, cosine = -s;
      return;
    case 2:
      sine = -s, cosine = -c;
      return;
    default:
      sine = -c, cosine = s;
      return;
  }
}

/// The azimuth as a Jacobi amplitude, ψ = am(x, k): the substitution that makes √(k′² + k² cos²ψ) = dn(x) analytic.
///
/// At grazing incidence a lobe's horizon has a boundary layer of width k′ ~ cotθ_L around ψ = ±π/2. In x the integrand
/// stays analytic in a strip that doesn't narrow, and a turn is 4K ~ 4 ln(4/k′) long: the layer costs nodes like
/// log(1/cosθ_L).
template <class S>
class Turn {
 public:
  /// @param complement k′ = √(1 − k²), k′ ≤ 1; below 1e-70 it is taken as that
  explicit Turn(const S& complement) : complement_(complement > 1e-70 ? complement : S(1e-70)) {
    S kp = complement_;
    quarter_ = boost::math::constants::half_pi<S>();
    const S converged = 8 * std::numeric_limits<S>::epsilon();
    while (1 - kp > converged) {
      const S k1 = (1 - kp) / (1 + kp);
      steps_.push_back({k1, 2 * kp / (1 + kp)});
      quarter_ *= 1 + k1;
      kp = 2 * sqrt(kp) / (1 + kp);
    }
  }

  /// A quarter turn in x, the complete elliptic integral K(k).
  [[nodiscard]] const S& quarter() const { return quarter_; }

  /// cosψ, sinψ and dψ/dx = dn at x = f K, by descending Landen steps (DLMF 22.7(i), with dn = (cn² + (1 − k₁) sn²)/(1
  /// + k₁ sn²) in terms of the modulus k₁, which has no cancellation); cosψ keeps its relative accuracy at f = ±1.
  template <class T>
  void at(const T& f, T& cosine, T& sine, T& slope) const {
    sincos_quarter(f, sine, cosine);
    slope = T(1);
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
      const T sine2 = square(sine);
      const T inverse = 1 / (1 + step->k1 * sine2);
      const T next_slope = (square(cosine) + step->complement * sine2) * inverse;
      cosine = cosine * (slope * inverse);
      sine = (1 + step->k1) * sine * inverse;
      slope = next_slope;
    }
  }

  /// The f in [0, 2] whose azimuth has this cosine.
  [[nodiscard]] S fraction(const S& cosine) const {
    const S c2 = cosine * cosine;
    const S s2 = (1 - cosine) * (1 + cosine);
    if (s2 <= 0) return cosine > 0 ? S(0) : S(2);
    const S f = sqrt(s2) * boost::math::ellint_rf(c2, c2 + complement_ * complement_ * s2, S(1)) / quarter_;
    return cosine >= 0 ? f : 2 - f;
  }

  /// Nodes to begin with for `digits` decimal digits on a part of the turn, `strip` being the half-width (in x) of
  /// analyticity. The rule doubles them to know its error, which leaves about the square of it: they needn't have all
  /// digits.
  [[nodiscard]] int order(AxisKind kind, double extent, double digits, double strip) const {
    const double length = extent * static_cast<double>(quarter_);
    const double logarithm = (1.2 + 0.7 * digits) * std::log(10.0);
    double nodes = 0;
    if (kind == AxisKind::interval) {
      const std::complex<double> z(1, 2 * strip / length);
      nodes = logarithm / (2 * std::log(std::abs(z + std::sqrt(z * z - 1.0))));
    } else {
      nodes = logarithm * length / (2 * boost::math::constants::pi<double>() * strip);
    }
    return std::clamp(static_cast<int>(std::ceil(nodes)), 4, 128);
  }

 private:
  struct Step {
    S k1, complement;  // k₁ and 1 − k₁
  };
  S complement_;
  S quarter_;
  std::vector<Step> steps_;
};

/// A part of the turn, from f0 to f1 in quarter turns of x.
template <class S>
struct Arc {
  S begin, end;
};

/// The arcs that an arc of the half turn [0, 2] stands for on the whole turn.
template <class S>
std::vector<Arc<S>> whole_turn(const Arc<S>& arc) {
  if (arc.begin == 0 && arc.end == 2) return {{S(-2), S(2)}};
  if (arc.begin == 0) return {{-arc.end, arc.end}};
  if (arc.end == 2) return {{arc.begin, 4 - arc.begin}};
  return {arc, {-arc.end, -arc.begin}};
}

}  // namespace albedo
