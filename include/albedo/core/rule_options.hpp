#pragma once

#include <cstdint>

namespace albedo {

/// What every rule is asked for.
struct RuleOptions {
  double tolerance = 1e-8;          ///< relative to the integral
  std::int64_t budget = 2'000'000;  ///< most evaluations
  std::uint64_t seed = 1;           ///< Monte Carlo rules
};

}  // namespace albedo
