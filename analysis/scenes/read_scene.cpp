#include <algorithm>
#include <filesystem>

#include "albedo/core/errors.hpp"
#include "analysis/scenes/readers.hpp"

namespace albedo::analysis {
namespace {

/// Our own list of materials, each used once, as `albedo table --materials` takes it.
Scene read_list(const std::string& path) {
  Scene scene{.path = path, .format = "materials"};
  for (Material& material : read_materials(path)) {
    const std::string type = material.model;
    scene.materials.push_back({.material = std::move(material), .file = path, .type = type, .uses = 1});
  }
  scene.declared = scene.materials.size();
  return scene;
}

}  // namespace

Scene read_scene(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 'a' - 'A') : c; });
  if (ending == ".xml") return read_mitsuba(path);
  if (ending == ".pbrt") return read_pbrt(path);
  if (ending == ".rad" || ending == ".mat") return read_radiance(path);
  if (ending == ".json" || ending == ".jsonl") return read_list(path);
  throw FormatError("'" + path +
                    "' isn't a scene's file by its ending: .xml (Mitsuba), .pbrt, .rad, .mat (Radiance), " +
                    ".json or .jsonl (a list of materials)");
}

}  // namespace albedo::analysis
