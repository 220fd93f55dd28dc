#include "albedo/cosine_tables.hpp"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/cos_pi.hpp>
#include <cmath>

namespace albedo {

CosineTables::CosineTables() : edges_{0, 0.5, 1.2, 2.5, 5, 10, 23, 60, last_x}, expansions_(edges_.size() - 1) {}

std::size_t CosineTables::panel_of(double x) const {
  const auto above = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, x);
  return static_cast<std::size_t>(above - edges_.begin()) - 1;
}

const double* CosineTables::expansions_at(double x, double* polynomials) const {
  x = std::clamp(x, 0.0, last_x);
  const std::size_t panel = panel_of(x);
  const double begin = std::sqrt(edges_[panel]), end = std::sqrt(edges_[panel + 1]);
  const double t = (2 * std::sqrt(x) - (begin + end)) / (end - begin);
  polynomials[0] = 1, polynomials[1] = t;
  for (int k = 2; k < terms; ++k) polynomials[k] = 2 * t * polynomials[k - 1] - polynomials[k - 2];
  return expansions_[panel].data();
}

double CosineTables::log(int k, double x) const {
  std::array<double, terms> t;
  const double* c = expansions_at(x, t.data()) + std::ptrdiff_t{k} * terms;
  double sum = 0;
  for (std::size_t i = 0; i < t.size(); ++i) sum += c[i] * t[i];
  return sum;
}

Block CosineTables::log(int k, const Block& x) const {
  const std::size_t panel = panel_of(x[0]);
  const double begin = edges_[panel], end = edges_[panel + 1];
  if (!all(x >= Block(begin)) || !all(x <= Block(end))) return Block::generate([&](int i) { return log(k, x[i]); });
  const double root_begin = std::sqrt(begin), root_end = std::sqrt(end);
  const Block t = (2 * sqrt(x) - (root_begin + root_end)) / (root_end - root_begin);
  const double* c = expansions_[panel].data() + std::ptrdiff_t{k} * terms;
  Block after = 0, sum = 0;  // Clenshaw's recurrence
  for (int i = terms - 1; i > 0; --i) {
    const Block next = c[i] + 2 * t * sum - after;
    after = sum, sum = next;
  }
  return c[0] + t * sum - after;
}

void CosineTables::logs(double x, double* values) const {
  std::array<double, terms> t;
  const double* c = expansions_at(x, t.data());
  for (int k = 0; k < count_; ++k, c += terms) {
    double sum = 0;
    for (std::size_t i = 0; i < t.size(); ++i) sum += c[i] * t[i];
    values[k] = sum;
  }
}

void CosineTables::add(const std::vector<double>& expansions) {
  for (std::size_t panel = 0; panel < expansions_.size(); ++panel) {
    const auto first = expansions.begin() + static_cast<std::ptrdiff_t>(panel) * terms;
    expansions_[panel].insert(expansions_[panel].end(), first, first + terms);
  }
  ++count_;
}

void CosineTables::replace_last(const std::vector<double>& expansions) {
  for (Expansion& expansion : expansions_) expansion.resize(static_cast<std::size_t>((count_ - 1) * terms));
  --count_;
  add(expansions);
}

void CosineTables::raise_last(double by) {
  for (Expansion& expansion : expansions_) expansion[static_cast<std::size_t>((count_ - 1) * terms)] += by;
}

void CosineTables::split(std::size_t panel, double x) {
  const double begin = edges_[panel], end = edges_[panel + 1];
  std::array<Expansion, 2> halves;
  for (int k = 0; k < count_; ++k) {
    for (std::size_t half = 0; half < 2; ++half) {
      std::array<double, terms> values;
      for (int i = 0; i < terms; ++i) {
        values[static_cast<std::size_t>(i)] = log(k, node(half == 0 ? begin : x, half == 0 ? x : end, i));
      }
      const auto through = expansion(values);
      halves[half].insert(halves[half].end(), through.begin(), through.end());
    }
  }
  expansions_[panel] = std::move(halves[0]);
  expansions_.insert(expansions_.begin() + static_cast<std::ptrdiff_t>(panel) + 1, std::move(halves[1]));
  edges_.insert(edges_.begin() + static_cast<std::ptrdiff_t>(panel) + 1, x);
}

double CosineTables::place(double begin, double end, double t) {
  const double root = (std::sqrt(begin) * (1 - t) + std::sqrt(end) * (1 + t)) / 2;
  return root * root;
}

double CosineTables::node(double begin, double end, int i) {
  if (i == 0) return begin;
  if (i == terms - 1) return end;
  return place(begin, end, -boost::math::cos_pi(static_cast<double>(i) / (terms - 1)));
}

std::array<double, CosineTables::terms> CosineTables::expansion(const std::array<double, terms>& values) {
  constexpr int n = terms - 1;
  static const auto transform = [] {
    std::array<std::array<double, n + 1>, n + 1> matrix;
    for (int k = 0; k <= n; ++k) {
      for (int i = 0; i <= n; ++i) {  // cos(kπ(n − i)/n), since the points ascend; halved at the ends of either index
        const double half_i = i == 0 || i == n ? 0.5 : 1, half_k = k == 0 || k == n ? 0.5 : 1;
        matrix[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] =
            2.0 / n * half_i * half_k * boost::math::cos_pi(static_cast<double>(k * (n - i) % (2 * n)) / n);
      }
    }
    return matrix;
  }();
  std::array<double, n + 1> coefficients{};
  for (std::size_t k = 0; k <= n; ++k) {
    for (std::size_t i = 0; i <= n; ++i) coefficients[k] += transform[k][i] * values[i];
  }
  return coefficients;
}

double CosineTables::sum(const std::array<double, terms>& expansion, double t) {
  double total = 0, previous = t, current = 1;
  for (const double c : expansion) {
    total += c * current;
    const double next = 2 * t * current - previous;
    previous = current, current = next;
  }
  return total;
}

}  // namespace albedo
