#include "albedo/rules/stratified.hpp"

#include <Random123/philox.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace albedo {
namespace {

/// Two numbers in (0, 1) with 53 bits each, from a counter and a key.
void uniform_pair(const r123::Philox4x32::ctr_type& counter, const r123::Philox4x32::key_type& key, double& a,
                  double& b) {
  const r123::Philox4x32::ctr_type bits = r123::Philox4x32{}(counter, key);
  constexpr double unit = 0x1p-53;
  const auto open = [](std::uint32_t high, std::uint32_t low) {
    return (static_cast<double>((std::uint64_t{high} << 21) ^ (low >> 11)) + 0.5) * unit;
  };
  a = open(bits[0], bits[1]);
  b = open(bits[2], bits[3]);
}

class Replicates {
 public:
  Replicates(const Integrand<double>& integrand, std::uint64_t seed)
      : integrand_(integrand), key_{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}} {}

  /// The integral from n × n strata a panel.
  double run(std::uint32_t replicate, std::uint32_t n) {
    double total = 0;
    u_.resize(n);
    v_.resize(n);
    w_.resize(n);
    for (std::size_t panel = 0; panel < integrand_.panels().size(); ++panel) {
      double sum = 0;
      for (std::uint32_t row = 0; row < n; ++row) {
        for (std::uint32_t column = 0; column < n; ++column) {
          const r123::Philox4x32::ctr_type counter{
              {row, column, replicate + (static_cast<std::uint32_t>(panel) << 8), n}};
          double a = 0, b = 0;
          uniform_pair(counter, key_, a, b);
          u_[column] = (column + a) / n;
          v_[column] = (row + b) / n;
        }
        integrand_.points(static_cast<int>(panel), u_.data(), v_.data(), w_.data(), static_cast<int>(n));
        for (const double w : w_) sum += w;
      }
      total += sum / (static_cast<double>(n) * n);
    }
    return total;
  }

 private:
  const Integrand<double>& integrand_;
  r123::Philox4x32::key_type key_;
  std::vector<double> u_, v_, w_;
};

/// Whether every known feature is at least as wide as a stratum.
bool features_met(const Integrand<double>& integrand, std::uint32_t n) {
  return std::all_of(integrand.panels().begin(), integrand.panels().end(), [n](const Panel& panel) {
    return std::all_of(panel.features.begin(), panel.features.end(),
                       [n](const Feature& feature) { return std::min(feature.width_u, feature.width_v) * n >= 1; });
  });
}

}  // namespace

Estimate stratified(const Integrand<double>& integrand, const RuleOptions& options) {
  Replicates replicates(integrand, options.seed);
  const auto panels = static_cast<double>(integrand.panels().size());
  const auto cost = [&](double n) { return n * n * replicate_count * panels; };
  Estimate estimate{0, 0, ErrorKind::standard_error, 0, Status::budget_exhausted};
  double n = 8;
  while (estimate.evaluations == 0 ||
         static_cast<double>(estimate.evaluations) + cost(n) <= static_cast<double>(options.budget)) {
    const auto size = static_cast<std::uint32_t>(n);
    std::array<double, replicate_count> values{};
    for (std::uint32_t i = 0; i < replicate_count; ++i) values[i] = replicates.run(i, size);
    double mean = 0, squares = 0;
    for (const double value : values) mean += value / replicate_count;
    for (const double value : values) squares += (value - mean) * (value - mean);
    estimate.value = mean;
    estimate.error =
        std::sqrt(squares / (replicate_count * (replicate_count - 1))) + integrand.truncation() * std::abs(mean);
    estimate.evaluations += static_cast<std::int64_t>(cost(size));
    if (!std::isfinite(mean)) {
      estimate.status = Status::non_finite;
      return estimate;
    }
    const double target = options.tolerance * std::abs(mean);
    const bool met = features_met(integrand, size);
    if (met && estimate.error <= target) {
      estimate.status = Status::converged;
      return estimate;
    }
    // the error falls at least like 1/n; jump to where it should be met, with some margin
    const double wanted = target > 0 ? 1.2 * n * estimate.error / target : 2 * n;
    const double largest = std::floor(
        std::sqrt((static_cast<double>(options.budget - estimate.evaluations)) / (replicate_count * panels)));
    n = std::ceil(std::clamp(met ? wanted : 4 * n, 1.5 * n, 8 * n));
    if (n > largest && largest >= 2 * size) n = largest;
  }
  return estimate;
}

}  // namespace albedo
