#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>

#include "audit/parts.hpp"

namespace albedo {
namespace {

constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

/// −ln cosθ of the directions to begin with.
std::vector<double> grid() {
  std::vector<double> all;
  for (int theta = 0; theta <= 84; theta += 4) all.push_back(-std::log(std::cos(theta * pi<double> / 180)));
  for (double x = all.back() + 0.5; x < 27; x += all.size() < 34 ? 0.5 : 2) all.push_back(x);
  return all;
}

class Search {
 public:
  Search(const Model& model, const AlbedoOptions& options) : model_(model), options_(options) {}

  /// Looks at the whole way from normal to grazing incidence, and then closer around the largest.
  void look(double phi) {
    static const std::vector<double> all = grid();
    std::size_t best = 0;
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double value = look(all[i], phi).value;
      if (value > largest) largest = value, best = i;
    }
    const Direction grazing = Direction::from_cosine(0, phi);
    if (look(grazing, phi).value > largest) return;
    refine(all[best > 0 ? best - 1 : 0], all[std::min(best + 1, all.size() - 1)], phi);
  }

  /// Turns around at the largest's polar angle, and looks along its meridian again.
  void refine_azimuth(double step) {
    if (!std::isfinite(found_.largest.value) || found_.theta_degrees >= 90) return;
    const double x = -std::log(Direction::from_degrees(found_.theta_degrees).cos_theta);
    const double left = std::max(found_.phi_degrees - step, 0.0), right = std::min(found_.phi_degrees + step, 90.0);
    minimise([&](double phi) { return -look(x, phi).value; }, left, right);
    refine(std::max(x - 0.1, 0.0), x + 0.1, found_.phi_degrees);
  }

  [[nodiscard]] EnergyAudit found() const { return found_; }
  /// Whether an albedo that missed its tolerance may be above 1, or infinite.
  [[nodiscard]] bool perhaps_above() const { return perhaps_above_; }
  [[nodiscard]] bool perhaps_unbounded() const { return perhaps_unbounded_; }

 private:
  template <class F>
  static void minimise(F f, double left, double right) {
    constexpr int bits = 18;
    std::uintmax_t iterations = 24;
    boost::math::tools::brent_find_minima(f, left, right, bits, iterations);
  }
  void refine(double left, double right, double phi) {
    minimise([&](double x) { return -look(x, phi).value; }, left, right);
  }
  Estimate look(double minus_log, double phi) {
    return look(Direction::from_cosine(std::min(std::exp(-minus_log), 1.0), phi), phi);
  }

  Estimate look(const Direction& l, double phi) {
    Estimate a = directional_albedo(model_, l, options_);
    constexpr double slight = 1e-3;
    if (a.value - a.error > 1 + rounding && a.value < 1 + slight && a.status == Status::converged) confirm(l, a);
    if (a.status != Status::converged && a.status != Status::divergent) {
      ++found_.unconverged;
      perhaps_above_ = perhaps_above_ || !(a.value + a.error <= 1);
      perhaps_unbounded_ = perhaps_unbounded_ || !std::isfinite(a.value + a.error);
    }
    if (std::isnan(a.value)) return a;
    if (!any_ || a.value > found_.largest.value) {
      found_.largest = a;
      found_.theta_degrees = l.theta_degrees();
      found_.phi_degrees = phi;
    }
    any_ = true;
    return a;
  }

  /// A small excess is no finding unless another rule finds it too.
  void confirm(const Direction& l, Estimate& a) const {
    AlbedoOptions other = options_;
    other.rule = options_.rule == Rule::kronrod ? Rule::gauss : Rule::kronrod;
    const Estimate second = directional_albedo(model_, l, other);
    const double doubt = second.status == Status::converged ? 0 : second.error;
    a.error = std::max(a.error, std::abs(a.value - second.value) + doubt);
  }

  const Model& model_;
  AlbedoOptions options_;
  EnergyAudit found_;
  bool any_ = false, perhaps_above_ = false, perhaps_unbounded_ = false;
};

/// 4 ∫ a(t²) t³ dt over [0, 1] at one azimuth: in t = √μ a square root at grazing incidence is no corner.
Estimate mean_over_cosines(const Model& model, double phi, const AlbedoOptions& options) {
  using Rule21 = boost::math::quadrature::gauss_kronrod<double, 21>;
  using Rule10 = boost::math::quadrature::gauss<double, 10>;
  Estimate mean{.error_kind = ErrorKind::rule_difference};
  double gauss_sum = 0;
  const auto& nodes = Rule21::abscissa();
  const auto& weights = Rule21::weights();
  const auto& gauss_weights = Rule10::weights();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const double sign : {-1.0, 1.0}) {
      if (nodes[i] == 0 && sign < 0) continue;
      const double t = (1 + sign * nodes[i]) / 2;
      const Estimate a = directional_albedo(model, Direction::from_cosine(t * t, phi), options);
      mean.evaluations += a.evaluations;
      if (a.status != Status::converged) mean.status = a.status;
      const double scale = 2 * t * t * t;
      mean.value += weights[i] * scale * a.value;
      mean.error += weights[i] * scale * a.error;
      if (i % 2 == 1) gauss_sum += gauss_weights[i / 2] * scale * a.value;  // 10 nodes: every second, without 0
    }
  }
  mean.error += std::abs(mean.value - gauss_sum);
  return mean;
}

}  // namespace

std::vector<double> azimuths_of(const Model& model) {
  if (model.claims().isotropic) return {0};
  return {0, 15, 30, 45, 60, 75, 90};
}

EnergyAudit audit_energy(const Model& model, const AlbedoOptions& options) {
  const std::vector<double> azimuths = azimuths_of(model);
  Search search(model, options);
  for (const double phi : azimuths) search.look(phi);
  if (azimuths.size() > 1) search.refine_azimuth(azimuths[1]);

  EnergyAudit energy = search.found();
  const Estimate& largest = energy.largest;
  const bool diverges = !std::isfinite(largest.value);
  const bool above = diverges || largest.value - largest.error > 1 + rounding;
  if (largest.value > 1) {
    std::vector<double> all = azimuths;
    if (std::find(all.begin(), all.end(), energy.phi_degrees) == all.end()) all.push_back(energy.phi_degrees);
    for (const double phi : all) {
      const double place = phi == energy.phi_degrees ? Direction::from_degrees(energy.theta_degrees).cos_theta : 0;
      const Crossing crossing =
          critical_angle(model, {.phi_degrees = phi, .tolerance = options.tolerance, .budget = options.budget}, place);
      if (!crossing.exists || (energy.critical && energy.critical->cos_theta >= crossing.cos_theta)) continue;
      energy.critical = crossing;
      energy.critical_phi_degrees = phi;
    }
  }
  const Claims claims = model.claims();
  energy.verdict = !claims.conserves_energy ? Verdict::not_claimed
                   : above                  ? Verdict::fails
                   : search.perhaps_above() ? Verdict::undecided
                                            : Verdict::pass;
  energy.bounded = !claims.bounded              ? Verdict::not_claimed
                   : diverges                   ? Verdict::fails
                   : search.perhaps_unbounded() ? Verdict::undecided
                                                : Verdict::pass;
  return energy;
}

AverageAudit audit_average(const Model& model, const AlbedoOptions& options) {
  if (model.claims().isotropic) return {mean_over_cosines(model, 0, options)};
  // the middles of thirds are every third of the middles of ninths
  AverageAudit average;
  Estimate& mean = average.albedo;
  mean.error_kind = ErrorKind::rule_difference;
  double coarse = 0;
  for (int i = 0; i < 9; ++i) {
    const Estimate one = mean_over_cosines(model, 5.0 + 10 * i, options);
    mean.value += one.value / 9;
    mean.error += one.error / 9;
    mean.evaluations += one.evaluations;
    if (one.status != Status::converged) mean.status = one.status;
    if (i % 3 == 1) coarse += one.value / 3;
  }
  mean.error += std::abs(mean.value - coarse);
  return average;
}

}  // namespace albedo
