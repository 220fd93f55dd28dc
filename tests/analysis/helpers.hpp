#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

/// What the tests of readers and writers share.
namespace albedo::analysis {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

using Names = std::vector<std::string>;

/// The message of the Exception that `action` throws; a test failure if it throws none.
template <class Exception, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A random finite double of any sign and exponent.
inline double random_double(std::mt19937_64& generator) {
  for (;;) {
    const auto value = std::bit_cast<double>(generator());
    if (std::isfinite(value)) return value;
  }
}

inline std::string shortest(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

}  // namespace albedo::analysis
