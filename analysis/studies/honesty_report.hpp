/// @file
/// What `albedo stability --honesty` prints.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>

#include "analysis/studies/honesty.hpp"

namespace albedo::analysis {

/// Tables of the rules' honesty and coverage, and the worst cases as commands.
void print_honesty(const Honesty& honesty, std::ostream& out);

/// The same as one object.
nlohmann::ordered_json honesty_json(const Honesty& honesty);

}  // namespace albedo::analysis
