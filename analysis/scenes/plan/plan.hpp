/// @file
/// What energy tables a scene needs, and no more: doc/plan.md has the definitions.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/scenes/plan/requirement.hpp"
#include "analysis/scenes/plan/surface.hpp"
#include "analysis/scenes/scene.hpp"
#include "numerics/parallel.hpp"

namespace albedo::analysis {

struct PlanOptions {
  double tolerance = 1.0 / 255;  ///< of a picture's radiances, whose white is 1; within [1e-5, 0.5]
  double least_theta = 0;        ///< degrees
  double largest_theta = 85;     ///< degrees, at most 89.9
  int most_pumpings = 8;         ///< how far a pump order is looked for; 0: it isn't
  int threads = 0;
  ProgressCallback progress{};
};

/// The least that suffices.
enum class Need {
  nothing,   ///< without a correction nothing shows
  constant,  ///< one number for all angles
  curve,     ///< a curve over cosθ
  surface,   ///< a table over cosθ and a second variable
  unknown,   ///< no table suffices, or the albedo can't be had: the reason says which
};

std::string_view name_of(Need need);

/// An extreme and where it is.
struct AtAngle {
  double value = 0, theta = 0;
};

/// One reflectance: a material in one channel, or all that are the same.
struct PlanCase {
  std::size_t material = 0;  ///< the first one in the scene
  std::size_t channel = 0;
  bool claims_conservation = false, is_isotropic = true;
  AtAngle largest{};           ///< of a(L) over the angles asked for
  AtAngle least_white{1, 0};   ///< E of the white lobe; 1 − E is what is lost
  AtAngle most_white{1, 0};    ///< E − 1 is what is made, if that is positive
  PictureError uncorrected{};  ///< without a correction
  PictureError corrected{};    ///< with the planned one, at the places of the grid
  Need need = Need::nothing;
  bool needs_azimuth = false;          ///< anisotropic, and one curve doesn't serve all azimuths
  std::optional<int> pumpings{};       ///< the order of pumping that does as well, for a reciprocal, isotropic lobe
  std::optional<std::size_t> table{};  ///< which one
  std::string reason{};                ///< a sentence
};

/// A table and who uses it.
struct PlanTable {
  std::string name{};  ///< of its file, without ending
  Need form = Need::curve;
  std::string second{};  ///< name of the second variable: "phi", "alpha"; empty if there is none
  PlannedSurface table{};
  std::vector<std::size_t> cases{};
  std::vector<std::string> lobes{};  ///< name and parameters of each white lobe
  // for figures: the first case's E and what all cases allow, at the grid's cosines and the first second place
  std::vector<double> cosines{}, reference{}, low{}, high{};
  PictureError met{};          ///< largest error met by an independent rule between nodes
  std::size_t verified = 0;    ///< at so many places
  std::size_t unverified = 0;  ///< where that rule missed its tolerance
};

/// A plan of a whole scene.
struct Plan {
  PlanOptions options{};
  std::vector<std::string> channels{};
  std::vector<PlanCase> cases{};
  std::vector<std::vector<std::size_t>> of_material{};  ///< a case for each channel, in the order of the scene
  std::vector<PlanTable> tables{};
  std::vector<std::string> notes{};

  [[nodiscard]] std::size_t bytes() const;
  /// What 32×32×32 floats for each material would take.
  [[nodiscard]] std::size_t usual_bytes() const;
  [[nodiscard]] PictureError largest_error() const;  ///< met by verification
  [[nodiscard]] std::size_t unknown() const;         ///< cases
};

/// @throws ParameterError for options outside their ranges
void check_plan_options(const PlanOptions& options);

/// Plans and verifies. @throws FormatError for a material that isn't one; ParameterError for options out of range
Plan plan_scene(const Scene& scene, const PlanOptions& options = {});

}  // namespace albedo::analysis
