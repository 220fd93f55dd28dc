#include "analysis/claims/measure.hpp"

#include <algorithm>
#include <limits>

#include "albedo/microfacet/sampling.hpp"
#include "analysis/text/text.hpp"

namespace albedo::analysis {
namespace {

constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

constexpr AuditOptions nothing_but_energy{
    .grazing = false, .reciprocity = false, .facets = false, .samplers = false, .average = false};

SlopeLobe slope_lobe_of(const Model& model) {
  const std::vector<Lobe> lobes = model.lobes();
  return std::ranges::find_if(lobes, &Lobe::is<SlopeLobe>)->slopes();
}

}  // namespace

std::string show(double value, int digits) {
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  return number_text(value + 0.0, digits);
}

std::string with_error(double value, double error, int digits) { return show(value, digits) + " +- " + show(error, 1); }

std::string with_error(const Estimate& estimate, int digits) {
  if (!std::isfinite(estimate.value)) return show(estimate.value);
  return with_error(estimate.value, estimate.error, digits);
}

std::string degrees(double theta) { return show(theta, 6) + " degrees"; }

std::string list_of(const std::vector<std::string>& items) { return joined(items, ", "); }

Quantity quantity(std::string name, const Estimate& estimate) {
  return {std::move(name), estimate.value, estimate.error};
}

Estimate albedo_at(const Model& model, double theta, double phi) {
  return directional_albedo(model, Direction::from_degrees(theta, phi), {.tolerance = 1e-10});
}

EnergyAudit energy_of(const Model& model) { return audit(model, nothing_but_energy).energy; }

ClaimVerdict Energies::conserved() const {
  if (above.empty()) return unknown ? ClaimVerdict::undecided : ClaimVerdict::holds;
  return below.empty() ? ClaimVerdict::fails : ClaimVerdict::holds_if;
}

Energies energies_of(const std::vector<Case>& cases) {
  Energies energies;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    energies.all.push_back(energy_of(*cases[i].model));
    const EnergyAudit& one = energies.all.back();
    const bool above = one.largest.value - one.largest.error > 1 + rounding || std::isinf(one.largest.value);
    (above ? energies.above : energies.below).push_back(cases[i].label);
    energies.unknown = energies.unknown || !(std::isinf(one.largest.value) || one.largest.error < 1e-6);
    if (one.largest.value > energies.all[energies.worst].largest.value) energies.worst = i;
  }
  return energies;
}

std::string largest_text(const Energies& energies, const std::vector<Case>& cases) {
  const EnergyAudit& one = energies.all[energies.worst];
  return with_error(one.largest) + " at " + degrees(one.theta_degrees) + " (" + cases[energies.worst].label + ")";
}

GrazingLaws grazing_laws(const std::vector<Case>& cases, double exponent) {
  GrazingLaws laws;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    laws.all.push_back(grazing_behaviour(*cases[i].model));
    const Grazing& one = laws.all.back();
    const double off = std::abs(one.fit.exponent - exponent);
    laws.unknown = laws.unknown || one.fit.status != Status::converged;
    const bool limit_too = one.limit.status != Status::converged || std::abs(one.limit.exponent - exponent) < 1e-6;
    const bool agrees = off <= std::max(one.fit.exponent_error, 1e-3) && limit_too;
    (agrees ? laws.agreeing : laws.others).push_back(cases[i].label);
    if (off >= laws.furthest) laws.furthest = off, laws.worst = i;
  }
  return laws;
}

Decrease decrease_of(const Model& model) {
  const double normal = albedo_at(model, 0).value;
  Decrease decrease;
  double before = 0;
  const auto look = [&](double theta) {
    const double part = albedo_at(model, theta).value / normal;
    if (part < decrease.least) decrease.least = part, decrease.theta = theta;
    if (part < 0.5 && decrease.half_lost == 90) {
      decrease.half_lost = threshold([&](double t) { return albedo_at(model, t).value / normal < 0.5; }, before, theta);
    }
    before = theta;
  };
  for (int theta = 1; theta < 90; ++theta) look(theta);
  for (const double theta : {89.5, 89.9, 89.99, 89.999}) look(theta);
  return decrease;
}

Estimate facet_integral(const Model& model, int power) {
  const SlopeLobe lobe = slope_lobe_of(model);
  const UnitVector<double> normal{0, 0, 1};
  return square_integral([&](double u, double v) {
    const double r = u / (1 - u), phi = pi<double> / 2 * v;  // all quadrants are alike
    const auto d = reflected(normal, lobe.width_x * r * std::cos(phi), lobe.width_y * r * std::sin(phi));
    const double area = 2 * pi<double> * lobe.width_x * lobe.width_y * r / square(1 - u);
    return model.facet_distribution(d) * std::pow(d.cos_theta_h, power + 3) * area;
  });
}

Estimate facing_away(const Model& model, double theta) {
  const SlopeLobe lobe = slope_lobe_of(model);
  const Direction direction = Direction::from_degrees(theta);
  const double edge = direction.cos_theta / direction.sin_theta;
  return square_integral([&](double u, double v) {
    const double along = edge + lobe.width_x * u / (1 - u), across = lobe.width_y * v / (1 - v);
    const auto d = reflected(UnitVector<double>{0, 0, 1}, -along, across);
    const double area = 2 * lobe.width_x * lobe.width_y / (square(1 - u) * square(1 - v));
    return model.facet_distribution(d) * square(square(d.cos_theta_h)) * area;
  });
}

double half_vector_density(const Model& model, const Direction& l, double theta_h, double phi_h) {
  const UnitVector<double> light = unit_vector<double>(l);
  const double slope = std::tan(theta_h);
  const auto d = reflected(light, slope * std::cos(phi_h), slope * std::sin(phi_h));
  return model.density(0, light, {d.v_x, d.v_y, d.cos_theta_v}) * 4 * d.cos_theta_d;
}

SamplerSummary samplers_of(const std::vector<Case>& cases) {
  AuditOptions options = nothing_but_energy;
  options.samplers = true;
  SamplerSummary all;
  for (const Case& one : cases) {
    const Audit found = audit(*one.model, options);
    all.pass = all.pass && found.sampler_verdict() == Verdict::pass;
    for (const SamplerAudit& sampler : found.samplers) {
      ++all.tests;
      all.least_p = std::min(all.least_p, sampler.p_value);
      all.integral_off = std::max(all.integral_off, std::abs(sampler.density_integral.value - 1));
      all.below_horizon = std::max(all.below_horizon, sampler.below_horizon);
      const double off = std::abs(sampler.mean_weight.value - sampler.albedo.value);
      if (sampler.mean_weight.error > 0)
        all.mean_weight_off = std::max(all.mean_weight_off, off / sampler.mean_weight.error);
    }
  }
  return all;
}

}  // namespace albedo::analysis
