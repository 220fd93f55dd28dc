#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace albedo {

/// The candidate that `word` may be a misspelling of, or an empty string: the nearest one, if at most a third of its
/// letters (at least one) are missing, extra, wrong or swapped with their neighbour. Case is not looked at.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace albedo
