/// @file
/// Pictures as arrays of linear colours, and as the bytes of files.
#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plots/render/path_tracer.hpp"

namespace albedo::render {

/// Linear red, green, blue with sRGB's primaries and white.
using Colour = std::array<double, 3>;

struct Picture {
  std::size_t width = 0, height = 0;
  std::vector<Colour> pixels{};  ///< rows from the top
  std::vector<double> error{};   ///< standard error of each pixel's luminance; empty where there is none

  Picture() = default;
  Picture(std::size_t w, std::size_t h, const Colour& colour = {}) : width(w), height(h), pixels(w * h, colour) {}

  [[nodiscard]] Colour& at(std::size_t x, std::size_t y) { return pixels[y * width + x]; }
  [[nodiscard]] const Colour& at(std::size_t x, std::size_t y) const { return pixels[y * width + x]; }
};

/// A rendering's picture; `colour` makes red, green and blue of its bands.
Picture picture_of(const Rendering& rendering, Colour (*colour)(const Spectrum&));

/// The first three bands as they are.
Colour first_three(const Spectrum& spectrum);

/// Pictures of one size side by side, row by row, `gap` pixels of one grey between them.
Picture mosaic(const std::vector<Picture>& pictures, std::size_t columns, std::size_t gap, double grey = 1);

/// A PNG of 8 bits with sRGB's curve, of `exposure` times the colours; what is below 0 or above 1 then shows as 0 or 1,
/// as a screen would. The provenance is its text "albedo". The same picture gives the same bytes.
/// @throws ParameterError for a pixel that isn't finite
std::string encode_png(const Picture& picture, double exposure, const nlohmann::ordered_json& provenance);

/// A PNG of 8 bits that are linear, for a programme that gives values colours: black is `low`, white `high`.
/// @throws ParameterError for a value that isn't finite
std::string encode_png(const std::vector<double>& values, std::size_t width, double low, double high,
                       const nlohmann::ordered_json& provenance);

/// An OpenEXR of the linear colours in 32-bit floats, channels R, G, B and, where there are errors, "error.Y"; the
/// provenance is its attribute "albedo".
std::string encode_exr(const Picture& picture, const nlohmann::ordered_json& provenance);

/// The part of the picture's pixels that the PNG shows too dark or too bright.
double saturated_part(const Picture& picture, double exposure);

}  // namespace albedo::render
