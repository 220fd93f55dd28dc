#include "analysis/studies/pumping.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "albedo/combinators/balanced.hpp"
#include "albedo/curve.hpp"

namespace albedo::analysis {
namespace {

constexpr double last_theta = 89.9;

/// f cosθ_L over a grid of L and V in the plane of incidence, divided again and again.
class Radiance {
 public:
  explicit Radiance(const Model& model) : model_(model) {
    double width = 20;
    for (const Lobe& lobe : model.lobes()) {
      if (lobe.is<CosineLobe>()) continue;
      width = std::min(width, lobe.widths().narrow * 180 / pi<double>);
    }
    for (double theta_l = 0; theta_l <= last_theta; theta_l += theta_l < 89 ? 1 : 0.3) {
      std::vector<double> views;
      for (double theta = 0; theta <= last_theta; theta += 0.5) views.push_back(theta);
      for (int i = -12; i <= 12; ++i) {
        const double theta = theta_l + i * width / 4;
        if (theta >= 0 && theta <= last_theta) views.push_back(theta);
      }
      for (const double theta_v : views) {
        grid_.push_back({theta_l, theta_v, x_of(theta_l), x_of(theta_v), value(theta_l, theta_v), 0});
      }
    }
  }

  /// Divides by the next factor of D.
  void advance(const PumpDivisor& divisor) {
    double theta_l = -1, log_l = 0;
    for (Point& point : grid_) {
      if (point.theta_l != theta_l) theta_l = point.theta_l, log_l = divisor.log_albedo(order_, point.x_l);
      const double log_v = divisor.log_albedo(order_, point.x_v);
      point.log_d = divisor.step(point.log_d, log_l, log_v, point.x_l, point.x_v);
    }
    ++order_;
  }

  /// Finds the largest one: from the best of the grid on, by steps in four directions that are halved.
  void find(const PumpDivisor& divisor, PumpedOrder& order) const {
    const auto radiance = [](const Point& point) { return point.plain * std::exp(-point.log_d); };
    const Point best = *std::max_element(grid_.begin(), grid_.end(),
                                         [&](const Point& a, const Point& b) { return radiance(a) < radiance(b); });
    order.theta_l = best.theta_l, order.theta_v = best.theta_v, order.radiance = radiance(best);
    for (double step = 0.5; step > 1e-5;) {
      const double from_l = order.theta_l, from_v = order.theta_v;
      const double before = order.radiance;
      for (const auto& [l, v] : {std::pair{step, 0.0},
                                 {-step, 0.0},
                                 {0.0, step},
                                 {0.0, -step},
                                 {step, step},
                                 {-step, -step},
                                 {step, -step},
                                 {-step, step}}) {
        const double theta_l = std::clamp(from_l + l, 0.0, last_theta);
        const double theta_v = std::clamp(from_v + v, 0.0, last_theta);
        const double now =
            value(theta_l, theta_v) * std::exp(-divisor.log_divisor(order_, x_of(theta_l), x_of(theta_v)));
        if (now > order.radiance) order.radiance = now, order.theta_l = theta_l, order.theta_v = theta_v;
      }
      if (!(order.radiance > before)) step /= 2;
    }
  }

 private:
  struct Point {
    double theta_l, theta_v, x_l, x_v, plain, log_d;
  };

  static double x_of(double theta) { return -std::log(Direction::from_degrees(theta).cos_theta); }

  [[nodiscard]] double value(double theta_l, double theta_v) const {
    const Direction l = Direction::from_degrees(theta_l);
    return brdf<double>(model_, l, Direction::from_degrees(theta_v, 180)) * l.cos_theta;
  }

  const Model& model_;
  std::vector<Point> grid_;
  int order_ = 0;
};

/// Extremes over all angles, between the ends of every panel of the tables.
void find_extremes(const PumpSequence& sequence, int order, PumpedOrder& result) {
  constexpr int steps = 64;
  const std::vector<double>& edges = sequence.divisor().albedos.edges();
  result.largest = result.smallest = sequence.albedo(order, 1);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    for (int step = 1; step <= steps; ++step) {
      const double a = sequence.albedo(order, std::exp(-(edges[i] + (edges[i + 1] - edges[i]) * step / steps)));
      result.largest = std::max(result.largest, a);
      result.smallest = std::min(result.smallest, a);
    }
  }
  result.distance = std::max(std::abs(result.largest - 1), std::abs(result.smallest - 1));
}

}  // namespace

int PumpStudy::worth() const {
  for (std::size_t k = 0; k + 1 < orders.size(); ++k) {
    if (orders[k + 1].average - orders[k].average < little * orders[k].average) return static_cast<int>(k);
  }
  return -1;
}

CorrectedModel study_correction(std::unique_ptr<Model> model, Correction correction, double rho, double tolerance) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const std::unique_ptr<Model> made = Corrections{.correct = correction, .rho = rho}.applied_to(std::move(model));
  CorrectedModel corrected{.correction = correction};
  PumpedOrder& numbers = corrected.numbers;
  numbers.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  const AlbedoCurve curve(*made, {.albedo = {.tolerance = tolerance}});
  corrected.status = curve.status();
  numbers.relative_bound = curve.relative_bound();
  numbers.average = curve.average();
  numbers.largest = numbers.smallest = curve(0);
  for (const AlbedoCurve::Node& node : curve.nodes()) {
    numbers.largest = std::max(numbers.largest, node.albedo.value);
    numbers.smallest = std::min(numbers.smallest, node.albedo.value);
  }
  numbers.distance = std::max(std::abs(numbers.largest - 1), std::abs(numbers.smallest - 1));
  Radiance(*made).find(PumpDivisor(PumpControl::none, false), numbers);
  if (const auto* balanced = dynamic_cast<const BalancedModel*>(made.get())) {
    const Balance& balance = balanced->balance();
    corrected.iterations = balance.iterations();
    corrected.rate = balance.rate();
    numbers.evaluations = balance.evaluations();
    if (balance.status() != Status::converged) corrected.status = balance.status();
  }
  return corrected;
}

PumpStudy study_pumping(const Model& model, const PumpOptions& options) {
  using Clock = std::chrono::steady_clock;
  PumpStudy study;
  Radiance radiance(model);
  auto begin = Clock::now();
  PumpSequence sequence(model, options.control, options.only_up, options.tolerance);
  std::int64_t before = 0;
  for (int k = 0;; ++k) {
    PumpedOrder order{.relative_bound = sequence.relative_bound(k)};
    order.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    order.evaluations = sequence.evaluations() - before;
    before = sequence.evaluations();
    order.average = sequence.average(k);
    find_extremes(sequence, k, order);
    radiance.find(sequence.divisor(), order);
    study.orders.push_back(order);
    if (k == options.times) break;
    radiance.advance(sequence.divisor());
    begin = Clock::now();
    sequence.advance();
  }
  study.status = sequence.status();
  return study;
}

}  // namespace albedo::analysis
