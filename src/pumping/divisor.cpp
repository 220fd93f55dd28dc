#include <algorithm>
#include <array>
#include <cmath>

#include "albedo/pumping.hpp"
#include "pumping/chebyshev.hpp"

namespace albedo {

std::string_view to_string(PumpControl control) {
  switch (control) {
    case PumpControl::none:
      return "none";
    case PumpControl::step:
      return "step";
    case PumpControl::total:
      break;
  }
  return "total";
}

/// The Chebyshev polynomials at x's place in its panel; returns the panel.
std::size_t PumpDivisor::basis(double x, double* values) const {
  x = std::clamp(x, 0.0, last_x);
  const auto above = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, x);
  const auto panel = static_cast<std::size_t>(above - edges_.begin()) - 1;
  const double t = 2 * (x - edges_[panel]) / (edges_[panel + 1] - edges_[panel]) - 1;
  values[0] = 1, values[1] = t;
  for (int k = 2; k < terms; ++k) values[k] = 2 * t * values[k - 1] - values[k - 2];
  return panel;
}

double PumpDivisor::log_albedo(int order, double x) const {
  std::array<double, terms> t;
  const double* c = expansions_[basis(x, t.data())].data() + std::ptrdiff_t{order} * terms;
  double sum = 0;
  for (std::size_t k = 0; k < t.size(); ++k) sum += c[k] * t[k];
  return sum;
}

void PumpDivisor::log_albedos(double x, double* values) const {
  std::array<double, terms> t;
  const double* c = expansions_[basis(x, t.data())].data();
  for (int order = 0; order < orders_; ++order, c += terms) {
    double sum = 0;
    for (std::size_t k = 0; k < t.size(); ++k) sum += c[k] * t[k];
    values[order] = sum;
  }
}

double PumpDivisor::log_divisor(int k, double x_l, double x_v) const {
  std::array<double, terms> t_l, t_v;
  const double* l = expansions_[basis(x_l, t_l.data())].data();
  const double* v = expansions_[basis(x_v, t_v.data())].data();
  double sum = 0;
  for (int order = 0; order < k; ++order, l += terms, v += terms) {
    double log_l = 0, log_v = 0;
    for (std::size_t i = 0; i < t_l.size(); ++i) log_l += l[i] * t_l[i], log_v += v[i] * t_v[i];
    sum = step(sum, log_l, log_v, x_l, x_v);
  }
  return sum;
}

void PumpDivisor::add_order(const std::vector<double>& expansions) {
  for (std::size_t panel = 0; panel < expansions_.size(); ++panel) {
    const auto first = expansions.begin() + static_cast<std::ptrdiff_t>(panel) * terms;
    expansions_[panel].insert(expansions_[panel].end(), first, first + terms);
  }
  ++orders_;
}

void PumpDivisor::raise_last(double by) {
  for (Expansion& expansion : expansions_) expansion[static_cast<std::size_t>((orders_ - 1) * terms)] += by;
}

void PumpDivisor::split(std::size_t panel, double x) {
  const double begin = edges_[panel], end = edges_[panel + 1];
  std::array<Expansion, 2> halves;
  for (int order = 0; order < orders_; ++order) {
    for (std::size_t half = 0; half < 2; ++half) {
      std::array<double, terms> values;
      for (int i = 0; i < terms; ++i) {
        values[static_cast<std::size_t>(i)] = log_albedo(order, lobatto(half == 0 ? begin : x, half == 0 ? x : end, i));
      }
      const auto expansion = chebyshev_expansion(values);
      halves[half].insert(halves[half].end(), expansion.begin(), expansion.end());
    }
  }
  expansions_[panel] = std::move(halves[0]);
  expansions_.insert(expansions_.begin() + static_cast<std::ptrdiff_t>(panel) + 1, std::move(halves[1]));
  edges_.insert(edges_.begin() + static_cast<std::ptrdiff_t>(panel) + 1, x);
}

}  // namespace albedo
