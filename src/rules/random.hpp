#pragma once

#include <Random123/philox.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace albedo {

/// The random numbers of a seed: counter-based streams (Philox4x32-10 [Salmon et al. 2011]), so that a number depends
/// on its counter alone and not on when it is asked for.
class RandomStream {
 public:
  using Counter = r123::Philox4x32::ctr_type;

  explicit RandomStream(std::uint64_t seed)
      : key_{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}} {}

  /// Two numbers in (0, 1) with 53 bits each.
  [[nodiscard]] std::array<double, 2> uniform_pair(const Counter& counter) const {
    const auto [a, b] = bits(counter);
    return {unit(a), unit(b)};
  }

  /// Two numbers of 64 bits.
  [[nodiscard]] std::array<std::uint64_t, 2> bits(const Counter& counter) const {
    const Counter words = r123::Philox4x32{}(counter, key_);
    return {(std::uint64_t{words[0]} << 32) | words[1], (std::uint64_t{words[2]} << 32) | words[3]};
  }

  /// A number in (0, 1) from its 53 leading bits.
  static double unit(std::uint64_t bits) { return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53; }

 private:
  r123::Philox4x32::key_type key_;
};

/// What the fourth word of a counter says of who uses the stream; the stratified rule has its size n there.
inline constexpr std::uint32_t monte_carlo_stream = 0, sobol_stream = 0xFFFFFFFF;

/// Mean of values and standard error of that mean.
struct Statistics {
  double mean = 0, standard_error = 0;
};

template <std::size_t N>
Statistics statistics(const std::array<double, N>& values) {
  double mean = 0, squares = 0;
  for (const double value : values) mean += value / N;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (N * (N - 1)))};
}

}  // namespace albedo
