/// @file
/// Integration in 113 bits, for those who don't name their type.
#pragma once

#include <memory>
#include <vector>

#include "albedo/directional_albedo.hpp"
#include "core/integrand.hpp"

namespace albedo {

/// Lobes of a model evaluated in 113 bits, for a rule that sums in double.
std::unique_ptr<Integrand<double>> rounded_quad_integrand(const Model& model, const std::vector<Lobe>& lobes,
                                                          const Direction& l, const AlbedoOptions& options);

/// Panels and truncation of a model's integrand, and what the gauss rule makes of it with nodes and sums in 113 bits.
struct QuadIntegral {
  Estimate estimate;
  bool tracked = true;  ///< every panel's lobe is announced
};
QuadIntegral integrated_in_quad(const Model& model, const Direction& l, const AlbedoOptions& options);

}  // namespace albedo
