/// @file
/// The least piecewise linear curve that stays within bounds.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "albedo/table_growth.hpp"

namespace albedo::analysis {

/// The places where a curve over cosθ may have its nodes: cosθ = (j/255)², so that 8 bits hold a place. Towards grazing
/// incidence they are close, which is where albedos change.
class CosineGrid {
 public:
  static constexpr int steps = 255;

  /// From the first place at or beyond `largest_theta` to the last one at or before `least_theta`, in degrees.
  CosineGrid(double least_theta, double largest_theta);

  [[nodiscard]] std::size_t size() const { return cosines_.size(); }
  [[nodiscard]] double cosine(std::size_t i) const { return cosines_[i]; }  ///< rising
  [[nodiscard]] const std::vector<double>& cosines() const { return cosines_; }

 private:
  std::vector<double> cosines_;
};

/// What a curve may be at each place of a grid: everything from low to high.
struct Tube {
  std::vector<double> low, high;

  /// Everything, at so many places.
  explicit Tube(std::size_t size = 0);

  /// Keeps what is in the other one too.
  void intersect(const Tube& other);
  [[nodiscard]] bool is_empty() const;  ///< somewhere there is no value left
  [[nodiscard]] bool holds(double constant) const;
  /// A constant within, in the middle of what there is; none if there is none.
  [[nodiscard]] std::optional<double> constant() const;
};

/// A piecewise linear curve over a grid of cosines; one node is a constant.
struct PlannedCurve {
  std::vector<std::size_t> places{};  ///< of the nodes, on the grid
  std::vector<double> cosines{};      ///< the same
  std::vector<double> values{};       ///< as they are held: multiples of the step, or floats
  Quantisation quantisation{};

  [[nodiscard]] double operator()(double cos_theta) const;  ///< constant beyond both ends
  /// Values of the given bits and, but for a constant, one byte for each place; 4 more for a scale that isn't 1.
  [[nodiscard]] std::size_t bytes() const;
};

/// Whether the curve is in the tube everywhere.
bool is_within(const PlannedCurve& curve, const Tube& tube, const CosineGrid& grid);

/// The curve with the fewest nodes that is in the tube, its values being held in so many bits: a shortest path over all
/// (place, value) of nodes, found breadth first, where an edge is a chord within the tube; beyond
/// both ends the curve is constant. For 8 and 10 bits every
/// value there is is tried, for 16 and 32 `levels` of them at each place. It has no fewer nodes than the tube asks for,
/// so that without one of them it leaves it.
/// @returns nothing if no such curve is within
std::optional<PlannedCurve> least_curve(const Tube& tube, const CosineGrid& grid, int bits);

/// The one of 8, 10, 16 and 32 bits that takes the fewest bytes; the fewer bits of two that take the same.
std::optional<PlannedCurve> smallest_curve(const Tube& tube, const CosineGrid& grid);

}  // namespace albedo::analysis
