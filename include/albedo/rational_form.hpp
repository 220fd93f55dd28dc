/// @file
/// The albedo over cosθ as one small rational function, for renderers that want no texture.
#pragma once

#include <cstdint>

#include "albedo/directional_albedo.hpp"
#include "albedo/rational_function.hpp"

namespace albedo {

struct RationalOptions {
  AlbedoOptions albedo{};  ///< of the integrations, whose tolerance is lowered to a hundredth of that of the form
  double tolerance = 1e-6;
  std::size_t most_coefficients = 16;
  double phi_degrees = 0;
  double last_theta = 89.99;  ///< degrees
  int threads = 0;
};

/// Errors are relative to the albedo, or to a thousandth of its largest value where it is less than that.
struct RationalFit {
  RationalForm form;
  double error = 0;        ///< the largest at verified places, which the fit has not seen, and at those it has
  double least = 0;        ///< what no function of the same variable and degrees stays below at the fitted places
  double float_error = 0;  ///< the same, evaluated in float
  double worst_theta = 0;  ///< degrees, of `error`
  double smallest = 0, largest = 0;  ///< albedos that were integrated
  int fitted = 0, verified = 0;      ///< directions integrated for either
  std::int64_t evaluations = 0;
  Status status = Status::converged;  ///< of the worst integration; budget_exhausted where the tolerance isn't met
};

/// The rational form with the fewest coefficients that meets the tolerance, or the best there is: of every variable,
/// exponent and pair of degrees the function with the least largest error, by exchange. Its denominator has no zero on
/// the interval. It is verified between all neighbours of the fitted places, and again around every place where that
/// shows the error at its largest.
/// @throws ParameterError unless there may be 3 coefficients or more, the tolerance is positive, and last_theta within
/// [1, 90)
RationalFit rational_form(const Model& model, const RationalOptions& options = {});

}  // namespace albedo
