/// @file
/// Albedos and peaks of all lobes of a scene over the grid of cosines, each computed once.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "albedo/directional_albedo.hpp"
#include "analysis/scenes/plan/tube.hpp"
#include "numerics/parallel.hpp"

namespace albedo::analysis {

/// How a plan integrates: the gauss rule to a thousandth of the tolerance; tables that aren't smooth by cubature, to a
/// tenth of the tolerance.
AlbedoOptions plan_albedo_options(const Model& model, double tolerance);

/// A lobe seen from one azimuth.
struct LobeSamples {
  std::shared_ptr<const Model> model{};
  double phi = 0;
  bool needs_peaks = false;
  std::vector<double> albedos{};  ///< at the cosines of the grid
  std::vector<double> peaks{};    ///< peak_radiance()
  bool is_good = true;            ///< all are finite, positive and well within the tolerance
};

class SampleStore {
 public:
  /// Asks for samples; the same lobe asked for again is the same number.
  std::size_t request(const std::shared_ptr<const Model>& model, double phi, bool needs_peaks);
  /// Computes what is asked for, in parallel.
  void fill(const CosineGrid& grid, double tolerance, int threads, const ProgressCallback& progress);

  [[nodiscard]] const LobeSamples& operator[](std::size_t i) const { return samples_[i]; }

 private:
  std::vector<LobeSamples> samples_;
  std::map<std::pair<std::string, double>, std::size_t> numbers_;
};

}  // namespace albedo::analysis
