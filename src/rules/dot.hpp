#pragma once

#include <cstddef>

#include "albedo/core/block.hpp"

namespace albedo {

/// Σ a[i] b[i]
template <class S>
S dot(const S* a, const S* b, std::size_t count) {
  S sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

/// In block_width partial sums, on every machine the same.
inline double dot(const double* a, const double* b, std::size_t count) {
  Block partial(0.0);
  std::size_t i = 0;
  for (; i + block_width <= count; i += block_width) partial += Block::load(a + i) * Block::load(b + i);
  double sum = 0;
  for (int lane = 0; lane < block_width; ++lane) sum += partial[lane];
  for (; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace albedo
