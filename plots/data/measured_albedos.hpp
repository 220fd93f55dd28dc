/// @file
/// Albedos of the measured materials in a directory.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "albedo/directional_albedo.hpp"

namespace albedo::analysis {

/// The paths of the measured materials in a directory, its *.bsdf and *.binary, in the order of their names; none where
/// there is no such directory.
std::vector<std::string> measured_files(const std::string& directory);

struct MeasuredAlbedos {
  std::vector<std::string> names{};  ///< of the materials: the file's, without its ending
  std::vector<double> thetas{};      ///< of L [degrees]
  AlbedoOptions options{};
  /// [material][theta], for R, G and B
  std::vector<std::vector<std::array<Estimate, 3>>> estimates{};

  [[nodiscard]] std::size_t unconverged() const;
  /// The largest error relative to its value.
  [[nodiscard]] double worst_relative_error() const;
};

/// @throws FormatError naming a file that isn't one of the model `measured`
MeasuredAlbedos measured_albedos(const std::vector<std::string>& files, std::vector<double> thetas,
                                 const AlbedoOptions& options);

}  // namespace albedo::analysis
