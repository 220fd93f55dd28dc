/// @file
/// Facts about interfaces that renderers know by name, and the diffuse body under a dielectric one.
#pragma once

#include <optional>
#include <string>

#include "analysis/scenes/scene_value.hpp"

namespace albedo::analysis {

struct ComplexIndex {
  Rgb eta, k;
};

/// Ag, Al, Au and Cu for R, G and B: spectra projected on the CIE 1931 curves and to linear sRGB, as Mitsuba's RGB
/// variants do it. Data of refractiveindex.info (CC0): Rakić 1998, Hagemann 1974, Olmon 2012, Hagemann 1974.
std::optional<ComplexIndex> metal_index(const std::string& name);

/// The index of refraction that Mitsuba has under a name, "bk7" or "air".
std::optional<double> dielectric_index(const std::string& name);

/// 2 ∫ F(μ) μ dμ from 0 to 1 for unpolarised light that meets an interface of relative index eta from the outer side;
/// from the inner side it is that of 1/eta.
double mean_fresnel(double eta);

/// Albedo, averaged over directions, of a Lambertian body of albedo ρ beneath a smooth dielectric interface: with the
/// means R_o and R_i of Fresnel's factor outside and inside, ρ (1 − R_o)(1 − R_i)/(1 − x R_i) where x is ρ if the
/// colour shift of what is reflected inside is followed (`nonlinear`), else 1.
SceneValue body_albedo(const SceneValue& rho, double eta, bool nonlinear);

}  // namespace albedo::analysis
