/// @file
/// What becomes of a model that is pumped again and again.
#pragma once

#include <memory>
#include <vector>

#include "albedo/corrections.hpp"
#include "albedo/pumping.hpp"

namespace albedo::analysis {

/// A model after so many pumpings; albedos over all angles of L, the limit at grazing incidence among them.
struct PumpedOrder {
  double largest = 0, smallest = 0;  ///< albedo
  double average = 0;                ///< 2 ∫ a(μ) μ dμ
  double distance = 0;               ///< largest |a − 1|
  double relative_bound = 0;         ///< of these albedos
  /// Largest output radiance over input radiance, f cosθ_L, with L and V in one plane with N and on opposite sides of
  /// it, no nearer to the horizon than 0.1°; L is at azimuth 0.
  double radiance = 0;
  double theta_l = 0, theta_v = 0;  ///< where [degrees]
  std::int64_t evaluations = 0;     ///< of the BRDF for this order's albedo
  double seconds = 0;               ///< for this order's albedo
};

struct PumpStudy {
  static constexpr double little = 0.01;  ///< gain of the average albedo that makes no pumping worth while
  std::vector<PumpedOrder> orders{};      ///< from 0 pumpings on
  Status status = Status::converged;

  /// The first order after which the average albedo gains less than that; −1 if all gain more.
  [[nodiscard]] int worth() const;
};

/// The model after another correction, in the same numbers; those of the albedo come from its curve.
struct CorrectedModel {
  Correction correction = Correction::none;
  PumpedOrder numbers{};
  Status status = Status::converged;
  int iterations = 0;  ///< of balance
  double rate = 0;     ///< by which each of the last ones made its error shrink
};

/// @throws ParameterError as Corrections::applied_to does
CorrectedModel study_correction(std::unique_ptr<Model> model, Correction correction, double rho, double tolerance);

/// @throws ParameterError as PumpSequence does
PumpStudy study_pumping(const Model& model, const PumpOptions& options);

}  // namespace albedo::analysis
