/// @file
/// Whether a plan's tables are as exact as they are said to be, by a rule that had no part in them.
#pragma once

#include "analysis/scenes/plan/plan.hpp"
#include "analysis/scenes/plan/variants.hpp"

namespace albedo::analysis {

/// What a picture shows wrongly at one direction.
struct CheckedError {
  PictureError error{};
  bool is_good = true;  ///< the rule met its tolerance
};

/// The error of a material that is corrected as its case plans it, with cubature for E and a_F.
/// @param table  of its case, or another one to try; null for none
/// @param second the place of the second variable, within the material's variation
CheckedError checked_error(const MaterialVariants& variants, const PlannedSurface* table, int colour_end, double second,
                           double cos_theta, double tolerance);

/// Checks every table in the middle of each of its gaps with its first case, and each of its cases at places spread
/// over them; fills in what was met.
void verify(const Scene& scene, Plan& plan);

}  // namespace albedo::analysis
