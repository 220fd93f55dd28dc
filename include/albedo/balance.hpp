#pragma once

#include <cstdint>

#include "albedo/core/estimate.hpp"
#include "albedo/core/model.hpp"
#include "albedo/cosine_tables.hpp"

namespace albedo {

struct BalanceOptions {
  double rho = 1;           ///< albedo to reach, within (0, 1]
  double tolerance = 1e-9;  ///< of that albedo, relative; within [1e-12, 0.1]
};

/// The s for which f(L,V) / (s(L) s(V)) reflects ρ of the light from everywhere: what infinitely many pumpings go
/// towards, in one step.
///
/// Integrated over azimuths, f cosθ_V is a symmetric kernel of two polar angles, and s scales it to constant row sums
/// [Sinkhorn & Knopp 1967]. Iterated is the geometric mean of s and ∫ f/s(V) cosθ_V dω_V / ρ: an error of ln s along an
/// eigenfunction of the balanced kernel with eigenvalue λ shrinks by (1 − λ)/2, and smooth kernels have few λ < 0.
///
/// s exists for every kernel that is positive; it may not where f is 0 for whole regions of V: if what light from A
/// sees is all in a smaller B, then B can't take ρ of it and reflect no more than that itself. Iteration doesn't settle
/// then.
class Balance {
 public:
  static constexpr int most_iterations = 200;  ///< for each refinement of the table

  /// @throws ParameterError for options outside their ranges; for a model that doesn't claim to be reciprocal, or is
  /// anisotropic: one s of the polar angle can't balance every azimuth; and for one whose albedo isn't finite and
  /// positive above the horizon.
  explicit Balance(const Model& model, const BalanceOptions& options = {});

  [[nodiscard]] const BalanceOptions& options() const { return options_; }
  /// ln s, one table, raised so that no albedo exceeds ρ.
  [[nodiscard]] const CosineTables& table() const { return table_; }
  [[nodiscard]] double log_s(double cos_theta) const;
  /// What 1 − a/ρ stays within, from 0 up.
  [[nodiscard]] double relative_bound() const { return bound_; }
  /// converged: the bound meets the tolerance; budget_exhausted: it doesn't, for want of panels or because iteration
  /// doesn't settle, which settled() tells
  [[nodiscard]] Status status() const { return status_; }
  [[nodiscard]] bool settled() const { return settled_; }
  [[nodiscard]] int iterations() const { return iterations_; }
  /// By how much the last iterations made the error shrink, each.
  [[nodiscard]] double rate() const { return rate_; }
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }  ///< of the BRDF

 private:
  BalanceOptions options_;
  CosineTables table_;
  double bound_ = 0, rate_ = 0;
  Status status_ = Status::converged;
  bool settled_ = true;
  int iterations_ = 0;
  std::int64_t evaluations_ = 0;
};

}  // namespace albedo
