#include "scaling/simulation.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>

namespace albedo::bench {

SimulatedFill simulate(const std::vector<double>& tiles, std::size_t cores, const FillCosts& costs) {
  // The moments at which cores ask. The counter serves the earliest; who gets no tile is done.
  std::priority_queue<double, std::vector<double>, std::greater<>> asking(std::greater<>(),
                                                                          std::vector<double>(cores, 0.0));
  double counter_free = 0, end = 0, waiting = 0, sum_of_ends = 0;
  for (std::size_t next = 0, done = 0; done < cores;) {
    const double asked = asking.top();
    asking.pop();
    const double served = std::max(asked + costs.round_trip / 2, counter_free);
    counter_free = served + costs.service;
    const double answered = counter_free + costs.round_trip / 2;
    if (next == tiles.size()) {
      ++done;
      sum_of_ends += asked;
      end = std::max(end, asked);
      continue;
    }
    waiting += answered - asked;
    asking.push(answered + tiles[next++] + costs.write);
  }
  const double work = std::accumulate(tiles.begin(), tiles.end(), 0.0);
  const double all = static_cast<double>(cores) * end;
  return {.seconds = end,
          .efficiency = work / all,
          .idle_end = (all - sum_of_ends) / all,
          .waiting = waiting / all,
          .writing = costs.write * static_cast<double>(tiles.size()) / all};
}

}  // namespace albedo::bench
