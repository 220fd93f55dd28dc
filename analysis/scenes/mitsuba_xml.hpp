/// @file
/// Mitsuba's XML: elements with their lines, variables, values and textures.
#pragma once

#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "analysis/scenes/scene_builder.hpp"

namespace albedo::analysis {

/// One file. Entities other than XML's own five stay as they are: nothing is expanded or fetched.
class MitsubaFile {
 public:
  /// @throws FormatError with the line, for what isn't XML, has no <scene> at its root, or brings the scene's tags
  /// and attributes above 8 million
  /// @param parts so many there are already; those of this file are added
  MitsubaFile(std::string text, std::string name, std::size_t& parts);

  [[nodiscard]] pugi::xml_node scene() const { return document_.child("scene"); }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t line_of(std::ptrdiff_t offset) const;

 private:
  std::string text_;  // the document is parsed in place and points into it
  std::string name_;
  std::vector<std::size_t> line_ends_;
  pugi::xml_document document_;
};

struct MitsubaElement {
  pugi::xml_node node;
  const MitsubaFile* file = nullptr;

  [[nodiscard]] std::string tag() const { return node.name(); }
  [[nodiscard]] std::size_t line() const { return file->line_of(node.offset_debug()); }
  [[noreturn]] void fail(const std::string& problem) const;
};

/// Reads what elements say. Names of parameters are compared without underscores and case: intIOR is int_ior.
class MitsubaValues {
 public:
  explicit MitsubaValues(SceneBuilder& builder) : builder_(builder) {}

  /// <default name= value=>; the first one of a name counts.
  void add_variable(const std::string& name, const std::string& value);
  void add_texture(const std::string& id, const MitsubaElement& texture) { textures_[id] = {.element = texture}; }

  [[nodiscard]] bool has_texture(const std::string& id) const { return textures_.contains(id); }

  /// An attribute with its $variables replaced, empty if it isn't there.
  /// @throws FormatError for an unknown variable, or a text of over 1000 characters made of variables
  std::string attribute(const MitsubaElement& element, const char* name) const;

  /// The child that sets a parameter.
  static std::optional<MitsubaElement> find(const MitsubaElement& parent, std::string_view parameter);

  SceneValue value(const MitsubaElement& parent, std::string_view parameter, const SceneValue& otherwise);
  std::string text(const MitsubaElement& parent, std::string_view parameter, const std::string& otherwise) const;
  bool boolean(const MitsubaElement& parent, std::string_view parameter, bool otherwise) const;

 private:
  /// One with an id, whose value is found once.
  struct Texture {
    MitsubaElement element{};
    std::optional<SceneValue> value{};
    bool is_open = false;  // its value is being found
  };

  SceneValue read(const MitsubaElement& element, int depth);
  SceneValue referred(const MitsubaElement& reference, int depth);
  SceneValue texture(const MitsubaElement& element, int depth);
  SceneValue spectrum(const MitsubaElement& element) const;

  SceneBuilder& builder_;
  std::unordered_map<std::string, std::string> variables_;
  std::size_t longest_name_ = 0;  // of a variable
  std::unordered_map<std::string, Texture> textures_;
};

}  // namespace albedo::analysis
