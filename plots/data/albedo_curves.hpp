/// @file
/// Directional albedos of several models over one list of directions: the numbers behind figures and charts.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "albedo/directional_albedo.hpp"

namespace albedo::analysis {

/// One curve: a model with its parameters, under a name that is unique among the curves.
struct CurveRequest {
  std::string label{};
  std::string model{};
  Parameters parameters{};
};

/// Curves over common directions.
struct AlbedoCurves {
  std::vector<CurveRequest> curves{};   ///< as requested, their parameters completed with the defaults
  std::vector<Direction> directions{};  ///< of L
  AlbedoOptions options{};
  std::vector<std::vector<Estimate>> estimates{};  ///< [curve][direction]

  /// The number of estimates that did not reach the tolerance; an infinite albedo is a result, not a failure.
  [[nodiscard]] std::size_t unconverged() const;

  /// The largest error relative to its value among the finite estimates of all curves.
  [[nodiscard]] double worst_relative_error() const;

  /// The exponent p of a ∝ (N·L)^p, measured by two points: the smallest positive N·L among the directions, and the one
  /// nearest to ten times that. Negative where the albedo diverges.
  /// @throws ParameterError if there are no two such directions with a positive finite albedo
  [[nodiscard]] double grazing_exponent(std::size_t curve) const;
};

/// Integrates every curve in every direction, in parallel.
/// @throws UnknownModel, ParameterError as make_model() and directional_albedo() do
AlbedoCurves albedo_curves(std::vector<CurveRequest> curves, std::vector<Direction> directions,
                           const AlbedoOptions& options = {});

}  // namespace albedo::analysis
