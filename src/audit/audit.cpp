#include "albedo/audit.hpp"

#include <algorithm>
#include <sstream>

#include "albedo/core/errors.hpp"
#include "audit/parts.hpp"
#include "integration/integrand_of.hpp"

namespace albedo {

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fails:
      return "fails";
    case Verdict::not_claimed:
      return "not claimed";
    case Verdict::undecided:
      return "undecided";
    case Verdict::not_applicable:
      break;
  }
  return "not applicable";
}

Verdict Audit::sampler_verdict() const {
  if (samplers.empty()) return Verdict::not_applicable;
  for (const Verdict worst : {Verdict::fails, Verdict::undecided}) {
    if (std::ranges::find(samplers, worst, &SamplerAudit::verdict) != samplers.end()) return worst;
  }
  return Verdict::pass;
}

Verdict Audit::verdict() const {
  const auto all = {energy.verdict,       energy.bounded,  reciprocity.verdict,
                    distribution.verdict, masking.verdict, sampler_verdict()};
  for (const Verdict worst : {Verdict::fails, Verdict::undecided, Verdict::pass, Verdict::not_claimed}) {
    if (std::ranges::find(all, worst) != all.end()) return worst;
  }
  return Verdict::not_applicable;
}

Audit audit(const Model& model, const AuditOptions& options) {
  check(options.albedo);
  if (!(options.significance > 0 && options.significance < 1)) {
    std::ostringstream message;
    message << "significance is " << options.significance << " and must be within (0, 1)";
    throw ParameterError(message.str());
  }
  Audit result{.claims = model.claims(), .energy = audit_energy(model, options.albedo)};
  if (options.grazing) {
    result.grazing = grazing_behaviour(
        model, {.phi_degrees = 0, .tolerance = options.albedo.tolerance, .budget = options.albedo.budget});
  }
  result.reciprocity.verdict = Verdict::not_applicable;
  if (options.reciprocity) result.reciprocity = audit_reciprocity(model);
  if (options.facets) {
    result.distribution = audit_distribution(model);
    result.masking = audit_masking(model);
  }
  if (options.samplers) result.samplers = audit_samplers(model, options);
  if (options.average) result.average = audit_average(model, options.albedo);
  return result;
}

}  // namespace albedo
