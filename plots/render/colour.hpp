/// @file
/// Metals at eight wavelengths, and what they look like.
#pragma once

#include <array>
#include <string_view>

#include "plots/render/picture.hpp"

namespace albedo::render {

/// The middles of eight bands of equal width [nm], from 400 to 720.
extern const std::array<double, block_width> wavelengths;

/// Complex index of refraction n + ik at these wavelengths.
struct Metal {
  Spectrum n, k;
};

/// Of Al, Ag, Cu or Au [McPeak et al. 2015]. @throws ParameterError for another element
Metal metal(std::string_view element);

/// The Fresnel factor of an interface air–metal.
Reflectance conductor(const Metal& metal);

/// Schlick's Fresnel factor of red, green and blue reflectances at normal incidence.
Reflectance schlick(const Colour& normal);

/// The linear sRGB of eight bands, through the CIE 1931 colour matching functions averaged over each band. Light that
/// is the same in all bands is white: illuminant E is adapted to D65 (Bradford).
Colour colour_of_bands(const Spectrum& spectrum);

/// The weights of the bands in Y; they add up to 1.
Spectrum luminance_of_bands();

}  // namespace albedo::render
