/// @file
/// The readers of each format; read_scene() chooses.
#pragma once

#include <string>

#include "analysis/scenes/scene.hpp"

namespace albedo::analysis {

/// Mitsuba's XML, 0.6 or 3. @throws FormatError
Scene read_mitsuba(const std::string& path);
/// pbrt-v4's text. @throws FormatError
Scene read_pbrt(const std::string& path);
/// Radiance's text, of scenes and of materials. @throws FormatError
Scene read_radiance(const std::string& path);

}  // namespace albedo::analysis
