/// @file
/// Where numbers in a file come from. The same command gives the same text: no times, no names of machines.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/files/table_document.hpp"

namespace albedo::analysis {

/// The program's name, wherever it stands: "albedo", or that of one with models of its own.
std::string program_name(int argc, const char* const* argv);

/// The command line, quoted for a shell, with the program's name alone.
std::string quoted_command_line(int argc, const char* const* argv);

/// {"generator", "command"}: what every provenance begins with.
nlohmann::ordered_json begin_provenance(const std::string& command_line);

/// {"alpha": {"from", "to", "count"}, "channel": {"count"}}
nlohmann::ordered_json describe_axes(const std::vector<TableAxis>& axes);

}  // namespace albedo::analysis
