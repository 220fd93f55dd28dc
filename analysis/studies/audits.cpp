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
  struct Names {
    std::set<std::string> all, creating, unbounded, failed, undecided;
  };
  std::vector<AuditSummary> summaries;
  std::vector<Names> names;
  for (const AuditCase& one : cases) {
    const std::string& model = one.model->info().name;
    const auto found = std::ranges::find_if(
        summaries, [&](const AuditSummary& summary) { return summary.list == one.list && summary.model == model; });
    const auto index = static_cast<std::size_t>(found - summaries.begin());
    if (found == summaries.end()) {
      summaries.push_back({.list = one.list, .model = model});
      names.emplace_back();
    }
    AuditSummary& summary = summaries[index];
    Names& of = names[index];
    const EnergyAudit& energy = one.audit.energy;
    of.all.insert(one.name);
    if (one.audit.verdict() == Verdict::fails) of.failed.insert(one.name);
    if (one.audit.verdict() == Verdict::undecided) of.undecided.insert(one.name);
    if (std::isinf(energy.largest.value)) {
      of.unbounded.insert(one.name);
    } else if (energy.largest.value > summary.largest) {
      summary.largest = energy.largest.value, summary.largest_name = one.name;
    }
    if (!creates_energy(one.audit)) continue;
    of.creating.insert(one.name);
    if (!energy.critical) continue;
    const double angle = Direction::from_cosine(energy.critical->cos_theta).theta_degrees();
    if (angle < summary.earliest_degrees) summary.earliest_degrees = angle, summary.earliest_name = one.name;
  }
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    summaries[i].materials = names[i].all.size();
    summaries[i].creating_energy = names[i].creating.size();
    summaries[i].unbounded = names[i].unbounded.size();
    summaries[i].failed = names[i].failed.size();
    summaries[i].undecided = names[i].undecided.size();
  }
  return summaries;
}

}  // namespace albedo::analysis
