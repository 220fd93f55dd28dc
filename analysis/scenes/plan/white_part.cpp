#include "analysis/scenes/plan/white_part.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "albedo/microfacet/fresnel.hpp"
#include "analysis/subjects/material_table.hpp"

namespace albedo::analysis {
namespace {

using Name = std::string_view;

bool is_one_of(const std::string& name, std::initializer_list<Name> names) {
  return std::ranges::find(names, name) != names.end();
}

bool is_scale(const std::string& name) { return is_one_of(name, {"rho_s", "k_s"}); }
bool is_matte(const std::string& name) { return is_one_of(name, {"rho_d", "k_d", "r_d"}); }
bool is_facet(const std::string& model, const std::string& name) {
  return is_one_of(name, {"f0", "r_s", "eta", "k"}) || (model == "oren_nayar" && name == "rho");
}

const albedo::ParameterValue* find(const Parameters& parameters, Name name) {
  for (const auto& [other, value] : parameters) {
    if (other == name) return &value;
  }
  return nullptr;
}

double number(const Parameters& parameters, Name name, double otherwise) {
  const albedo::ParameterValue* value = find(parameters, name);
  return value != nullptr && std::holds_alternative<double>(*value) ? std::get<double>(*value) : otherwise;
}

/// F at normal incidence.
double facet_reflectance(const std::string& model, const Parameters& parameters) {
  if (model == "oren_nayar") return number(parameters, "rho", 1);
  if (find(parameters, "r_s") != nullptr) return number(parameters, "r_s", 1);
  Fresnel fresnel{
      .f0 = number(parameters, "f0", 1), .eta = number(parameters, "eta", 1), .k = number(parameters, "k", 0)};
  if (const albedo::ParameterValue* kind = find(parameters, "fresnel")) {
    const auto& name = std::get<std::string>(*kind);
    fresnel.kind = name == "none"      ? FresnelKind::none
                   : name == "schlick" ? FresnelKind::schlick
                                       : FresnelKind::conductor;
  }
  return fresnel(1.0);
}

/// Scales are 1 and what is matte is gone.
Parameters specular_parameters(Parameters parameters) {
  for (auto& [name, value] : parameters) {
    if (is_scale(name)) value = 1.0;
    if (is_matte(name)) value = 0.0;
  }
  return parameters;
}

/// Without a Fresnel factor too, whose parameters have their defaults: equal lobes are equal texts.
Parameters white_parameters(const ModelInfo& info, Parameters parameters) {
  for (auto& [name, value] : parameters) {
    if (name == "fresnel") value = std::string("none");
    if (is_facet(info.name, name)) value = is_one_of(name, {"eta", "k"}) ? info.find(name)->default_value : 1.0;
  }
  return parameters;
}

/// Whether all of a model's reflectances are known by name.
bool is_known(const ModelInfo& info) {
  return !info.needs_input() && info.name != "shirley_matte" &&
         std::ranges::all_of(info.parameters, [&](const ParameterInfo& parameter) {
           const std::string& name = parameter.name;
           return !parameter.per_channel || is_scale(name) || is_matte(name) || is_facet(info.name, name);
         });
}

Material without_scale(Material material) {
  material.scale = 1.0, material.lambertian = 0.0;
  return material;
}

double in_channel(const ParameterValue& value, std::size_t channel) {
  if (const auto* channels = std::get_if<std::array<double, 3>>(&value)) return (*channels)[channel];
  return std::get<double>(value);
}

}  // namespace

WhitePart white_part(const Material& material, std::size_t channel, const std::string& file) {
  WhitePart part{.whole = make_material(material, channel, file), .scale = in_channel(material.scale, channel)};
  std::shared_ptr<const Model> base = make_material(without_scale(material), channel, file);
  const ModelInfo& info = base->info();
  if (info.name == "lambert" || info.name == "shirley_matte") {
    part.matte_reason = info.name == "lambert"
                            ? "Lambertian: it reflects the same part of the light at every angle, and loses none"
                            : "matte: it takes what the surface above it leaves, and that adds up by construction";
    return part;
  }
  const Parameters parameters = base->parameters();
  if (!is_known(info)) {
    part.specular = std::move(base);
    return part;
  }
  for (const auto& [name, value] : parameters) {
    if (is_scale(name)) part.scale *= std::get<double>(value);
  }
  if (part.scale == 0) {
    part.matte_reason = "its specular part has a weight of 0, and the rest is Lambertian";
    return part;
  }
  part.facet_reflectance = facet_reflectance(info.name, parameters);
  const Parameters specular = specular_parameters(parameters);
  part.specular = make_model(info.name, specular);
  part.white = make_model(info.name, white_parameters(info, specular));
  if (key_of(*part.white) == key_of(*part.specular)) part.specular = part.white;
  return part;
}

std::string key_of(const Model& model) {
  std::string key = model.info().name;
  for (const auto& [name, value] : model.parameters()) {
    key += ' ' + name + '=';
    if (const auto* text = std::get_if<std::string>(&value)) {
      key += *text;
    } else {
      std::array<char, 32> digits{};  // the fewest that read back as the same number
      key.append(digits.data(),
                 std::to_chars(digits.data(), digits.data() + digits.size(), std::get<double>(value)).ptr);
    }
  }
  return key;
}

}  // namespace albedo::analysis
