/// @file
/// All that a material can be over a scene's surfaces: its textures' values, and its azimuths.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/scenes/plan/white_part.hpp"
#include "analysis/scenes/scene.hpp"

namespace albedo::analysis {

/// What beside cosθ a lobe's albedo varies with.
struct Variation {
  enum class Kind { none, azimuth, parameter };

  Kind kind = Kind::none;
  std::vector<std::string> parameters{};  ///< set together
  double low = 0, high = 0;               ///< azimuths are 0 to 90 degrees: every model has two planes of symmetry

  [[nodiscard]] std::string name() const;  ///< "phi", "alpha"; empty if there is none
  /// Places at which a table is fitted, rising: closer towards small roughness. One for Kind::none, else 33, and twice
  /// as close for each refinement.
  [[nodiscard]] std::vector<double> references(int refinement = 0) const;
};

/// A scene's material in one channel.
class MaterialVariants {
 public:
  /// @throws FormatError for a material that isn't one
  MaterialVariants(const SceneMaterial& material, std::size_t channel);

  [[nodiscard]] const Variation& variation() const { return variation_; }
  /// 2 where a texture sets a colour: its least and its most, which asks for the most exact correction.
  [[nodiscard]] int colour_ends() const { return colour_ends_; }
  /// Why it can't be planned, if it can't.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }

  /// The material at a place of the second variable.
  [[nodiscard]] WhitePart part(int colour_end, double second) const;
  [[nodiscard]] double azimuth(double second) const { return variation_.kind == Variation::Kind::azimuth ? second : 0; }

 private:
  [[nodiscard]] Material at(int colour_end, double second) const;

  const SceneMaterial* material_;
  std::size_t channel_;
  Variation variation_;
  std::vector<ParameterInterval> colours_;
  int colour_ends_ = 1;
  std::string refusal_;
};

/// A material's reflectance in one channel as text: equal for equal ones, whatever their names.
std::string key_of(const SceneMaterial& material, std::size_t channel);

}  // namespace albedo::analysis
