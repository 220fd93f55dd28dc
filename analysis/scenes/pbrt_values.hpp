/// @file
/// Textures and spectra of pbrt-v4 scenes as values.
#pragma once

#include <string>
#include <unordered_map>

#include "analysis/scenes/pbrt_parser.hpp"
#include "analysis/scenes/scene_builder.hpp"

namespace albedo::analysis {

class PbrtValues {
 public:
  explicit PbrtValues(SceneBuilder& builder) : builder_(builder) {}

  /// Texture "name" "spectrum" "class" ...; it hides an earlier one of its name. @throws FormatError
  void add_texture(const PbrtDirective& texture, const std::string& file);

  /// A number, a colour, a spectrum or a texture. @throws FormatError if it is malformed
  SceneValue value(const PbrtDirective& directive, const std::string& name, const SceneValue& otherwise,
                   const std::string& file);

 private:
  SceneValue read(const PbrtParameter& parameter, const std::string& file);

  SceneBuilder& builder_;
  std::unordered_map<std::string, SceneValue> float_textures_, spectrum_textures_;
};

}  // namespace albedo::analysis
