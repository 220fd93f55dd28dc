/// @file
/// Models and what is done to them, as they are told.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "albedo/corrections.hpp"

namespace albedo::analysis {

/// As on the command line.
std::string name_of(PumpControl control);

/// {"model": "ward", "parameters": {...}}; without the channel where there are several.
nlohmann::ordered_json model_json(const Model& model, bool several_channels);

/// {"pump": 2, "control": "none", "only_up": false, "correct": "balance", "rho": 1}, as far as they do anything
nlohmann::ordered_json corrections_json(const Corrections& corrections);

/// alpha_x=0.1 masking=none, numbers with so many digits
std::string parameters_text(const Parameters& parameters, int digits = 17);

/// {"alpha_x": 0.1, "masking": "none"}
nlohmann::ordered_json parameters_json(const Parameters& parameters);

}  // namespace albedo::analysis
