#pragma once

#include "albedo/audit.hpp"

/// The parts of an audit, one a file.
namespace albedo {

EnergyAudit audit_energy(const Model& model, const AlbedoOptions& options);
ReciprocityAudit audit_reciprocity(const Model& model);
DistributionAudit audit_distribution(const Model& model);
MaskingAudit audit_masking(const Model& model);
std::vector<SamplerAudit> audit_samplers(const Model& model, const AuditOptions& options);
AverageAudit audit_average(const Model& model, const AlbedoOptions& options);

/// critical_angle() where the albedo is known to be above 1 at a cosine that its grid may miss.
Crossing critical_angle(const Model& model, const GrazingOptions& options, double cosine_above);

/// The azimuths of L [degrees] that tell a model's albedo: a lobe's axes are those of the surface.
std::vector<double> azimuths_of(const Model& model);

}  // namespace albedo
