/// @file
/// For which parameters a model reflects more than it receives, and from which angle on.
#pragma once

#include <vector>

#include "albedo/grazing.hpp"
#include "plots/data/albedo_curves.hpp"

namespace albedo::analysis {

/// One material.
struct Plausibility {
  double largest = 0;   ///< albedo over the angles up to last_theta
  double theta = 0;     ///< where [degrees]
  double grazing = 0;   ///< the albedo's limit at 90 degrees; infinite where it diverges
  Crossing critical{};  ///< where the albedo first passes 1, all the way down to cosθ = 1e-60
  int unconverged = 0;
};

/// The largest albedo is looked for on a grid of 2 degrees and then closer around its best.
Plausibility plausibility(const Model& model, double last_theta, double tolerance);

/// The same of many materials, in parallel.
std::vector<Plausibility> plausibility_map(const std::vector<CurveRequest>& materials, double last_theta,
                                           double tolerance);

}  // namespace albedo::analysis
