#pragma once

#include <array>

#include "albedo/core/special.hpp"

namespace albedo {

namespace detail {

/// What a number type's sum leaves out, in factors e and in standard deviations, and how fine a resampled one is.
template <class T>
struct WaveSeriesAccuracy {
  static constexpr double left_out = is_wide<T> ? 65 : 40, left = is_wide<T> ? 13.5 : 10,
                          right = is_wide<T> ? 11.5 : 8.7, steps = is_wide<T> ? 2.1 : 1.6,
                          least_peak = is_wide<T> ? 60 : 24;
  static constexpr std::size_t stirling_terms = is_wide<T> ? 13 : 7;
};

inline constexpr int most_wave_terms = 240;

/// ln(m! m) for m = 0 (not used), 1, …, in 113 bits, rounded to S.
template <class S>
const std::array<S, most_wave_terms + 1>& wave_term_logarithms();

/// B_2k/(2k(2k − 1)), the coefficients of 1/m^(2k − 1) in Stirling's series of ln(m!/(√(2πm) (m/e)^m)).
inline constexpr std::array<double, 13> stirling_numerators{1,     -1,    1,       -1,    1,          -691,  1,
                                                            -3617, 43867, -174611, 77683, -236364091, 657931};
inline constexpr std::array<double, 13> stirling_denominators{12,     360,    1260,   1680, 1188,    360360, 156,
                                                              122400, 244188, 125400, 5796, 1506960, 300};

template <class T>
T stirling_remainder(const T& m) {
  const T inverse = 1 / m, inverse2 = square(inverse);
  T sum(0.0);
  for (std::size_t k = WaveSeriesAccuracy<T>::stirling_terms; k-- > 0;) {
    sum = sum * inverse2 + T(Scalar<T>(stirling_numerators[k]) / Scalar<T>(stirling_denominators[k]));
  }
  return sum * inverse;
}

/// ln(y) − x for y = 1 + x, to its own last digits.
template <class T>
T log1p_minus(const T& x, const T& y) {
  constexpr double small = 0.25;
  constexpr int terms = is_wide<T> ? 20 : 10;
  const T z = x / (2 + x), z2 = square(z);  // ln(1 + x) = 2 artanh(z), 2z − x = −z x
  T sum(0.0);
  for (int k = terms; k > 0; --k) sum = sum * z2 + T(Scalar<T>(1) / Scalar<T>(2 * k + 1));
  const T near = z * (2 * z2 * sum - x);
  return select(abs(x) < T(small), near, T(log(y) - x));
}

inline double largest(const Block& x) {
  double most = x[0];
  for (int lane = 1; lane < block_width; ++lane) most = most < x[lane] ? x[lane] : most;
  return most;
}
template <class T>
double largest(const T& x) {
  return static_cast<double>(x);
}
inline bool any(const BlockMask& mask) { return largest(select(mask, Block(1), Block(0))) > 0; }
inline bool any(bool mask) { return mask; }

}  // namespace detail

/// The series of scattering by a rough surface of Gaussian heights and correlation,
///
///     T(g, b) = Σ_{m≥1} g^m e^(−g)/(m! m) e^(−b/m),   b = g·ratio
///
/// [Beckmann & Spizzichino 1963, §5.3, eq. 35; He et al. 1991, eq. 78], to 1e-13 of itself for any g > 0 and b ≥ 0
/// (float: 1e-5; 113 bits: 1e-27), 0 where it underflows.
///
/// Its terms are largest at m₀ = g e^(W/2), W = W₀(2b/g²), with variance m₀/(1 + W). A narrow or low peak is summed as
/// it stands, in logarithms. A wide one, 0 at m = 0 to all digits, is smooth and equal to its integral, which needs no
/// more than 1.6 points a standard deviation (in √m, which evens out the skewness): 30 for any g.
template <class T>
T wave_series(const T& g, const T& ratio) {
  using Accuracy = detail::WaveSeriesAccuracy<T>;
  constexpr double tiny = 1e-18, huge = 1e37;  // beyond them the peak's place no longer matters
  const T b = ratio * g;
  const T held = max(g, T(tiny));
  const T w = lambert_w(T(min(T(huge), T(2 * (b / held) / held))));
  const T peak = held * exp(T(w / 2));
  const T variance = peak / (1 + w);
  const T log_g = log(g);
  // ln of the peak's term over the first one's
  const T rise = (peak * (1 - w) - g) - (1 - g + log_g - b);
  // how far each condition of resampling is met
  const T met = min(min(T(variance - T(square(Accuracy::steps))), T(rise - T(Accuracy::left_out))),
                    T(peak - T(Accuracy::least_peak)));
  const auto is_resampled = met > T(0.0);

  // beyond the peak the terms fall at least as a Poisson distribution's do
  constexpr double third = Accuracy::left_out / 3;
  const T from = max(T(1.0), peak);
  const T last = from + T(third) + sqrt(T(square(third)) + T(2 * Accuracy::left_out) * from);
  const double count = detail::largest(select(is_resampled, T(0.0), last));
  const int terms = count <= detail::most_wave_terms ? static_cast<int>(count) : detail::most_wave_terms;
  const auto& logarithms = detail::wave_term_logarithms<Scalar<T>>();
  T summed(0.0);
  for (int m = 1; m <= terms; ++m) {
    const T constant(logarithms[static_cast<std::size_t>(m)]);
    summed += exp(T(T(Scalar<T>(m)) * log_g - constant - g - b * T(Scalar<T>(1) / Scalar<T>(m))));
  }
  if (!detail::any(is_resampled)) return summed;

  const T root = sqrt(select(is_resampled, peak, T(100.0)));
  const T spread = 1 / (2 * sqrt(T(1 + w)));
  const T step = spread / T(Accuracy::steps);
  const T excess = root * root * expm1(T(-w / 2));  // g − m₀
  constexpr int first = -static_cast<int>(Accuracy::left * Accuracy::steps),
                final = static_cast<int>(Accuracy::right * Accuracy::steps);
  T integrated(0.0);
  for (int j = first; j <= final; ++j) {
    const T along = T(Scalar<T>(j)) * step;
    const T beside = along * (2 * root + along);
    const T m = max(T(square(T(root + along))), T(1.0));
    const T x = (excess - beside) / m;
    integrated += exp(T(m * detail::log1p_minus(x, T(held / m)) - b / m - detail::stirling_remainder(m))) / m;
  }
  return select(is_resampled, T(integrated * step * 2 / sqrt(2 * pi<T>)), summed);
}

}  // namespace albedo
