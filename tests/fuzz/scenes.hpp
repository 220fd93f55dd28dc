/// @file
/// The readers of scenes. The text up to the first NUL byte is the scene, the rest is a file `b` that it may include.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "albedo/core/errors.hpp"
#include "analysis/scenes/readers.hpp"
#include "analysis/subjects/material_table.hpp"
#include "fuzz/files.hpp"
#include "fuzz/fuzz.hpp"

namespace albedo::fuzz {

inline void read_scene_file(std::string_view bytes, analysis::Scene (*reader)(const std::string& path)) {
  static const Directory directory;
  const std::size_t end = std::min(bytes.find('\0'), bytes.size());
  const std::string path = directory.write("a", bytes.substr(0, end));
  static_cast<void>(directory.write("b", bytes.substr(std::min(end + 1, bytes.size()))));
  analysis::Scene scene;
  if (!accepts<FormatError>([&] { scene = reader(path); })) return;
  std::size_t met = scene.materials.size();
  for (const auto* counts : {&scene.unmodelled, &scene.holders}) {
    for (const auto& [type, count] : *counts) met += count;
  }
  require(scene.declared == met, "a scene whose materials don't add up");
  // What a reader takes for a material is one: it has checked the parameters.
  for (std::size_t i = 0; i < std::min<std::size_t>(scene.materials.size(), 3); ++i) {
    analysis::make_material(scene.materials[i].material, 0, scene.path);
    for (const analysis::ParameterInterval& interval : scene.materials[i].intervals) {
      require(interval.low <= interval.high, "an interval of " + interval.parameter + " that is empty");
    }
  }
}

}  // namespace albedo::fuzz
