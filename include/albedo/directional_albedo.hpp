#pragma once

#include "albedo/core/estimate.hpp"
#include "albedo/core/model.hpp"
#include "albedo/core/rule_options.hpp"

namespace albedo {

/// Where the points are in the unit square, and what the error is; each is described in rules/. `gauss` hands a model
/// with Lobe::hidden_kinks over to `kronrod`.
enum class Rule { gauss, cubature, kronrod, tanh_sinh, stratified, sobol, monte_carlo };

/// Whether a rule's points are random, and its error a standard error.
constexpr bool is_monte_carlo(Rule rule) {
  return rule == Rule::stratified || rule == Rule::sobol || rule == Rule::monte_carlo;
}

/// Which map from the unit square the rule works on.
enum class Warp {
  lobe,        ///< the exact domain of each of the model's lobes
  hemisphere,  ///< cosθ_V and azimuth; an elongated lobe or one that reaches the horizon never counts as converged
               ///< there
  paper,       ///< the sampling published with the model, weight 0 below the horizon
};

/// The arithmetic that a model's formula is evaluated in. `quad` sums in 113 bits too with the gauss rule.
enum class Precision { float32, float64, quad };

struct AlbedoOptions {
  Rule rule = Rule::gauss;
  Warp warp = Warp::lobe;
  Precision precision = Precision::float64;
  double tolerance = 1e-8;          ///< relative
  std::int64_t budget = 2'000'000;  ///< most evaluations
  std::uint64_t seed = 1;           ///< of the Monte Carlo rules
};

/// The directional albedo a(L) = ∫ f(L,V) cosθ_V dω_V, the fraction of the light from L that is reflected   [Neumann
/// 1999, eq. 2], and the model's coherent_albedo(): a delta has no f, but it reflects.
///
/// At grazing incidence (θ = 90°, cosθ below 1e-60) it is the limit from above the horizon, or status `divergent` with
/// an infinite value.
/// @throws ParameterError unless the tolerance is within [1e-30, 1) and the budget positive; for Warp::paper also where
/// a lobe of the model has no sampler.
Estimate directional_albedo(const Model& model, const Direction& l, const AlbedoOptions& options = {});

}  // namespace albedo
