#pragma once

#include <array>

#include "albedo/core/number.hpp"

namespace albedo {

/// Draws an azimuth φ of density ∝ 1/√(cos²φ + p² sin²φ), 0 < p ≤ 1: φ = am(4K(k) v), k² = 1 − p², the inverse of the
/// elliptic integral of the first kind. Gauss's arithmetic–geometric mean of 1 and p leads to the amplitude by
/// φ_N = 2^N a_N x, sin(2φ_(i−1) − φ_i) = c_i/a_i sinφ_i   [Abramowitz & Stegun, 16.4], and to K = π/(2 a_N). One
/// formula for all quadrants.
template <class T>
class EllipticAzimuth {
  using S = Scalar<T>;

 public:
  explicit EllipticAzimuth(double p) noexcept : a_(1) {
    using std::sqrt;
    S b = S(p);
    for (S& ratio : ratios_) {
      const S next = (a_ + b) / 2;
      ratio = (a_ - b) / (2 * next);  // c/a
      b = sqrt(S(a_ * b));
      a_ = next;
    }
  }

  /// The mean of 1/√(cos²φ + p² sin²φ) over the azimuth is 1 over that of 1 and p.
  [[nodiscard]] const S& mean() const noexcept { return a_; }

  /// φ of v in (0, 1), a turn.
  [[nodiscard]] T operator()(const T& v) const noexcept {
    using std::atan;
    using std::sin;
    T phi = T(S(1 << steps)) * 2 * pi<T> * v;  // 2^N a_N 4K v
    for (int i = steps - 1; i >= 0; --i) {
      const T sine = T(ratios_[static_cast<std::size_t>(i)]) * sin(phi);
      phi = (phi + atan(T(sine / sqrt(T(1 - square(sine)))))) / 2;
    }
    return phi;
  }

 private:
  static constexpr int steps = 8;  // the ratio c/a after them is below 1e-65 for p ≥ 1e-3

  S a_;
  std::array<S, steps> ratios_;
};

}  // namespace albedo
