#include "analysis/commands/model_arguments.hpp"

#include <map>
#include <utility>

#include "albedo/combinators/sum.hpp"
#include "albedo/core/errors.hpp"

namespace albedo::analysis {
namespace {

/// A model from NAME=VALUE assignments; "NAME is set twice" where two of them set the same parameter.
std::unique_ptr<Model> make_assigned(const std::string& model, const std::vector<Assignment>& assignments) {
  const ModelInfo& info = model_info(model);
  Parameters values;
  std::vector<std::string> names;
  for (const Assignment& assignment : assignments) {
    values.push_back(parameter_of(info, assignment));
    names.push_back(assignment.name);
  }
  std::unique_ptr<Model> made = make_model(model, values);
  check_set_once(info, names);
  return made;
}

/// MODEL[:NAME=VALUE[,NAME=VALUE]...], one of the names may be `weight`.
SumModel::Part part_of(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string model = text.substr(0, colon);
  if (model.empty() || model.find('=') != std::string::npos) {
    throw ParameterError("sum: '" + text + "' is not of the form MODEL or MODEL:NAME=VALUE,NAME=VALUE");
  }
  if (model == sum_name) throw ParameterError("sum: '" + text + "' is a sum; write its parts instead");
  SumModel::Part part;
  std::vector<Assignment> assignments;
  bool weighted = false;
  for (std::size_t begin = colon; begin != std::string::npos;) {
    const std::size_t end = text.find(',', begin + 1);
    const Assignment assignment = parse_assignment(std::string_view(text).substr(begin + 1, end - begin - 1));
    begin = end;
    if (assignment.name != "weight") {
      assignments.push_back(assignment);
      continue;
    }
    if (weighted) throw ParameterError("sum: '" + text + "' has its weight set twice");
    weighted = true;
    part.weight = parse_number(model + ": weight", assignment.text);
  }
  part.model = make_assigned(model, assignments);
  return part;
}

}  // namespace

std::vector<Assignment> ModelArguments::assignments() const {
  if (model.empty()) throw ParameterError("no MODEL is given; 'albedo models' lists them");
  std::vector<Assignment> result;
  for (const std::string& parameter : parameters) result.push_back(parse_assignment(parameter));
  return result;
}

std::unique_ptr<Model> ModelArguments::make() const {
  if (model != sum_name) return make_assigned(model, assignments());
  if (parameters.empty()) throw ParameterError("sum has no parts; give some, such as lambert:rho=0.2");
  std::vector<SumModel::Part> parts;
  for (const std::string& part : parameters) parts.push_back(part_of(part));
  return std::make_unique<SumModel>(std::move(parts));
}

void add_model_arguments(CLI::App& command, ModelArguments& arguments) {
  command.add_option("MODEL", arguments.model, "the reflectance model's name, or sum")->type_name("");
  command
      .add_option("PARAMETERS", arguments.parameters,
                  "its parameters, each as NAME=VALUE; of a sum its parts, each as MODEL:NAME=VALUE,...")
      ->type_name("");
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
