/// @file
/// What the positional arguments of `albedo table` ask for.
#pragma once

#include <string>
#include <vector>

#include "albedo/table.hpp"
#include "analysis/commands/model_arguments.hpp"
#include "analysis/files/table_document.hpp"

namespace albedo::analysis {

/// A table of one model. A range or a list makes an axis of the document; a single value of cos_theta, theta or phi is
/// an axis of the computation only, unless there would be no other.
struct TableRequest {
  std::string model;
  Parameters fixed;
  std::vector<TableAxis> axes;
  std::vector<bool> is_in_document;     ///< for each axis
  std::vector<std::string> channels{};  ///< of ModelArguments

  [[nodiscard]] std::vector<Axis> document_axes() const;
  [[nodiscard]] std::vector<TableAxis> fixed_directions() const;
  /// The azimuth if it is fixed (0 if not given), NaN if it varies.
  [[nodiscard]] double phi() const;
  /// The value of every parameter that no axis varies.
  [[nodiscard]] Parameters fixed_parameters() const;
};

/// @throws UnknownModel, ParameterError
TableRequest parse_table_request(const ModelArguments& arguments);

/// The directions of a table of materials, which fix their models and parameters themselves.
struct MaterialRequest {
  TableAxis directions{"theta", {0, 15, 30, 45, 60, 75, 80, 85, 88, 89}};
  double phi = 0;
};

/// @throws ParameterError
MaterialRequest parse_material_request(const ModelArguments& arguments);

Axis document_axis(const TableAxis& axis);

}  // namespace albedo::analysis
