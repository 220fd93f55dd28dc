/// @file
/// The scenes of the papers' pictures, as far as their texts tell: they show what, and not where it stands.
#pragma once

#include <memory>
#include <vector>

#include "plots/render/path_tracer.hpp"

namespace albedo::render {

struct View {
  Scene scene{};
  Camera camera{};
};

/// Neumann 1999, figure 8: an open golden tank in which pyramids of aluminium, silver, copper and gold stand, under sky
/// light and two small bright lamps, in bands of wavelengths.
/// @param model of all metals, to be multiplied with each metal's Fresnel factor of L·H
View metal_tank(const std::shared_ptr<const Model>& model);

/// A sphere of radius 1 on a chequered Lambertian plane, under a grey sky and one lamp, in colours.
View sphere_on_plane(std::vector<SurfaceLobe> lobes);

/// Ashikhmin–Shirley's metal: its specular term, with the colour of gold at normal incidence for R_s.
std::vector<SurfaceLobe> golden(double n_u, double n_v);
/// Polished red plastic: R_s = 0.05 in all colours over their diffuse term.
std::vector<SurfaceLobe> red_plastic(double n_u, double n_v);

}  // namespace albedo::render
