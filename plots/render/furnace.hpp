/// @file
/// Spheres in a white furnace: radiance 1 from everywhere, so that what is seen is the albedo of the direction to the
/// eye.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "albedo/directional_albedo.hpp"
#include "albedo/pumping.hpp"
#include "plots/render/picture.hpp"

namespace albedo::render {

/// The albedo of a direction, with its error.
using AlbedoFunction = std::function<Estimate(const UnitVector<double>& v)>;

/// a(V) of a model that outlives it: from a curve where it is isotropic, integrated for every direction otherwise.
AlbedoFunction albedo_of(const Model& model, double tolerance);

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

/// A model and where its albedos come from.
struct FurnaceCase {
  std::shared_ptr<const Model> model{};
  AlbedoFunction albedo{};
};

/// A pumped model with the tables of PumpSequence, or integrated for every direction where it is anisotropic: the
/// tables have the largest albedo over the azimuth.
FurnaceCase pumped_case(std::string_view model, const Parameters& parameters, const PumpOptions& options);

/// Any other model, by albedo_of.
FurnaceCase plain_case(std::unique_ptr<Model> model);

/// An entry of the list of what the furnace test is run for.
struct FurnaceModel {
  std::string label{};  ///< with markup for gnuplot
  FurnaceCase (*make)();
};

/// Pumped models of each control, by mirror directions and by half vectors, and an anisotropic one that isn't pumped.
const std::vector<FurnaceModel>& furnace_models();

/// Models after other corrections than pumping: balanced, with Kulla and Conty's complement, after Turquin.
const std::vector<FurnaceModel>& corrected_furnace_models();

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

FurnaceTest test_in_furnace(const FurnaceCase& furnace_case, std::size_t size, std::uint32_t samples,
                            std::uint64_t seed, const ProgressCallback& progress = {});

}  // namespace albedo::render
