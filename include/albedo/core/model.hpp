#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "albedo/core/direction.hpp"
#include "albedo/core/lobe.hpp"
#include "albedo/core/sampled.hpp"

namespace albedo {

/// The valid values of a numeric parameter.
struct Range {
  double minimum;
  double maximum;

  [[nodiscard]] bool contains(double value) const { return value >= minimum && value <= maximum; }  // false for NaN
};

/// One parameter of a model, as shown to users.
struct ParameterInfo {
  std::string name{};
  std::string meaning{};
  Range range{0, 0};
  double default_value = 0;
  bool per_channel = false;            ///< may differ for red, green and blue
  std::vector<std::string> choices{};  ///< non-empty: the parameter is one of these names and default_value is an index

  bool is_text = false;  ///< any text, such as a file's name; it has no default and must be given

  [[nodiscard]] bool is_choice() const { return !choices.empty(); }
};

/// One name that sets several parameters: `alpha` sets alpha_x and alpha_y.
struct Shorthand {
  std::string name;
  std::vector<std::string> parameters;
};

/// In which measure a distribution of half vectors integrates to 1.
enum class Measure {
  none,
  solid_angle,  ///< ∫ D dω_H = 1: a density of half vectors
  projected,    ///< ∫ D N·H dω_H = 1: facets of a height field
};

/// What a model promises for given parameters; tests and the audit hold it to that.
struct Claims {
  bool reciprocal = true;
  bool conserves_energy = true;  ///< a(L) ≤ 1 for every L
  bool bounded = true;           ///< a(L) stays finite at grazing incidence
  bool isotropic = true;
  Measure distribution = Measure::none;  ///< in which its distribution is normalised
  bool consistent_masking = false;  ///< visible facets fill what is seen of the surface: ∫ G₁ D (L·H)₊ = N·L
};

/// A model's name, source and parameters.
struct ModelInfo {
  std::string name;
  std::string title;
  std::string source;     ///< paper and equation numbers
  std::string deviation;  ///< from the source, or "none"
  std::vector<ParameterInfo> parameters{};
  std::vector<Shorthand> shorthands{};
  Claims claims{};  ///< with its default parameters

  /// Whether some parameter has no default.
  [[nodiscard]] bool needs_input() const;
  /// The choice of a colour channel, or nullptr: asked for without it, such a model stands for one of each.
  [[nodiscard]] const ParameterInfo* channel() const;
  /// The parameter of that name, or nullptr.
  [[nodiscard]] const ParameterInfo* find(std::string_view wanted) const;
  /// The parameters that a name stands for: itself, or a shorthand's; empty if there is none.
  [[nodiscard]] std::vector<std::string> resolve(std::string_view wanted) const;
};

/// A number, the name of a choice, or a text.
using ParameterValue = std::variant<double, std::string>;
using Parameters = std::vector<std::pair<std::string, ParameterValue>>;

class QuadFormula;

inline namespace ALBEDO_INSTRUCTION_SET {

/// A reflectance model with its parameters set: a sum of lobes, each of which can be integrated on a warp of its own.
///
/// The formula behind it is one template over the number type; this interface runs it on a block of pairs (the fast
/// path), on one pair in double and float (as a shader would) and, behind quad(), in 113 bits.
class Model {
 public:
  virtual ~Model() = default;

  [[nodiscard]] virtual const ModelInfo& info() const = 0;
  [[nodiscard]] virtual Claims claims() const = 0;
  /// Every parameter with its value, in the order of info().parameters.
  [[nodiscard]] virtual Parameters parameters() const = 0;
  /// The lobes that are not switched off.
  [[nodiscard]] virtual std::vector<Lobe> lobes() const = 0;

  /// The same formula in 113 bits; core/quad.hpp says what it does.
  [[nodiscard]] virtual const QuadFormula& quad() const = 0;

  /// What the model reflects into the mirror direction alone, as a fraction of the light from L: a delta, which is in
  /// no lobe and no f(L,V), but is part of the albedo. 0 unless a model says otherwise. Rounded from 113 bits.
  [[nodiscard]] double coherent_albedo(const Direction& l) const;

  /// Lobe `component`'s f(L,V) [1/sr].
  [[nodiscard]] virtual Block evaluate(int component, const DirectionPair<Block>& pair) const noexcept = 0;
  [[nodiscard]] virtual double evaluate(int component, const DirectionPair<double>& pair) const noexcept = 0;
  [[nodiscard]] virtual float evaluate(int component, const DirectionPair<float>& pair) const noexcept = 0;

  /// Whether lobe `component` has a published way to draw V for a given L; sample and density answer NaN otherwise.
  [[nodiscard]] virtual bool has_sampler(int /*component*/) const noexcept { return false; }
  /// The V that lobe `component`'s sampler makes of a point (u, v) of the unit square.
  [[nodiscard]] virtual Sampled<Block> sample(int component, const UnitVector<Block>& l, const Block& u,
                                              const Block& v) const noexcept;
  [[nodiscard]] virtual Sampled<double> sample(int component, const UnitVector<double>& l, double u,
                                               double v) const noexcept;
  /// The density [1/sr] with which that sampler draws V; ∫ density dω_V = 1 over the whole sphere.
  [[nodiscard]] virtual double density(int component, const UnitVector<double>& l,
                                       const UnitVector<double>& v) const noexcept;

  /// Whether the model is made of facets; what it hasn't is answered with NaN.
  [[nodiscard]] virtual bool has_facet_distribution() const noexcept { return false; }
  [[nodiscard]] virtual bool has_facet_masking() const noexcept { return false; }
  /// D(H) [1/sr] of half vectors above the surface.
  [[nodiscard]] virtual double facet_distribution(const DirectionPair<double>& pair) const noexcept;
  /// The part G₁(L,H) of facets facing L (L·H > 0) that L sees.
  [[nodiscard]] virtual double facet_masking(const DirectionPair<double>& pair) const noexcept;

 protected:
  Model() = default;
  Model(const Model&) = default;
  Model& operator=(const Model&) = default;
};

}  // namespace ALBEDO_INSTRUCTION_SET

/// f(L,V) [1/sr], the sum of a model's lobes, for directions in the number type T (double or float; Quad with
/// core/quad.hpp).
template <class T>
T brdf(const Model& model, const Direction& l, const Direction& v);

template <>
double brdf<double>(const Model&, const Direction&, const Direction&);
template <>
float brdf<float>(const Model&, const Direction&, const Direction&);

/// A model by name; parameters that are not given have their default.
/// @throws UnknownModel (with a suggestion for a misspelt name), ParameterError (unknown name, value outside its
/// range).
std::unique_ptr<Model> make_model(std::string_view name, const Parameters& parameters = {});

/// Every model's information, in the order of models/all.hpp, then of register_model; it stays where it is.
std::vector<std::reference_wrapper<const ModelInfo>> model_infos();

/// The information of one model. @throws UnknownModel
const ModelInfo& model_info(std::string_view name);

}  // namespace albedo
