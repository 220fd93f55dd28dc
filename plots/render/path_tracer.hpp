/// @file
#pragma once

#include <cstdint>
#include <vector>

#include "numerics/parallel.hpp"
#include "plots/render/scene.hpp"

namespace albedo::render {

struct RenderSettings {
  std::size_t width = 128, height = 128;
  std::uint32_t samples = 64;  ///< of a pixel, at least 2
  std::uint64_t seed = 1;
  bool centred = false;  ///< all samples through the pixel's centre, not spread over its square
  Spectrum luminance = rgb(0.2126, 0.7152, 0.0722);  ///< weights of the bands in what standard errors are of
  int threads = 0;                                   ///< 0: as many as OpenMP would use
};

/// Means over a pixel's samples, rows from the top.
struct Rendering {
  std::size_t width = 0, height = 0;
  std::uint32_t samples = 0;
  Spectrum weights = Spectrum(0);  ///< of the luminance
  std::vector<Spectrum> mean{};
  std::vector<double> luminance{};  ///< of the mean
  std::vector<double> error{};      ///< standard error of the luminance, from the samples' variance

  [[nodiscard]] double mean_luminance() const;
  [[nodiscard]] double mean_error() const;  ///< mean over the pixels
  [[nodiscard]] double largest_error() const;
};

/// The weight of one bounce and where it goes; nothing where the drawn direction is below the surface.
struct Bounce {
  UnitVector<double> direction;
  Spectrum weight;
};

/// Draws a direction of a lobe for a viewer in direction `l`: weight f cosθ/density as Sampling says, never clamped.
std::optional<Bounce> bounce(const SurfaceLobe& lobe, const UnitVector<double>& l, double u, double v);

/// Path tracing without light sampling: light is found by the paths that hit it. Of a surface's lobes one is chosen,
/// each as often; paths end by roulette from the fifth bounce on. The random numbers are counted by pixel, sample and
/// bounce (Philox4x32-10), so that the picture's bits don't depend on threads.
///
/// A sample that isn't finite makes its pixel so.
/// @throws ParameterError unless there are 2 samples and a pixel at least
Rendering render(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                 const ProgressCallback& progress = {});

}  // namespace albedo::render
