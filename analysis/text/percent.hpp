#pragma once

#include <string>

#include "core/text.hpp"

namespace albedo::analysis {

/// "73.4 %" of a share of 1.
inline std::string percent(double share) { return fmt::format("{:.1f} %", share * 100); }

}  // namespace albedo::analysis
