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

}  // namespace albedo::analysis
