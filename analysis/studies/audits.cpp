#include "analysis/studies/audits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace albedo::analysis {

std::string name_of(Check check) {
  switch (check) {
    case Check::grazing:
      return "grazing";
    case Check::reciprocity:
      return "reciprocity";
    case Check::facets:
      return "facets";
    case Check::samplers:
      return "samplers";
    case Check::average:
      break;
  }
  return "average";
}

AuditOptions audit_options(const AlbedoOptions& albedo, const std::vector<Check>& checks) {
  const auto wanted = [&](Check check) { return std::ranges::find(checks, check) != checks.end(); };
  return {.albedo = albedo,
          .grazing = wanted(Check::grazing),
          .reciprocity = wanted(Check::reciprocity),
          .facets = wanted(Check::facets),
          .samplers = wanted(Check::samplers),
          .average = wanted(Check::average)};
}

void run_audits(std::vector<AuditCase>& cases, int threads, const ProgressCallback& progress) {
  in_parallel(
      cases.size(), threads, [&cases](std::size_t i) { cases[i].audit = audit(*cases[i].model, cases[i].options); },
      progress);
}

bool creates_energy(const Audit& audit) {
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  const Estimate& largest = audit.energy.largest;
  return std::isinf(largest.value) || largest.value - largest.error > 1 + rounding;
}

std::vector<AuditSummary> summaries_of(const std::vector<AuditCase>& cases) {
  std::vector<AuditSummary> summaries;
  std::vector<std::set<std::string>> seen, creating, unbounded;
  for (const AuditCase& one : cases) {
    const std::string& model = one.model->info().name;
    auto found = std::ranges::find(summaries, model, &AuditSummary::model);
    if (found == summaries.end()) {
      summaries.push_back({.model = model});
      found = summaries.end() - 1;
      seen.emplace_back(), creating.emplace_back(), unbounded.emplace_back();
    }
    const auto index = static_cast<std::size_t>(found - summaries.begin());
    const EnergyAudit& energy = one.audit.energy;
    seen[index].insert(one.name);
    if (one.audit.verdict() == Verdict::fails) ++found->failed;
    if (one.audit.verdict() == Verdict::undecided) ++found->undecided;
    const double finite = std::isinf(energy.largest.value) ? 0 : energy.largest.value;
    if (finite > found->largest) found->largest = finite, found->largest_name = one.name;
    if (!creates_energy(one.audit)) continue;
    creating[index].insert(one.name);
    if (std::isinf(energy.largest.value)) unbounded[index].insert(one.name);
    if (!energy.critical) continue;
    const double angle = Direction::from_cosine(energy.critical->cos_theta).theta_degrees();
    if (angle < found->earliest_degrees) found->earliest_degrees = angle, found->earliest_name = one.name;
  }
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    summaries[i].materials = seen[i].size();
    summaries[i].creating_energy = creating[i].size();
    summaries[i].unbounded = unbounded[i].size();
  }
  return summaries;
}

}  // namespace albedo::analysis
