#include "rules/stratified.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "rules/conclusion.hpp"
#include "rules/random.hpp"

namespace albedo {
namespace {

class Replicates {
 public:
  Replicates(const Integrand<double>& integrand, std::uint64_t seed) : integrand_(integrand), stream_(seed) {}

  /// The integral from n × n strata a panel; adds the squares of w.
  double run(std::uint32_t replicate, std::uint32_t n, Squares& squares) {
    double total = 0;
    u_.resize(n);
    v_.resize(n);
    w_.resize(n);
    for (std::size_t panel = 0; panel < integrand_.panels().size(); ++panel) {
      double sum = 0;
      for (std::uint32_t row = 0; row < n; ++row) {
        for (std::uint32_t column = 0; column < n; ++column) {
          const auto [a, b] =
              stream_.uniform_pair({{row, column, replicate + (static_cast<std::uint32_t>(panel) << 8), n}});
          u_[column] = (column + a) / n;
          v_[column] = (row + b) / n;
        }
        integrand_.points(static_cast<int>(panel), u_.data(), v_.data(), w_.data(), static_cast<int>(n));
        for (const double w : w_) {
          sum += w;
          squares.add(w);
        }
      }
      total += sum / (static_cast<double>(n) * n);
    }
    return total;
  }

 private:
  const Integrand<double>& integrand_;
  RandomStream stream_;
  std::vector<double> u_, v_, w_;
};

}  // namespace

Estimate stratified(const Integrand<double>& integrand, const RuleOptions& options) {
  constexpr double first_size = 8;  // fewer strata are a look, and no answer
  Replicates replicates(integrand, options.seed);
  const auto panels = static_cast<double>(integrand.panels().size());
  const auto cost = [&](double n) { return n * n * replicate_count * panels; };
  Estimate estimate = unaffordable(ErrorKind::standard_error);
  const auto affordable = [&] {
    return std::floor(std::sqrt(static_cast<double>(options.budget - estimate.evaluations) / cost(1)));
  };
  double n = panels > 0 ? std::min(first_size, affordable()) : first_size;
  while (n >= 1 && static_cast<double>(estimate.evaluations) + cost(n) <= static_cast<double>(options.budget)) {
    const auto size = static_cast<std::uint32_t>(n);
    std::array<double, replicate_count> values{};
    Squares squares;
    for (std::uint32_t i = 0; i < replicate_count; ++i) values[i] = replicates.run(i, size, squares);
    const auto [mean, standard_error] = statistics(values);
    estimate.evaluations += static_cast<std::int64_t>(cost(size));
    const bool seen = every_feature(
        integrand, [n](const Feature& feature) { return std::min(feature.width_u, feature.width_v) * n >= 1; });
    const bool believable = seen && n >= first_size && !squares.dominated();
    if (conclude(estimate, mean, standard_error, believable, integrand, options)) return estimate;
    // the error falls at least like 1/n; jump to where it should be met, with some margin
    const double target = options.tolerance * std::abs(mean);
    const double wanted = target > 0 ? 1.2 * n * estimate.error / target : 2 * n;
    const double largest = affordable();
    n = std::ceil(std::clamp(seen ? wanted : 4 * n, 1.5 * n, 8 * n));
    if (n > largest && largest >= 2 * size) n = largest;
  }
  return estimate;
}

}  // namespace albedo
