/// @file
/// The file of a study: CSV under its provenance, or one JSON object, as the ending of its path says.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

namespace albedo::analysis {

/// Whether a path is that of JSON: it ends with .json, in any case; with .csv it isn't, and neither is "-".
/// @throws ParameterError if it ends otherwise
bool is_json_path(const std::string& path);

/// Throws what writing to this path would throw now. @throws ParameterError, WriteError
void check_study_path(const std::string& path);

/// The lines "# key: value" above CSV.
void write_provenance(const nlohmann::ordered_json& provenance, std::ostream& out);

}  // namespace albedo::analysis
