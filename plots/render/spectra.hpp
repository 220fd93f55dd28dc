/// @file
#pragma once

#include <string_view>

namespace albedo::render {

/// The files analysis/data/spectra/metals.csv and cie1931.csv.
extern const std::string_view metals_csv;
extern const std::string_view cie1931_csv;

}  // namespace albedo::render
