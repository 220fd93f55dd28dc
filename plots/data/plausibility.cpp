#include "plots/data/plausibility.hpp"

#include <algorithm>

#include "numerics/parallel.hpp"

namespace albedo::analysis {

Plausibility plausibility(const Model& model, double last_theta, double tolerance) {
  const AlbedoOptions options{.tolerance = tolerance};
  Plausibility result{.largest = -1};
  const auto albedo_at = [&](const Direction& l) {
    const Estimate a = directional_albedo(model, l, options);
    if (a.status != Status::converged && a.status != Status::divergent) ++result.unconverged;
    return a.value;
  };
  const auto look = [&](double theta) {
    const double a = albedo_at(Direction::from_degrees(theta));
    if (a > result.largest) result.largest = a, result.theta = theta;
  };
  for (double theta = 0; theta < last_theta; theta += 2) look(theta);
  look(last_theta);
  for (double step = 1; step > 1e-4;) {
    const double before = result.largest, from = result.theta;
    look(std::max(from - step, 0.0));
    look(std::min(from + step, last_theta));
    if (!(result.largest > before)) step /= 2;
  }
  result.grazing = albedo_at(Direction::from_cosine(0));
  result.critical = critical_angle(model, {.tolerance = tolerance});
  return result;
}

std::vector<Plausibility> plausibility_map(const std::vector<CurveRequest>& materials, double last_theta,
                                           double tolerance) {
  std::vector<Plausibility> results(materials.size());
  in_parallel(materials.size(), 0, [&](std::size_t i) {
    const auto model = make_model(materials[i].model, materials[i].parameters);
    results[i] = plausibility(*model, last_theta, tolerance);
  });
  return results;
}

}  // namespace albedo::analysis
