/// @file
/// Fits of one specular lobe and a Lambertian part to another isotropic model.
#pragma once

#include <string>
#include <vector>

#include "albedo/core/model.hpp"

namespace albedo::analysis {

/// A parameter of the lobe that is searched for.
struct FitParameter {
  std::string name;
  double minimum = 0, maximum = 1;
  std::vector<double> starts{};
};

struct LobeFit {
  Parameters parameters{};        ///< of the lobe, scale and Lambertian part included
  double scale = 0, diffuse = 0;  ///< of the lobe, and the albedo of the Lambertian part
  double error = 0;               ///< root mean square of (f − target) cosθ_L over solid angles
};

/// The lobe's names of its scale and of its Lambertian part's albedo.
struct FitScales {
  std::string scale, diffuse;
};

/// Ngan's metric [Ngan et al. 2005]: Σ w ((f − target) cosθ_L)² over angles of L and V up to 80°, weighted by solid
/// angle. Scale and Lambertian part, neither negative, follow from the rest by linear least squares; the rest by steps
/// that are halved, from all combinations of starts.
LobeFit fit_lobe(const Model& target, const std::string& model, const Parameters& fixed,
                 const std::vector<FitParameter>& searched, const FitScales& scales);

}  // namespace albedo::analysis
