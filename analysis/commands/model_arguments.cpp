#include "analysis/commands/model_arguments.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "albedo/combinators/coupled.hpp"
#include "albedo/combinators/sum.hpp"
#include "albedo/core/errors.hpp"
#include "analysis/commands/checks.hpp"
#include "analysis/commands/option_kinds.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

/// One model as it is written.
struct Written {
  std::string model;
  std::vector<Assignment> assignments{};
  double weight = 1;

  /// Its choice of a channel, if it has one that isn't given; nullptr otherwise.
  [[nodiscard]] const ParameterInfo* open_channel() const {
    const ParameterInfo* channel = model_info(model).channel();
    const auto is_channel = [&](const Assignment& a) { return channel != nullptr && a.name == channel->name; };
    return std::ranges::any_of(assignments, is_channel) ? nullptr : channel;
  }
};

/// "NAME is set twice" where two of the assignments set the same parameter.
std::unique_ptr<Model> make_written(const Written& written, const std::string& channel) {
  const auto& [model, assignments, weight] = written;
  const ModelInfo& info = model_info(model);
  Parameters values;
  std::vector<std::string> names;
  for (const Assignment& assignment : assignments) {
    values.push_back(parameter_of(info, assignment));
    names.push_back(assignment.name);
  }
  const ParameterInfo* open = written.open_channel();
  if (open != nullptr && !channel.empty()) values.emplace_back(open->name, channel);
  std::unique_ptr<Model> made = make_model(model, values);
  check_set_once(info, names);
  return made;
}

/// MODEL[:NAME=VALUE[,NAME=VALUE]...], one of the names may be `weight`.
Written part_of(const std::string& combination, const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string model = text.substr(0, colon);
  if (model.empty() || model.find('=') != std::string::npos) {
    throw ParameterError(combination + ": '" + text + "' is not of the form MODEL or MODEL:NAME=VALUE,NAME=VALUE");
  }
  if (is_combination(model)) {
    throw ParameterError(combination + ": '" + text + "' is not a model of its own and can't be a part");
  }
  Written part{.model = model};
  bool weighted = false;
  for (std::size_t begin = colon; begin != std::string::npos;) {
    const std::size_t end = text.find(',', begin + 1);
    const Assignment assignment = parse_assignment(std::string_view(text).substr(begin + 1, end - begin - 1));
    begin = end;
    if (assignment.name != "weight") {
      part.assignments.push_back(assignment);
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

/// What is behind the name of a combination.
struct Combination {
  std::vector<Written> parts;
  double r_m = 1;  ///< of `coupled`
};

Combination combination_of(const std::string& name, const std::vector<std::string>& texts) {
  Combination combination;
  bool has_r_m = false;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('='), colon = text.find(':');
    const bool is_parameter = equals != std::string::npos && equals < colon;
    if (name != coupled_name || !is_parameter) {
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
    throw ParameterError("coupled has " + std::to_string(combination.parts.size()) + " surfaces and must have one");
  }
  return combination;
}

/// The model or combination, not corrected.
std::unique_ptr<Model> make_plain(const ModelArguments& given, const std::string& channel) {
  if (!is_combination(given.model)) return make_written({given.model, given.assignments()}, channel);
  const Combination combination = combination_of(given.model, given.parameters);
  if (given.model == coupled_name) return coupled(make_written(combination.parts.front(), channel), combination.r_m);
  std::vector<SumModel::Part> parts;
  for (const Written& part : combination.parts) parts.push_back({part.weight, make_written(part, channel)});
  return std::make_unique<SumModel>(std::move(parts));
}

}  // namespace

std::vector<Assignment> ModelArguments::assignments() const {
  if (model.empty()) throw ParameterError("no MODEL is given; 'albedo models' lists them");
  std::vector<Assignment> result;
  for (const std::string& parameter : parameters) result.push_back(parse_assignment(parameter));
  return result;
}

bool is_combination(const std::string& name) { return name == sum_name || name == coupled_name; }

std::vector<std::string> ModelArguments::channels() const {
  std::vector<Written> written;
  if (is_combination(model)) {
    written = combination_of(model, parameters).parts;
  } else {
    // Not within the braces: GCC 12 destroys the string twice if this throws there.
    std::vector<Assignment> own = assignments();
    written.push_back({model, std::move(own)});
  }
  for (const Written& one : written) {
    if (const ParameterInfo* channel = one.open_channel()) return channel->choices;
  }
  return {""};
}

std::unique_ptr<Model> ModelArguments::make(const std::string& channel) const {
  return corrections.applied_to(make_plain(*this, channel));
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

std::string name_of(PumpControl control) { return std::string(to_string(control)); }

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

void check_set_once(const ModelInfo& model, const std::vector<std::string>& names) {
  std::map<std::string, std::string> setters;
  for (const std::string& name : names) {
    for (const std::string& parameter : model.resolve(name)) {
      const auto [other, is_new] = setters.emplace(parameter, name);
      if (is_new) continue;
      throw ParameterError(model.name + ": " + parameter + " is set twice, by " + other->second + " and by " + name);
    }
  }
}

nlohmann::ordered_json model_json(const Model& model, bool several_channels) {
  Parameters parameters = model.parameters();
  if (several_channels) {
    std::erase_if(parameters, [&](const auto& parameter) {
      const ParameterInfo* info = model.info().find(parameter.first);
      return info != nullptr && info->is_choice() && info->per_channel;
    });
  }
  return {{"model", model.info().name}, {"parameters", parameters_json(parameters)}};
}

nlohmann::ordered_json corrections_json(const Corrections& corrections) {
  auto object = nlohmann::ordered_json::object();
  if (corrections.pump.times > 0) {
    object = {{"pump", corrections.pump.times},
              {"control", name_of(corrections.pump.control)},
              {"only_up", corrections.pump.only_up}};
  }
  if (corrections.correct != Correction::none) {
    object["correct"] = name_of(corrections.correct);
    object["rho"] = corrections.rho;
  }
  return object;
}

std::string parameters_text(const Parameters& parameters, int digits) {
  std::string text;
  for (const auto& [name, value] : parameters) {
    text.append(text.empty() ? "" : " ").append(name).append("=");
    text += std::holds_alternative<double>(value) ? number_text(std::get<double>(value), digits)
                                                  : std::get<std::string>(value);
  }
  return text;
}

nlohmann::ordered_json parameters_json(const Parameters& parameters) {
  auto object = nlohmann::ordered_json::object();
  for (const auto& [name, value] : parameters) {
    std::visit([&, &key = name](const auto& item) { object[key] = item; }, value);
  }
  return object;
}

}  // namespace albedo::analysis
