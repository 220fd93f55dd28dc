#include "peers/summary.hpp"

#include <algorithm>
#include <cmath>

namespace albedo::peers {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Asked for the target, as its user would.
double as_asked(const TargetResult& result, const std::string& rule) {
  for (const PeerResult& peer : result.peers) {
    if (peer.peer->rule != rule || !is_baseline(peer)) continue;
    return peer.asked.true_error <= result.target ? peer.asked_timing.ratio : never;
  }
  return never;
}

double of_best(const TargetResult& result, bool vectorised) {
  const PeerResult* best = best_peer(result, vectorised);
  return best == nullptr ? never : best->timing.ratio;
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::size_t middle = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double Ratios::median() const { return peers::median(values); }

double Ratios::smallest() const { return values.empty() ? std::numeric_limits<double>::quiet_NaN() : values.front(); }

std::vector<Baseline> baselines() {
  return {{"hcubature in (theta_V, phi_V), asked for that tolerance",
           [](const TargetResult& result) { return as_asked(result, "hcubature"); }},
          {"nested cquad in (theta_V, phi_V), asked for that tolerance",
           [](const TargetResult& result) { return as_asked(result, "nested cquad"); }},
          {"the best scalar library rule of each case, tuned with the answer known",
           [](const TargetResult& result) { return of_best(result, false); }},
          {"the same, integrands vectorised for the peers too",
           [](const TargetResult& result) { return of_best(result, true); }}};
}

std::vector<Ratios> ratios(const Baseline& baseline, const std::vector<CaseResult>& results) {
  std::vector<Ratios> all(results.front().targets.size());
  for (const CaseResult& result : results) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double ratio = baseline.ratio(result.targets[i]);
      ++all[i].cases;
      if (ratio < never) all[i].values.push_back(ratio);
    }
  }
  for (Ratios& ratios : all) std::sort(ratios.values.begin(), ratios.values.end());
  return all;
}

const PeerResult* best_peer(const TargetResult& result, bool vectorised) {
  const PeerResult* best = nullptr;
  for (const PeerResult& peer : result.peers) {
    if (!peer.reached || (peer.peer->vectorised && !vectorised)) continue;
    if (best == nullptr || peer.timing.ratio < best->timing.ratio) best = &peer;
  }
  return best;
}

std::vector<Slower> slower_cases(const std::vector<CaseResult>& results, bool vectorised) {
  std::vector<Slower> slower;
  for (const CaseResult& result : results) {
    for (const TargetResult& target : result.targets) {
      const PeerResult* best = best_peer(target, vectorised);
      if (best != nullptr && best->timing.ratio < 1) slower.push_back({&result, target.target, best});
    }
  }
  return slower;
}

bool is_right(const TargetResult& result) {
  return result.gauss.estimate.status == Status::converged && result.gauss.true_error <= result.target;
}

}  // namespace albedo::peers
