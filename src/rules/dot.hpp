#pragma once

#include <cstddef>
#include <type_traits>

#include "albedo/core/block.hpp"

namespace albedo {

/// What sums of a rule run over side by side: a block of doubles, or a single wider number.
template <class S>
using Lanes = std::conditional_t<std::is_same_v<S, double>, Block, S>;
template <class S>
inline constexpr std::size_t lanes = std::is_same_v<S, double> ? block_width : 1;

template <class S>
Lanes<S> load_lanes(const S* values) {
  if constexpr (std::is_same_v<S, double>) {
    return Block::load(values);
  } else {
    return *values;
  }
}

inline void store_lanes(const Block& lanes, double* values) { lanes.store(values); }
template <class S>
void store_lanes(const S& lane, S* values) {
  *values = lane;
}

/// Σ a[i] b[i]
template <class S>
S dot(const S* a, const S* b, std::size_t count) {
  S sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

/// In block_width partial sums that are added in pairs, on every machine the same.
inline double dot(const double* a, const double* b, std::size_t count) {
  Block partial(0.0);
  std::size_t i = 0;
  for (; i + block_width <= count; i += block_width) partial += Block::load(a + i) * Block::load(b + i);
  double sums[block_width];
  partial.store(sums);
  for (int half = block_width / 2; half > 0; half /= 2) {
    for (int lane = 0; lane < half; ++lane) sums[lane] += sums[lane + half];
  }
  for (; i < count; ++i) sums[0] += a[i] * b[i];
  return sums[0];
}

}  // namespace albedo
