/// @file
#pragma once

#include <string>
#include <vector>

#include "analysis/files/table_document.hpp"

namespace albedo::analysis {

/// Writes a table of one to three axes as an OpenEXR image of 32-bit floats, with the description that the JSON format
/// has (provenance, axes, shape) in its string attribute "albedo".
///
/// | axes | image |
/// |---|---|
/// | x | one row, channel Y |
/// | y, x | channel Y |
/// | first or last of three is {R, G, B} | channels R, G, B over the other two |
/// | layer, y, x | a channel "layer=PLACE.Y" for each place on the first axis |
///
/// @throws WriteError also for a finite entry beyond the range of float: it is not turned into infinity
void write_exr(const TableDocument& table, const std::string& path);

/// @throws ParameterError if such an image can't hold these axes
void check_exr_axes(const std::vector<TableAxis>& axes);

}  // namespace albedo::analysis
