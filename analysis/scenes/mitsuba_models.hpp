/// @file
/// Mitsuba's BSDF plugins in the models of this library.
#pragma once

#include <optional>
#include <string>

#include "analysis/scenes/mitsuba_xml.hpp"

namespace albedo::analysis {

/// How a plugin that holds other BSDFs is taken.
enum class MitsubaHolder {
  none,     ///< it holds nothing
  neutral,  ///< what it holds reflects as it would alone: "twosided", "mask"
  altering  ///< what it holds is modelled, itself not: "coating", and any other with a BSDF inside
};
MitsubaHolder holder_kind(const std::string& type, const MitsubaElement& bsdf);

/// A plugin that is modelled, or why it is not; both are empty for one that this library has no model of.
struct MitsubaModel {
  std::optional<MaterialParts> parts{};
  std::string why{};
};

/// @param is_old of 0.6 and before, whose defaults differ from those of Mitsuba 3
/// @throws FormatError for malformed values
MitsubaModel model_of(const MitsubaElement& bsdf, const Place& place, bool is_old, MitsubaValues& values,
                      SceneBuilder& builder);

}  // namespace albedo::analysis
