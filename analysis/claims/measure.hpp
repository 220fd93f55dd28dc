/// @file
/// What several claims are measured with.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "albedo/audit.hpp"
#include "analysis/claims/claims.hpp"
#include "core/integrand.hpp"
#include "rules/kronrod.hpp"

namespace albedo::analysis {

/// A model with what sets it apart from the others of a claim.
struct Case {
  std::string label;
  std::unique_ptr<Model> model;
};

/// A number with so many digits, and "value +- error" with the error's first one.
std::string show(double value, int digits = 6);
std::string with_error(double value, double error, int digits = 8);
std::string with_error(const Estimate& estimate, int digits = 8);
std::string degrees(double theta);
std::string list_of(const std::vector<std::string>& items);

/// `value` with a name, for a finding's list.
Quantity quantity(std::string name, const Estimate& estimate);

/// The largest of what was looked at, and where it was.
struct Worst {
  double value = -std::numeric_limits<double>::infinity();
  std::string where{};

  void look(double candidate, const std::string& place) {
    if (candidate > value || std::isnan(candidate)) value = candidate, where = place;
  }
};

Estimate albedo_at(const Model& model, double theta, double phi = 0);

/// The audit of nothing but the energy.
EnergyAudit energy_of(const Model& model);

/// The largest albedo of several models.
struct Energies {
  std::vector<EnergyAudit> all;               ///< of each case
  std::vector<std::string> above{}, below{};  ///< labels of cases whose albedo passes 1, and doesn't
  std::size_t worst = 0;                      ///< the case with the largest albedo
  bool unknown = false;                       ///< some albedo missed its tolerance where it would decide

  /// holds if no albedo is above 1, fails if each model's passes it, holds_if between.
  [[nodiscard]] ClaimVerdict conserved() const;
};
Energies energies_of(const std::vector<Case>& cases);

/// "1.5 +- 1e-9 at 45 degrees (n=0)", or "infinite at ...".
std::string largest_text(const Energies& energies, const std::vector<Case>& cases);

/// Whether the albedo of every case goes like (N.L)^-exponent at grazing incidence, by a fit and by the limit integral.
struct GrazingLaws {
  std::vector<Grazing> all;
  std::vector<std::string> agreeing{}, others{};
  double furthest = 0;  ///< of a fitted exponent from the claimed one
  std::size_t worst = 0;
  bool unknown = false;
};
GrazingLaws grazing_laws(const std::vector<Case>& cases, double exponent);

/// The least albedo over all angles in units of that at normal incidence, and the first angle where half of it is lost
/// (90 degrees if none is).
struct Decrease {
  double least = 1, theta = 0, half_lost = 90;
};
Decrease decrease_of(const Model& model);

/// Integrates f(u, v) over the unit square.
template <class Function>
class SquareIntegrand final : public Integrand<double> {
 public:
  explicit SquareIntegrand(Function function) : function_(std::move(function)) { panels_ = {Panel{}}; }

  void points(int, const double* u, const double* v, double* w, int count) const override {
    for (int i = 0; i < count; ++i) w[i] = function_(u[i], v[i]);
  }
  void grid(int, const double* u, int count_u, const double* v, int count_v, double* w) const override {
    for (int i = 0; i < count_u; ++i) {
      for (int j = 0; j < count_v; ++j) w[i * count_v + j] = function_(u[i], v[j]);
    }
  }

 private:
  Function function_;
};

template <class Function>
Estimate square_integral(Function function) {
  return kronrod(SquareIntegrand(std::move(function)), {.tolerance = 1e-10, .budget = 1'000'000, .seed = 1});
}

/// Integral of D(H) (N.H)^power over all half vectors.
Estimate facet_integral(const Model& model, int power);

/// The part of the half vectors of density D(H) N.H that face away from L: L.H < 0. Gaussian tails only.
Estimate facing_away(const Model& model, double theta);

/// The density [1/sr] at the (theta, phi) that map(u, v) gives for uniform u, v, by central differences.
template <class Map>
double density_of_map(const Map& map, double u, double v) {
  constexpr double h = 1e-5;
  const auto [right_t, right_p] = map(u + h, v);
  const auto [left_t, left_p] = map(u - h, v);
  const auto [up_t, up_p] = map(u, v + h);
  const auto [down_t, down_p] = map(u, v - h);
  const double determinant =
      ((right_t - left_t) * (up_p - down_p) - (up_t - down_t) * (right_p - left_p)) / (4 * h * h);
  return 1 / (std::abs(determinant) * std::sin(map(u, v).first));
}

/// p_H(H), the density of half vectors that lobe 0's density of directions V for a given L stands for.
double half_vector_density(const Model& model, const Direction& l, double theta_h, double phi_h);

/// The smallest and largest of what all samplers' audits of a model found.
struct SamplerSummary {
  double least_p = 1;          ///< of chi-squared
  double integral_off = 0;     ///< largest distance of the density's integral from 1
  double mean_weight_off = 0;  ///< of the albedo, in standard errors
  double below_horizon = 0;    ///< largest part of directions drawn
  int tests = 0;
  bool pass = true;
};
SamplerSummary samplers_of(const std::vector<Case>& cases);

/// The value where a monotone condition changes between `low` and `high`, by bisection.
template <class Condition>
double threshold(const Condition& condition, double low, double high) {
  const bool at_low = condition(low);
  for (int i = 0; i < 50 && std::nextafter(low, high) < high && (high - low) > 1e-8 * high; ++i) {
    const double middle = (low + high) / 2;
    (condition(middle) == at_low ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace albedo::analysis
