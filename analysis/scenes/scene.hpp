/// @file
/// What a scene file says about its materials, in the models of this library, and what it says that isn't modelled.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "analysis/subjects/materials.hpp"

namespace albedo::analysis {

/// A parameter that a texture or a spectrum sets: all that is known is where its values are. The material itself has
/// the upper end. `parameter` may be "scale" or "lambertian", the two of a Material beside its parameters.
struct ParameterInterval {
  std::string parameter;
  double low = 0, high = 1;
  bool is_known = false;  ///< false: nothing is known of the texture, and the interval is the whole of what is valid
};

/// A reflectance of a scene: one BSDF that is modelled, whatever it is nested in.
struct SceneMaterial {
  Material material;                           ///< its name, model and parameters; its line is that of its file
  std::string file;                            ///< where it stands, which may be an included file
  std::string type;                            ///< what the scene calls it: "roughconductor", "plastic2"
  std::vector<ParameterInterval> intervals{};  ///< of parameters that vary over a surface
  std::vector<std::string> within{};           ///< from outside in: "twosided", "mask", "blendbsdf"
  std::size_t uses = 0;                        ///< shapes that refer to it
};

struct Scene {
  std::string path;
  std::string format;                               ///< "mitsuba", "pbrt", "radiance" or "materials"
  std::vector<SceneMaterial> materials{};           ///< in the order in which the file names them
  std::map<std::string, std::size_t> unmodelled{};  ///< type of a BSDF that isn't modelled, how many
  std::map<std::string, std::size_t> holders{};     ///< type of what only holds others ("twosided"), how many
  std::vector<std::string> notes{};                 ///< what was assumed, a sentence each
  std::size_t declared = 0;                         ///< BSDFs met: materials, unmodelled and holders
};

/// Reads a scene with what it includes. The format follows from the file's ending (.xml, .pbrt, .rad, .mat, .json,
/// .jsonl).
/// @throws FormatError naming the file and the line; for one too large, nested too deeply, or that includes itself
Scene read_scene(const std::string& path);

}  // namespace albedo::analysis
