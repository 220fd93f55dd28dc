#pragma once

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <string>
#include <variant>

#include "albedo/core/direction.hpp"
#include "albedo/core/errors.hpp"
#include "albedo/core/model.hpp"
#include "analysis/helpers.hpp"
#include "analysis/output_directory.hpp"
#include "analysis/scenes/scene.hpp"
#include "analysis/subjects/material_table.hpp"

namespace albedo::analysis {

/// Writes small scenes into a directory of its own, and reads them.
class SceneTest : public OutputDirectory {
 protected:
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(path(name)).parent_path());
    std::ofstream(path(name), std::ios::binary) << text;
  }
  [[nodiscard]] Scene scene_of(const std::string& name, const std::string& text) const {
    write(name, text);
    return read_scene(path(name));
  }
  /// What the message says behind the directory's name.
  [[nodiscard]] std::string refusal_of(const std::string& name, const std::string& text) const {
    write(name, text);
    return refusal_of(name);
  }
  [[nodiscard]] std::string refusal_of(const std::string& name) const {
    std::string message = message_of<FormatError>([&] { read_scene(path(name)); });
    const std::string directory = directory_.string() + "/";
    for (std::size_t at = message.find(directory); at != std::string::npos; at = message.find(directory)) {
      message.erase(at, directory.size());
    }
    return message;
  }
};

inline bool has_note(const Scene& scene, const std::string& part) {
  return std::ranges::any_of(scene.notes, [&](const std::string& note) { return contains(note, part); });
}

/// A parameter, or a failure and an empty text.
inline ParameterValue parameter(const SceneMaterial& material, const std::string& name) {
  for (const auto& [known, value] : material.material.parameters) {
    if (known == name) return value;
  }
  ADD_FAILURE() << material.material.name << " has no " << name;
  return std::string();
}

inline double number(const SceneMaterial& material, const std::string& name) {
  const ParameterValue value = parameter(material, name);
  const double* number = std::get_if<double>(&value);
  return number != nullptr ? *number : std::numeric_limits<double>::quiet_NaN();
}

inline std::string choice(const SceneMaterial& material, const std::string& name) {
  const ParameterValue value = parameter(material, name);
  const std::string* text = std::get_if<std::string>(&value);
  return text != nullptr ? *text : "not a choice";
}

using Rgb3 = std::array<double, 3>;

inline Rgb3 rgb(const SceneMaterial& material, const std::string& name) {
  const ParameterValue value = parameter(material, name);
  const Rgb3* colour = std::get_if<Rgb3>(&value);
  return colour != nullptr ? *colour : Rgb3{-1, -1, -1};
}

/// The interval of a parameter, or a failure.
inline ParameterInterval interval(const SceneMaterial& material, const std::string& name) {
  for (const ParameterInterval& interval : material.intervals) {
    if (interval.parameter == name) return interval;
  }
  ADD_FAILURE() << material.material.name << " has no interval of " << name;
  return {};
}

/// f(L, V) of a material in one of its channels, all its parts.
inline double brdf(const SceneMaterial& material, std::size_t channel, const Direction& l, const Direction& v) {
  const auto model = make_material(material.material, channel, "scene");
  const UnitVector<double> light = unit_vector<double>(l);
  const auto pair = direction_pair(light, unit_vector<double>(v), UnitVector<double>{-light.x, -light.y, light.z});
  double sum = 0;
  for (const Lobe& lobe : model->lobes()) sum += model->evaluate(lobe.component, pair);
  return sum;
}

}  // namespace albedo::analysis
