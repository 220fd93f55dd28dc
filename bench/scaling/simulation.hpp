/// @file
/// A table filled by many cores, simulated.
#pragma once

#include <cstddef>
#include <vector>

namespace albedo::bench {

/// What a claim and a finished tile cost, in seconds.
struct FillCosts {
  double round_trip = 0;  ///< of a claim, over the network
  double service = 0;     ///< for which the counter is busy with one claim; claims queue
  double write = 0;       ///< of a tile and its record, in which its core waits
};

struct SimulatedFill {
  double seconds = 0;     ///< until the last core is done
  double efficiency = 0;  ///< computing time of all tiles / (cores × seconds)
  double idle_end = 0;    ///< share of cores × seconds after a core's last tile, while others compute
  double waiting = 0;     ///< share of cores × seconds spent on claims: round trips and the queue
  double writing = 0;     ///< share of cores × seconds spent on writes
};

/// Cores that claim one tile after the other, in their order, until none is left; the counter answers in the order in
/// which claims arrive.
/// @param tiles the computing time of each tile
[[nodiscard]] SimulatedFill simulate(const std::vector<double>& tiles, std::size_t cores, const FillCosts& costs);

}  // namespace albedo::bench
