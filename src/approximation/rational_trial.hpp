/// @file
/// One way to write an albedo as a rational function: a variable, an exponent, a power; the degrees are free.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "albedo/rational_function.hpp"
#include "approximation/rational_minimax.hpp"

namespace albedo {

/// What is fitted: values over cosθ, and what errors are relative to.
struct RationalSample {
  double cos_theta, value, scale;
};

/// The degrees of numerator and denominator.
using RationalType = std::pair<int, int>;

class RationalTrial {
 public:
  /// @param form without factors
  /// @param samples with rising, different cosines; they are kept by reference
  RationalTrial(RationalForm form, const std::vector<RationalSample>& samples);

  /// Tries a reference for these degrees, unless one has converged before.
  void attempt(RationalType type, const std::vector<int>& reference);
  /// The same from what this trial knows by itself: its reference for lower degrees, and Chebyshev's.
  void attempt(RationalType type);

  [[nodiscard]] const Minimax& best(RationalType type) { return found_[type]; }
  /// The form with the factors of the best function; nothing if there is none without poles.
  [[nodiscard]] std::optional<RationalForm> form(RationalType type);
  [[nodiscard]] const RationalForm& shape() const { return form_; }

 private:
  [[nodiscard]] MinimaxProblem problem_of(int excess) const;
  [[nodiscard]] RealFactors factors_of(const MinimaxProblem::Vector& coefficients) const;

  RationalForm form_;
  const std::vector<RationalSample>* samples_;
  MinimaxProblem::Vector x_;
  MinimaxProblem::Real first_ = 0, middle_ = 1, reach_ = 1;  ///< u + 1 = 2/reach · (x − first)/(x − first + middle)
  std::map<RationalType, Minimax> found_;
};

}  // namespace albedo
