#pragma once

#include <optional>
#include <vector>

#include "albedo/grazing.hpp"

namespace albedo {

/// What an audit says of one property.
enum class Verdict {
  pass,            ///< claimed, and so it is
  fails,           ///< claimed, and it is not so
  not_claimed,     ///< the model doesn't claim it for these parameters; the numbers are given all the same
  not_applicable,  ///< the model has no such part
  undecided,       ///< claimed, and the numbers weren't good enough to tell
};

std::string_view to_string(Verdict verdict);

/// The largest albedo that was found over all L.
struct EnergyAudit {
  Verdict verdict = Verdict::undecided;  ///< of a(L) ≤ 1
  Verdict bounded = Verdict::undecided;  ///< of a(L) < ∞
  Estimate largest{};
  double theta_degrees = 0, phi_degrees = 0;  ///< where it is
  std::optional<Crossing> critical{};         ///< where the albedo first passes 1, if it does
  double critical_phi_degrees = 0;
  int unconverged = 0;  ///< directions that missed the tolerance
};

/// The largest |f(L,V) − f(V,L)|/max(f(L,V), f(V,L)) over pairs of directions, in 113 bits.
struct ReciprocityAudit {
  Verdict verdict = Verdict::undecided;
  double asymmetry = 0;
  Direction l{}, v{};  ///< where it is
  int pairs = 0;
};

/// Both integrals of the distribution of half vectors.
struct DistributionAudit {
  Verdict verdict = Verdict::not_applicable;
  Estimate projected{};    ///< ∫ D N·H dω_H
  Estimate solid_angle{};  ///< ∫ D dω_H
};

/// The weak white furnace: ∫ G₁(L,H) D(H) (L·H)₊ dω_H/(N·L), which is 1 where the facets that L sees fill the
/// surface   [Heitz 2014, eq. 16]
struct MaskingAudit {
  Verdict verdict = Verdict::not_applicable;
  Estimate furthest{};  ///< of 1, over L
  double theta_degrees = 0, phi_degrees = 0;
};

/// One lobe's sampler, for one L.
struct SamplerAudit {
  Verdict verdict = Verdict::not_applicable;
  int component = 0;
  double theta_degrees = 0, phi_degrees = 0;
  double chi_squared = 0;
  int degrees_of_freedom = 0;
  double p_value = 1;           ///< of χ²: directions drawn in cells of the sphere against ∫ density
  Estimate density_integral{};  ///< over the sphere, with what is below the horizon
  double below_horizon = 0;     ///< of the directions drawn
  double density_mismatch = 0;  ///< largest relative difference of the density said with a direction and asked for it
  Estimate mean_weight{};       ///< of f cosθ_V/density over directions drawn: a standard error
  Estimate albedo{};            ///< of this lobe by the exact domain, which the mean weight should be
};

/// 2 ∫ a(μ) μ dμ, the mean over azimuths: what is reflected of light from everywhere.
struct AverageAudit {
  Estimate albedo{};
};

struct Audit {
  Claims claims{};
  EnergyAudit energy{};
  std::optional<Grazing> grazing{};
  ReciprocityAudit reciprocity{};
  DistributionAudit distribution{};
  MaskingAudit masking{};
  std::vector<SamplerAudit> samplers{};
  AverageAudit average{};

  [[nodiscard]] Verdict sampler_verdict() const;
  /// fails if any check does, else undecided if any is.
  [[nodiscard]] Verdict verdict() const;
};

struct AuditOptions {
  AlbedoOptions albedo{};  ///< for the albedos; others are integrated by rules of their own
  bool grazing = true;
  bool reciprocity = true;
  bool facets = true;  ///< distribution and masking
  bool samplers = true;
  bool average = true;
  double significance = 0.01;  ///< of all χ² tests together (Šidák)
};

/// Measures what a model claims, and what it doesn't.
/// @throws ParameterError as directional_albedo does, and unless the significance is within (0, 1)
Audit audit(const Model& model, const AuditOptions& options = {});

}  // namespace albedo
