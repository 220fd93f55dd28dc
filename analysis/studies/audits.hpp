/// @file
/// Audits of a list of models.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "albedo/audit.hpp"
#include "numerics/parallel.hpp"

namespace albedo::analysis {

/// What an audit looks at beside the energy, which it always does.
enum class Check { grazing, reciprocity, facets, samplers, average };

inline constexpr std::array all_checks{Check::grazing, Check::reciprocity, Check::facets, Check::samplers,
                                       Check::average};

/// As on the command line.
std::string name_of(Check check);

struct AuditCase {
  std::string list{};     ///< of materials, or empty
  std::string name{};     ///< of the material, or empty
  std::string channel{};  ///< or empty
  std::unique_ptr<Model> model{};
  AuditOptions options{};
  Audit audit{};
};

/// The options with only these checks.
AuditOptions audit_options(const AlbedoOptions& albedo, const std::vector<Check>& checks);

/// Audits all cases, with the same bits for any number of threads.
void run_audits(std::vector<AuditCase>& cases, int threads, const ProgressCallback& progress = {});

/// What the audits of one list's materials of one model found together. A material counts once, whatever its channels.
struct AuditSummary {
  std::string list{};
  std::string model{};
  std::size_t materials = 0, creating_energy = 0;
  std::size_t unbounded = 0;  ///< of those that create energy
  double largest = -1;        ///< finite albedo, if there is one
  std::string largest_name{};
  double earliest_degrees = 90;  ///< angle at which one first passes 1
  std::string earliest_name{};
  std::size_t undecided = 0, failed = 0;
};
std::vector<AuditSummary> summaries_of(const std::vector<AuditCase>& cases);

/// Whether some albedo is above 1 by more than its error.
bool creates_energy(const Audit& audit);

}  // namespace albedo::analysis
