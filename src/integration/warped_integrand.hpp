/// @file
/// The integrands of every warp, as templates over the number type: to be included where one is instantiated.
#pragma once

#include <memory>
#include <vector>

#include "integration/integrand_of.hpp"
#include "integration/lobe_integrand.hpp"
#include "integration/paper_integrand.hpp"
#include "warps/half_angles.hpp"
#include "warps/half_vector.hpp"
#include "warps/hemisphere.hpp"
#include "warps/mirror_lobe.hpp"
#include "warps/near_mirror.hpp"

namespace albedo {

/// One lobe of a model on the warp that the options ask for, evaluated in T.
template <class T>
std::unique_ptr<Integrand<Scalar<T>>> warped_integrand(const Model& model, const Lobe& lobe, const Direction& l,
                                                       const AlbedoOptions& options) {
  const bool as_float = options.precision == Precision::float32;
  if (options.warp == Warp::paper) {
    return std::make_unique<PaperIntegrand<T>>(model, lobe, l, options.tolerance, as_float);
  }
  const auto on = [&]<template <class> class Warped>() -> std::unique_ptr<Integrand<Scalar<T>>> {
    return std::make_unique<LobeIntegrand<Warped, T>>(model, lobe, l, options.tolerance, as_float);
  };
  if (options.warp != Warp::hemisphere) {
    if (lobe.is<MirrorLobe>()) return on.template operator()<MirrorLobeWarp>();
    if (lobe.is<SlopeLobe>()) return on.template operator()<HalfVectorWarp>();
    if (lobe.is<NearMirrorLobe>()) return on.template operator()<NearMirrorWarp>();
    if (lobe.is<HalfAnglesLobe>()) return on.template operator()<HalfAnglesWarp>();
  }
  return on.template operator()<HemisphereWarp>();
}

/// Lobes of a model, each on its own warp.
template <class T>
std::unique_ptr<Integrand<Scalar<T>>> warped_integrand(const Model& model, const std::vector<Lobe>& lobes,
                                                       const Direction& l, const AlbedoOptions& options) {
  std::vector<std::unique_ptr<Integrand<Scalar<T>>>> parts;
  for (const Lobe& lobe : lobes) parts.push_back(warped_integrand<T>(model, lobe, l, options));
  if (parts.size() == 1) return std::move(parts.front());
  return std::make_unique<SumIntegrand<Scalar<T>>>(std::move(parts));
}

}  // namespace albedo
