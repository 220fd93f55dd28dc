#include "analysis/studies/tradeoff.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

#include "albedo/core/errors.hpp"

namespace albedo::analysis {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double infinity = std::numeric_limits<double>::infinity();

double median(std::vector<double> values) {
  if (values.empty()) return infinity;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  const double upper = *middle;
  if (values.size() % 2 == 1 || std::isinf(upper)) return upper;
  return (upper + *std::max_element(values.begin(), middle)) / 2;
}

/// From 0.1 down to the last, so many steps a digit.
std::vector<double> ladder(int steps, double last) {
  constexpr double near = 1.1;
  std::vector<double> tolerances;
  for (int step = steps;; ++step) {
    const double tolerance = std::pow(10.0, -static_cast<double>(step) / steps);
    if (tolerance < near * last) break;
    tolerances.push_back(tolerance);
  }
  tolerances.push_back(last);
  return tolerances;
}

/// |difference| in 113 bits, relative to the reference.
double relative(const Quad& difference, const Quad& reference) {
  return static_cast<double>(Quad(abs(difference) / abs(reference)));
}

double seconds_of(const std::function<void()>& work) {
  const auto begin = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// One timing, and how many runs it takes together so that the clock can tell.
struct Timer {
  AlbedoOptions options;
  int batch = 1;
  bool is_long = false;  // takes every other turn
  std::vector<double> seconds{};

  /// What came before has filled the caches: a short run is first taken once for nothing.
  void run(const Model& model, const Direction& l) {
    if (batch > 1) directional_albedo(model, l, options);
    const auto repeated = [&] {
      for (int i = 0; i < batch; ++i) directional_albedo(model, l, options);
    };
    seconds.push_back(seconds_of(repeated) / batch);
  }
};

/// All runs of a cell once, not timed for the result: the estimates, and how long about each takes.
void estimate(const Model& model, const Direction& l, const TradeoffRequest& request, TradeoffCell& cell,
              std::vector<Timer>& timers) {
  constexpr double least = 100e-6;  // seconds that a timing should take
  for (const Rule rule : request.rules) {
    for (const Warp warp : request.warps) {
      if (warp == Warp::paper && !has_samplers(model)) continue;
      std::optional<Estimate> before;
      for (const double tolerance : is_monte_carlo(rule) ? request.random_tolerances : request.tolerances) {
        Timer timer{.options = {.rule = rule,
                                .warp = warp,
                                .precision = request.precision,
                                .tolerance = tolerance,
                                .budget = request.budget,
                                .seed = request.seed}};
        Estimate result;
        const auto once = [&] { result = directional_albedo(model, l, timer.options); };
        double seconds = seconds_of(once);
        if (seconds < 1e-3) seconds = seconds_of(once);  // the first may have made the rule's nodes
        const bool stuck = before && before->status != Status::converged && result.status != Status::converged &&
                           before->evaluations == result.evaluations;
        if (stuck) break;
        before = result;
        constexpr double long_time = 1e-3;
        timer.is_long = seconds > long_time;
        timer.batch = std::clamp(static_cast<int>(least / seconds), 1, 32);
        timers.push_back(timer);
        cell.runs.push_back({.method = {rule, warp},
                             .tolerance = tolerance,
                             .estimate = result,
                             .true_error = relative(Quad(result.value) - cell.reference.value, cell.reference.value),
                             .reported_error = relative(Quad(result.error), cell.reference.value)});
      }
    }
  }
}

void measure(const Model& model, const Direction& l, const TradeoffRequest& request, TradeoffCell& cell) {
  std::vector<Timer> timers;
  estimate(model, l, request, cell, timers);
  for (int round = 0; round < request.repeats; ++round) {
    for (Timer& timer : timers) {
      if (!timer.is_long || round % 2 == 0) timer.run(model, l);
    }
  }
  for (std::size_t i = 0; i < timers.size(); ++i) cell.runs[i].seconds = median(timers[i].seconds);
}

/// The references of all cells, on several threads.
void find_references(const std::vector<std::unique_ptr<Model>>& models, const std::vector<Direction>& directions,
                     const TradeoffRequest& request, std::vector<TradeoffCell>& cells) {
  ProgressCallback progress;
  if (request.progress) progress = [&](std::size_t done, std::size_t count) { request.progress(done, 2 * count); };
  in_parallel(
      cells.size(), request.threads,
      [&](std::size_t i) {
        cells[i].reference = reference_albedo(*models[cells[i].material], directions[i % directions.size()],
                                              {.tolerance = request.reference_tolerance});
      },
      progress);
}

}  // namespace

TradeoffRequest default_tradeoff(double last, double last_random) {
  TradeoffRequest request;
  request.rules.assign(all_rules.begin(), all_rules.end());
  request.warps.assign(all_warps.begin(), all_warps.end());
  request.tolerances = ladder(1, last);
  request.random_tolerances = ladder(2, last_random);
  return request;
}

const std::vector<std::string>& tradeoff_models() {
  static const std::vector<std::string> names{"ward", "cook_torrance", "ashikhmin_shirley", "phong", "ggx"};
  return names;
}

std::vector<TradeoffMaterial> usual_materials(const std::string& model) {
  struct Pair {
    const char* parameter;
    double smooth, rough;
  };
  const auto pair_of = [&]() -> std::optional<Pair> {
    if (model == "ward") return Pair{"alpha", 0.1, 0.5};
    if (model == "cook_torrance") return Pair{"m", 0.1, 0.3};
    if (model == "ashikhmin_shirley") return Pair{"n", 1000, 10};
    if (model == "phong") return Pair{"n", 1000, 20};
    if (model == "ggx") return Pair{"alpha", 0.1, 0.5};
    return std::nullopt;
  };
  if (const auto pair = pair_of()) {
    return {{model, "smooth", {{pair->parameter, pair->smooth}}}, {model, "rough", {{pair->parameter, pair->rough}}}};
  }
  return {{model_info(model).name, "default", {}}};
}

bool TradeoffRun::wrong(double slack) const {
  if (estimate.status != Status::converged) return false;
  constexpr double standard_errors = 4;
  const double admitted = is_monte_carlo(method.rule) ? standard_errors * reported_error : reported_error;
  return !(true_error <= admitted + slack);
}

double TradeoffCell::slack() const { return relative(reference.error, reference.value); }

const TradeoffRun* TradeoffCell::reaching(const Method& method, double target) const {
  const TradeoffRun* first = nullptr;
  for (const TradeoffRun& run : runs) {
    if (run.method != method) continue;
    if (!(run.true_error <= target)) {
      first = nullptr;
    } else if (first == nullptr) {
      first = &run;
    }
  }
  return first;
}

std::size_t Tradeoff::unconverged() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(cells, [](const auto& cell) { return cell.reference.status != Status::converged; }));
}

std::vector<Method> Tradeoff::methods() const {
  std::vector<Method> found;
  for (const Rule rule : request.rules) {
    for (const Warp warp : request.warps) {
      const Method method{rule, warp};
      const bool ran = std::ranges::any_of(cells, [&](const TradeoffCell& cell) {
        return std::ranges::find(cell.runs, method, &TradeoffRun::method) != cell.runs.end();
      });
      if (ran) found.push_back(method);
    }
  }
  return found;
}

MethodSummary summary_of(const Tradeoff& study, const Method& method, double target) {
  MethodSummary summary;
  std::vector<double> seconds, evaluations, ratios;
  for (const TradeoffCell& cell : study.cells) {
    if (std::ranges::find(cell.runs, method, &TradeoffRun::method) == cell.runs.end()) continue;
    ++summary.cells;
    const TradeoffRun *const run = cell.reaching(method, target), *const ours = cell.reaching({}, target);
    if (run != nullptr) ++summary.reached;
    seconds.push_back(run != nullptr ? run->seconds : infinity);
    evaluations.push_back(run != nullptr ? static_cast<double>(run->estimate.evaluations) : infinity);
    if (ours != nullptr) ratios.push_back(seconds.back() / ours->seconds);
  }
  summary.seconds = median(seconds);
  summary.evaluations = median(evaluations);
  summary.ratio = median(ratios);
  return summary;
}

Tradeoff measure_tradeoff(TradeoffRequest request) {
  std::vector<Direction> directions;
  for (const double theta : request.thetas) {
    if (!(theta >= 0 && theta < 90)) {
      std::ostringstream message;
      message << "theta is " << theta << "° and must be within [0, 90)";
      throw ParameterError(message.str());
    }
    directions.push_back(Direction::from_degrees(theta, request.phi));
  }
  Tradeoff study{.request = std::move(request)};
  std::vector<std::unique_ptr<Model>> models;
  for (std::size_t i = 0; i < study.request.materials.size(); ++i) {
    TradeoffMaterial& material = study.request.materials[i];
    models.push_back(make_model(material.model, material.parameters));
    material.parameters = models.back()->parameters();
    for (const double theta : study.request.thetas) study.cells.push_back({.material = i, .theta = theta});
  }
  find_references(models, directions, study.request, study.cells);
  for (std::size_t i = 0; i < study.cells.size(); ++i) {
    TradeoffCell& cell = study.cells[i];
    measure(*models[cell.material], directions[i % directions.size()], study.request, cell);
    if (study.request.progress) study.request.progress(study.cells.size() + i + 1, 2 * study.cells.size());
  }
  return study;
}

}  // namespace albedo::analysis
