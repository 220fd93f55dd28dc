#include <cmath>
#include <nlohmann/json.hpp>

#include "albedo/version.hpp"
#include "peers/report.hpp"

namespace albedo::peers {
namespace {

using nlohmann::ordered_json;

/// Infinite and undefined numbers are null.
ordered_json number(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr); }

ordered_json run_of(const Run& run, const Peer& peer) {
  ordered_json object;
  if (peer.monte_carlo) {
    object["calls"] = run.calls;
  } else {
    object["tolerance"] = run.tolerance;
  }
  object["value"] = number(run.answer.value);
  object["reported_error"] = number(run.answer.error);
  object["claims_converged"] = run.answer.claimed;
  object["true_error"] = number(run.true_error);
  object["evaluations"] = run.answer.evaluations;
  return object;
}

void add_timing(ordered_json& object, const Timing& timing) {
  object["seconds"] = number(timing.seconds);
  object["ratio"] = number(timing.ratio);
}

ordered_json peer_of(const PeerResult& result) {
  const Peer& peer = *result.peer;
  ordered_json object{
      {"library", peer.library},       {"rule", peer.rule},         {"coordinates", to_string(result.coordinates)},
      {"vectorised", peer.vectorised}, {"reached", result.reached}, {"silently_wrong", result.silently_wrong}};
  if (result.reached) {
    object["best"] = run_of(result.best, peer);
    add_timing(object["best"], result.timing);
  }
  if (!peer.monte_carlo || result.asked.answer.evaluations > 0) {
    object["asked"] = run_of(result.asked, peer);
    if (is_baseline(result)) add_timing(object["asked"], result.asked_timing);
  }
  return object;
}

ordered_json target_of(const TargetResult& result) {
  ordered_json object{{"target", result.target}};
  const Estimate& estimate = result.gauss.estimate;
  object["gauss"] = {{"value", number(estimate.value)},      {"reported_error", number(estimate.error)},
                     {"status", to_string(estimate.status)}, {"true_error", number(result.gauss.true_error)},
                     {"evaluations", estimate.evaluations},  {"seconds", result.gauss.seconds}};
  object["peers"] = ordered_json::array();
  for (const PeerResult& peer : result.peers) object["peers"].push_back(peer_of(peer));
  return object;
}

}  // namespace

ordered_json json_report(const std::vector<CaseResult>& results, const MeasureOptions& options,
                         const Machine& machine) {
  ordered_json report{{"generator", "albedo-peers " + std::string(version)},
                      {"machine",
                       {{"processor", machine.processor},
                        {"cores", machine.cores},
                        {"load_before", number(machine.load_before)},
                        {"load_after", number(machine.load_after)}}},
                      {"repeats", options.repeats},
                      {"budget", options.budget},
                      {"monte_carlo_calls", options.monte_carlo_calls}};
  report["summary"] = ordered_json::array();
  for (const Baseline& baseline : baselines()) {
    const std::vector<Ratios> all = ratios(baseline, results);
    for (std::size_t i = 0; i < all.size(); ++i) {
      report["summary"].push_back({{"against", baseline.name},
                                   {"target", results.front().targets[i].target},
                                   {"median_ratio", number(all[i].median())},
                                   {"smallest_ratio", number(all[i].smallest())},
                                   {"right", all[i].values.size()},
                                   {"cases", all[i].cases}});
    }
  }
  report["cases"] = ordered_json::array();
  for (const CaseResult& result : results) {
    ordered_json object{{"model", result.material.model},
                        {"parameters", {{result.material.parameter, result.material.value}}},
                        {"theta_deg", result.theta},
                        {"reference", result.reference},
                        {"reference_error", result.reference_error}};
    for (const TargetResult& target : result.targets) object["targets"].push_back(target_of(target));
    report["cases"].push_back(std::move(object));
  }
  return report;
}

}  // namespace albedo::peers
