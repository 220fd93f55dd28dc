/// @file
/// Where numbers in a file come from. The same command gives the same text: no times, no names of machines.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/commands/options.hpp"
#include "analysis/output/table_document.hpp"

namespace albedo::analysis {

/// The command line, quoted for a shell; the program is "albedo" wherever it stood.
std::string command_line(int argc, const char* const* argv);

/// {"generator", "command"}: what every provenance begins with.
nlohmann::ordered_json begin_provenance(const std::string& command_line);

/// {"alpha": {"from", "to", "count"}, "channel": {"count"}}
nlohmann::ordered_json describe_axes(const std::vector<Axis>& axes);

}  // namespace albedo::analysis
