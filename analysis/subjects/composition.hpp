/// @file
/// A model that isn't made yet: its parameters may still be set. By its name, or as a combination of parts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "albedo/core/model.hpp"

namespace albedo::analysis {

/// The names that make a model of the parts behind them.
inline constexpr const char* sum_name = "sum";
inline constexpr const char* coupled_name = "coupled";

/// Whether a name is one of these.
[[nodiscard]] bool is_combination(const std::string& name);

/// @throws ParameterError if two of the names set the same parameter, such as alpha and alpha_x
void check_set_once(const ModelInfo& model, const std::vector<std::string>& names);

/// One model of a composition.
struct ModelPart {
  std::string model;
  Parameters parameters{};
  double weight = 1;  ///< in a sum

  /// Its choice of a channel, if it has one that isn't given; nullptr otherwise. @throws UnknownModel
  [[nodiscard]] const ParameterInfo* open_channel() const;
};

/// Names of parameters: alpha of a model; 1.alpha and 1.weight of the first part of a sum; r_m and surface.alpha of
/// coupled.
struct Composition {
  std::string name{};              ///< of the model or the combination
  std::vector<ModelPart> parts{};  ///< one, unless it is a sum
  double r_m = 1;                  ///< of coupled

  /// What a name sets.
  struct Target {
    enum class Kind { parameter, weight, r_m } kind = Kind::parameter;
    std::size_t part = 0;
    std::string parameter{};  ///< of the part
  };

  /// @throws ParameterError for a name that is none of a combination's; whether a model has the parameter is said by
  /// whoever makes it
  [[nodiscard]] Target target(const std::string& parameter) const;
  /// What a target is; nullptr for a parameter that there isn't, and what isn't a model's.
  [[nodiscard]] const ParameterInfo* info(const Target& target) const;
  /// The parameters of the model that make() makes which a target sets: {"alpha_x", "alpha_y"}, {"1.weight"}.
  [[nodiscard]] std::vector<std::string> set_by(const Target& target) const;

  void set(const Target& target, const ParameterValue& value);
  /// Sets the channel of all parts that leave it open.
  void set_channel(const std::string& channel);
  /// All channels of the first part that leaves it open, or one that has no name.
  [[nodiscard]] std::vector<std::string> channels() const;

  /// @throws UnknownModel, ParameterError, FormatError
  [[nodiscard]] std::unique_ptr<Model> make() const;
  /// The same, and refuses a parameter that is set twice.
  [[nodiscard]] std::unique_ptr<Model> make_checked() const;
  /// Throws what the model would throw for this value of this one parameter.
  void check(const Target& target, const ParameterValue& value) const;
  /// Whether a model takes long to make: a table of its own, or a file.
  [[nodiscard]] bool is_dear() const;
};

}  // namespace albedo::analysis
