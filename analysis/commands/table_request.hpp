/// @file
/// What the positional arguments of `albedo table` ask for.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "albedo/table_source.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/subjects/composition.hpp"

namespace albedo::analysis {

/// A table of one model or combination. A range or a list makes an axis of the document, of numbers or of a choice's
/// names; a single value of cos_theta, theta or phi is an axis of the computation only, unless there would be no other.
/// Where a model's channel isn't given, the first axis is that of all channels.
struct TableRequest {
  Composition model;  ///< without what the axes vary
  std::vector<TableAxis> axes;
  std::vector<bool> is_in_document;  ///< for each axis
  std::vector<std::string> channels{""};

  [[nodiscard]] bool is_by_channel() const { return channels.size() > 1; }
  [[nodiscard]] std::vector<TableAxis> document_axes() const;
  [[nodiscard]] std::vector<TableAxis> fixed_directions() const;
  /// The azimuth if it is fixed (0 if not given), NaN if it varies.
  [[nodiscard]] double phi() const;
  /// The value of every parameter that no axis varies.
  [[nodiscard]] Parameters fixed_parameters() const;
  /// Makes the model of a place on the axes that are no directions.
  [[nodiscard]] std::function<std::unique_ptr<Model>(const std::vector<double>& place)> plain_models() const;
  /// The same, each corrected.
  [[nodiscard]] TableModels models(const Corrections& corrections) const;
  /// The checksums of files that the model's parameters name: {"file": 123}; other files are other tables.
  [[nodiscard]] nlohmann::ordered_json checksums_of_files() const;
};

/// @throws UnknownModel, ParameterError
TableRequest parse_table_request(const ModelArguments& arguments);

/// The directions of a table of materials, which fix their models and parameters themselves.
struct MaterialRequest {
  TableAxis directions{.name = "theta", .values = {0, 15, 30, 45, 60, 75, 80, 85, 88, 89}, .unit = "degrees"};
  double phi = 0;
};

/// @throws ParameterError
MaterialRequest parse_material_request(const ModelArguments& arguments);

}  // namespace albedo::analysis
