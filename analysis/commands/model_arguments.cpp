#include "analysis/commands/model_arguments.hpp"

#include <map>
#include <utility>

#include "albedo/core/errors.hpp"

namespace albedo::analysis {

std::vector<Assignment> ModelArguments::assignments() const {
  if (model.empty()) throw ParameterError("no MODEL is given; 'albedo models' lists them");
  std::vector<Assignment> result;
  for (const std::string& parameter : parameters) result.push_back(parse_assignment(parameter));
  return result;
}

std::unique_ptr<Model> ModelArguments::make() const {
  const std::vector<Assignment> given = assignments();
  const ModelInfo& info = model_info(model);
  Parameters values;
  std::vector<std::string> names;
  for (const Assignment& assignment : given) {
    values.push_back(parameter_of(info, assignment));
    names.push_back(assignment.name);
  }
  std::unique_ptr<Model> made = make_model(model, values);
  check_set_once(info, names);
  return made;
}

void add_model_arguments(CLI::App& command, ModelArguments& arguments) {
  command.add_option("MODEL", arguments.model, "the reflectance model's name")->type_name("");
  command.add_option("PARAMETERS", arguments.parameters, "its parameters, each as NAME=VALUE")->type_name("");
}

std::pair<std::string, albedo::ParameterValue> parameter_of(const ModelInfo& model, const Assignment& assignment) {
  for (const std::string& name : model.resolve(assignment.name)) {
    if (model.find(name)->is_choice()) return {assignment.name, assignment.text};
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

nlohmann::ordered_json parameters_json(const Parameters& parameters) {
  auto object = nlohmann::ordered_json::object();
  for (const auto& [name, value] : parameters) {
    std::visit([&, &key = name](const auto& item) { object[key] = item; }, value);
  }
  return object;
}

}  // namespace albedo::analysis
