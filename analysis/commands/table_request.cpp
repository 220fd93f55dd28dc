#include "analysis/commands/table_request.hpp"

#include <algorithm>
#include <limits>

#include "albedo/core/errors.hpp"

namespace albedo::analysis {
namespace {

bool is_direction(const std::string& name) { return name == "cos_theta" || name == "theta" || name == "phi"; }

bool varies(const Assignment& assignment) { return assignment.text.find_first_of(":,") != std::string::npos; }

bool is_text(const ModelInfo& model, const Assignment& assignment) {
  const ParameterInfo* parameter = model.find(assignment.name);
  return parameter != nullptr && parameter->is_text;
}

TableAxis parse_direction_axis(const Assignment& assignment) {
  TableAxis axis{assignment.name, parse_values(assignment.name, assignment.text)};
  for (const double value : axis.values) {
    if (axis.name == "theta") Direction::from_degrees(value);
    if (axis.name == "cos_theta") Direction::from_cosine(value);
  }
  return axis;
}

TableAxis parse_parameter_axis(const ModelInfo& model, const Assignment& assignment) {
  for (const std::string& name : model.resolve(assignment.name)) {
    if (model.find(name)->is_choice()) {
      throw ParameterError(model.name + ": " + assignment.name + " is a choice, and an axis holds numbers");
    }
  }
  TableAxis axis{assignment.name, parse_values(model.name + ": " + assignment.name, assignment.text)};
  const auto [least, most] = std::ranges::minmax(axis.values);
  for (const double value : {least, most})
    make_model(model.name, {{axis.name, value}});  // refuses the name or the value
  return axis;
}

/// Directions are refused when given twice, parameters when set twice.
void check_names(const ModelInfo& model, const std::vector<Assignment>& assignments) {
  std::vector<std::string> directions, parameters;
  for (const Assignment& assignment : assignments) {
    (is_direction(assignment.name) ? directions : parameters).push_back(assignment.name);
  }
  check_set_once(model, parameters);
  for (std::string& name : directions) {
    if (name == "theta") name = "cos_theta";
  }
  std::ranges::sort(directions);
  const auto twice = std::ranges::adjacent_find(directions);
  if (twice == directions.end()) return;
  throw ParameterError(*twice == "phi" ? "phi is given twice"
                                       : "the polar angle is given twice, as cos_theta or theta");
}

TableAxis texel_centres() {
  constexpr int count = 32;
  TableAxis axis{"cos_theta", {}};
  for (int i = 0; i < count; ++i) axis.values.push_back((i + 0.5) / count);
  return axis;
}

/// Refuses a table that no memory holds, before its size overflows.
void check_size(const std::vector<TableAxis>& axes) {
  constexpr double most = 1e11;
  double entries = 1;
  for (const TableAxis& axis : axes) entries *= static_cast<double>(axis.values.size());
  if (entries > most) throw ParameterError("the table would have more than 1e11 entries");
}

}  // namespace

std::vector<Axis> TableRequest::document_axes() const {
  std::vector<Axis> result;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (is_in_document[i]) result.push_back(document_axis(axes[i]));
  }
  return result;
}

std::vector<TableAxis> TableRequest::fixed_directions() const {
  std::vector<TableAxis> result;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!is_in_document[i]) result.push_back(axes[i]);
  }
  return result;
}

double TableRequest::phi() const {
  const auto axis = std::ranges::find(axes, "phi", &TableAxis::name);
  if (axis == axes.end()) return 0;
  return axis->values.size() == 1 ? axis->values.front() : std::numeric_limits<double>::quiet_NaN();
}

Parameters TableRequest::fixed_parameters() const {
  const ModelInfo& info = model_info(model);
  Parameters result = make_model(model, fixed)->parameters();
  std::erase_if(result, [&](const auto& parameter) {
    if (channels.size() > 1 && parameter.first == info.channel()->name) return true;
    return std::ranges::any_of(axes, [&](const TableAxis& axis) {
      const std::vector<std::string> varied = info.resolve(axis.name);
      return std::ranges::find(varied, parameter.first) != varied.end();
    });
  });
  return result;
}

TableRequest parse_table_request(const ModelArguments& arguments) {
  if (is_combination(arguments.model)) {
    throw ParameterError("a table varies the parameters of one model, and " + arguments.model + " has none");
  }
  const std::vector<Assignment> assignments = arguments.assignments();
  const ModelInfo& info = model_info(arguments.model);
  TableRequest request{
      .model = arguments.model, .fixed = {}, .axes = {}, .is_in_document = {}, .channels = arguments.channels()};
  check_names(info, assignments);
  bool has_polar_angle = false;
  for (const Assignment& assignment : assignments) {
    const std::string& name = assignment.name;
    check_size(request.axes);  // before the next axis takes memory
    if (is_direction(name)) {
      request.axes.push_back(parse_direction_axis(assignment));
      request.is_in_document.push_back(varies(assignment));
      has_polar_angle = has_polar_angle || name != "phi";
    } else if (varies(assignment) && !is_text(info, assignment)) {
      request.axes.push_back(parse_parameter_axis(info, assignment));
      request.is_in_document.push_back(true);
    } else {
      request.fixed.push_back(parameter_of(info, assignment));
    }
  }
  make_model(arguments.model, request.fixed);
  if (!has_polar_angle) {
    request.axes.push_back(texel_centres());
    request.is_in_document.push_back(true);
  }
  if (std::ranges::find(request.is_in_document, true) == request.is_in_document.end())
    request.is_in_document.back() = true;
  check_size(request.axes);
  return request;
}

MaterialRequest parse_material_request(const ModelArguments& arguments) {
  std::vector<std::string> texts = arguments.parameters;
  if (!arguments.model.empty()) texts.insert(texts.begin(), arguments.model);  // the first positional argument
  MaterialRequest request;
  std::vector<Assignment> assignments;
  for (const std::string& text : texts) {
    assignments.push_back(parse_assignment(text));
    if (!is_direction(assignments.back().name)) {
      throw ParameterError("'" + text + "': a table of --materials takes theta, cos_theta and phi only");
    }
  }
  check_names({}, assignments);
  for (const Assignment& assignment : assignments) {
    if (assignment.name == "phi") {
      request.phi = parse_number(assignment.name, assignment.text);
    } else {
      request.directions = parse_direction_axis(assignment);
    }
  }
  return request;
}

Axis document_axis(const TableAxis& axis) {
  const bool is_angle = axis.name == "theta" || axis.name == "phi";
  return {.name = axis.name, .unit = is_angle ? "degrees" : "", .values = axis.values};
}

}  // namespace albedo::analysis
