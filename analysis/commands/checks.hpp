/// @file
/// What a computing subcommand ends with: its --assert conditions, and its exit code.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "analysis/commands/syntax.hpp"
#include "analysis/text/assertion.hpp"

namespace albedo::analysis {

/// Adds --assert, which may be given several times. While parsing, a malformed condition throws a ParameterError.
void add_assert_option(const Syntax& command, std::vector<Assertion>& assertions);

/// Refuses, before anything is computed, an at(θ,φ) that the results can't answer.
/// @throws ParameterError that ends with `reason`
void check_answerable(const std::vector<Assertion>& assertions,
                      const std::function<bool(double theta, double phi)>& can_answer, const std::string& reason);

/// The extremes and the mean of some values; NaN if one of them is NaN.
struct Extent {
  double max, min, mean;
};
Extent extent_of(const std::vector<double>& values);

/// The same for values that are elsewhere.
Extent extent_of(std::size_t size, const std::function<double(std::size_t)>& value);

/// How many results there are, and how many of them missed the tolerance.
struct Convergence {
  std::size_t results = 0;
  std::size_t missed = 0;
};

/// Says on standard error which conditions fail and how many results missed their tolerance, one line each.
int concluding_exit_code(const std::vector<Assertion>& assertions, const Facts& facts, const Convergence& convergence);

}  // namespace albedo::analysis
