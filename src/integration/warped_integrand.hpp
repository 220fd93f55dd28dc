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
  switch (options.warp == Warp::hemisphere ? LobeShape::cosine : lobe.shape) {
    case LobeShape::mirror:
      return std::make_unique<LobeIntegrand<MirrorLobeWarp, T>>(model, lobe, l, options.tolerance, as_float);
    case LobeShape::half_vector:
      return std::make_unique<LobeIntegrand<HalfVectorWarp, T>>(model, lobe, l, options.tolerance, as_float);
    case LobeShape::near_mirror:
      return std::make_unique<LobeIntegrand<NearMirrorWarp, T>>(model, lobe, l, options.tolerance, as_float);
    case LobeShape::half_angles:
      return std::make_unique<LobeIntegrand<HalfAnglesWarp, T>>(model, lobe, l, options.tolerance, as_float);
    case LobeShape::cosine:
      break;
  }
  return std::make_unique<LobeIntegrand<HemisphereWarp, T>>(model, lobe, l, options.tolerance, as_float);
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
