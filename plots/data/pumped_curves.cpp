#include "plots/data/pumped_curves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/parallel.hpp"

namespace albedo::analysis {
namespace {

constexpr double horizon_cosine = 1e-30;  // stands for 90 degrees

Direction direction_of(double theta, double phi = 0) {
  return theta < 90 ? Direction::from_degrees(theta, phi) : Direction::from_cosine(horizon_cosine, phi);
}

double x_of(const Direction& direction) { return -std::log(direction.cos_theta); }

/// f cosθ_L of order k; negative views are on the side of L.
class Radiance {
 public:
  Radiance(const Model& model, const PumpDivisor& divisor) : model_(model), divisor_(divisor) {}

  [[nodiscard]] double operator()(int order, double theta_l, double view) const {
    const Direction l = direction_of(theta_l), v = direction_of(std::abs(view), view < 0 ? 0 : 180);
    return brdf<double>(model_, l, v) * l.cos_theta * std::exp(-divisor_.log_divisor(order, x_of(l), x_of(v)));
  }

  /// The largest one over V: the best of a grid that has the mirror direction, then a search beside it.
  [[nodiscard]] double peak(int order, double theta_l) const {
    double best = theta_l, most = (*this)(order, theta_l, theta_l);
    const auto look = [&](double view) {
      const double here = (*this)(order, theta_l, view);
      if (here > most) most = here, best = view;
    };
    for (double view = -90; view <= 90; view += 1) look(view);
    for (double step = 0.5; step > 1e-7;) {
      const double before = most, from = best;
      look(std::min(from + step, 90.0));
      look(std::max(from - step, -90.0));
      if (!(most > before)) step /= 2;
    }
    return most;
  }

 private:
  const Model& model_;
  const PumpDivisor& divisor_;
};

}  // namespace

PumpedCurves pumped_curves(const Model& model, const PumpOptions& options, std::vector<double> incidences) {
  PumpSequence sequence(model, options.control, options.only_up, options.tolerance);
  for (int k = 0; k < options.times; ++k) sequence.advance();
  const auto orders = static_cast<std::size_t>(options.times) + 1;

  PumpedCurves curves{.incidences = std::move(incidences), .status = sequence.status()};
  for (int i = 0; i <= 180; ++i) curves.thetas.push_back(0.5 * i);
  for (int i = -180; i <= 180; ++i) curves.views.push_back(0.5 * i);
  curves.albedo.assign(orders, std::vector<double>(curves.thetas.size()));
  curves.peak = curves.albedo;
  curves.radiance.assign(curves.incidences.size(),
                         std::vector<std::vector<double>>(orders, std::vector<double>(curves.views.size())));
  const Radiance radiance(model, sequence.divisor());
  in_parallel(orders, 0, [&](std::size_t k) {
    const int order = static_cast<int>(k);
    for (std::size_t i = 0; i < curves.thetas.size(); ++i) {
      curves.albedo[k][i] = sequence.albedo(order, direction_of(curves.thetas[i]).cos_theta);
      curves.peak[k][i] = radiance.peak(order, curves.thetas[i]);
    }
    for (std::size_t j = 0; j < curves.incidences.size(); ++j) {
      for (std::size_t i = 0; i < curves.views.size(); ++i) {
        curves.radiance[j][k][i] = radiance(order, curves.incidences[j], curves.views[i]);
      }
    }
  });
  for (std::size_t k = 0; k < orders; ++k)
    curves.relative_bound.push_back(sequence.relative_bound(static_cast<int>(k)));
  return curves;
}

}  // namespace albedo::analysis
