/// @file
/// Whether errors can be believed: reported against true ones, over many random cases.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "albedo/directional_albedo.hpp"
#include "analysis/studies/random_case.hpp"
#include "numerics/parallel.hpp"

namespace albedo::analysis {

struct HonestyOptions {
  std::uint64_t cases = 2000;
  std::uint64_t seed = 1;
  std::vector<Rule> rules{};          ///< empty: all of them
  std::vector<std::string> models{};  ///< empty: all of them
  Warp warp = Warp::lobe;             ///< models without a sampler are left out on the paper warp
  std::int64_t budget = 200'000;      ///< of a rule, for one case; the gauss rule has ten times as much
  std::uint64_t quad_every = 100;     ///< every so-many-th reference is checked in 113 bits; 0: none
  int threads = 0;                    ///< 0: as many as OpenMP would use
};

/// Tolerances that a case draws one of.
inline constexpr std::array honesty_tolerances{1e-4, 1e-6, 1e-8}, honesty_random_tolerances{3e-2, 1e-2, 3e-3};

/// The options with which a rule answers a case.
AlbedoOptions options_of(Rule rule, const RandomCase& question, const HonestyOptions& options);

/// The most misleading of a rule's answers.
struct Worst {
  std::uint64_t index = 0;  ///< of the case
  double ratio = 0;         ///< true error per reported one
  Estimate answer{}, reference{};
};

/// What a rule's errors were worth.
struct RuleHonesty {
  Rule rule = Rule::gauss;
  std::uint64_t judged = 0;                ///< answers; where the reference isn't good enough to tell there is none
  std::uint64_t converged = 0;             ///< of those, with status converged: all below count these
  std::uint64_t honest = 0;                ///< the true error is at most the reported one
  std::uint64_t far_off = 0;               ///< the true error is more than 10 times the reported one
  std::uint64_t undecidable = 0;           ///< true and reported error are both near the reference's own or below
  std::array<std::uint64_t, 3> covered{};  ///< of the decidable: the true error is at most 1, 2, 3 times the reported
  std::uint64_t unconverged_honest = 0;    ///< of the others: the true error is at most the reported one
  std::uint64_t non_finite = 0;            ///< of the others
  std::vector<Worst> worst{};              ///< with ratios above 1 (Monte Carlo: 5), the worst first; at most 10

  /// Answers that tell whether a standard error is one: black lobes, which every rule gets exactly, don't.
  [[nodiscard]] std::uint64_t decidable() const { return converged - undecidable; }
};

struct Honesty {
  HonestyOptions options{};
  std::vector<RuleHonesty> rules{};
  std::uint64_t without_reference = 0;  ///< cases whose reference didn't converge
  std::uint64_t disputed = 0;           ///< cases whose reference another rule contradicts; they count as without
  std::vector<Worst> disputes{};        ///< answer: gauss, reference: kronrod, ratio: the relative distance; at most 10
  std::uint64_t quad_checks = 0;        ///< references compared with 113 bits
  std::uint64_t quad_refuted = 0;       ///< of those, further apart than both errors allow
  std::vector<Worst> refuted{};         ///< answer: the reference, reference: in 113 bits
};

/// Answers random cases by every rule, and judges them by the gauss rule on the lobe warp in double precision at 1e-12.
/// That reference's own error is granted to the answers. Since a rule can't testify for itself, the kronrod rule at
/// 1e-10 is a second opinion; where the two are further apart than both errors, their distance is the reference's
/// error. The same for any number of threads.
/// @throws UnknownModel, ParameterError
Honesty study_honesty(const HonestyOptions& options, const ProgressCallback& progress = {});

/// The probability that the true error is within k reported ones if those are what they say: Student's distribution
/// with 15 degrees of freedom for 16 replicates, the normal one for plain Monte Carlo.
double nominal_coverage(Rule rule, int k);

/// The command that gives a rule's answer to a case again.
std::string command_of(const RandomCase& question, Rule rule, const HonestyOptions& options);

}  // namespace albedo::analysis
