/// @file
/// What of a material can lose energy: its specular part, and that part made white.
#pragma once

#include <memory>
#include <string>

#include "albedo/core/model.hpp"
#include "analysis/subjects/materials.hpp"

namespace albedo::analysis {

/// A material in one channel, a = s a_F + d: a lobe of albedo a_F times a scale s, and what is matte. With colours and
/// Fresnel factor 1 the lobe's albedo is E, which would be 1 if the lobe kept all light.
struct WhitePart {
  std::shared_ptr<const Model> whole{};     ///< the material: a
  std::shared_ptr<const Model> specular{};  ///< the lobe with its Fresnel factor: a_F; null if there is none
  std::shared_ptr<const Model> white{};     ///< the same without colour and Fresnel factor: E; null if that isn't known
  double scale = 1;                         ///< s
  double facet_reflectance = 1;             ///< F₀: of a facet at normal incidence
  std::string matte_reason{};               ///< why there is no specular part, where there is none
};

/// Splits a material by the names of its model's parameters: rho_s and k_s are scales, f0, r_s, eta and k and Oren and
/// Nayar's rho a facet's reflectance, rho_d, k_d and r_d matte. A model of one's own that has other reflectances has no
/// white part, and neither has a measured one.
/// @throws FormatError as make_material() does
WhitePart white_part(const Material& material, std::size_t channel, const std::string& file);

/// Name and parameters as one text: equal for equal models.
std::string key_of(const Model& model);

}  // namespace albedo::analysis
