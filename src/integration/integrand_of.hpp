#pragma once

#include <memory>

#include "albedo/directional_albedo.hpp"
#include "core/integrand.hpp"

namespace albedo {

/// The cosine below which L is grazing: no angle in degrees comes closer to 90 without being it.
inline constexpr double grazing_cosine = 1e-60;

/// @throws ParameterError unless the tolerance is within [1e-30, 1) and the budget positive
void check(const AlbedoOptions& options);

/// One lobe of a model on the warp and in the arithmetic that the options ask for.
std::unique_ptr<Integrand<double>> integrand_of(const Model& model, const Lobe& lobe, const Direction& l,
                                                const AlbedoOptions& options);

/// All lobes of a model, each on its own warp.
std::unique_ptr<Integrand<double>> integrand_of(const Model& model, const Direction& l, const AlbedoOptions& options);

}  // namespace albedo
