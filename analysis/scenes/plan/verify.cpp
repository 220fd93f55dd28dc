#include "analysis/scenes/plan/verify.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/scenes/plan/samples.hpp"

namespace albedo::analysis {
namespace {

/// One check to be done.
struct Probe {
  std::size_t table, planned_case;
  double second, cosine;
  int colour_end;
};

/// The fractional part of i times the golden ratio: spread over [0, 1), however many there are.
double spread(std::size_t i) {
  const double at = (static_cast<double>(i) + 0.5) * 0.6180339887498949;
  return at - std::floor(at);
}

Estimate checked_albedo(const Model& model, const Direction& l, double tolerance) {
  AlbedoOptions options = plan_albedo_options(model, tolerance);
  options.rule = Rule::cubature;
  options.tolerance = std::max(options.tolerance, tolerance / 200);
  return directional_albedo(model, l, options);
}

/// The places between neighbours, or the only one.
std::vector<double> middles(const std::vector<double>& places) {
  if (places.size() < 2) return places;
  std::vector<double> all;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) all.push_back(std::midpoint(places[i], places[i + 1]));
  return all;
}

std::vector<Probe> probes_of(const Plan& plan, std::size_t number, const std::vector<double>& range) {
  constexpr std::size_t for_each_case = 4;
  const PlanTable& planned = plan.tables[number];
  std::vector<Probe> probes;
  std::vector<double> cosines = middles(planned.table.cosines), seconds = middles(planned.table.second);
  if (planned.table.cosines.size() < 2) cosines.clear();
  if (seconds.empty()) seconds = {-1.5};  // see below
  for (const double second : seconds) {
    for (const double cosine : cosines) probes.push_back({number, planned.cases.front(), second, cosine, 0});
  }
  std::size_t i = 0;
  for (const std::size_t one : planned.cases) {
    for (std::size_t k = 0; k < for_each_case; ++k, ++i) {
      // a curve may serve all azimuths or a texture's whole interval: the place is a share of that then
      probes.push_back(
          {number, one, -1 - spread(7 * i + 3), std::lerp(range[0], range[1], spread(i)), static_cast<int>(k % 2)});
    }
  }
  return probes;
}

}  // namespace

CheckedError checked_error(const MaterialVariants& variants, const PlannedSurface* table, int colour_end, double second,
                           double cos_theta, double tolerance) {
  const WhitePart part = variants.part(colour_end, second);
  if (!part.specular) return {};
  const double phi = variants.azimuth(second);
  const Direction l = Direction::from_cosine(cos_theta, phi);
  const Estimate a = checked_albedo(*part.specular, l, tolerance);
  Estimate white = a;
  if (!part.white) {
    white.value = std::max(white.value, 1.0);
  } else if (part.white != part.specular) {
    white = checked_albedo(*part.white, l, tolerance);
  }
  const Appearance appearance{.white_albedo = white.value,
                              .radiance = part.scale * a.value,
                              .peak = part.scale * peak_radiance(*part.specular, cos_theta, phi),
                              .facet_reflectance = part.facet_reflectance};
  return {.error = picture_error(appearance, table != nullptr ? (*table)(second, cos_theta) : 1),
          .is_good = a.status == Status::converged && white.status == Status::converged};
}

void verify(const Scene& scene, Plan& plan) {
  const CosineGrid grid(plan.options.least_theta, plan.options.largest_theta);
  const std::vector<double> range{grid.cosines().front(), grid.cosines().back()};
  std::vector<Probe> probes;
  for (std::size_t i = 0; i < plan.tables.size(); ++i) {
    const std::vector<Probe> more = probes_of(plan, i, range);
    probes.insert(probes.end(), more.begin(), more.end());
  }
  std::vector<CheckedError> errors(probes.size());
  in_parallel(probes.size(), plan.options.threads, [&](std::size_t i) {
    const Probe& probe = probes[i];
    const PlanCase& planned = plan.cases[probe.planned_case];
    const MaterialVariants variants(scene.materials[planned.material], planned.channel);
    const Variation& variation = variants.variation();
    double second = probe.second;
    if (second < 0 || variation.kind == Variation::Kind::none) {
      second = std::lerp(variation.low, variation.high, std::abs(second) - std::floor(std::abs(second)));
    }
    errors[i] = checked_error(variants, &plan.tables[probe.table].table, probe.colour_end % variants.colour_ends(),
                              second, probe.cosine, plan.options.tolerance);
  });
  for (std::size_t i = 0; i < probes.size(); ++i) {
    PlanTable& table = plan.tables[probes[i].table];
    ++table.verified;
    if (!errors[i].is_good) ++table.unverified;
    table.met.furnace = std::max(table.met.furnace, errors[i].error.furnace);
    table.met.point = std::max(table.met.point, errors[i].error.point);
  }
}

}  // namespace albedo::analysis
