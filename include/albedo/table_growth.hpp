/// @file
/// Tables that grow until linear interpolation between their entries is good enough.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "albedo/table.hpp"

namespace albedo {

/// The entries over these axes, C order.
using TableEntries = std::function<std::vector<double>(const std::vector<TableAxis>& axes)>;

struct TableGrowth {
  double max_error = 1e-3;             ///< of interpolated entries, absolute
  int bits = 0;                        ///< of entries: 8, 10 or 16, or 32 for floats; 0: they stay what they are
  std::size_t most_entries = 1 << 20;  ///< for each combination of names
};

/// How a value v within [0, scale] is held: as a whole number of scale/(2^bits − 1), or as a float.
struct Quantisation {
  int bits = 32;     ///< 8, 10, 16: unsigned whole numbers; 32: float
  double scale = 1;  ///< of whole numbers

  [[nodiscard]] double step() const;  ///< of whole numbers
  [[nodiscard]] double rounded(double value) const;
};

/// A table that is held in so many bits: whole numbers of scale/(2^bits − 1), where the scale is 1 or the largest
/// finite entry, or floats. Infinite entries stay infinite.
struct QuantisedEntries {
  std::vector<double> values{};
  double scale = 1;
  double error = 0;  ///< largest change of a finite entry
};
QuantisedEntries quantised(std::vector<double> values, int bits);

/// The largest error of multilinear interpolation in the middles of cells and at places spread over all of them, 256 in
/// all. Cells with an infinite corner are left out.
double interpolation_error(const std::vector<TableAxis>& axes, const std::vector<double>& values,
                           const TableEntries& entries);

struct GrownTable {
  std::vector<TableAxis> axes{};
  double error = 0;         ///< the largest met, with the values as they are held
  bool is_reached = false;  ///< that is max_error or less
};

/// Halves the gaps of every axis in which interpolation along it misses what it may, until the error at verified places
/// is within max_error too. Axes of names or of one value stay; others have to rise or fall.
/// @throws ParameterError for an axis that does neither, and unless max_error is positive
GrownTable grown(std::vector<TableAxis> axes, const TableEntries& entries, const TableGrowth& growth);

}  // namespace albedo
