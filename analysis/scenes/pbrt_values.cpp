#include "analysis/scenes/pbrt_values.hpp"

#include <algorithm>

#include "analysis/scenes/scene_files.hpp"

namespace albedo::analysis {

void PbrtValues::add_texture(const PbrtDirective& texture, const std::string& file) {
  if (texture.texts.size() < 3) fail_at(file, texture.line, "Texture takes a name, a type and a class");
  const std::string &name = texture.texts[0], &type = texture.texts[1], &kind = texture.texts[2];
  const auto argument = [&](const char* parameter, double otherwise) {
    return value(texture, parameter, SceneValue(otherwise), file);
  };
  SceneValue result = SceneValue::unknown();
  if (kind == "constant") {
    result = argument("value", 1);
  } else if (kind == "scale") {
    result = product(argument("tex", 1), argument("scale", 1));
  } else if (kind == "mix" || kind == "checkerboard" || kind == "directionmix") {
    result = hull(argument("tex1", kind == "mix" ? 0 : 1), argument("tex2", kind == "mix" ? 1 : 0));
  } else if (kind == "dots") {
    result = hull(argument("inside", 1), argument("outside", 0));
  }
  (type == "float" ? float_textures_ : spectrum_textures_)[name] = result;
}

SceneValue PbrtValues::value(const PbrtDirective& directive, const std::string& name, const SceneValue& otherwise,
                             const std::string& file) {
  const PbrtParameter* parameter = directive.find(name);
  return parameter == nullptr ? otherwise : read(*parameter, file);
}

SceneValue PbrtValues::read(const PbrtParameter& parameter, const std::string& file) {
  const std::vector<std::string>& values = parameter.values;
  const auto number = [&](std::size_t i) { return number_in(parameter.name, values[i], file, parameter.line); };
  const auto fail = [&](const std::string& problem) {
    fail_at(file, parameter.line, in_quotes(parameter.type + " " + parameter.name) + " " + problem);
  };
  if (values.empty()) fail("has no value");
  if (parameter.type == "texture") {
    for (const auto* textures : {&spectrum_textures_, &float_textures_}) {
      const auto found = textures->find(values[0]);
      if (found != textures->end()) return found->second;
    }
    builder_.note("the texture " + in_quotes(values[0]) + " isn't defined", file, parameter.line);
    return SceneValue::unknown();
  }
  if (parameter.type == "float") {
    if (values.size() != 1) fail("takes one number");
    return SceneValue(number(0));
  }
  if (parameter.type == "rgb") {
    if (values.size() != 3) fail("takes three numbers");
    return SceneValue(Rgb{number(0), number(1), number(2)});
  }
  if (parameter.type != "spectrum") fail("is of no type that a material's value has");
  if (values.size() == 1) return SceneValue::unknown();  // a named spectrum, or a file
  if (values.size() % 2 != 0) fail("takes pairs of a wavelength and a value");
  SceneValue result(number(1));
  for (std::size_t i = 3; i < values.size(); i += 2) result = hull(result, SceneValue(number(i)));
  return result;
}

}  // namespace albedo::analysis
