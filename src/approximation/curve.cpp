#include "albedo/curve.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>

#include "albedo/core/errors.hpp"
#include "numerics/interpolation.hpp"

namespace albedo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double last_cosine = 1e-10;  // of the nodes
constexpr double asymptotic = 1e-13;   // cosθ at which the power law holds
constexpr double beyond = 1e-15;       // and another
constexpr int first_gaps = 15;         // what a lobe does takes an e-fold of cosθ or more: nothing hides between
constexpr int fitted_between = 2;      // samples in every gap between nodes of the rational form
constexpr std::size_t most_rational = 80;
constexpr int fewest_nodes = 16;

// Errors are measured at three or more points between neighbouring nodes, where they swing once or twice: 2.1 times
// what is met covers swings that are met no closer than 61° from their crest.
constexpr double unmeasured = 2.1;
constexpr double measured_share = 0.45;                                   // of the tolerance
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();  // of a look-up

struct Sample {
  double x;
  double f;  ///< what is interpolated: ln a, or a itself where it has zeros
  double cos_theta;
  Estimate albedo;
  bool is_node = false;
};

/// The albedo where it has been integrated, from normal incidence to grazing.
class Samples {
 public:
  Samples(const Model& model, const CurveOptions& options) : model_(model), options_(options) {
    // A Monte Carlo rule pays with the square of what it is asked for.
    const double share = is_monte_carlo(options.albedo.rule) ? 2 : 16, tolerance = options.albedo.tolerance;
    options_.albedo.tolerance = std::max(tolerance / share, std::min(1e-13, tolerance));
  }

  Estimate integrate(double cos_theta) {
    const Estimate a =
        directional_albedo(model_, Direction::from_cosine(cos_theta, options_.phi_degrees), options_.albedo);
    evaluations_ += a.evaluations;
    ++integrations_;
    if (a.status == Status::non_finite || (a.status == Status::divergent && cos_theta > 0)) broken_ = a.status;
    if (a.status == Status::rounding_limited) missed_ = a.status;
    return a;
  }

  /// A sample at x; returns its place, from which the later ones move up.
  std::size_t add(double x) {
    const auto place =
        std::upper_bound(list_.begin(), list_.end(), x, [](double at, const Sample& s) { return at < s.x; });
    const double cos_theta = std::exp(-x);
    const Estimate a = integrate(cos_theta);
    const auto added = list_.insert(place, {x, logarithmic_ ? std::log(a.value) : a.value, cos_theta, a});
    largest_ = std::max(largest_, std::abs(a.value));
    if (logarithmic_ && !(a.value > 0)) {
      logarithmic_ = false;
      for (Sample& s : list_) s.f = s.albedo.value;
    }
    return static_cast<std::size_t>(added - list_.begin());
  }

  [[nodiscard]] std::size_t size() const { return list_.size(); }
  Sample& operator[](std::size_t i) { return list_[i]; }
  const Sample& operator[](std::size_t i) const { return list_[i]; }

  [[nodiscard]] bool logarithmic() const { return logarithmic_; }
  [[nodiscard]] double floor() const { return logarithmic_ ? 0 : AlbedoCurve::relative_floor * largest_; }
  [[nodiscard]] Status broken() const { return broken_; }  ///< converged unless a sample isn't a number
  [[nodiscard]] Status missed() const { return missed_; }  ///< what keeps the curve from its tolerance
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }
  [[nodiscard]] int integrations() const { return integrations_; }

  /// What `difference` is relative to `a`, or to the floor.
  [[nodiscard]] double relative(double difference, double a) const {
    return difference == 0 ? 0 : std::abs(difference) / std::max(std::abs(a), floor());
  }

  /// The relative error of a curve whose f is `interpolated` where it is `f`; infinite if that isn't a number.
  [[nodiscard]] double difference(double interpolated, double f) const {
    const double e = logarithmic_ ? std::abs(std::expm1(interpolated - f)) : relative(interpolated - f, f);
    return std::isnan(e) ? infinity : e;
  }
  [[nodiscard]] double error(double interpolated, std::size_t i) const { return difference(interpolated, list_[i].f); }

  [[nodiscard]] double worst_node_error() const {
    double worst = 0;
    for (const Sample& s : list_) worst = std::max(worst, relative(s.albedo.error, s.albedo.value));
    return worst;
  }

 private:
  const Model& model_;
  CurveOptions options_;
  std::vector<Sample> list_;
  bool logarithmic_ = true;
  double largest_ = 0;
  Status broken_ = Status::converged, missed_ = Status::budget_exhausted;
  std::int64_t evaluations_ = 0;
  int integrations_ = 0;
};

/// A form through some of the samples, and its largest error at all of them.
struct Fit {
  CurveForm form;
  std::vector<std::size_t> nodes{};
  std::vector<double> x{}, f{}, weights{};
  double error = infinity;

  double operator()(double t) const {
    return form == CurveForm::rational ? rational(x, f, weights, t) : monotone(x, f, weights, t);
  }

  /// Through the samples that are marked as nodes.
  void take_nodes(const Samples& samples) {
    nodes.clear(), x.clear(), f.clear();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!samples[i].is_node) continue;
      nodes.push_back(i), x.push_back(samples[i].x), f.push_back(samples[i].f);
    }
  }

  /// The error at each sample; sets `error`.
  std::vector<double> measure(const Samples& samples) {
    std::vector<double> errors(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) errors[i] = samples.error((*this)(samples[i].x), i);
    error = *std::max_element(errors.begin(), errors.end());
    return errors;
  }
};

/// Halves the widest spaces between samples until there are `count` of them from the node at `begin` to the next, and
/// returns the error of `fit` there. Next to either end of the curve, where nothing holds a fit from outside, a space
/// counts for more.
double fill_gap(Samples& samples, std::size_t begin, std::size_t count, const Fit& fit) {
  for (double worst = 0;;) {
    std::size_t end = begin + 1, widest = begin;
    while (!samples[end].is_node) ++end;
    if (end - begin > count) return worst;
    const auto space = [&](std::size_t i) {
      return (samples[i + 1].x - samples[i].x) * (i == 0 || i + 2 == samples.size() ? 3 : 1);
    };
    for (std::size_t i = begin + 1; i < end; ++i) {
      if (space(i) > 1.001 * space(widest)) widest = i;
    }
    const std::size_t i = samples.add((samples[widest].x + samples[widest + 1].x) / 2);
    worst = std::max(worst, samples.error(fit(samples[i].x), i));
  }
}

std::size_t place_of_largest(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

/// At least `count` samples in every gap between nodes, and `fresh` more; returns the error of `fit` at those that are
/// new, and stops where it is above `most`.
double fill_gaps(Samples& samples, std::size_t count, std::size_t fresh, const Fit& fit, double most = infinity) {
  double worst = 0;
  for (std::size_t begin = 0; begin + 1 < samples.size() && worst <= most;) {
    std::size_t end = begin + 1;
    while (!samples[end].is_node) ++end;
    worst = std::max(worst, fill_gap(samples, begin, std::max(count, end - begin - 1 + fresh), fit));
    ++begin;
    while (!samples[begin].is_node) ++begin;
  }
  return worst;
}

void fit_weights(const Samples& samples, Fit& fit) {
  if (fit.nodes.size() == 2) {
    fit.weights = {1, -1};  // a straight line
    return;
  }
  std::vector<double> x(samples.size()), f(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) x[i] = samples[i].x, f[i] = samples[i].f;
  fit.weights = rational_weights(x, f, fit.nodes);
}

/// How far a rational fit changes between its nodes when it is fitted to all samples: what one of them does where the
/// other has nothing to go by, such as a pole beside its own zero, shows without an integration.
double change_of_weights(const Samples& samples, const Fit& fit) {
  constexpr int steps = 16;
  Fit other = fit;
  other.take_nodes(samples);
  fit_weights(samples, other);
  double change = 0;
  const auto compare = [&](double t) { change = std::max(change, samples.difference(fit(t), other(t))); };
  for (std::size_t j = 0; j + 1 < fit.x.size(); ++j) {
    for (int step = 1; step < steps; ++step) compare(fit.x[j] + (fit.x[j + 1] - fit.x[j]) * step / steps);
  }
  for (double distance = 0.1; distance > 1e-7; distance /= 2) {
    compare(fit.x.front() + distance);
    compare(fit.x.back() - distance);
  }
  return change;
}

/// The greedy rational fit of the AAA algorithm   [Nakatsukasa, Sète & Trefethen 2018], with samples added between its
/// nodes as it goes [Driscoll, Nakatsukasa & Trefethen 2024]: the sample that it fits worst becomes its next node. When
/// it fits all, it is measured at fresh samples, one or more in every gap.
Fit rational_fit(Samples& samples, double target) {
  constexpr std::size_t patience = 10;  // nodes that need not help
  samples[0].is_node = samples[samples.size() - 1].is_node = true;
  Fit fit{CurveForm::rational}, best = fit;
  std::size_t last_gain = 2;
  bool is_refitted = false;
  for (;;) {
    fit.take_nodes(samples);
    fit_weights(samples, fit);
    std::vector<double> errors = fit.measure(samples);
    const std::size_t broken_gap = pole(fit.x, fit.weights);
    const bool is_whole = broken_gap == fit.x.size();
    if (is_whole && fit.error <= target / 2) {
      double measured = fill_gaps(samples, fitted_between, 1, fit, target);
      if (measured <= target) measured = change_of_weights(samples, fit);
      if (measured <= target) {
        fit.measure(samples);
        fit.error = std::max(fit.error, measured);
        return fit;
      }
      is_refitted = !is_refitted;
      if (is_refitted) continue;  // more samples may be all that it needs
      fit.take_nodes(samples);    // their places have moved
      errors = fit.measure(samples);
    }
    is_refitted = false;
    if (is_whole && fit.error < best.error) {
      if (fit.error < best.error / 2) last_gain = fit.nodes.size();
      best = fit;
    }
    if (samples.broken() != Status::converged || fit.nodes.size() >= most_rational ||
        fit.nodes.size() > last_gain + patience) {
      fit = best;
      break;
    }
    const bool is_close = !is_whole && fit.error <= target / 2;
    samples[is_close ? fit.nodes[broken_gap] + 1 : place_of_largest(errors)].is_node = true;
    fill_gaps(samples, fitted_between, 0, fit);
  }
  fit.measure(samples);
  return fit;
}

/// Every sample is a node and its gaps are halved where the form misses their middles, as long as it may still become
/// better than `to_beat`.
Fit monotone_fit(Samples& samples, double target, double to_beat, std::size_t most_nodes) {
  constexpr std::size_t trial = 129;  // nodes; with more, the error falls at best with their fourth power
  constexpr int patience = 4;         // rounds that need not halve the error
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].is_node = true;
  Fit fit{CurveForm::monotone};
  double halved = infinity;
  for (int idle = 0;; ++idle) {
    fit.take_nodes(samples);
    fit.weights = monotone_slopes(fit.x, fit.f);
    fill_gaps(samples, 1, 0, fit);
    const std::vector<double> errors = fit.measure(samples);
    const std::size_t count = fit.x.size();
    const double hoped_for = fit.error * std::pow(static_cast<double>(count) / static_cast<double>(most_nodes), 4);
    if (fit.error <= target || count >= most_nodes || (count >= trial && hoped_for > to_beat)) return fit;
    if (fit.error <= halved / 2) {
      halved = fit.error;
      idle = 0;
    }
    if (idle >= patience || samples.broken() != Status::converged) return fit;
    std::vector<std::size_t> missed;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (errors[i] > target) missed.push_back(i);
    }
    std::sort(missed.begin(), missed.end(), [&](std::size_t i, std::size_t j) { return errors[i] > errors[j]; });
    missed.resize(std::min(missed.size(), most_nodes - count));
    for (const std::size_t i : missed) samples[i].is_node = true;
  }
}

Fit best_fit(Samples& samples, double target, std::size_t most_nodes) {
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].is_node = false;
  Fit fit = rational_fit(samples, target);
  if (fit.error <= target) return fit;
  Fit other = monotone_fit(samples, target, fit.error, most_nodes);
  fit.measure(samples);
  return fit.error < other.error ? fit : other;
}

}  // namespace

AlbedoCurve::AlbedoCurve(const Model& model, const CurveOptions& options) {
  if (options.most_nodes < fewest_nodes) {
    throw ParameterError("most_nodes is " + std::to_string(options.most_nodes) + " and must be at least " +
                         std::to_string(fewest_nodes));
  }
  const double tolerance = options.albedo.tolerance;
  Samples samples(model, options);
  for (int i = 0; i <= first_gaps; ++i) samples.add(-std::log(last_cosine) * i / first_gaps);
  // Nothing holds a fit from beyond its ends: without these it could leave the nodes there by a jump that no sample
  // sees.
  for (const double x : {0.002, 0.02, 0.2, -std::log(last_cosine) - 0.05}) samples.add(x);

  Fit fit{CurveForm::rational};
  bool logarithmic = true;
  do {  // again if a zero came up
    logarithmic = samples.logarithmic();
    fit = best_fit(samples, measured_share * tolerance, static_cast<std::size_t>(options.most_nodes));
  } while (samples.logarithmic() != logarithmic);
  form_ = fit.form;
  logarithmic_ = samples.logarithmic();
  floor_ = samples.floor();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!std::binary_search(fit.x.begin(), fit.x.end(), samples[i].x)) continue;
    nodes_.push_back({samples[i].cos_theta, samples[i].albedo});
  }
  variable_ = std::move(fit.x);
  values_ = std::move(fit.f);
  weights_ = std::move(fit.weights);

  const Estimate limit = samples.integrate(0), near = samples.integrate(beyond), far = samples.integrate(asymptotic);
  // a = A (c/c₀)^p (1 + b c/c₀) through the last node and the two beyond; p all but follows from these, so that few
  // rounds do.
  const double last = nodes_.back().albedo.value, f = asymptotic / last_cosine, n = beyond / last_cosine;
  double p = 0, b = 0, factor = 0;
  for (int round = 0; round < 4; ++round) {
    p = std::log(far.value * (1 + b * n) / (near.value * (1 + b * f))) / std::log(f / n);
    factor = far.value / (std::pow(f, p) * (1 + b * f));
    b = last / factor - 1;
  }
  constexpr double no_growth = 1e-3;  // what directional_albedo takes for a limit
  if (limit.status == Status::divergent || p > no_growth) {
    grazing_exponent_ = p;
    grazing_factor_ = factor;
    grazing_value_ = limit.status == Status::divergent ? infinity : 0;
  } else {
    grazing_factor_ = grazing_value_ = limit.value;
  }
  double error = fit.error, node_error = samples.worst_node_error();
  const Node between{std::sqrt(last_cosine * asymptotic), samples.integrate(std::sqrt(last_cosine * asymptotic))};
  for (const Node& node : {between, Node{asymptotic, far}, Node{beyond, near}}) {
    error = std::max(error, samples.relative((*this)(node.cos_theta) - node.albedo.value, node.albedo.value));
    node_error = std::max(node_error, samples.relative(node.albedo.error, node.albedo.value));
  }

  relative_bound_ = unmeasured * error + node_error + rounding;
  evaluations_ = samples.evaluations();
  integrations_ = samples.integrations();
  if (!(relative_bound_ <= tolerance)) status_ = samples.missed();
  if (samples.broken() != Status::converged) {
    relative_bound_ = infinity;
    status_ = samples.broken();
  }
}

double AlbedoCurve::operator()(double cos_theta) const {
  const double x = -std::log(cos_theta);
  if (x > variable_.back()) {
    if (cos_theta == 0) return grazing_value_;
    const double ratio = cos_theta / nodes_.back().cos_theta;
    const double a = grazing_factor_ + (nodes_.back().albedo.value - grazing_factor_) * ratio;
    return grazing_exponent_ == 0 ? a : a * std::pow(ratio, grazing_exponent_);
  }
  const double f = form_ == CurveForm::rational ? rational(variable_, values_, weights_, x)
                                                : monotone(variable_, values_, weights_, x);
  return logarithmic_ ? std::exp(f) : f;
}

double AlbedoCurve::upper(double cos_theta) const {
  const double a = (*this)(cos_theta);
  if (!(relative_bound_ < 1)) return infinity;
  return a + relative_bound_ / (1 - relative_bound_) *
                 std::max(a, floor_);  // the bound is relative to the albedo, not to a
}

double AlbedoCurve::average() const {
  double sum = 0, upper = 1;
  for (std::size_t i = 0; i <= nodes_.size(); ++i) {
    const double lower = i < nodes_.size() ? nodes_[i].cos_theta : 0;
    if (lower == upper) continue;
    sum += boost::math::quadrature::gauss<double, 15>::integrate([&](double c) { return 2 * c * (*this)(c); }, lower,
                                                                 upper);
    upper = lower;
  }
  return sum;
}

}  // namespace albedo
