#pragma once

#include "albedo/core/lobe.hpp"
#include "albedo/microfacet/sampling.hpp"

namespace albedo {

/// A direction V within a lobe wherever L is: of given slopes, of a given gap from its axis, or anywhere.
inline Sampled<double> sample_lobe(const Lobe& lobe, const UnitVector<double>& l, double u, double v) {
  if (const auto* slopes = lobe.as<SlopeLobe>()) return sample_beckmann(l, slopes->width_x, slopes->width_y, u, v);
  if (const auto* near = lobe.as<NearMirrorLobe>()) return sample_beckmann(l, near->width, near->width, u, v);
  if (const auto* mirror = lobe.as<MirrorLobe>()) {
    const auto [x, y, z] = mirror->axis;
    return sample_axis(l, sampling_axis(l, x, y, z), 1 / square(mirror->width) - 1, u, v);
  }
  return sample_cosine(l, u, v);
}

}  // namespace albedo
