/// @file
/// Random questions to the toolkit: any model, parameters over their ranges, directions down to grazing incidence.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "albedo/core/model.hpp"

namespace albedo::analysis {

struct RandomCase {
  std::string model{};
  Parameters parameters{};  ///< all of them
  double theta_degrees = 0, phi_degrees = 0;
  std::uint64_t choice = 0;  ///< 64 random bits, for whatever else is to be drawn
};

/// Case number `index` of a seed, whatever was asked for before. `models` are names to choose from.
///
/// Parameters: log-uniform over a range of two decades or more (1 + n for an exponent n from 0 on), uniform otherwise;
/// a reflectance is 0 or 1 in an eighth of the cases each. Of two parameters under one shorthand (alpha, n) one half is
/// equal, the others differ by a log-uniform ratio up to 1000.
/// Directions: θ uniform, or 90° − θ log-uniform down to 1e-10°, in half of the cases each; φ a multiple of 90° in a
/// quarter.
RandomCase random_case(std::uint64_t seed, std::uint64_t index, const std::vector<std::string>& models);

/// "albedo at MODEL NAME=VALUE... --theta DEG --phi DEG", with all digits.
std::string command_of(const RandomCase& question);

}  // namespace albedo::analysis
