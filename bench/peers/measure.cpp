#include "peers/measure.hpp"

#include <ctime>

#include <algorithm>
#include <cmath>

#include "albedo/core/errors.hpp"

namespace albedo::peers {
namespace {

/// The thread's own time, which a loaded machine's other work isn't part of; the wall's for what works in another
/// thread.
double now(bool threaded) {
  std::timespec time{};
  clock_gettime(threaded ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <class Work>
double seconds(const Work& work, int times, bool threaded) {
  const double begin = now(threaded);
  for (int i = 0; i < times; ++i) work();
  return (now(threaded) - begin) / times;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Times two pieces of work in turns; short ones are repeated within a turn. Both have run before.
template <class Peers, class Ours>
Timing in_turns(const Peers& peers, const Ours& ours, const MeasureOptions& options, bool threaded,
                std::vector<double>& our_seconds) {
  constexpr double turn = 30e-6;
  const double first = seconds(peers, 1, threaded), our_first = seconds(ours, 1, false);
  constexpr double too_long = 0.05;
  if (first > too_long) {
    our_seconds.push_back(our_first);
    return {first, first / our_first};
  }
  const auto times = [](double one) { return static_cast<int>(std::clamp(turn / one, 1.0, 200.0)); };
  const double both = std::max(first, turn) + std::max(our_first, turn);
  const int turns =
      std::clamp(static_cast<int>(options.pair_seconds / both), std::min(3, options.repeats), options.repeats);
  std::vector<double> theirs, ratios;
  for (int i = 0; i < turns; ++i) {
    const double peer_time = seconds(peers, times(first), threaded);
    const double our_time = seconds(ours, times(our_first), false);
    theirs.push_back(peer_time);
    our_seconds.push_back(our_time);
    ratios.push_back(peer_time / our_time);
  }
  return {median(theirs), median(ratios)};
}

class Measurement {
 public:
  Measurement(const Material& material, double theta, const MeasureOptions& options)
      : material_(material), options_(options), model_(material.make()), l_(Direction::from_degrees(theta)) {
    AlbedoOptions exact;
    exact.precision = Precision::quad;
    exact.tolerance = 1e-14;
    const Estimate estimate = directional_albedo(*model_, l_, exact);
    result_ = {material, theta, estimate.value, estimate.error};
    if (estimate.status != Status::converged || !(estimate.error <= 1e-13 * estimate.value))
      throw Error("no reference good to 1e-13 for " + material.model + " at " + std::to_string(theta) + " degrees");
  }

  CaseResult run(const std::vector<double>& targets, const std::vector<Peer>& peers) {
    std::vector<Ladder> ladders;
    for (const Peer& peer : peers) {
      for (const Coordinates coordinates : {Coordinates::hemisphere, Coordinates::lobe})
        ladders.push_back({&peer, coordinates});
    }
    for (const double target : targets) result_.targets.push_back(at_target(target, ladders));
    return result_;
  }

 private:
  /// Where a peer stands on the way to tighter targets.
  struct Ladder {
    const Peer* peer;
    Coordinates coordinates;
    int rung = 0;
    bool ended = false;  ///< a rung has spent the budget: there is nothing beyond
  };

  /// Tolerances 1, 0.3, 0.1, ...; calls 1000, 4000, ...
  static double tolerance_of(int rung) { return std::pow(10.0, -(rung / 2)) * (rung % 2 == 0 ? 1.0 : 0.3); }
  [[nodiscard]] std::int64_t calls_of(const Peer& peer, int rung) const {
    // a threaded rule is asked for an error, and cancelled after so many calls
    return (peer.threaded ? options_.monte_carlo_calls : std::int64_t{1000}) << (2 * rung);
  }
  static constexpr double least_tolerance = 2e-15;

  TargetResult at_target(double target, std::vector<Ladder>& ladders) {
    TargetResult result{target};
    const auto ours = [&] { return directional_albedo(*model_, l_, {.tolerance = target}); };
    result.gauss.estimate = ours();  // also makes the nodes of every order that it meets
    result.gauss.true_error = relative_error(result.gauss.estimate.value);
    std::vector<double> our_seconds;
    for (Ladder& ladder : ladders) {
      const std::unique_ptr<Plane> plane = make_plane(material_, *model_, l_, ladder.coordinates, target);
      PeerResult found = climb(ladder, *plane, target);
      const auto timed = [&](const Run& run) {
        const auto peers = [&] { return ladder.peer->integrate(*plane, request(*ladder.peer, run, target)); };
        return in_turns(peers, ours, options_, ladder.peer->threaded, our_seconds);
      };
      if (found.reached) found.timing = timed(found.best);
      if (is_baseline(found)) found.asked_timing = timed(found.asked);
      result.peers.push_back(found);
    }
    result.gauss.seconds = median(our_seconds);
    return result;
  }

  PeerResult climb(Ladder& ladder, Plane& plane, double target) const {
    const Peer& peer = *ladder.peer;
    PeerResult result{&peer, ladder.coordinates};
    const auto judge = [&](const Run& run) {
      constexpr double far_off = 10;
      result.silently_wrong = run.answer.claimed && !(run.true_error <= far_off * target);
    };
    if (!peer.monte_carlo) {
      result.asked = run_at(peer, plane, {.tolerance = target}, target);
      judge(result.asked);
    }
    bool asked = !peer.monte_carlo;
    for (; !ladder.ended; ++ladder.rung) {
      const Run rung{.tolerance = peer.monte_carlo ? target : tolerance_of(ladder.rung),
                     .calls = peer.monte_carlo ? calls_of(peer, ladder.rung) : 0};
      if (peer.monte_carlo ? rung.calls > options_.monte_carlo_calls : rung.tolerance < least_tolerance) {
        ladder.ended = true;
        break;
      }
      const Run run = run_at(peer, plane, rung, target);
      if (!asked && run.answer.claimed) {
        result.asked = run;
        judge(run);
        asked = true;
      }
      if (run.true_error <= target) {
        result.reached = true;
        result.best = run;
        break;
      }
      if (!peer.monte_carlo && plane.spent()) ladder.ended = true;
    }
    return result;
  }

  [[nodiscard]] Request request(const Peer& peer, const Run& run, double target) const {
    return {.tolerance = peer.monte_carlo ? target : run.tolerance,
            .reference = result_.reference,
            .budget = peer.monte_carlo ? std::numeric_limits<std::int64_t>::max() : options_.budget,
            .calls = run.calls};
  }

  Run run_at(const Peer& peer, Plane& plane, Run run, double target) const {
    Request asked = request(peer, run, target);
    const unsigned long seeds = peer.monte_carlo && !peer.threaded ? 3 : 1;
    double sum = 0;
    for (asked.seed = 1; asked.seed <= seeds; ++asked.seed) {
      try {
        run.answer = peer.integrate(plane, asked);
        const double error = relative_error(run.answer.value);
        sum += error * error;
      } catch (const std::exception&) {  // the rule gave up
        run.answer = {.value = std::numeric_limits<double>::quiet_NaN(), .claimed = false};
        run.answer.evaluations = plane.evaluations;
        return run;
      }
    }
    run.true_error = std::sqrt(sum / static_cast<double>(seeds));
    return run;
  }

  [[nodiscard]] double relative_error(double value) const {
    return std::abs(value - result_.reference) / result_.reference;
  }

  const Material& material_;
  const MeasureOptions& options_;
  std::unique_ptr<Model> model_;
  Direction l_;
  CaseResult result_;
};

}  // namespace

bool is_baseline(const PeerResult& result) {
  return result.coordinates == Coordinates::hemisphere &&
         (result.peer->rule == "hcubature" || result.peer->rule == "nested cquad");
}

CaseResult measure(const Material& material, double theta, const std::vector<double>& targets,
                   const std::vector<Peer>& peers, const MeasureOptions& options) {
  return Measurement(material, theta, options).run(targets, peers);
}

}  // namespace albedo::peers
