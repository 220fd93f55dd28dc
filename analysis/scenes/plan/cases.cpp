#include "analysis/scenes/plan/cases.hpp"

#include <algorithm>
#include <cmath>

#include "albedo/core/errors.hpp"

namespace albedo::analysis {
namespace {

/// Where the samples of a look are.
struct Source {
  std::size_t planned_case, second, white, specular;
  double scale, facet_reflectance;
  bool has_white;
};

double theta_of(double cosine) { return Direction::from_cosine(std::min(cosine, 1.0)).theta_degrees(); }

}  // namespace

Tube CaseLook::tube(std::size_t second, double tolerance) const {
  Tube tube;
  for (const Look& look : looks) {
    if (look.second != second) continue;
    Tube one(look.at.size());
    for (std::size_t i = 0; i < look.at.size(); ++i) {
      const Allowed range = allowed(look.at[i], tolerance);
      one.low[i] = range.low, one.high[i] = range.high;
    }
    if (tube.low.empty()) {
      tube = std::move(one);
    } else {
      tube.intersect(one);
    }
  }
  return tube;
}

Tube CaseLook::tube(double tolerance) const {
  Tube all = tube(std::size_t{0}, tolerance);
  for (std::size_t second = 1; second < references.size(); ++second) all.intersect(tube(second, tolerance));
  return all;
}

CaseLooks::CaseLooks(const Scene& scene, const Plan& plan, const CosineGrid& grid, int refinement)
    : grid_(grid), looks_(plan.cases.size()), wholes_(plan.cases.size()) {
  SampleStore store;
  std::vector<Source> sources;
  for (std::size_t i = 0; i < plan.cases.size(); ++i) {
    const MaterialVariants variants(scene.materials[plan.cases[i].material], plan.cases[i].channel);
    CaseLook& look = looks_[i];
    look.variation = variants.variation();
    look.references = look.variation.references(refinement);
    const WhitePart first = variants.part(0, look.references.back());
    wholes_[i] = first.whole;
    if (!first.specular) {
      look.reason = first.matte_reason;
      look.need = Need::nothing;
      continue;
    }
    if (!variants.refusal().empty()) {
      look.reason = variants.refusal();
      continue;
    }
    for (std::size_t second = 0; second < look.references.size(); ++second) {
      const double place = look.references[second], phi = variants.azimuth(place);
      for (int end = 0; end < variants.colour_ends(); ++end) {
        const WhitePart part = variants.part(end, place);
        if (!part.specular) continue;  // a texture's least value switches the lobe off
        const std::size_t specular = store.request(part.specular, phi, true);
        const std::size_t white = part.white ? store.request(part.white, phi, false) : specular;
        sources.push_back({i, second, white, specular, part.scale, part.facet_reflectance, part.white != nullptr});
        if (end > 0) continue;
        look.lobe += key_of(part.white ? *part.white : *part.specular);
        look.lobe += part.white ? "; " : " (as it is); ";
      }
    }
    if (look.variation.kind == Variation::Kind::azimuth) look.lobe += "over phi";
  }
  store.fill(grid, plan.options.tolerance, plan.options.threads, plan.options.progress);

  for (const Source& source : sources) {
    CaseLook& look = looks_[source.planned_case];
    const LobeSamples &white = store[source.white], &specular = store[source.specular];
    if (!white.is_good || !specular.is_good) {
      look.reason = "its albedo is 0 or couldn't be integrated at some of the angles";
    }
    Look& one =
        look.looks.emplace_back(Look{.second = source.second, .white = source.has_white ? white.model : nullptr});
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const double albedo = white.albedos[i];
      one.at.push_back({.white_albedo = source.has_white ? albedo : std::max(albedo, 1.0),
                        .radiance = source.scale * specular.albedos[i],
                        .peak = source.scale * specular.peaks[i],
                        .facet_reflectance = source.facet_reflectance});
    }
  }
}

void CaseLooks::describe(Plan& plan) const {
  constexpr int angles = 18;
  in_parallel(plan.cases.size(), plan.options.threads, [&](std::size_t number) {
    PlanCase& planned = plan.cases[number];
    const CaseLook& look = looks_[number];
    const Model& whole = *wholes_[number];
    const Claims claims = whole.claims();
    planned.claims_conservation = claims.conserves_energy;
    planned.is_isotropic = claims.isotropic;
    const AlbedoOptions options = plan_albedo_options(whole, plan.options.tolerance);
    planned.largest.value = -1;
    for (int i = 0; i < angles; ++i) {
      const double theta =
          std::lerp(plan.options.least_theta, plan.options.largest_theta, static_cast<double>(i) / (angles - 1));
      const double a = directional_albedo(whole, Direction::from_degrees(theta), options).value;
      if (!std::isnan(planned.largest.value) && !(a <= planned.largest.value)) planned.largest = {a, theta};
    }
    planned.need = look.need;
    planned.reason = look.reason;
    if (look.looks.empty()) return;
    planned.least_white = {look.looks[0].at[0].white_albedo, theta_of(grid_.cosine(0))};
    planned.most_white = planned.least_white;
    for (const Look& one : look.looks) {
      for (std::size_t i = 0; i < grid_.size(); ++i) {
        const double white = one.at[i].white_albedo, theta = theta_of(grid_.cosine(i));
        if (white < planned.least_white.value) planned.least_white = {white, theta};
        if (white > planned.most_white.value) planned.most_white = {white, theta};
        const PictureError error = picture_error(one.at[i], 1);
        planned.uncorrected.furnace = std::max(planned.uncorrected.furnace, error.furnace);
        planned.uncorrected.point = std::max(planned.uncorrected.point, error.point);
      }
    }
  });
}

}  // namespace albedo::analysis
