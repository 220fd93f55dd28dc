#include "analysis/scenes/plan/requirement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace albedo::analysis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The E of a factor: the inverse of correction_factor().
double white_albedo_of(double factor, double facet_reflectance) {
  if (factor <= 0) return infinity;
  if (factor < 1) return 1 / factor;
  return facet_reflectance > 0 ? 1 / (1 + (factor - 1) / facet_reflectance) : 0;
}

}  // namespace

double correction_factor(double white_albedo, double facet_reflectance) {
  return white_albedo <= 1 ? 1 + facet_reflectance * (1 - white_albedo) / white_albedo : 1 / white_albedo;
}

PictureError picture_error(const Appearance& appearance, double tabulated) {
  const double k = correction_factor(appearance.white_albedo, appearance.facet_reflectance);
  const double used = correction_factor(tabulated, appearance.facet_reflectance);
  const double larger = std::max(k, used);
  // the radiance at which the difference shows most: that which the larger factor just makes white
  const double radiance = std::min(appearance.peak, 1 / larger);
  return {.furnace = appearance.radiance * std::abs(used - k), .point = radiance * std::abs(used - k)};
}

Allowed allowed(const Appearance& appearance, double tolerance) {
  const double k = correction_factor(appearance.white_albedo, appearance.facet_reflectance), peak = appearance.peak;
  const double in_furnace = appearance.radiance > 0 ? tolerance / appearance.radiance : infinity;
  const double in_sight = peak > 0 ? tolerance / peak : infinity;  // where the peak isn't white
  const double above = peak * k + tolerance <= 1 ? k + in_sight : k / (1 - tolerance);
  const double below = peak * k <= 1 ? k - in_sight : k * (1 - tolerance);
  return {.low = white_albedo_of(std::min(k + in_furnace, above), appearance.facet_reflectance),
          .high = white_albedo_of(std::max(k - in_furnace, below), appearance.facet_reflectance)};
}

double peak_radiance(const Model& model, double cos_theta, double phi_degrees) {
  const Direction l = Direction::from_cosine(cos_theta, phi_degrees);
  if (model.coherent_albedo(l) > 0) return infinity;
  constexpr int even = 24, near = 12;
  const double theta = l.theta_degrees();
  double largest = 0;
  const auto look = [&](double angle) {  // from L's side of the normal to the other
    if (!(std::abs(angle) < 90)) return;
    const double side = angle < 0 ? 1 : -1, radians = std::abs(angle) * std::numbers::pi / 180;
    const Direction v{std::cos(radians), std::sin(radians), side * l.cos_phi, side * l.sin_phi};
    const double seen = std::numbers::pi * brdf<double>(model, l, v) * v.cos_theta;
    if (seen > largest) largest = seen;
  };
  for (int i = 1 - even; i < even; ++i) look(90.0 * i / even);
  look(theta);
  for (const Lobe& lobe : model.lobes()) {
    const double width = 2 * lobe.widths().wide * 180 / std::numbers::pi;  // of V about the mirror
    for (int i = -near; i <= near; ++i) look(theta + std::min(width, 45.0) * i / 4);
  }
  constexpr double between = 1.01;  // of neighbours of such a grid, at a peak
  return between * largest;
}

}  // namespace albedo::analysis
