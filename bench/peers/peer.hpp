/// @file
/// The library rules that are compared, one file a library.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "peers/plane.hpp"

namespace albedo::peers {

/// What a rule is asked for. Monte Carlo rules take a number of calls and a seed, the others a tolerance.
struct Request {
  double tolerance;  ///< relative
  double reference;  ///< the answer, from which a sum of panels gets absolute tolerances
  std::int64_t budget;
  std::int64_t calls = 0;
  unsigned long seed = 1;
};

struct Answer {
  double value = 0;
  double error = 0;     ///< as the rule reports it
  bool claimed = true;  ///< the rule says that it met its tolerance
  std::int64_t evaluations = 0;
};

struct Peer {
  std::string library;
  std::string rule;
  bool vectorised = false;  ///< the integrand is evaluated in blocks
  bool monte_carlo = false;
  bool threaded = false;  ///< works in a thread of its own: its time is the wall's
  std::function<Answer(Plane&, const Request&)> integrate;
};

/// The sum over a plane's panels of what `one(panel)` answers (value, error, claimed).
template <class One>
Answer over_panels(Plane& plane, const Request& request, const One& one) {
  plane.start(request.budget);
  Answer sum;
  for (int panel = 0; panel < plane.panels(); ++panel) {
    const Answer part = one(panel);
    sum.value += part.value;
    sum.error += part.error;
    sum.claimed = sum.claimed && part.claimed;
  }
  sum.claimed = sum.claimed && !plane.spent();
  sum.evaluations = plane.evaluations;
  return sum;
}

/// The absolute error that a panel may have where there are several; a single one is asked for a relative error only.
inline double absolute_share(const Plane& plane, const Request& request) {
  return plane.panels() > 1 ? request.tolerance * request.reference / plane.panels() : 0;
}

std::vector<Peer> cubature_peers();
std::vector<Peer> gsl_peers();
std::vector<Peer> boost_peers();
/// Nested Gauss–Kronrod with Boost's nodes and Boost's way of dividing, on blocks.
std::vector<Peer> block_kronrod_peers();

}  // namespace albedo::peers
