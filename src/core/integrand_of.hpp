#pragma once

#include <memory>
#include <vector>

#include "albedo/directional_albedo.hpp"
#include "albedo/warps/half_angles.hpp"
#include "albedo/warps/half_vector.hpp"
#include "albedo/warps/hemisphere.hpp"
#include "albedo/warps/mirror_lobe.hpp"
#include "albedo/warps/near_mirror.hpp"
#include "core/lobe_integrand.hpp"
#include "core/paper_integrand.hpp"

namespace albedo {

/// The cosine below which L is grazing: no angle in degrees comes closer to 90 without being it.
inline constexpr double grazing_cosine = 1e-60;

/// @throws ParameterError unless the tolerance is within [1e-30, 1) and the budget positive
void check(const AlbedoOptions& options);

/// All lobes of a model, each on the warp that the options ask for, evaluated in T.
template <class T>
std::unique_ptr<Integrand<Scalar<T>>> integrand_of(const Model& model, const Direction& l,
                                                   const AlbedoOptions& options) {
  const bool as_float = options.precision == Precision::float32;
  std::vector<std::unique_ptr<Integrand<Scalar<T>>>> parts;
  for (const Lobe& lobe : model.lobes()) {
    if (options.warp == Warp::paper) {
      parts.push_back(std::make_unique<PaperIntegrand<T>>(model, lobe, l, options.tolerance, as_float));
      continue;
    }
    const LobeShape shape = options.warp == Warp::hemisphere ? LobeShape::cosine : lobe.shape;
    switch (shape) {
      case LobeShape::cosine:
        parts.push_back(
            std::make_unique<LobeIntegrand<HemisphereWarp, T>>(model, lobe, l, options.tolerance, as_float));
        break;
      case LobeShape::mirror:
        parts.push_back(
            std::make_unique<LobeIntegrand<MirrorLobeWarp, T>>(model, lobe, l, options.tolerance, as_float));
        break;
      case LobeShape::half_vector:
        parts.push_back(
            std::make_unique<LobeIntegrand<HalfVectorWarp, T>>(model, lobe, l, options.tolerance, as_float));
        break;
      case LobeShape::near_mirror:
        parts.push_back(
            std::make_unique<LobeIntegrand<NearMirrorWarp, T>>(model, lobe, l, options.tolerance, as_float));
        break;
      case LobeShape::half_angles:
        parts.push_back(
            std::make_unique<LobeIntegrand<HalfAnglesWarp, T>>(model, lobe, l, options.tolerance, as_float));
        break;
    }
  }
  if (parts.size() == 1) return std::move(parts.front());
  return std::make_unique<SumIntegrand<Scalar<T>>>(std::move(parts));
}

}  // namespace albedo
