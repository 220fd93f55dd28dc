/// @file
/// MODEL [PARAM=VALUE]... on the command line, or a combination of parts MODEL[:PARAM=VALUE[,PARAM=VALUE]...]: sum
/// PART..., coupled PART [r_m=VALUE]. Any of them may be corrected: --pump K --control none|step|total --only-up, then
/// --correct balance|multiscatter|turquin --rho VALUE.
#pragma once

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "albedo/core/model.hpp"
#include "albedo/corrections.hpp"
#include "analysis/commands/syntax.hpp"
#include "analysis/subjects/composition.hpp"
#include "analysis/subjects/model_text.hpp"
#include "analysis/text/assertion.hpp"
#include "analysis/text/value.hpp"

namespace albedo::analysis {

/// The positional arguments, as written.
struct ModelArguments {
  std::string model;
  std::vector<std::string> parameters;  ///< NAME=VALUE, or the parts of a sum; `weight` scales a part
  Corrections corrections{};            ///< what make() does to the model

  /// @throws ParameterError if there is no model, or an argument is not NAME=VALUE
  [[nodiscard]] std::vector<Assignment> assignments() const;
  /// @throws UnknownModel, ParameterError
  [[nodiscard]] Composition composition() const;
  /// What may vary apart: the parameters of a model, and what is given beside the parts of a combination.
  /// @throws UnknownModel, ParameterError
  [[nodiscard]] std::pair<Composition, std::vector<Assignment>> varied_composition() const;
  /// The colour channels to answer for: one that has no name, or all of a measured model whose channel isn't given.
  /// @throws UnknownModel, ParameterError
  [[nodiscard]] std::vector<std::string> channels() const;
  /// @param channel of the models whose channel isn't given
  /// @throws UnknownModel, ParameterError, FormatError
  [[nodiscard]] std::unique_ptr<Model> make(const std::string& channel = "") const;
};

/// MODEL [PARAM=VALUE]... several times: a word without '=' begins a model. @throws ParameterError
std::vector<ModelArguments> split_models(const std::vector<std::string>& words);

/// @throws ParameterError for an --assert of at(...) where there are several channels
void check_one_channel(const std::vector<Assertion>& assertions, const std::vector<std::string>& channels);

/// Adds MODEL and PARAMETERS and, unless the command has corrections of its own, those that make() applies.
void add_model_arguments(const Syntax& command, ModelArguments& arguments, bool can_correct = true);

inline constexpr std::array all_controls{PumpControl::none, PumpControl::step, PumpControl::total};

/// Adds --pump, --control, --only-up, --correct and --rho, which ask for what `needed` is, if anything.
void add_corrections(const Syntax& command, Corrections& corrections, std::optional<OptionSyntax> needed);

/// Adds --control and --only-up, which say how a model is pumped.
std::vector<OptionSyntax> add_pump_kind(const Syntax& command, PumpOptions& options);

/// The value of a model's parameter: a number taken strictly, or the name of a choice. Whether the model has such a
/// parameter, and its range, is make_model's to say.
std::pair<std::string, albedo::ParameterValue> parameter_of(const ModelInfo& model, const Assignment& assignment);

}  // namespace albedo::analysis
