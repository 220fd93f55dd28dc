/// @file
/// Walter 2005, figure 3: what equal weights do to pictures of Ward's model.
#pragma once

#include <string>
#include <vector>

#include "albedo/directional_albedo.hpp"
#include "plots/render/path_tracer.hpp"

namespace albedo::render {

inline constexpr double walter_rho_s = 0.75, walter_alpha = 0.15;

/// A view of a sphere with Ward's model; the pictures differ in how its directions are drawn and weighted only.
struct WardView {
  Scene (*scene)(Sampling sampling, double alpha);
  Camera camera;
  bool centred;  ///< all samples through the pixels' centres
};

/// In a diffuse box, lit from its ceiling.
WardView ward_in_box();
/// In a furnace, where the bias of a pixel is that of the curve.
WardView ward_in_furnace();

/// What equal weights make of the albedo, ρ_s P: ρ_s times the probability that Ward's sampling draws a V above the
/// horizon, by cubature. Only the roughness matters beside ρ_s, which is 1 here.
Estimate equal_weights_albedo(double alpha, const Direction& l, const AlbedoOptions& options = {.tolerance = 1e-7});
/// Ward's albedo for ρ_s = 1.
Estimate ward_albedo(double alpha, const Direction& l, const AlbedoOptions& options = {.tolerance = 1e-7});

/// A mean over the sphere's pixels and its standard error.
struct Mean {
  double value = 0, error = 0;
};

/// The three pictures and what follows from them.
struct WalterPictures {
  Rendering uniform{}, equal{}, weighted{};
  std::vector<double> cosine{};  ///< of the angle of view in a pixel's centre; 0 where not all of it is sphere
  std::size_t pixels = 0;        ///< of the sphere
  Mean reference{};              ///< luminance with uniform sampling
  Mean weighted_minus_reference{};
  Mean equal_minus_reference{};
  /// What the curve predicts of the last one: in every pixel the weighted estimate times the relative bias. Exact in a
  /// furnace; elsewhere it takes the light as even over the lobe.
  Mean predicted{};
};

WalterPictures walter_pictures(const WardView& view, double alpha, std::size_t size, std::uint32_t uniform_samples,
                               std::uint32_t samples, std::uint64_t seed, const ProgressCallback& progress = {});

}  // namespace albedo::render
