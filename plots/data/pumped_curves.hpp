/// @file
/// Albedo and output radiance of a model that is pumped again and again, as curves over angles.
#pragma once

#include <vector>

#include "albedo/pumping.hpp"

namespace albedo::analysis {

/// Output radiance is f(L,V) cosθ_L [1/sr] with V in the plane of L and N, as of a lamp of intensity 4π at distance 1
/// in direction L   [Neumann 1999, eq. 3]; angles are in degrees.
struct PumpedCurves {
  std::vector<double> thetas{};               ///< of L, from 0 to 90; 90 stands for the limit from above the horizon
  std::vector<std::vector<double>> albedo{};  ///< [order][theta]
  std::vector<std::vector<double>> peak{};    ///< [order][theta]: largest radiance over V
  std::vector<double> incidences{};           ///< of L, for whole curves of the radiance
  std::vector<double> views{};                ///< of V, from −90 to 90; positive on the side of the mirror direction
  std::vector<std::vector<std::vector<double>>> radiance{};  ///< [incidence][order][view]
  std::vector<double> relative_bound{};                      ///< of the albedos of each order
  Status status = Status::converged;
};

/// @throws ParameterError as PumpSequence does
PumpedCurves pumped_curves(const Model& model, const PumpOptions& options, std::vector<double> incidences);

}  // namespace albedo::analysis
