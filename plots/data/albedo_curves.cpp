#include "plots/data/albedo_curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "albedo/core/errors.hpp"
#include "numerics/parallel.hpp"

namespace albedo::analysis {
namespace {

/// The index of the direction whose cosθ > 0 is nearest to `wanted` on a logarithmic scale, or the number of
/// directions.
std::size_t nearest_direction(const std::vector<Direction>& directions, double wanted) {
  std::size_t best = directions.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double distance = std::abs(std::log(directions[i].cos_theta / wanted));
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  return best;
}

double smallest_positive_cosine(const std::vector<Direction>& directions) {
  double smallest = 1;
  for (const Direction& l : directions) {
    if (l.cos_theta > 0) smallest = std::min(smallest, l.cos_theta);
  }
  return smallest;
}

}  // namespace

std::size_t AlbedoCurves::unconverged() const {
  std::size_t count = 0;
  for (const auto& curve : estimates) {
    count += static_cast<std::size_t>(std::ranges::count_if(
        curve, [](const Estimate& e) { return e.status != Status::converged && e.status != Status::divergent; }));
  }
  return count;
}

double AlbedoCurves::worst_relative_error() const {
  double worst = 0;
  for (const auto& curve : estimates) {
    for (const Estimate& e : curve) {
      if (std::isfinite(e.value) && e.value != 0) worst = std::max(worst, e.error / std::abs(e.value));
    }
  }
  return worst;
}

double AlbedoCurves::grazing_exponent(std::size_t curve) const {
  const double smallest = smallest_positive_cosine(directions);
  const std::size_t near = nearest_direction(directions, smallest);
  const std::size_t far = nearest_direction(directions, 10 * smallest);
  if (near < directions.size() && far < directions.size()) {
    const double run = std::log(directions[far].cos_theta / directions[near].cos_theta);
    const double rise = std::log(estimates[curve][far].value / estimates[curve][near].value);
    if (run > 0 && std::isfinite(rise)) return rise / run;
  }
  throw ParameterError("directions: a grazing exponent of " + curves[curve].label +
                       " needs two of them above the horizon with a positive finite albedo");
}

AlbedoCurves albedo_curves(std::vector<CurveRequest> curves, std::vector<Direction> directions,
                           const AlbedoOptions& options) {
  AlbedoCurves result{.curves = std::move(curves), .directions = std::move(directions), .options = options};
  std::vector<std::unique_ptr<Model>> models;
  for (CurveRequest& curve : result.curves) {
    models.push_back(make_model(curve.model, curve.parameters));
    curve.parameters = models.back()->parameters();
  }
  const std::size_t count = result.directions.size();
  result.estimates.assign(models.size(), std::vector<Estimate>(count));
  in_parallel(models.size() * count, 0, [&](std::size_t i) {
    result.estimates[i / count][i % count] =
        directional_albedo(*models[i / count], result.directions[i % count], options);
  });
  return result;
}

}  // namespace albedo::analysis
