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

/// One lobe of a model on the warp that the options ask for, evaluated in T.
template <class T>
std::unique_ptr<Integrand<Scalar<T>>> integrand_of(const Model& model, const Lobe& lobe, const Direction& l,
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

/// All lobes of a model, each on its own warp.
template <class T>
std::unique_ptr<Integrand<Scalar<T>>> integrand_of(const Model& model, const Direction& l,
                                                   const AlbedoOptions& options) {
  std::vector<std::unique_ptr<Integrand<Scalar<T>>>> parts;
  for (const Lobe& lobe : model.lobes()) parts.push_back(integrand_of<T>(model, lobe, l, options));
  if (parts.size() == 1) return std::move(parts.front());
  return std::make_unique<SumIntegrand<Scalar<T>>>(std::move(parts));
}

}  // namespace albedo
