#include "albedo/directional_albedo.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "albedo/core/errors.hpp"
#include "albedo/rules/cubature.hpp"
#include "albedo/rules/gauss.hpp"
#include "albedo/rules/kronrod.hpp"
#include "albedo/rules/monte_carlo.hpp"
#include "albedo/rules/sobol.hpp"
#include "albedo/rules/stratified.hpp"
#include "albedo/rules/tanh_sinh.hpp"
#include "core/integrand_of.hpp"

namespace albedo {
namespace {

template <class S>
Estimate rounded(const EstimateIn<S>& estimate) {
  return {static_cast<double>(estimate.value), static_cast<double>(estimate.error), ErrorKind::embedded,
          estimate.evaluations, estimate.status};
}

/// Nothing counts as converged where a lobe isn't tracked.
template <class S>
Estimate believed(Estimate estimate, const Integrand<S>& integrand) {
  const auto& panels = integrand.panels();
  const bool tracked = std::all_of(panels.begin(), panels.end(), [](const Panel& panel) { return panel.tracked; });
  if (!tracked && estimate.status == Status::converged) estimate.status = Status::budget_exhausted;
  return estimate;
}

Estimate applied(Rule rule, const Integrand<double>& integrand, const RuleOptions& options) {
  switch (rule) {
    case Rule::gauss:
      return rounded(gauss(integrand, options));
    case Rule::cubature:
      return cubature(integrand, options);
    case Rule::kronrod:
      return kronrod(integrand, options);
    case Rule::tanh_sinh:
      return tanh_sinh(integrand, options);
    case Rule::stratified:
      return stratified(integrand, options);
    case Rule::sobol:
      return sobol(integrand, options);
    case Rule::monte_carlo:
      break;
  }
  return monte_carlo(integrand, options);
}

Estimate integrate(const Model& model, const Direction& l, AlbedoOptions options) {
  const RuleOptions rule{options.tolerance, options.budget, options.seed};
  // what a warp leaves out is no part of a standard error: it should not show beside one
  if (is_monte_carlo(options.rule)) options.tolerance /= 10;
  if (options.precision == Precision::quad && options.rule == Rule::gauss) {
    const std::unique_ptr<Integrand<Quad>> exact = integrand_of<Quad>(model, l, options);
    return believed(rounded(gauss(*exact, rule)), *exact);
  }
  const std::unique_ptr<Integrand<double>> integrand =
      options.precision == Precision::quad ? std::make_unique<RoundedIntegrand>(integrand_of<Quad>(model, l, options))
                                           : integrand_of<Block>(model, l, options);
  return believed(applied(options.rule, *integrand, rule), *integrand);
}

/// The limit cosθ_L → 0: the albedo there is a constant times a power of cosθ_L, and the power tells whether it has a
/// limit. Where it changes as in a logarithm (He–Torrance: towards 0), how far is not known.
Estimate grazing_limit(const Model& model, const Direction& l, AlbedoOptions options) {
  constexpr double farther = 1e-10, far = 1e-12, near = 1e-14;
  const double tolerance = options.tolerance;
  options.tolerance = std::max(tolerance / 4, 1e-30);  // two of them, and the way to the limit
  const auto at = [&](double cosine) {
    Direction toward = l;
    toward.sin_theta = 1;
    toward.cos_theta = cosine;
    return integrate(model, toward, options);
  };
  const Estimate before = at(far);
  Estimate limit = at(near);
  const double change = std::abs(limit.value - before.value);
  limit.evaluations += before.evaluations;
  if (limit.status == Status::non_finite || before.status == Status::non_finite) return limit;
  const double growth = std::log(limit.value / before.value) / std::log(far / near);
  constexpr double no_growth = 1e-3;  // per factor e of cosθ_L; a limit's own rate is far below at these cosines
  if (growth > no_growth && change > 4 * (limit.error + before.error)) {
    limit.value = limit.error = std::numeric_limits<double>::infinity();
    limit.status = Status::divergent;
    return limit;
  }
  limit.error += change;
  limit.error_kind = ErrorKind::extrapolated;
  if (limit.error > tolerance * std::abs(limit.value)) {
    const Estimate earlier = at(farther);
    limit.evaluations += earlier.evaluations;
    const bool as_logarithm = 2 * change > std::abs(before.value - earlier.value);
    if (as_logarithm && change > 4 * (limit.error - change + before.error)) limit.error += std::abs(limit.value);
  }
  if (limit.status == Status::converged && limit.error > tolerance * std::abs(limit.value)) {
    limit.status = Status::budget_exhausted;
  }
  return limit;
}

/// Adds the delta's share, known to rounding.
Estimate with_coherent_part(Estimate estimate, double coherent, double tolerance) {
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  estimate.value += coherent;
  estimate.error += rounding * coherent;
  if (estimate.status == Status::converged && estimate.error > tolerance * std::abs(estimate.value)) {
    estimate.status = Status::rounding_limited;
  }
  return estimate;
}

void require_samplers(const Model& model) {
  for (const Lobe& lobe : model.lobes()) {
    if (model.has_sampler(lobe.component)) continue;
    throw ParameterError("warp is 'paper' and " + model.info().name +
                         " has no sampler for one of its lobes: it must be 'lobe' or 'hemisphere'");
  }
}

}  // namespace

void check(const AlbedoOptions& options) {
  if (!(options.tolerance >= 1e-30 && options.tolerance < 1)) {
    std::ostringstream message;
    message << "tolerance is " << options.tolerance << " and must be within [1e-30, 1)";
    throw ParameterError(message.str());
  }
  if (options.budget < 1)
    throw ParameterError("budget is " + std::to_string(options.budget) + " and must be at least 1");
}

Estimate directional_albedo(const Model& model, const Direction& l, const AlbedoOptions& options) {
  check(options);
  if (options.warp == Warp::paper) require_samplers(model);
  const Estimate integral = model.lobes().empty()          ? Estimate{}
                            : l.cos_theta > grazing_cosine ? integrate(model, l, options)
                                                           : grazing_limit(model, l, options);
  const double coherent = static_cast<double>(model.coherent_albedo(l));
  return coherent == 0 ? integral : with_coherent_part(integral, coherent, options.tolerance);
}

}  // namespace albedo
