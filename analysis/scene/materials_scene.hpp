/// @file
#pragma once

#include <string>

#include "analysis/scene/scene.hpp"

namespace albedo::analysis {

/// A list of materials as a scene, whose every material is used once.
/// @throws FormatError as read_materials() does
Scene read_materials_scene(const std::string& path);

}  // namespace albedo::analysis
