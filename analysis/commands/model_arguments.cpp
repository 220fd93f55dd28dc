#include "analysis/commands/model_arguments.hpp"

#include <algorithm>
#include <utility>

#include "albedo/core/errors.hpp"
#include "analysis/commands/checks.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/text/text.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

/// A parameter whose '=' comes before any ':', and not a part.
bool is_assignment(const std::string& text) {
  const std::size_t equals = text.find('=');
  return equals != std::string::npos && equals < text.find(':');
}

/// MODEL[:NAME=VALUE[,NAME=VALUE]...], one of the names may be `weight`.
ModelPart part_of(const std::string& combination, const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string model = text.substr(0, colon);
  if (model.empty() || model.find('=') != std::string::npos) {
    throw ParameterError(combination + ": '" + text + "' is not of the form MODEL or MODEL:NAME=VALUE,NAME=VALUE");
  }
  if (is_combination(model)) {
    throw ParameterError(combination + ": '" + text + "' is not a model of its own and can't be a part");
  }
  ModelPart part{.model = model};
  bool weighted = false;
  for (std::size_t begin = colon; begin != std::string::npos;) {
    const std::size_t end = text.find(',', begin + 1);
    const Assignment assignment = parse_assignment(std::string_view(text).substr(begin + 1, end - begin - 1));
    begin = end;
    if (assignment.name != "weight") {
      part.parameters.push_back(parameter_of(model_info(model), assignment));
      continue;
    }
    if (combination != sum_name)
      throw ParameterError(combination + ": '" + text + "' has a weight; parts of a sum have one");
    if (weighted) throw ParameterError("sum: '" + text + "' has its weight set twice");
    weighted = true;
    part.weight = parse_number(model + ": weight", assignment.text);
  }
  return part;
}

Composition combination_of(const std::string& name, const std::vector<std::string>& texts) {
  Composition combination{.name = name};
  bool has_r_m = false;
  for (const std::string& text : texts) {
    if (name != coupled_name || !is_assignment(text)) {
      combination.parts.push_back(part_of(name, text));
      continue;
    }
    const Assignment assignment = parse_assignment(text);
    if (assignment.name != "r_m") {
      throw ParameterError("coupled has no parameter '" + assignment.name +
                           "'; it has r_m, and those of its surface are behind a colon");
    }
    if (has_r_m) throw ParameterError("coupled: r_m is set twice");
    has_r_m = true;
    combination.r_m = parse_number("coupled: r_m", assignment.text);
  }
  if (combination.parts.empty()) {
    throw ParameterError(name == sum_name ? "sum has no parts; give some, such as lambert:rho=0.2"
                                          : "coupled has no surface; give one, such as ggx:alpha=0.2,f0=0.04");
  }
  if (name == coupled_name && combination.parts.size() > 1) {
    throw ParameterError(fmt::format("coupled has {} surfaces and must have one", combination.parts.size()));
  }
  return combination;
}

}  // namespace

std::vector<Assignment> ModelArguments::assignments() const {
  if (model.empty()) throw ParameterError("no MODEL is given; 'albedo models' lists them");
  std::vector<Assignment> result;
  for (const std::string& parameter : parameters) result.push_back(parse_assignment(parameter));
  return result;
}

Composition ModelArguments::composition() const {
  if (is_combination(model)) return combination_of(model, parameters);
  ModelPart part{.model = model};
  for (const Assignment& assignment : assignments()) {
    part.parameters.push_back(parameter_of(model_info(model), assignment));
  }
  static_cast<void>(model_info(model));
  return {.name = model, .parts = {std::move(part)}};
}

std::pair<Composition, std::vector<Assignment>> ModelArguments::varied_composition() const {
  if (!is_combination(model)) {
    std::vector<Assignment> all = assignments();
    static_cast<void>(model_info(model));
    return {{.name = model, .parts = {{.model = model}}}, std::move(all)};
  }
  std::vector<std::string> parts;
  std::vector<Assignment> all;
  for (const std::string& text : parameters) {
    if (is_assignment(text)) {
      all.push_back(parse_assignment(text));
    } else {
      parts.push_back(text);
    }
  }
  return {combination_of(model, parts), std::move(all)};
}

std::vector<std::string> ModelArguments::channels() const { return composition().channels(); }

std::unique_ptr<Model> ModelArguments::make(const std::string& channel) const {
  Composition plain = composition();
  if (!channel.empty()) plain.set_channel(channel);
  return corrections.applied_to(plain.make_checked());
}

std::vector<ModelArguments> split_models(const std::vector<std::string>& words) {
  std::vector<ModelArguments> models;
  for (const std::string& word : words) {
    if (word.find('=') == std::string::npos) {
      models.push_back({word, {}});
    } else if (models.empty()) {
      throw ParameterError("'" + word + "' comes before any MODEL");
    } else {
      models.back().parameters.push_back(word);
    }
  }
  return models;
}

void check_one_channel(const std::vector<Assertion>& assertions, const std::vector<std::string>& channels) {
  if (channels.size() == 1) return;
  check_answerable(
      assertions, [](double, double) { return false; }, "there are several channels; channel=R is one of them");
}

std::vector<OptionSyntax> add_pump_kind(const Syntax& command, PumpOptions& options) {
  add_choice(
      command, "--control", all_controls, options.control,
      "what keeps the output radiance of a pumped model from exceeding its input (Neumann 1999, eq. 21): a floor "
      "of the divisor at every step, or of the product of all divisors");
  return {command.option("--control"),
          command.flag("--only-up", options.only_up, "an albedo above 1 stays as it is: g <= 1 (eq. 17)")};
}

void add_model_arguments(const Syntax& command, ModelArguments& arguments, bool can_correct) {
  const OptionSyntax model =
      command.text("MODEL", arguments.model, "the reflectance model's name, sum or coupled").type_name("");
  command
      .texts("PARAMETERS", arguments.parameters,
             "its parameters, each as NAME=VALUE; the parts of a sum, each as MODEL:NAME=VALUE,...")
      .type_name("");
  if (can_correct) add_corrections(command, arguments.corrections, model);
}

void add_corrections(const Syntax& command, Corrections& corrections, std::optional<OptionSyntax> needed) {
  std::vector<OptionSyntax> options = add_pump_kind(command, corrections.pump);
  const OptionSyntax pump = add_integer(command, "--pump", corrections.pump.times, 0, PumpOptions::most_times,
                                        "the model with its albedo pumped up so many times (Neumann 1999)");
  for (const OptionSyntax option : options) option.needs(pump);
  add_choice(command, "--correct", all_corrections, corrections.correct,
             "what is done to its energy then: balanced to rho everywhere; Kulla and Conty's complement added, or "
             "scaled after Turquin, which bring back rho of the light that is lost");
  const OptionSyntax correct = command.option("--correct");
  const OptionSyntax rho = add_real(command, "--rho", corrections.rho, 0, 1, "of --correct");
  rho.needs(correct);
  if (!needed) return;
  for (const OptionSyntax option : {pump, correct}) option.needs(*needed);
}

std::pair<std::string, albedo::ParameterValue> parameter_of(const ModelInfo& model, const Assignment& assignment) {
  for (const std::string& name : model.resolve(assignment.name)) {
    if (model.find(name)->is_choice() || model.find(name)->is_text) return {assignment.name, assignment.text};
    return {assignment.name, parse_number(model.name + ": " + assignment.name, assignment.text)};
  }
  return {assignment.name, 0.0};  // make_model refuses the name
}

}  // namespace albedo::analysis
