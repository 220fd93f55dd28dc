#pragma once

#include "albedo/core/estimate.hpp"
#include "albedo/core/quad.hpp"

namespace albedo {

struct ReferenceOptions {
  double tolerance = 1e-20;       ///< relative
  std::int64_t budget = 500'000;  ///< most evaluations, of some 0.2 ms each
};

/// The directional albedo in 113 bits, that true errors are measured against: the model's own formula, the lobe warp,
/// the product rule's nodes and sums all in Quad, and the value kept so. Whether it is good to the tolerance is said by
/// its status and error, as by every rule.
///
/// Parameters and L are the doubles they are given as: 0.1 is not a tenth, and cosθ_L not that of a decimal angle. So
/// are constants that a model derives from its parameters in double (the root of two exponents, Blinn's normalisation,
/// tabulated areas): they are a part of the formula.
///
/// At grazing incidence (cosθ below 1e-60) it is the limit of directional_albedo(), known to a double's digits at best.
/// @throws ParameterError unless the tolerance is within [1e-30, 1) and the budget positive
EstimateIn<Quad> reference_albedo(const Model& model, const Direction& l, const ReferenceOptions& options = {});

}  // namespace albedo
