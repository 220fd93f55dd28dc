#include "albedo/grazing.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "audit/parts.hpp"
#include "audit/sample_lobe.hpp"
#include "integration/integrand_of.hpp"

namespace albedo {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

AlbedoOptions albedo_options(const GrazingOptions& options, Rule rule) {
  return {.rule = rule, .tolerance = options.tolerance, .budget = options.budget};
}

Direction toward(double cos_theta, double phi) { return Direction::from_cosine(cos_theta, phi); }

/// Directions V that are within a lobe wherever L is.
std::vector<DirectionPair<double>> within(const Lobe& lobe, const UnitVector<double>& l) {
  constexpr std::array places{0.15, 0.4, 0.7, 0.9};
  std::vector<DirectionPair<double>> pairs;
  for (const double u : places) {
    for (const double v : {0.07, 0.31, 0.57, 0.83}) pairs.push_back(sample_lobe(lobe, l, u, v).pair);
  }
  return pairs;
}

/// The largest p with f ~ (N·L)^−p at fixed half vectors.
double formula_exponent(const Model& model, double phi) {
  constexpr double near = 1e-40, nearer = 1e-42;
  const UnitVector<double> l = unit_vector<double>(toward(near, phi));
  const UnitVector<double> l_nearer = unit_vector<double>(toward(nearer, phi));
  double exponent = -std::numeric_limits<double>::infinity();
  for (const Lobe& lobe : model.lobes()) {
    const auto pairs = within(lobe, l), nearer_pairs = within(lobe, l_nearer);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (!(pairs[i].cos_theta_v > 0 && nearer_pairs[i].cos_theta_v > 0)) continue;
      const double f = model.evaluate(lobe.component, pairs[i]);
      const double f_nearer = model.evaluate(lobe.component, nearer_pairs[i]);
      if (!(f > 0 && f_nearer > 0)) continue;
      exponent = std::max(exponent, std::log(f_nearer / f) / std::log(near / nearer));
    }
  }
  return exponent;
}

/// The law of a given exponent, if (N·L)^p a(L) has a limit.
PowerLaw limit_of_exponent(const Model& model, const GrazingOptions& options, double exponent) {
  constexpr double near = 1e-30, nearer = 1e-50;
  PowerLaw law{.exponent = exponent};
  const auto scaled = [&](double cosine, double& error) {
    const Estimate a =
        directional_albedo(model, toward(cosine, options.phi_degrees), albedo_options(options, Rule::gauss));
    law.evaluations += a.evaluations;
    if (a.status != Status::converged) law.status = a.status;
    const double scale = std::pow(cosine, exponent);
    error = a.error * scale;
    return a.value * scale;
  };
  double before_error = 0;
  const double before = scaled(near, before_error);
  law.constant = scaled(nearer, law.constant_error);
  const double change = std::abs(law.constant - before);
  law.constant_error += change;
  const double slack = 4 * (before_error + law.constant_error - change) + 1e-7 * law.constant;
  if (law.status == Status::converged && !(change <= slack && law.constant > 0)) law.status = Status::divergent;
  return law;
}

PowerLaw limit_law(const Model& model, const GrazingOptions& options) {
  // exponents of formulas are simple fractions: rounding is taken off
  const double found = formula_exponent(model, options.phi_degrees);
  const double rounded = std::round(found * 1e10) / 1e10;
  PowerLaw law{.exponent = nan, .constant = nan, .status = Status::divergent};
  for (const double exponent : {rounded, 0.0}) {
    if (!std::isfinite(exponent)) continue;
    law = limit_of_exponent(model, options, exponent);
    if (law.status == Status::converged) return law;
  }
  return law;
}

PowerLaw fitted_law(const Model& model, const GrazingOptions& options) {
  constexpr int points = 17, last = 8;
  const double begin = std::log(std::cos(89 * pi<double> / 180)), end = std::log(1e-8 * pi<double> / 180);
  PowerLaw law;
  std::array<double, points> x{}, y{};
  double noise = 0;
  for (std::size_t i = 0; i < points; ++i) {
    x[i] = begin + (end - begin) * static_cast<double>(i) / (points - 1);
    const Estimate a =
        directional_albedo(model, toward(std::exp(x[i]), options.phi_degrees), albedo_options(options, Rule::kronrod));
    law.evaluations += a.evaluations;
    if (!(a.value > 0) || !std::isfinite(a.error)) {
      law.status = a.status == Status::converged ? Status::divergent : a.status;  // no logarithm of 0
      law.exponent = law.constant = nan;
      return law;
    }
    y[i] = std::log(a.value);
    noise = std::max(noise, a.error / a.value);
  }
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t i = points - last; i < points; ++i) mean_x += x[i] / last, mean_y += y[i] / last;
  for (std::size_t i = points - last; i < points; ++i) {
    xx += square(x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  const double slope = xy / xx;
  double bend = 0, miss = 0;
  for (std::size_t i = points - last; i < points; ++i) {
    if (i + 1 < points) bend = std::max(bend, std::abs((y[i + 1] - y[i]) / (x[i + 1] - x[i]) - slope));
    miss = std::max(miss, std::abs(y[i] - mean_y - slope * (x[i] - mean_x)));
  }
  law.exponent = -slope;
  law.exponent_error = bend + noise / (x[points - last] - x[points - 1]);
  law.constant = std::exp(mean_y - slope * mean_x);
  law.constant_error = law.constant * std::expm1(miss + noise + law.exponent_error * std::abs(mean_x));
  return law;
}

}  // namespace

bool Grazing::agree() const {
  if (limit.status != Status::converged || fit.status != Status::converged) return false;
  return std::abs(limit.exponent - fit.exponent) <= limit.exponent_error + fit.exponent_error + 1e-9 &&
         std::abs(limit.constant - fit.constant) <= limit.constant_error + fit.constant_error;
}

Grazing grazing_behaviour(const Model& model, const GrazingOptions& options) {
  check(albedo_options(options, Rule::gauss));
  return {.limit = limit_law(model, options), .fit = fitted_law(model, options)};
}

Crossing critical_angle(const Model& model, const GrazingOptions& options) { return critical_angle(model, options, 0); }

Crossing critical_angle(const Model& model, const GrazingOptions& options, double cosine_above) {
  const auto excess = [&](double minus_log) {
    return directional_albedo(model, toward(std::exp(-minus_log), options.phi_degrees),
                              albedo_options(options, Rule::gauss));
  };
  // in degrees where the albedo is a function of the angle, by decades of cosθ where it is one of its logarithm
  std::vector<double> grid;
  for (int theta = 0; theta <= 86; theta += 2) grid.push_back(-std::log(std::cos(theta * pi<double> / 180)));
  const double farthest = -std::log(1.1 * grazing_cosine);
  for (double x = grid.back(); x < farthest;) {
    x = std::min(x + (x < 30 ? 0.5 : 4), farthest);
    grid.push_back(x);
  }
  if (cosine_above > grazing_cosine) {
    const double place = -std::log(cosine_above);
    grid.insert(std::lower_bound(grid.begin(), grid.end(), place), place);
  }
  double before = 0;
  for (const double x : grid) {
    const Estimate a = excess(x);
    if (a.value - a.error <= 1 || !std::isfinite(a.value)) {
      before = x;
      continue;
    }
    if (x == 0) return {.exists = true, .cos_theta = 1};
    std::uintmax_t iterations = 60;
    const auto f = [&](double at) { return excess(at).value - 1; };
    double low = f(before);
    if (low >= 0) return {.exists = true, .cos_theta = std::exp(-before), .error = std::exp(-before) - std::exp(-x)};
    const auto [left, right] = boost::math::tools::toms748_solve(
        f, before, x, low, a.value - 1, boost::math::tools::eps_tolerance<double>(30), iterations);
    const double middle = (left + right) / 2, slope = (a.value - 1 - low) / (x - before);
    const double error = (right - left) / 2 + a.error / std::max(slope, 1e-300);
    return {.exists = true, .cos_theta = std::exp(-middle), .error = std::exp(-middle) * error};
  }
  return {};
}

}  // namespace albedo
