/// @file
/// What an error of a correction does to a picture, and so how exact it has to be.
#pragma once

#include "albedo/core/model.hpp"
#include "analysis/scenes/plan/tube.hpp"

namespace albedo::analysis {

/// The factor by which a lobe of white albedo E is multiplied, of facets that reflect F₀   [Turquin 2019]:
///
///     k(E) = 1 + F₀ (1 − E)/E   for E ≤ 1: light that is lost meets a facet once more, and comes back in its colour
///     k(E) = 1/E                for E > 1: light that is made is taken away
double correction_factor(double white_albedo, double facet_reflectance);

/// What a lobe shows from one direction.
struct Appearance {
  double white_albedo = 1;  ///< E
  double radiance = 1;      ///< s a_F: under light of radiance 1 from everywhere, as in a white furnace
  double peak = 1;          ///< the largest s π f(L,V) N·V under a point light that makes a white wall facing it 1
  double facet_reflectance = 1;  ///< F₀
};

/// Largest error of a picture, in units of its white.
struct PictureError {
  double furnace = 0;  ///< |a k(Ê) − a k(E)| in a white furnace
  double point = 0;    ///< under a point light, of any direction; what is beyond white is white

  [[nodiscard]] double largest() const { return furnace > point ? furnace : point; }
};

/// What a picture shows wrongly where a table says Ê; without a correction Ê is 1.
PictureError picture_error(const Appearance& appearance, double tabulated);

/// The Ê from which no error exceeds the tolerance: [low, high].
struct Allowed {
  double low, high;
};
Allowed allowed(const Appearance& appearance, double tolerance);

/// The largest π f(L,V) N·V of the plane of incidence, [1]: at the mirror direction, off-specular, or at a peak of its
/// own; infinite for a model with a mirror part, and no less than what any direction of a grid shows.
double peak_radiance(const Model& model, double cos_theta, double phi_degrees);

}  // namespace albedo::analysis
