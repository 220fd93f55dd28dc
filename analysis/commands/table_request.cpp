#include "analysis/commands/table_request.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "albedo/core/errors.hpp"
#include "albedo/registry.hpp"
#include "analysis/files/tiled_table.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

bool is_direction(const std::string& name) { return name == "cos_theta" || name == "theta" || name == "phi"; }

bool varies(const Assignment& assignment) { return assignment.text.find_first_of(":,") != std::string::npos; }

TableAxis parse_direction_axis(const Assignment& assignment) {
  TableAxis axis{.name = assignment.name, .values = parse_values(assignment.name, assignment.text)};
  if (axis.name != "cos_theta") axis.unit = "degrees";
  for (const double value : axis.values) {
    if (axis.name == "theta") Direction::from_degrees(value);
    if (axis.name == "cos_theta") Direction::from_cosine(value);
  }
  return axis;
}

/// A,B,... of a choice.
TableAxis parse_name_axis(const Composition& model, const Assignment& assignment) {
  const Composition::Target target = model.target(assignment.name);
  const ModelInfo& part = model_info(model.parts[target.part].model);
  TableAxis axis{.name = assignment.name};
  for (std::size_t begin = 0; begin != std::string::npos;) {
    const std::size_t end = assignment.text.find(',', begin);
    const std::string& label = axis.labels.emplace_back(assignment.text.substr(begin, end - begin));
    detail::checked_value(part, *model.info(target), label);
    if (std::ranges::count(axis.labels, label) > 1) {
      throw ParameterError(fmt::format("{}: {} has '{}' twice on its axis", model.name, axis.name, label));
    }
    begin = end == std::string::npos ? end : end + 1;
  }
  return axis;
}

TableAxis parse_parameter_axis(const Composition& model, const Assignment& assignment) {
  const Composition::Target target = model.target(assignment.name);
  const ParameterInfo* const info = model.info(target);
  if (info != nullptr && info->is_choice()) return parse_name_axis(model, assignment);
  TableAxis axis{.name = assignment.name,
                 .values = parse_values(fmt::format("{}: {}", model.name, assignment.name), assignment.text)};
  const auto [least, most] = std::ranges::minmax(axis.values);
  for (const double value : {least, most}) model.check(target, value);  // refuses the name or the value
  return axis;
}

/// One value of a parameter.
void fix(Composition& model, const Assignment& assignment) {
  const Composition::Target target = model.target(assignment.name);
  if (target.kind == Composition::Target::Kind::parameter) {
    const ModelInfo& info = model_info(model.parts[target.part].model);
    model.set(target, parameter_of(info, {target.parameter, assignment.text}).second);
  } else {
    model.set(target, parse_number(fmt::format("{}: {}", model.name, assignment.name), assignment.text));
  }
}

/// Directions are refused when given twice.
void check_directions(const std::vector<Assignment>& assignments) {
  std::vector<std::string> names;
  for (const Assignment& assignment : assignments) {
    if (is_direction(assignment.name)) names.push_back(assignment.name == "theta" ? "cos_theta" : assignment.name);
  }
  std::ranges::sort(names);
  const auto twice = std::ranges::adjacent_find(names);
  if (twice == names.end()) return;
  throw ParameterError(*twice == "phi" ? "phi is given twice"
                                       : "the polar angle is given twice, as cos_theta or theta");
}

/// Parameters are refused when set twice, wherever they are given.
void check_parameters(const Composition& model, const std::vector<Assignment>& assignments) {
  std::vector<std::vector<std::string>> names(model.parts.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (const auto& [name, value] : model.parts[i].parameters) names[i].push_back(name);
  }
  std::vector<std::string> others;  // r_m and weights
  for (const Assignment& assignment : assignments) {
    if (is_direction(assignment.name)) continue;
    const Composition::Target target = model.target(assignment.name);
    if (target.kind == Composition::Target::Kind::parameter) {
      names[target.part].push_back(target.parameter);
    } else if (std::ranges::find(others, assignment.name) != others.end()) {
      throw ParameterError(fmt::format("{}: {} is set twice", model.name, assignment.name));
    } else {
      others.push_back(assignment.name);
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) check_set_once(model_info(model.parts[i].model), names[i]);
}

TableAxis texel_centres() {
  constexpr int count = 32;
  TableAxis axis{.name = "cos_theta"};
  for (int i = 0; i < count; ++i) axis.values.push_back((i + 0.5) / count);
  return axis;
}

/// Refuses a table that no memory holds, before its size overflows.
void check_size(const std::vector<TableAxis>& axes) {
  constexpr double most = 1e11;
  double entries = 1;
  for (const TableAxis& axis : axes) entries *= static_cast<double>(axis.size());
  if (entries > most) throw ParameterError("the table would have more than 1e11 entries");
}

}  // namespace

std::vector<TableAxis> TableRequest::document_axes() const {
  std::vector<TableAxis> result;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (is_in_document[i]) result.push_back(axes[i]);
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
  return axis->size() == 1 ? axis->values.front() : std::numeric_limits<double>::quiet_NaN();
}

Parameters TableRequest::fixed_parameters() const {
  const std::unique_ptr<Model> made = model.make();
  std::vector<std::string> varied;
  for (std::size_t i = is_by_channel() ? 1 : 0; i < axes.size(); ++i) {
    if (is_direction(axes[i].name)) continue;
    for (std::string& name : model.set_by(model.target(axes[i].name))) varied.push_back(std::move(name));
  }
  Parameters result = made->parameters();
  std::erase_if(result, [&](const auto& parameter) {
    const ParameterInfo& info = *made->info().find(parameter.first);
    if (is_by_channel() && info.is_choice() && info.per_channel) return true;
    return std::ranges::find(varied, parameter.first) != varied.end();
  });
  return result;
}

std::function<std::unique_ptr<Model>(const std::vector<double>&)> TableRequest::plain_models() const {
  struct Varied {
    std::optional<Composition::Target> target;  // none: the channel
    std::vector<std::string> labels;
  };
  std::vector<Varied> varied;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (is_direction(axes[i].name)) continue;
    Varied& one = varied.emplace_back(Varied{.target = {}, .labels = axes[i].labels});
    if (i > 0 || !is_by_channel()) one.target = model.target(axes[i].name);
  }
  return [plain = model, varied = std::move(varied)](const std::vector<double>& place) {
    Composition at_place = plain;
    for (std::size_t i = 0; i < varied.size(); ++i) {
      const auto& [target, labels] = varied[i];
      albedo::ParameterValue value = place[i];
      if (!labels.empty()) value = labels[static_cast<std::size_t>(place[i])];
      if (target) {
        at_place.set(*target, value);
      } else {
        at_place.set_channel(std::get<std::string>(value));
      }
    }
    return at_place.make();
  };
}

TableModels TableRequest::models(const Corrections& corrections) const {
  TableModels result = [make = plain_models(), corrections](const std::vector<double>& place) {
    return corrections.applied_to(make(place));
  };
  return corrections.any() || model.is_dear() ? kept(std::move(result)) : result;
}

nlohmann::ordered_json TableRequest::checksums_of_files() const {
  auto result = nlohmann::ordered_json::object();
  for (const ModelPart& part : model.parts) {
    result.update(analysis::checksums_of_files(model_info(part.model), part.parameters));
  }
  return result;
}

TableRequest parse_table_request(const ModelArguments& arguments) {
  auto [model, assignments] = arguments.varied_composition();
  check_directions(assignments);
  check_parameters(model, assignments);
  TableRequest request{.model = model, .axes = {}, .is_in_document = {}};
  Composition given = model;  // with what varies: a channel that does isn't open
  bool has_polar_angle = false;
  for (const Assignment& assignment : assignments) {
    const std::string& name = assignment.name;
    check_size(request.axes);  // before the next axis takes memory
    if (is_direction(name)) {
      request.axes.push_back(parse_direction_axis(assignment));
      request.is_in_document.push_back(varies(assignment));
      has_polar_angle = has_polar_angle || name != "phi";
      continue;
    }
    const Composition::Target target = model.target(name);
    const ParameterInfo* const info = model.info(target);
    if (varies(assignment) && (info == nullptr || !info->is_text)) {
      request.axes.push_back(parse_parameter_axis(model, assignment));
      request.is_in_document.push_back(true);
      if (info != nullptr) given.set(target, {});
    } else {
      fix(request.model, assignment);
      fix(given, assignment);
    }
  }
  request.channels = given.channels();
  static_cast<void>(request.model.make());
  if (!has_polar_angle) {
    request.axes.push_back(texel_centres());
    request.is_in_document.push_back(true);
  }
  if (std::ranges::find(request.is_in_document, true) == request.is_in_document.end())
    request.is_in_document.back() = true;
  if (request.is_by_channel()) {
    request.axes.insert(request.axes.begin(), TableAxis{.name = "channel", .labels = request.channels});
    request.is_in_document.insert(request.is_in_document.begin(), true);
  }
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
  check_directions(assignments);
  for (const Assignment& assignment : assignments) {
    if (assignment.name == "phi") {
      request.phi = parse_number(assignment.name, assignment.text);
    } else {
      request.directions = parse_direction_axis(assignment);
    }
  }
  return request;
}

}  // namespace albedo::analysis
