/// @file
/// The speed/accuracy study as rows: one line a run.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>

#include "analysis/studies/tradeoff.hpp"

namespace albedo::analysis {

/// Rule, warp, tolerances, budget and how times were taken: what a file of the study begins with, after its generator.
nlohmann::ordered_json describe(const TradeoffRequest& request);

/// CSV: the provenance in lines "# key: value", the names of the columns, and one line a run. Errors are relative to
/// the reference, which has 25 digits.
void write_csv(const nlohmann::ordered_json& provenance, const Tradeoff& study, std::ostream& out);

/// The provenance with "cells", each with its reference (a string of 25 digits) and its runs.
nlohmann::ordered_json with_cells(nlohmann::ordered_json provenance, const Tradeoff& study);

}  // namespace albedo::analysis
