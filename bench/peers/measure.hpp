/// @file
/// What each rule needs to really reach a target error, in time, beside gauss.
#pragma once

#include <limits>
#include <vector>

#include "albedo/directional_albedo.hpp"
#include "peers/battery.hpp"
#include "peers/peer.hpp"

namespace albedo::peers {

/// One answer of a peer, and what it is worth.
struct Run {
  double tolerance = 0;    ///< asked
  std::int64_t calls = 0;  ///< asked of a Monte Carlo rule
  Answer answer{};
  double true_error = std::numeric_limits<double>::infinity();  ///< relative; Monte Carlo: root mean square over seeds
};

/// Times of a peer and of gauss, measured in turns: medians.
struct Timing {
  double seconds = 0;
  double ratio = 0;  ///< of the peer's time to gauss's next to it
};

/// A peer in one kind of coordinates at one target.
struct PeerResult {
  const Peer* peer = nullptr;
  Coordinates coordinates = Coordinates::hemisphere;
  bool reached = false;
  Run best{};                   ///< the loosest that reaches the target
  Timing timing{};              ///< of `best`, where reached
  Run asked{};                  ///< asked for the target itself; Monte Carlo: the first that claims it
  Timing asked_timing{};        ///< of `asked`, for hcubature and cquad on the hemisphere
  bool silently_wrong = false;  ///< `asked` claims the target and is off by more than ten times it
};

/// gauss on lobe coordinates.
struct GaussResult {
  Estimate estimate{};
  double true_error = 0;  ///< relative
  double seconds = 0;
};

struct TargetResult {
  double target = 0;
  GaussResult gauss{};
  std::vector<PeerResult> peers{};
};

struct CaseResult {
  Material material;
  double theta = 0;
  double reference = 0, reference_error = 0;
  std::vector<TargetResult> targets{};
};

struct MeasureOptions {
  int repeats = 11;                          ///< of a pair of timings; fewer for what takes long
  double pair_seconds = 0.02;                ///< about what a pair's turns may take
  std::int64_t budget = 1'000'000;           ///< evaluations of a deterministic rule
  std::int64_t monte_carlo_calls = 300'000;  ///< most of a Monte Carlo rule
};

/// Whether `result` is one of the two baselines that are asked for the target itself, without knowing the answer.
bool is_baseline(const PeerResult& result);

/// @throws Error where the reference in 113 bits isn't good to 1e-13
CaseResult measure(const Material& material, double theta, const std::vector<double>& targets,
                   const std::vector<Peer>& peers, const MeasureOptions& options);

}  // namespace albedo::peers
