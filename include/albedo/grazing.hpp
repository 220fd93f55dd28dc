#pragma once

#include "albedo/directional_albedo.hpp"

namespace albedo {

/// a(L) ~ constant · (N·L)^−exponent as L approaches grazing incidence. Exponent 0: the constant is the limit.
struct PowerLaw {
  double exponent = 0, exponent_error = 0;
  double constant = 0, constant_error = 0;
  std::int64_t evaluations = 0;
  Status status = Status::converged;  ///< otherwise no such law was found
};

/// How a model's albedo behaves towards grazing incidence, found in two ways that share no more than the formula.
struct Grazing {
  /// From the formula's limit: the exponent is that of f(L,V) at fixed half vectors, the constant the integral ∫ lim
  /// (N·L)^p f cosθ_V dω_V. Not converged where that integral isn't what the albedo tends to.
  PowerLaw limit;
  /// From a straight line through ln a(L) against ln N·L at 89° … 90° − 1e-8°, integrated by another rule.
  PowerLaw fit;

  /// Whether both were found and are the same within their errors.
  [[nodiscard]] bool agree() const;
};

struct GrazingOptions {
  double phi_degrees = 0;   ///< azimuth of L
  double tolerance = 1e-8;  ///< of the albedos
  std::int64_t budget = AlbedoOptions{}.budget;
};

/// @throws ParameterError unless phi is finite, the tolerance within [1e-30, 1) and the budget positive
Grazing grazing_behaviour(const Model& model, const GrazingOptions& options = {});

/// Where the albedo first passes 1 on the way from normal to grazing incidence.
struct Crossing {
  bool exists = false;
  double cos_theta = 0;  ///< 90° − θ keeps its digits in it
  double error = 0;      ///< of cos_theta
};

/// Looked for on a grid down to cosθ = 1e-60; two crossings closer than its step aren't seen.
/// @throws ParameterError as grazing_behaviour does
Crossing critical_angle(const Model& model, const GrazingOptions& options = {});

}  // namespace albedo
