#include "analysis/scenes/plan/variants.hpp"

#include <algorithm>
#include <cmath>

#include "albedo/core/errors.hpp"
#include "analysis/files/table_document.hpp"

namespace albedo::analysis {
namespace {

FormatError wrong(const SceneMaterial& material, const std::string& what) {
  return FormatError("'" + material.file + "', line " + std::to_string(material.material.line) + ": " + what);
}

bool is_colour(const ModelInfo& info, const std::string& name) {
  if (name == "scale" || name == "lambertian") return true;
  if (info.name == "oren_nayar" && name == "rho") return true;
  const ParameterInfo* parameter = info.find(name);
  return parameter != nullptr && parameter->per_channel;
}

/// An exponent's decades are what a roughness's are.
bool is_exponent(const std::string& name) { return name == "n" || name == "n_u" || name == "n_v"; }

/// Sets a parameter in place of what sets it now.
void set(Material& material, const ModelInfo& info, const std::string& name, double value) {
  if (name == "scale" || name == "lambertian") {
    (name == "scale" ? material.scale : material.lambertian) = value;
    return;
  }
  const std::vector<std::string> wanted = info.resolve(name);
  std::vector<std::pair<std::string, ParameterValue>> kept;
  for (auto& [other, old] : material.parameters) {
    for (const std::string& one : info.resolve(other)) {
      if (std::ranges::find(wanted, one) == wanted.end()) kept.emplace_back(one, old);
    }
  }
  kept.emplace_back(name, value);
  material.parameters = std::move(kept);
}

void append_value(std::string& key, const ParameterValue& value, std::size_t channel) {
  if (const auto* text = std::get_if<std::string>(&value)) {
    key += *text;
  } else if (const auto* number = std::get_if<double>(&value)) {
    append_number(key, *number);
  } else {
    append_number(key, std::get<std::array<double, 3>>(value)[channel]);
  }
}

}  // namespace

std::string Variation::name() const {
  if (kind == Kind::none) return "";
  if (kind == Kind::azimuth) return "phi";
  return parameters.size() > 1 && parameters.front().ends_with("_x") ? "alpha" : parameters.front();
}

std::vector<double> Variation::references(int refinement) const {
  if (kind == Kind::none) return {0};
  const int count = (32 << refinement) + 1;
  std::vector<double> places;
  for (int i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / (count - 1);
    double place = std::lerp(low, high, t);
    if (kind == Kind::parameter && is_exponent(parameters.front())) {
      place = std::expm1(std::lerp(std::log1p(low), std::log1p(high), t));
    } else if (kind == Kind::parameter && low >= 0) {
      const double root = std::lerp(std::sqrt(low), std::sqrt(high), t);
      place = root * root;
    }
    places.push_back(i == 0 ? low : i + 1 == count ? high : place);
  }
  return places;
}

MaterialVariants::MaterialVariants(const SceneMaterial& material, std::size_t channel)
    : material_(&material), channel_(channel) {
  const ModelInfo* info = nullptr;
  try {
    info = &model_info(material.material.model);
  } catch (const Error& error) {
    throw wrong(material, error.what());
  }
  for (ParameterInterval interval : material.intervals) {
    const std::string& name = interval.parameter;
    if (!(interval.low <= interval.high) || !std::isfinite(interval.low) || !std::isfinite(interval.high)) {
      throw wrong(material, "the interval of " + name + " has no lower and upper end");
    }
    const std::vector<std::string> names = info->resolve(name);
    if (names.empty() && name != "scale" && name != "lambertian") {
      throw wrong(material, info->name + " has no parameter '" + name + "'");
    }
    if (!names.empty()) {
      const Range range = info->find(names.front())->range;
      interval.low = std::clamp(interval.low, range.minimum, range.maximum);
      interval.high = std::clamp(interval.high, range.minimum, range.maximum);
    }
    if (is_colour(*info, name)) {
      colours_.push_back(interval);
      colour_ends_ = 2;
      continue;
    }
    if (interval.low == interval.high) {
      colours_.push_back(interval);  // known after all
      continue;
    }
    const bool is_same = variation_.kind == Variation::Kind::parameter && variation_.low == interval.low &&
                         variation_.high == interval.high;
    if (variation_.kind != Variation::Kind::none && !is_same) {
      refusal_ =
          "textures set " + variation_.name() + " and " + name + " apart, which would take a table of three variables";
      continue;
    }
    variation_.kind = Variation::Kind::parameter;
    variation_.low = interval.low, variation_.high = interval.high;
    variation_.parameters.push_back(name);
  }
  const bool is_anisotropic = !part(0, variation_.references().front()).whole->claims().isotropic;
  if (!is_anisotropic) return;
  if (variation_.kind == Variation::Kind::parameter) {
    refusal_ =
        "it is anisotropic and a texture sets " + variation_.name() + ", which would take a table of three variables";
    return;
  }
  variation_ = {.kind = Variation::Kind::azimuth, .low = 0, .high = 90};
}

Material MaterialVariants::at(int colour_end, double second) const {
  Material material = material_->material;
  const ModelInfo& info = model_info(material.model);
  for (const ParameterInterval& colour : colours_) {
    set(material, info, colour.parameter, colour_end == 0 ? colour.high : colour.low);
  }
  for (const std::string& parameter : variation_.parameters) set(material, info, parameter, second);
  return material;
}

WhitePart MaterialVariants::part(int colour_end, double second) const {
  return white_part(at(colour_end, second), channel_, material_->file);
}

std::string key_of(const SceneMaterial& scene_material, std::size_t channel) {
  const Material& material = scene_material.material;
  std::string key = material.model;
  const bool has_open_channel = [&] {
    for (const ModelInfo& info : model_infos()) {
      if (info.name == material.model) return info.channel() != nullptr;
    }
    return false;
  }();
  if (has_open_channel) key += " channel " + std::to_string(channel);
  for (const auto& [name, value] : material.parameters) {
    key += ' ' + name + '=';
    append_value(key, value, channel);
  }
  key += " *";
  append_value(key, material.scale, channel);
  key += " +";
  append_value(key, material.lambertian, channel);
  for (const ParameterInterval& interval : scene_material.intervals) {
    key += ' ' + interval.parameter + " in ";
    append_number(key, interval.low);
    key += ':';
    append_number(key, interval.high);
  }
  return key;
}

}  // namespace albedo::analysis
