/// @file
/// Values of a scene's materials, and the materials made of them.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "analysis/scenes/scene.hpp"

namespace albedo::analysis {

using Rgb = std::array<double, 3>;

/// A number for R, G and B or, of a texture, the interval of its values.
struct SceneValue {
  Rgb low{}, high{};
  bool is_known = true;  ///< false: nothing is known of the texture

  SceneValue() = default;
  explicit SceneValue(double value) : SceneValue(Rgb{value, value, value}) {}
  explicit SceneValue(const Rgb& value) : low(value), high(value) {}

  /// A texture of which nothing is known.
  static SceneValue unknown();

  [[nodiscard]] bool is_constant() const { return low == high && is_known; }
  [[nodiscard]] double lowest() const;
  [[nodiscard]] double highest() const;

  /// What a monotone function of every channel makes of it.
  [[nodiscard]] SceneValue mapped(const std::function<double(double)>& function) const;
  /// The mean of the three channels, as renderers have it of a parameter that is no colour.
  [[nodiscard]] SceneValue mean() const;
};

/// What covers both.
SceneValue hull(const SceneValue& a, const SceneValue& b);
/// Of two values that aren't negative.
SceneValue product(const SceneValue& a, const SceneValue& b);

/// A material in the making: its parameters are checked as they are set, and the first that is outside of its range is
/// the material's problem.
class MaterialParts {
 public:
  struct Range {
    double low, high;
  };
  static constexpr Range reflectance{0, 1}, roughness{1e-6, 100}, index{1e-3, 100}, extinction{0, 100},
      exponent{0, 1e8}, scale{0, 1e6};

  explicit MaterialParts(std::string model);

  MaterialParts& set(const std::string& name, const SceneValue& value, const Range& range);
  MaterialParts& choose(const std::string& name, const std::string& choice);
  MaterialParts& set_scale(const SceneValue& value);
  MaterialParts& set_lambertian(const SceneValue& value);

  /// One sentence; empty if all is well.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  /// The model, its parameters and intervals; name and place are for the reader to fill in.
  [[nodiscard]] const SceneMaterial& material() const { return material_; }

 private:
  ParameterValue checked(const std::string& name, const SceneValue& value, const Range& range);

  SceneMaterial material_;
  std::string problem_;
};

}  // namespace albedo::analysis
