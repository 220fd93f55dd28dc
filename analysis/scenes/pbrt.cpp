#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "analysis/scenes/interfaces.hpp"
#include "analysis/scenes/pbrt_parser.hpp"
#include "analysis/scenes/pbrt_values.hpp"
#include "analysis/scenes/readers.hpp"
#include "analysis/scenes/scene_builder.hpp"
#include "analysis/scenes/scene_files.hpp"

namespace albedo::analysis {
namespace {

class PbrtReader {
 public:
  explicit PbrtReader(const std::string& path) : builder_(path, "pbrt"), files_(path) {}

  Scene read() {
    const std::string text = files_.open();
    read_text(text);
    for (const Reference& reference : references_) {
      const auto found = named_.find(reference.name);
      if (found == named_.end()) {
        builder_.note("the material " + in_quotes(reference.name) + " isn't defined", reference.file, reference.line);
      } else if (reference.holder) {
        builder_.hold(*reference.holder, found->second);
      } else {
        builder_.use(found->second);
      }
    }
    return builder_.finish();
  }

 private:
  /// The material that shapes get: one by its number, or by a name.
  struct Current {
    std::optional<std::size_t> bsdf{};
    std::string name{};
  };
  /// Names may be used before they are defined.
  struct Reference {
    std::string name{}, file{};
    std::size_t line = 0;
    std::optional<std::size_t> holder{};  // none for a shape
  };

  void read_text(const std::string& text) {
    const std::string file = files_.name();
    PbrtParser parser(text, file);
    while (const std::optional<PbrtDirective> directive = parser.next()) read_directive(*directive, file);
  }

  void read_directive(const PbrtDirective& directive, const std::string& file) {
    const std::string& name = directive.name;
    const auto first = [&]() -> const std::string& {
      if (directive.texts.empty()) fail_at(file, directive.line, name + " takes a name");
      if (directive.texts[0].size() > longest_name) fail_at(file, directive.line, "a name is longer than 1000 bytes");
      return directive.texts[0];
    };
    if (name == "Material") {
      current_ = {.bsdf = add_material(directive, {.type = first(), .file = file, .line = directive.line})};
    } else if (name == "MakeNamedMaterial") {
      const PbrtParameter* type = directive.find("type");
      if (type == nullptr || type->values.empty())
        fail_at(file, directive.line, in_quotes(first()) + " has no \"type\"");
      const Place place{.name = first(), .type = type->values[0], .file = file, .line = directive.line};
      named_[first()] = add_material(directive, place);
    } else if (name == "NamedMaterial") {
      current_ = {.name = first()};
    } else if (name == "Texture") {
      values_.add_texture(directive, file);
    } else if (name == "Shape") {
      use_current(file, directive.line);
    } else if (name == "Include" || name == "Import") {
      const std::string text = files_.open(first(), file, directive.line);
      read_text(text);
      files_.close();
    } else if (name == "AttributeBegin" || name == "ObjectBegin") {
      if (saved_.size() >= deepest_nesting) fail_at(file, directive.line, "attributes are nested more than 10000 deep");
      saved_.push_back(current_);
    } else if (name == "AttributeEnd" || name == "ObjectEnd") {
      if (saved_.empty()) fail_at(file, directive.line, name + " ends what hasn't begun");
      current_ = saved_.back();
      saved_.pop_back();
    } else if (name == "Attribute" && first() == "material") {
      builder_.note("Attribute \"material\" sets defaults of materials, which isn't followed", file, directive.line);
    }
  }

  void use_current(const std::string& file, std::size_t line) {
    if (current_.bsdf) {
      builder_.use(*current_.bsdf);
    } else if (!current_.name.empty()) {
      references_.push_back({.name = current_.name, .file = file, .line = line});
    } else {
      builder_.note("a shape has no material: pbrt gives it the diffuse one of reflectance 0.5", file, line);
    }
  }

  std::size_t add_material(const PbrtDirective& material, Place place) {
    if (place.name.empty()) place.name = place.type + " at line " + std::to_string(place.line);
    if (place.type == "diffuse") {
      MaterialParts parts("lambert");
      parts.set("rho", value(material, "reflectance", 0.5, place), MaterialParts::reflectance);
      return builder_.add(parts, place);
    }
    if (place.type == "conductor") return add_conductor(material, place);
    if (place.type == "coateddiffuse") return add_coated_diffuse(material, place);
    if (place.type == "mix") return add_mix(material, place);
    return builder_.add_unmodelled(place);
  }

  SceneValue value(const PbrtDirective& material, const char* name, double otherwise, const Place& place) {
    return values_.value(material, name, SceneValue(otherwise), place.file);
  }

  /// GGX with height-correlated Smith masking; α = √roughness unless told otherwise, and a mirror where both are below
  /// 1e-3. @return nothing for a mirror
  std::optional<MaterialParts> facets(const PbrtDirective& material, const Place& place) {
    const PbrtParameter* remap = material.find("remaproughness");
    const bool is_remapped = remap == nullptr || remap->values.empty() || remap->values[0] != "false";
    const SceneValue roughness = value(material, "roughness", 0, place);
    const auto alpha = [&](const char* name) {
      SceneValue result = values_.value(material, name, roughness, place.file);
      if (is_remapped && result.lowest() >= 0) result = result.mapped([](double r) { return std::sqrt(r); });
      return result;
    };
    const SceneValue u = alpha("uroughness"), v = alpha("vroughness");
    constexpr double smooth = 1e-3, least = 1e-4;  // of TrowbridgeReitzDistribution
    if (u.lowest() >= 0 && v.lowest() >= 0 && u.highest() < smooth && v.highest() < smooth) return std::nullopt;
    const auto raised = [&](const SceneValue& a) {
      return a.lowest() >= 0 ? a.mapped([&](double x) { return std::max(x, least); }) : a;
    };
    MaterialParts parts("ggx");
    parts.set("alpha_x", raised(u), MaterialParts::roughness)
        .set("alpha_y", raised(v), MaterialParts::roughness)
        .choose("masking", "correlated")
        .choose("fresnel", "conductor");
    return parts;
  }

  std::size_t add_conductor(const PbrtDirective& material, const Place& place) {
    std::optional<MaterialParts> parts = facets(material, place);
    if (!parts) return builder_.add_unmodelled(place, "it is smooth, and a mirror's reflection is no lobe");
    SceneValue eta(1.0), k(0.0);
    if (material.find("reflectance") != nullptr) {
      // pbrt's index of 1 whose extinction gives this reflectance at normal incidence
      k = value(material, "reflectance", 0, place).mapped([](double r) {
        const double kept = std::min(r, 0.9999);
        return kept >= 0 ? 2 * std::sqrt(kept) / std::sqrt(1 - kept) : kept;
      });
    } else {
      const std::optional<SceneValue> known_eta = metal(material, "eta", place), known_k = metal(material, "k", place);
      if (!known_eta || !known_k || !known_eta->is_known || !known_k->is_known) {
        return builder_.add_unmodelled(place, "the numbers of a spectrum that it names aren't known here");
      }
      eta = *known_eta;
      k = *known_k;
    }
    parts->set("eta", eta, MaterialParts::index).set("k", k, MaterialParts::extinction);
    return builder_.add(*parts, place);
  }

  /// "metal-Cu-eta" and the like, or what else is given.
  std::optional<SceneValue> metal(const PbrtDirective& material, const std::string& which, const Place& place) {
    const PbrtParameter* parameter = material.find(which);
    std::string name = "metal-Cu-" + which;
    if (parameter != nullptr) {
      if (parameter->type != "spectrum" || parameter->values.size() != 1) {
        return values_.value(material, which, SceneValue(0.0), place.file);
      }
      name = parameter->values[0];
    }
    const std::string head = "metal-", tail = "-" + which;
    if (name.size() <= head.size() + tail.size() || !name.starts_with(head) || !name.ends_with(tail))
      return std::nullopt;
    const std::string element = name.substr(head.size(), name.size() - head.size() - tail.size());
    const std::optional<ComplexIndex> index = metal_index(element);
    if (!index) return std::nullopt;
    builder_.note("the indices of the metal " + element + " are ours for R, G and B, not the renderer's spectra",
                  place);
    return SceneValue(which == "eta" ? index->eta : index->k);
  }

  std::size_t add_coated_diffuse(const PbrtDirective& material, const Place& place) {
    std::optional<MaterialParts> parts = facets(material, place);
    if (!parts) return builder_.add_unmodelled(place, "its coat is smooth, and a mirror's reflection is no lobe");
    SceneValue eta = value(material, "eta", 1.5, place);
    if (!eta.is_constant()) {
      builder_.note("the coat's index isn't a number: pbrt's default, 1.5, is taken", place);
      eta = SceneValue(1.5);
    }
    const SceneValue reflectance = value(material, "reflectance", 0.5, place);
    parts->set("eta", eta, MaterialParts::index).set("k", SceneValue(0.0), MaterialParts::extinction);
    if (parts->problem().empty()) parts->set_lambertian(body_albedo(reflectance, eta.high[0], true));
    builder_.note(
        "coateddiffuse: beside the coat's lobe, a Lambertian part of the body's mean albedo under a smooth coat",
        place);
    return builder_.add(*parts, place);
  }

  std::size_t add_mix(const PbrtDirective& material, const Place& place) {
    const std::size_t holder = builder_.add_holder(place);
    if (const PbrtParameter* materials = material.find("materials")) {
      for (const std::string& name : materials->values) {
        references_.push_back({.name = name, .file = place.file, .line = place.line, .holder = holder});
      }
    }
    return holder;
  }

  static constexpr std::size_t longest_name = 1000, deepest_nesting = 10'000;

  SceneBuilder builder_;
  SceneFiles files_;
  PbrtValues values_{builder_};
  Current current_;
  std::vector<Current> saved_;
  std::vector<Reference> references_;
  std::unordered_map<std::string, std::size_t> named_;
};

}  // namespace

Scene read_pbrt(const std::string& path) { return PbrtReader(path).read(); }

}  // namespace albedo::analysis
