/// @file
/// The least table of two variables that stays within bounds.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/scenes/plan/tube.hpp"

namespace albedo::analysis {

/// A table over a second variable and cosθ, to be interpolated bilinearly. With one second place it is a curve.
struct PlannedSurface {
  std::vector<double> second{};   ///< rising places of the second variable; empty: there is none
  std::vector<double> cosines{};  ///< rising
  std::vector<double> values{};   ///< second × cosine, as they are held
  Quantisation quantisation{};

  explicit PlannedSurface() = default;
  explicit PlannedSurface(const PlannedCurve& curve);

  /// Constant beyond the ends.
  [[nodiscard]] double operator()(double second_place, double cos_theta) const;
  /// Values of the given bits, a byte for each place of a cosine, four for each of the second variable, and four for a
  /// scale that isn't 1.
  [[nodiscard]] std::size_t bytes() const;
  /// Without one place: what is left interpolates between its neighbours.
  [[nodiscard]] PlannedSurface without_cosine(std::size_t i) const;
  [[nodiscard]] PlannedSurface without_second(std::size_t i) const;
};

/// Exact values at reference places of the second variable, each with what a table may be there.
struct SurfaceReference {
  std::vector<double> second{};
  std::vector<std::vector<double>> values{};  ///< [second][cosine of the grid]
  std::vector<Tube> tubes{};
};

/// A table of exact values, from which no place can be taken: places of the second variable are taken away first, as
/// long as that costs no more than half of what is allowed, then cosines, then both again.
std::optional<PlannedSurface> least_surface(const SurfaceReference& reference, const CosineGrid& grid);

/// Whether a table is within all tubes.
bool is_within(const PlannedSurface& surface, const SurfaceReference& reference, const CosineGrid& grid);

}  // namespace albedo::analysis
