#include "analysis/scenes/mitsuba_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "analysis/scenes/interfaces.hpp"
#include "analysis/scenes/scene_files.hpp"

namespace albedo::analysis {
namespace {

/// One BSDF, and what is needed to read it.
struct Reader {
  const MitsubaElement& bsdf;
  const Place& place;
  bool is_old;
  MitsubaValues& values;
  SceneBuilder& builder;

  SceneValue value(std::string_view parameter, double otherwise) const {
    return values.value(bsdf, parameter, SceneValue(otherwise));
  }
  void note(const std::string& sentence) const { builder.note(place.type + ": " + sentence, place); }
};

/// alpha, or alphaU and alphaV; Mitsuba raises what is below 1e-4 of a microfacet distribution.
struct Roughness {
  SceneValue u, v;
};
Roughness roughness_of(const Reader& reader, bool is_raised) {
  const SceneValue alpha = reader.value("alpha", 0.1);
  Roughness result{reader.values.value(reader.bsdf, "alphau", alpha).mean(),
                   reader.values.value(reader.bsdf, "alphav", alpha).mean()};
  constexpr double least = 1e-4;
  for (SceneValue* value : {&result.u, &result.v}) {
    if (value->lowest() < 0 || value->lowest() >= least) continue;
    if (is_raised && value->is_constant()) reader.note("its roughness is raised to 1e-4, as the renderer does it");
    // of Ward's plugin, which divides by it, a texture's zero is no surface
    if (is_raised || !value->is_known) *value = value->mapped([&](double a) { return std::max(a, least); });
  }
  return result;
}

/// The index of refraction of a side, a number or a name.
std::optional<double> index_of(const Reader& reader, std::string_view parameter, const char* otherwise) {
  const std::optional<MitsubaElement> child = MitsubaValues::find(reader.bsdf, parameter);
  if (!child || child->tag() == "string") {
    std::string name = reader.values.text(reader.bsdf, parameter, otherwise);
    std::ranges::transform(name, name.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 'a' - 'A') : c; });
    return dielectric_index(name);
  }
  const SceneValue value = reader.values.value(reader.bsdf, parameter, SceneValue(0.0));
  if (!value.is_constant() || !(value.low[0] > 0)) return std::nullopt;
  return value.low[0];
}

/// GGX or Beckmann with separable Smith masking, which is Mitsuba's; its Beckmann masking is a rational fit of this
/// one.
std::optional<MaterialParts> facets_of(const Reader& reader, MitsubaModel& model) {
  std::string distribution = reader.values.text(reader.bsdf, "distribution", "beckmann");
  std::ranges::transform(distribution, distribution.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 'a' - 'A') : c; });
  if (distribution != "beckmann" && distribution != "ggx") {
    model.why = "its distribution " + in_quotes(distribution) + " isn't modelled";
    return std::nullopt;
  }
  const Roughness alpha = roughness_of(reader, true);
  MaterialParts parts(distribution);
  parts.set("alpha_x", alpha.u, MaterialParts::roughness)
      .set("alpha_y", alpha.v, MaterialParts::roughness)
      .choose("masking", "separable");
  return parts;
}

/// Mitsuba 0.6 scales a reflectance that exceeds 1 somewhere; it is told not to by a flag.
bool is_conserved(const Reader& reader) {
  return reader.is_old && reader.values.boolean(reader.bsdf, "ensureenergyconservation", true);
}

SceneValue reflectance(const Reader& reader, std::string_view parameter, double otherwise) {
  const SceneValue value = reader.value(parameter, otherwise);
  const double most = value.highest();
  if (!(most > 1) || !value.is_known || !is_conserved(reader)) return value;
  reader.note("a reflectance exceeds 1, and is scaled as the renderer does it");
  return value.mapped([&](double x) { return 0.99 * x / most; });
}

void set_scale(MaterialParts& parts, const SceneValue& value) {
  if (!value.is_constant() || value.low != Rgb{1, 1, 1}) parts.set_scale(value);
}

MitsubaModel diffuse(const Reader& reader) {
  MitsubaModel model{.parts = MaterialParts("lambert")};
  model.parts->set("rho", reflectance(reader, "reflectance", 0.5), MaterialParts::reflectance);
  return model;
}

MitsubaModel rough_diffuse(const Reader& reader) {
  MitsubaModel model{.parts = MaterialParts("oren_nayar")};
  if (!reader.values.boolean(reader.bsdf, "usefastapprox", false)) {
    reader.note("Oren and Nayar's qualitative model stands for the full one");
  }
  const SceneValue sigma = reader.value("alpha", 0.2).mean().mapped([](double a) { return a / std::numbers::sqrt2; });
  model.parts->set("sigma", sigma, {0, 2})
      .set("rho", reflectance(reader, "reflectance", 0.5), MaterialParts::reflectance);
  return model;
}

MitsubaModel rough_conductor(const Reader& reader) {
  MitsubaModel model;
  std::optional<MaterialParts> parts = facets_of(reader, model);
  if (!parts) return model;
  const std::string material = reader.values.text(reader.bsdf, "material", reader.is_old ? "Cu" : "none");
  const bool has_eta = MitsubaValues::find(reader.bsdf, "eta").has_value();
  const bool has_k = MitsubaValues::find(reader.bsdf, "k").has_value();
  const bool is_mirror = material == "none" || material == "None";
  if (is_mirror && !has_eta && !has_k) {
    parts->choose("fresnel", "none");
  } else {
    const std::optional<ComplexIndex> metal = is_mirror ? ComplexIndex{{0, 0, 0}, {1, 1, 1}} : metal_index(material);
    if (!metal && !(has_eta && has_k)) {
      model.why = "the indices of the metal " + in_quotes(material) + " aren't known here";
      return model;
    }
    if (!is_mirror && !(has_eta && has_k)) {
      reader.note("the indices of the metal " + in_quotes(material) +
                  " are ours for R, G and B, not the renderer's spectra");
    }
    const std::optional<double> outside = reader.is_old ? index_of(reader, "exteta", "air") : 1.0;
    if (!outside) {
      model.why = "its outer index of refraction isn't known";
      return model;
    }
    const ComplexIndex known = metal.value_or(ComplexIndex{});
    const auto relative = [&](const char* name, const Rgb& otherwise) {
      return reader.values.value(reader.bsdf, name, SceneValue(otherwise)).mapped([&](double x) {
        return x / *outside;
      });
    };
    SceneValue eta = relative("eta", known.eta);
    const SceneValue k = relative("k", known.k);
    if (!eta.is_known || !k.is_known) {
      model.why = "the numbers of its spectra aren't known here";
      return model;
    }
    if (eta.is_constant() && eta.lowest() < 0) {
      // what a spectrum's projection on R, G and B can give; the renderer's formula has the square of it
      reader.note("a negative index of refraction counts as its absolute value");
      eta = eta.mapped([](double x) { return std::abs(x); });
    }
    parts->choose("fresnel", "conductor").set("eta", eta, MaterialParts::index).set("k", k, MaterialParts::extinction);
  }
  set_scale(*parts, reflectance(reader, "specularreflectance", 1));
  model.parts = std::move(parts);
  return model;
}

MitsubaModel rough_plastic(const Reader& reader) {
  MitsubaModel model;
  std::optional<MaterialParts> parts = facets_of(reader, model);
  if (!parts) return model;
  const std::optional<double> inside = index_of(reader, "intior", "polypropylene");
  const std::optional<double> outside = index_of(reader, "extior", "air");
  if (!inside || !outside) {
    model.why = "its index of refraction isn't known";
    return model;
  }
  const double eta = *inside / *outside;
  parts->choose("fresnel", "conductor")
      .set("eta", SceneValue(eta), MaterialParts::index)
      .set("k", SceneValue(0.0), MaterialParts::extinction);
  set_scale(*parts, reflectance(reader, "specularreflectance", 1));
  if (parts->problem().empty()) {
    const bool nonlinear = reader.values.boolean(reader.bsdf, "nonlinear", false);
    parts->set_lambertian(body_albedo(reflectance(reader, "diffusereflectance", 0.5), eta, nonlinear));
  }
  reader.note("beside its lobe, a Lambertian part of the body's mean albedo under a smooth surface");
  model.parts = std::move(parts);
  return model;
}

/// Of phong and ward: where the two reflectances exceed 1 together, Mitsuba 0.6 scales both.
struct TwoReflectances {
  SceneValue specular, diffuse;
};
TwoReflectances conserved(const Reader& reader) {
  TwoReflectances two{reader.value("specularreflectance", 0.2), reader.value("diffusereflectance", 0.5)};
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) most = std::max(most, two.specular.high[i] + two.diffuse.high[i]);
  const bool is_known = two.specular.is_known && two.diffuse.is_known;
  if (!(most > 1) || !is_conserved(reader)) return two;
  if (!is_known) {
    reader.note("the renderer scales its reflectances if they exceed 1 together, which isn't known of a texture");
    return two;
  }
  reader.note("its reflectances exceed 1 together, and are scaled as the renderer does it");
  const auto scaled = [&](double x) { return 0.99 * x / most; };
  return {two.specular.mapped(scaled), two.diffuse.mapped(scaled)};
}

/// Lafortune and Willems' modified Phong, (n+2)/2π (R·V)^n, which is our `phong`.
MitsubaModel phong(const Reader& reader) {
  const TwoReflectances reflectances = conserved(reader);
  MitsubaModel model{.parts = MaterialParts("phong")};
  SceneValue exponent = reader.value("exponent", 30).mean();
  model.parts->set("n", exponent, MaterialParts::exponent);
  set_scale(*model.parts, reflectances.specular);
  model.parts->set_lambertian(reflectances.diffuse);
  return model;
}

MitsubaModel ward(const Reader& reader) {
  std::string variant = reader.values.text(reader.bsdf, "variant", "balanced");
  MitsubaModel model;
  if (variant != "ward" && variant != "ward-duer" && variant != "balanced") {
    model.why = "its variant " + in_quotes(variant) + " isn't one of Mitsuba's";
    return model;
  }
  const TwoReflectances reflectances = conserved(reader);
  const Roughness alpha = roughness_of(reader, false);
  model.parts = MaterialParts(variant == "ward" ? "ward" : variant == "ward-duer" ? "ward_duer" : "ward_bounded");
  model.parts->set("alpha_x", alpha.u, MaterialParts::roughness)
      .set("alpha_y", alpha.v, MaterialParts::roughness)
      .set("rho_s", reflectances.specular, MaterialParts::scale)
      .set("rho_d", reflectances.diffuse, MaterialParts::reflectance);
  return model;
}

}  // namespace

MitsubaHolder holder_kind(const std::string& type, const MitsubaElement& bsdf) {
  static constexpr std::array<std::string_view, 9> neutral{"twosided",    "bumpmap", "normalmap", "mask", "blendbsdf",
                                                           "mixturebsdf", "mixture", "composite", "bump"};
  if (std::ranges::find(neutral, type) != neutral.end()) return MitsubaHolder::neutral;
  const bool is_coat = type == "coating" || type == "roughcoating";
  return is_coat || bsdf.node.child("bsdf") ? MitsubaHolder::altering : MitsubaHolder::none;
}

MitsubaModel model_of(const MitsubaElement& bsdf, const Place& place, bool is_old, MitsubaValues& values,
                      SceneBuilder& builder) {
  using Function = MitsubaModel (*)(const Reader&);
  static constexpr std::array<std::pair<std::string_view, Function>, 6> modelled{{{"diffuse", diffuse},
                                                                                  {"roughdiffuse", rough_diffuse},
                                                                                  {"roughconductor", rough_conductor},
                                                                                  {"roughplastic", rough_plastic},
                                                                                  {"phong", phong},
                                                                                  {"ward", ward}}};
  for (const auto& [type, function] : modelled) {
    if (type == place.type) return function({bsdf, place, is_old, values, builder});
  }
  MitsubaModel model;
  if (place.type == "conductor" || place.type == "plastic") {
    model.why = "it is smooth, and a mirror's reflection is no lobe";
  }
  return model;
}

}  // namespace albedo::analysis
