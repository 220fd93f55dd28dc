#include "analysis/scenes/mitsuba_xml.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "analysis/scenes/scene_files.hpp"

namespace albedo::analysis {
namespace {

constexpr int deepest_texture = 100;

std::string lowered(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 'a' - 'A');
  }
  return result;
}

bool is_same_parameter(const char* name, std::string_view normal) {
  std::size_t i = 0;
  for (; *name != '\0'; ++name) {
    if (*name == '_') continue;
    const char c = *name >= 'A' && *name <= 'Z' ? static_cast<char>(*name + 'a' - 'A') : *name;
    if (i == normal.size() || normal[i++] != c) return false;
  }
  return i == normal.size();
}

std::vector<std::string> words(const std::string& text) {
  constexpr const char* between = ", \t\r\n";
  std::vector<std::string> result;
  for (std::size_t begin = text.find_first_not_of(between); begin != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(between, begin), text.size());
    result.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(between, end);
  }
  return result;
}

double linear_of_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// #rrggbb as numbers in [0, 1].
std::optional<Rgb> html_colour(const std::string& text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  if (text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos) return std::nullopt;
  Rgb colour{};
  for (std::size_t i = 0; i < 3; ++i) colour[i] = std::stoi(text.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
  return colour;
}

}  // namespace

MitsubaFile::MitsubaFile(std::string text, std::string name, std::size_t& parts)
    : text_(std::move(text)), name_(std::move(name)) {
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\n') line_ends_.push_back(i);
    if (text_[i] == '<' || text_[i] == '=') ++parts;
  }
  // a node takes 64 bytes and an attribute 40
  if (parts > 8'000'000) fail_at(name_, 1, "the scene has more than 8 million tags and attributes");
  const pugi::xml_parse_result result =
      document_.load_buffer_inplace(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result) {
    fail_at(name_, line_of(result.offset), std::string("this is not XML (") + lowered(result.description()) + ")");
  }
  if (!scene()) {
    const pugi::xml_node root = document_.document_element();
    fail_at(name_, line_of(root.offset_debug()),
            "the root is <" + std::string(root.name()).substr(0, 60) + ">, not <scene>");
  }
}

std::size_t MitsubaFile::line_of(std::ptrdiff_t offset) const {
  const auto end = std::ranges::lower_bound(line_ends_, static_cast<std::size_t>(std::max(offset, std::ptrdiff_t{0})));
  return 1 + static_cast<std::size_t>(end - line_ends_.begin());
}

void MitsubaElement::fail(const std::string& problem) const { fail_at(file->name(), line(), problem); }

void MitsubaValues::add_variable(const std::string& name, const std::string& value) {
  constexpr std::size_t longest = 256;
  if (name.empty() || name.size() > longest) return;  // nothing can refer to it
  variables_.emplace(name, value);
  longest_name_ = std::max(longest_name_, name.size());
}

std::string MitsubaValues::attribute(const MitsubaElement& element, const char* name) const {
  constexpr std::size_t longest = 1000;
  std::string text = element.node.attribute(name).value();
  for (std::size_t at = text.find('$'); at != std::string::npos;) {
    auto variable = variables_.end();
    std::size_t length = std::min(longest_name_, text.size() - at - 1);  // of two names that fit, the longer counts
    for (; length > 0 && variable == variables_.end(); --length)
      variable = variables_.find(text.substr(at + 1, length));
    if (variable == variables_.end()) {
      element.fail("the variable in " + in_quotes(text) + " has no value; the scene expects it on the command line");
    }
    text.replace(at, 1 + variable->first.size(), variable->second);
    if (text.size() > longest) element.fail("a text made of variables is longer than 1000 characters");
    at = text.find('$', at + variable->second.size());
  }
  return text;
}

std::optional<MitsubaElement> MitsubaValues::find(const MitsubaElement& parent, std::string_view parameter) {
  for (const pugi::xml_node& child : parent.node.children()) {
    if (is_same_parameter(child.attribute("name").value(), parameter)) return MitsubaElement{child, parent.file};
  }
  return std::nullopt;
}

SceneValue MitsubaValues::value(const MitsubaElement& parent, std::string_view parameter, const SceneValue& otherwise) {
  const std::optional<MitsubaElement> child = find(parent, parameter);
  return child ? read(*child, 0) : otherwise;
}

std::string MitsubaValues::text(const MitsubaElement& parent, std::string_view parameter,
                                const std::string& otherwise) const {
  const std::optional<MitsubaElement> child = find(parent, parameter);
  return child ? attribute(*child, "value") : otherwise;
}

bool MitsubaValues::boolean(const MitsubaElement& parent, std::string_view parameter, bool otherwise) const {
  const std::string value = lowered(text(parent, parameter, otherwise ? "true" : "false"));
  if (value == "true") return true;
  if (value == "false") return false;
  parent.fail(std::string(parameter) + " = " + in_quotes(value) + " is neither true nor false");
}

SceneValue MitsubaValues::read(const MitsubaElement& element, int depth) {
  const std::string tag = element.tag();
  const std::string name = element.node.attribute("name").value();
  const auto number = [&](const std::string& text) {
    return number_in(name, text, element.file->name(), element.line());
  };
  if (tag == "texture") return texture(element, depth);
  if (tag == "ref") return referred(element, depth);
  if (tag == "spectrum") return spectrum(element);
  const std::vector<std::string> parts = words(attribute(element, "value"));
  if (tag == "float" || tag == "integer") {
    if (parts.size() == 1) return SceneValue(number(parts[0]));
  } else if (tag == "rgb" || tag == "srgb") {
    const std::optional<Rgb> html = parts.size() == 1 ? html_colour(parts[0]) : std::nullopt;
    if (!html && parts.size() != 1 && parts.size() != 3) element.fail(in_quotes(name) + " takes one or three numbers");
    const Rgb colour = html                ? *html
                       : parts.size() == 1 ? SceneValue(number(parts[0])).low
                                           : Rgb{number(parts[0]), number(parts[1]), number(parts[2])};
    const SceneValue value(colour);
    return html || tag == "srgb" ? value.mapped(linear_of_srgb) : value;
  }
  element.fail(in_quotes(name) + " = " + in_quotes(attribute(element, "value")) + " in <" + tag.substr(0, 20) +
               "> is not a value of a material");
}

SceneValue MitsubaValues::referred(const MitsubaElement& reference, int depth) {
  const std::string id = attribute(reference, "id");
  const auto found = textures_.find(id);
  if (found == textures_.end()) {
    builder_.note("the texture " + in_quotes(id) + " isn't defined before its use", reference.file->name(),
                  reference.line());
    return SceneValue::unknown();
  }
  Texture& texture = found->second;
  if (texture.is_open) reference.fail("the texture " + in_quotes(id) + " refers to itself");
  if (!texture.value) {
    texture.is_open = true;
    texture.value = read(texture.element, depth + 1);
    texture.is_open = false;
  }
  return *texture.value;
}

SceneValue MitsubaValues::spectrum(const MitsubaElement& element) const {
  const std::vector<std::string> parts = words(attribute(element, "value"));
  if (parts.empty()) return SceneValue::unknown();  // a file, or a spectrum of a plugin
  const auto number = [&](const std::string& text) {
    return number_in(element.node.attribute("name").value(), text, element.file->name(), element.line());
  };
  if (parts.size() == 1 && parts[0].find(':') == std::string::npos) return SceneValue(number(parts[0]));
  if (parts.size() == 3 && parts[0].find(':') == std::string::npos) {
    return SceneValue(Rgb{number(parts[0]), number(parts[1]), number(parts[2])});
  }
  std::optional<SceneValue> result;
  for (const std::string& part : parts) {
    const std::size_t colon = part.find(':');
    if (colon == std::string::npos) element.fail(in_quotes(part) + " is not a wavelength and a value");
    static_cast<void>(number(part.substr(0, colon)));
    const SceneValue value(number(part.substr(colon + 1)));
    result = result ? hull(*result, value) : value;
  }
  return *result;
}

SceneValue MitsubaValues::texture(const MitsubaElement& element, int depth) {
  if (depth > deepest_texture) element.fail("textures are nested more than 100 deep");
  const std::string type = attribute(element, "type");
  const auto inner = [&](std::string_view parameter, double otherwise) {
    const std::optional<MitsubaElement> child = find(element, parameter);
    return child ? read(*child, depth + 1) : SceneValue(otherwise);
  };
  if (type == "checkerboard") return hull(inner("color0", 0.4), inner("color1", 0.2));
  if (type == "gridtexture") return hull(inner("color0", 0.2), inner("color1", 0.4));
  if (type == "wireframe") return hull(inner("interiorcolor", 0.5), inner("edgecolor", 0.1));
  if (type == "uniform") return inner("value", 1);
  if (type == "scale") {
    SceneValue scaled = SceneValue::unknown();
    for (const pugi::xml_node& child : element.node.children()) {
      const bool is_texture = std::strcmp(child.name(), "texture") == 0 || std::strcmp(child.name(), "ref") == 0;
      if (is_texture) scaled = read({child, element.file}, depth + 1);
    }
    return product(scaled, inner("scale", 1));
  }
  return SceneValue::unknown();
}

}  // namespace albedo::analysis
