#include <cstring>
#include <deque>
#include <unordered_map>

#include "analysis/scenes/mitsuba_models.hpp"
#include "analysis/scenes/mitsuba_xml.hpp"
#include "analysis/scenes/readers.hpp"
#include "analysis/scenes/scene_builder.hpp"
#include "analysis/scenes/scene_files.hpp"

namespace albedo::analysis {
namespace {

class MitsubaReader {
 public:
  explicit MitsubaReader(const std::string& path) : builder_(path, "mitsuba"), files_(path) {}

  Scene read() {
    read_file(files_.open());
    for (const Reference& reference : references_) {
      const auto found = bsdfs_.find(reference.id);
      if (found == bsdfs_.end()) {
        if (reference.holder && !values_.has_texture(reference.id)) {
          reference.element.fail("it refers to " + in_quotes(reference.id) + ", which isn't in the scene");
        }
        continue;  // shapes refer to emitters and media too
      }
      if (reference.holder) {
        builder_.hold(*reference.holder, found->second);
      } else {
        builder_.use(found->second);
      }
    }
    return builder_.finish();
  }

 private:
  static constexpr int deepest_nesting = 100;
  static constexpr std::size_t deepest_holding = 16;

  /// <ref id=> of a shape or of a BSDF that holds others; it may come before what it refers to.
  struct Reference {
    std::string id;
    MitsubaElement element;
    std::optional<std::size_t> holder{};
  };

  void read_file(std::string text) {
    const MitsubaFile& file = documents_.emplace_back(std::move(text), files_.name(), parts_);
    const std::string version = file.scene().attribute("version").value();
    if (documents_.size() == 1) is_old_ = version.starts_with("0.");
    walk({file.scene(), &file}, 0);
  }

  void walk(const MitsubaElement& parent, int depth) {
    if (depth > deepest_nesting) parent.fail("elements are nested more than 100 deep");
    const bool is_shape = std::strcmp(parent.node.name(), "shape") == 0;
    bool has_bsdf = false;
    for (const pugi::xml_node& node : parent.node.children()) {
      const MitsubaElement element{node, parent.file};
      const std::string tag = element.tag();
      if (tag == "default") {
        values_.add_variable(node.attribute("name").value(), values_.attribute(element, "value"));
      } else if (tag == "include") {
        include(element);
      } else if (tag == "alias") {
        aliases(element);
      } else if (tag == "bsdf") {
        const std::size_t bsdf = read_bsdf(element, {}, {});
        if (is_shape) builder_.use(bsdf);
        has_bsdf = true;
      } else if (tag == "ref" && is_shape) {
        references_.push_back({values_.attribute(element, "id"), element});
        has_bsdf = true;
      } else {
        const bool is_value = tag == "texture" || tag == "spectrum" || tag == "rgb";
        const char* id = node.attribute("id").value();
        if (is_value && *id != '\0') values_.add_texture(id, element);
        walk(element, depth + 1);
      }
    }
    if (is_shape && !has_bsdf && std::strcmp(parent.node.attribute("type").value(), "shapegroup") != 0 &&
        std::strcmp(parent.node.attribute("type").value(), "instance") != 0) {
      builder_.note("a shape has no BSDF: the renderer gives it one of its own", parent.file->name(), parent.line());
    }
  }

  void include(const MitsubaElement& element) {
    read_file(files_.open(values_.attribute(element, "filename"), element.file->name(), element.line()));
    files_.close();
  }

  void aliases(const MitsubaElement& element) {
    const auto found = bsdfs_.find(values_.attribute(element, "id"));
    if (found != bsdfs_.end()) bsdfs_[values_.attribute(element, "as")] = found->second;
  }

  std::size_t read_bsdf(const MitsubaElement& element, const std::string& holder_name,
                        const std::vector<std::string>& within) {
    if (within.size() > deepest_holding) element.fail("BSDFs are nested more than 16 deep");
    const std::string id = values_.attribute(element, "id");
    Place place{!id.empty() ? id : holder_name, values_.attribute(element, "type"), element.file->name(),
                element.line(), within};
    if (place.type.empty()) element.fail("the BSDF has no type");
    const MitsubaHolder kind = holder_kind(place.type, element);
    if (kind == MitsubaHolder::none && place.name.empty()) {
      place.name = place.type + " at line " + std::to_string(place.line);
    }
    const std::size_t bsdf = kind == MitsubaHolder::none ? read_model(element, place)
                             : kind == MitsubaHolder::neutral
                                 ? builder_.add_holder(place)
                                 : builder_.add_unmodelled(place, "only what it holds is modelled");
    if (!id.empty()) bsdfs_[id] = bsdf;
    for (const pugi::xml_node& texture : element.node.children("texture")) {
      const char* texture_id = texture.attribute("id").value();
      if (*texture_id != '\0') values_.add_texture(texture_id, {texture, element.file});
    }
    if (kind == MitsubaHolder::none) return bsdf;
    std::vector<std::string> inside = within;
    inside.push_back(place.type);
    for (const pugi::xml_node& node : element.node.children()) {
      const MitsubaElement child{node, element.file};
      if (child.tag() == "bsdf") {
        const std::size_t held = read_bsdf(child, place.name, inside);
        builder_.hold(bsdf, held);
      } else if (child.tag() == "ref") {
        references_.push_back({values_.attribute(child, "id"), child, bsdf});
      }
    }
    return bsdf;
  }

  std::size_t read_model(const MitsubaElement& element, const Place& place) {
    const MitsubaModel model = model_of(element, place, is_old_, values_, builder_);
    return model.parts ? builder_.add(*model.parts, place) : builder_.add_unmodelled(place, model.why);
  }

  SceneBuilder builder_;
  SceneFiles files_;
  MitsubaValues values_{builder_};
  bool is_old_ = false;
  std::size_t parts_ = 0;              // tags and attributes so far
  std::deque<MitsubaFile> documents_;  // elements point into them
  std::unordered_map<std::string, std::size_t> bsdfs_;
  std::vector<Reference> references_;
};

}  // namespace

Scene read_mitsuba(const std::string& path) { return MitsubaReader(path).read(); }

}  // namespace albedo::analysis
