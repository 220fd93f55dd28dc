#pragma once

#include <array>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "albedo/core/number.hpp"

namespace albedo {

/// The projected area A(K) = ∫ D (H·K)₊ dω_H of facets with D = (n+2)/(2π) (N·H)^n, that is N·K (1 + Λ(K)) of their
/// Smith masking; also the albedo of reciprocal Phong. With c = N·K, s² = 1 − c²:
///
///     A = c + s^(n+2) b(c),   b = C ∫₀¹ w^n (1 − c w/q) dw,   q² = 1 − w² + c² w²,   C = (n+1) Γ((n+1)/2)/(2√π
///     Γ(n/2+1))
///
/// b is tabulated as a Chebyshev series in a variable that follows its scale, n^(−1/2); A is then good to 1e-14.
class PowerArea {
 public:
  explicit PowerArea(double n) : n_(n), scale_(3.75 * std::sqrt(2 / (n + 2))) {
    constexpr double pi_ = boost::math::constants::pi<double>();
    std::array<double, terms> values{};
    for (std::size_t i = 0; i < terms; ++i) {
      const double t = std::cos(pi_ * (static_cast<double>(i) + 0.5) / terms);
      values[i] = excess(scale_ * (1 + t) / (1 + 2 * scale_ - t));
    }
    for (std::size_t k = 0; k < terms; ++k) {
      double sum = 0;
      for (std::size_t i = 0; i < terms; ++i) {
        sum += values[i] * std::cos(pi_ * static_cast<double>(k) * (static_cast<double>(i) + 0.5) / terms);
      }
      series_[k] = (k == 0 ? 1 : 2) * sum / terms;
    }
  }

  /// A of a direction whose N·K is z.
  template <class T>
  T operator()(const T& z) const noexcept {
    const T t = (T(1 + 2 * scale_) * z - T(scale_)) / (z + T(scale_));
    T next(0.0), current(0.0);  // Clenshaw
    for (std::size_t k = terms - 1; k > 0; --k) {
      const T previous = T(series_[k]) + 2 * t * current - next;
      next = current;
      current = previous;
    }
    const T b = T(series_[0]) + t * current - next;
    return z + exp(T(n_ / 2 + 1) * log1p(T(-min(T(square(z)), T(1.0))))) * b;
  }

 private:
  static constexpr std::size_t terms = 32;

  /// b(c), in v = √(1 − w²) and without cancellation.
  [[nodiscard]] double excess(double c) const {
    const auto integrand = [&](double v, double to_end) {  // to_end: 1 − v near 1, −v near 0
      const double w2 = v > 0.5 ? to_end * (1 + v) : (1 - v) * (1 + v);
      const double q = std::sqrt(v * v + c * c * w2);
      return std::exp((n_ - 1) / 2 * (v > 0.5 ? std::log(w2) : std::log1p(-v * v))) * v * v * v /
             (q * (q + c * std::sqrt(w2)));
    };
    const double ratio = boost::math::tgamma_delta_ratio((n_ + 1) / 2, 0.5);  // Γ((n+1)/2)/Γ(n/2+1)
    boost::math::quadrature::tanh_sinh<double> rule;
    return (n_ + 1) / (2 * std::sqrt(boost::math::constants::pi<double>())) * ratio *
           rule.integrate(integrand, 0.0, 1.0, 1e-12);
  }

  double n_, scale_;
  std::array<double, terms> series_{};
};

}  // namespace albedo
