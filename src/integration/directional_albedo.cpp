#include "albedo/directional_albedo.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "albedo/core/errors.hpp"
#include "core/text.hpp"
#include "integration/integrand_of.hpp"
#include "integration/quad_integrand.hpp"
#include "rules/cubature.hpp"
#include "rules/gauss.hpp"
#include "rules/kronrod.hpp"
#include "rules/monte_carlo.hpp"
#include "rules/sobol.hpp"
#include "rules/stratified.hpp"
#include "rules/tanh_sinh.hpp"

namespace albedo {
namespace {

/// Nothing counts as converged where a lobe isn't tracked.
Estimate believed(Estimate estimate, bool tracked) {
  if (!tracked && estimate.status == Status::converged) estimate.status = Status::budget_exhausted;
  return estimate;
}

Estimate applied(Rule rule, const Integrand<double>& integrand, const RuleOptions& options) {
  switch (rule) {
    case Rule::gauss:
      return gauss_estimate(integrand, options);
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

/// Polynomials of the gauss rule don't get past kinks that no warp knows of; the kronrod rule halves its way to them.
bool is_beyond_gauss(const Model& model) { return std::ranges::any_of(model.lobes(), &Lobe::hidden_kinks); }

Estimate integrate(const Model& model, const Direction& l, AlbedoOptions options) {
  const RuleOptions rule{options.tolerance, options.budget, options.seed};
  // what a warp leaves out is no part of a standard error: it should not show beside one
  if (is_monte_carlo(options.rule)) options.tolerance /= 10;
  if (options.precision == Precision::quad && options.rule == Rule::gauss) {
    const QuadIntegral exact = integrated_in_quad(model, l, options);
    return believed(exact.estimate, exact.tracked);
  }
  const std::unique_ptr<Integrand<double>> integrand = integrand_of(model, l, options);
  const bool handed_over = options.rule == Rule::gauss && is_beyond_gauss(model);
  return believed(applied(handed_over ? Rule::kronrod : options.rule, *integrand, rule),
                  std::ranges::all_of(integrand->panels(), &Panel::tracked));
}

/// What three albedos on the way to grazing incidence, each a hundredth of the cosine before, tell of the limit. Growth
/// that isn't that of a power yet says nothing unless they are the last.
Estimate extrapolated(const Estimate& earlier, const Estimate& before, Estimate limit, double tolerance, bool last) {
  const double change = std::abs(limit.value - before.value);
  limit.evaluations += before.evaluations + earlier.evaluations;
  for (const Estimate* one : {&earlier, &before}) {
    if (one->status == Status::non_finite || limit.status == Status::converged) limit.status = one->status;
  }
  if (limit.status == Status::non_finite) return limit;
  constexpr double decades = 100;
  const double growth = std::log(limit.value / before.value) / std::log(decades);
  const double growth_before = std::log(before.value / earlier.value) / std::log(decades);
  constexpr double no_growth = 1e-3;  // per factor e of cosθ_L; a limit's own rate is far below at these cosines
  constexpr double same = 0.01;
  const bool as_power = std::abs(growth - growth_before) < same;
  if (growth > no_growth && change > 4 * (limit.error + before.error)) {
    limit.status = Status::budget_exhausted;
    if (!last && !as_power) return limit;
    limit.value = limit.error = std::numeric_limits<double>::infinity();
    limit.status = Status::divergent;
    return limit;
  }
  constexpr double vanishing = -0.1;
  if (growth < vanishing && as_power) {
    return {0, 0, ErrorKind::extrapolated, limit.evaluations, limit.status};
  }
  const bool as_logarithm =
      2 * change > std::abs(before.value - earlier.value) && change > 4 * (limit.error + before.error);
  limit.error += change + (as_logarithm ? std::abs(limit.value) : 0);
  limit.error_kind = ErrorKind::extrapolated;
  if (limit.status == Status::converged && limit.error > tolerance * std::abs(limit.value)) {
    limit.status = Status::budget_exhausted;
  }
  return limit;
}

/// The limit cosθ_L → 0: the albedo there is a constant times a power of cosθ_L, and the power tells whether it has a
/// limit, which is 0 where it falls as a power of its own. Where it changes as in a logarithm (He–Torrance: towards 0),
/// how far is not known.
Estimate grazing_limit(const Model& model, const Direction& l, AlbedoOptions options) {
  const double tolerance = options.tolerance;
  options.tolerance = std::max(tolerance / 4, 1e-30);  // two of them, and the way to the limit
  const auto limit_from = [&](double cosine, bool last) {
    const auto at = [&](double factor) {
      Direction toward = l;
      toward.sin_theta = 1;
      toward.cos_theta = cosine * factor;
      return integrate(model, toward, options);
    };
    return extrapolated(at(1), at(1e-2), at(1e-4), tolerance, last);
  };
  const Estimate limit = limit_from(1e-10, false);
  if (limit.status != Status::budget_exhausted && limit.status != Status::rounding_limited) return limit;
  Estimate farther = limit_from(1e-36, true);  // a roughness of 1e-12 has its layers where the first were
  farther.evaluations += limit.evaluations;
  return farther;
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
    throw ParameterError(fmt::format("tolerance is {:g} and must be within [1e-30, 1)", options.tolerance));
  }
  if (options.budget < 1) throw ParameterError(fmt::format("budget is {} and must be at least 1", options.budget));
}

Estimate directional_albedo(const Model& model, const Direction& l, const AlbedoOptions& options) {
  check(options);
  if (options.warp == Warp::paper) require_samplers(model);
  const Estimate integral = model.lobes().empty()          ? Estimate{}
                            : l.cos_theta > grazing_cosine ? integrate(model, l, options)
                                                           : grazing_limit(model, l, options);
  const double coherent = model.coherent_albedo(l);
  return coherent == 0 ? integral : with_coherent_part(integral, coherent, options.tolerance);
}

}  // namespace albedo
