/// @file
/// Spheres in a white furnace: radiance 1 from everywhere, so that what is seen of a reciprocal model is a(V).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "albedo/curve.hpp"
#include "analysis/render/picture.hpp"

namespace albedo::render {

/// a(V) of a model: from a curve where it is isotropic, integrated for every direction otherwise.
class AlbedoOf {
 public:
  AlbedoOf(const Model& model, double tolerance);

  /// The albedo, and its error.
  [[nodiscard]] Estimate operator()(const UnitVector<double>& v) const;

 private:
  const Model& model_;
  double tolerance_;
  std::optional<AlbedoCurve> curve_{};
};

/// The camera of all furnaces: parallel rays along y, a sphere of radius 1 about the origin, its axis upwards.
Camera furnace_camera();
Scene furnace(std::vector<SurfaceLobe> lobes);

struct AlbedoSphere {
  Picture picture{};
  double darkest = 0, brightest = 0;  ///< albedos on the sphere
  double worst_error = 0;             ///< of an albedo, absolute
  std::size_t unconverged = 0;        ///< albedos that missed the tolerance
};

/// A sphere that isn't path-traced: every pixel is a(V) of the library, its edge is blended with the background.
/// A model is taken to be symmetric about its two axes, as all of the library's are.
AlbedoSphere albedo_sphere(const Model& model, std::size_t size, double tolerance);

/// A model to be tested in the furnace.
struct FurnaceModel {
  std::string label{};  ///< with markup for gnuplot
  std::unique_ptr<Model> (*make)();
};

/// Pumped models of each control, isotropic and not, by mirror directions and by half vectors.
const std::vector<FurnaceModel>& furnace_models();

/// A path-traced sphere against its albedos, in the pixels' centres.
struct FurnaceTest {
  Rendering traced{};
  std::vector<double> albedo{};     ///< of every pixel; the background's is 1
  std::vector<double> deviation{};  ///< (traced − albedo)/standard error; 0 where there is no sphere
  std::size_t pixels = 0;           ///< on the sphere
  double mean_difference = 0;       ///< of traced and albedo, over the sphere
  double mean_error = 0;            ///< its standard error
  double rms_deviation = 0;         ///< 1 where the pixels' standard errors are right
  double largest_deviation = 0;
  std::size_t unconverged = 0;  ///< albedos that missed the tolerance
};

FurnaceTest test_in_furnace(std::shared_ptr<const Model> model, std::size_t size, std::uint32_t samples,
                            std::uint64_t seed, double tolerance = 1e-5,
                            const analysis::ProgressCallback& progress = {});

}  // namespace albedo::render
