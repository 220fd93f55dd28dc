#include "analysis/scene/materials_scene.hpp"

#include <filesystem>

#include "albedo/core/errors.hpp"

namespace albedo::analysis {

Scene read_materials_scene(const std::string& path) {
  Scene scene{.path = path, .format = "materials"};
  for (Material& material : read_materials(path)) {
    SceneMaterial& added = scene.materials.emplace_back();
    added.type = material.model;
    added.file = path;
    added.uses = 1;
    added.material = std::move(material);
  }
  scene.declared = scene.materials.size();
  return scene;
}

Scene read_scene(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".json" || ending == ".jsonl") return read_materials_scene(path);
  throw FormatError("'" + path + "' must end in .json or .jsonl");
}

}  // namespace albedo::analysis
