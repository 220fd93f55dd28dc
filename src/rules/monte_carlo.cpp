#include "rules/monte_carlo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "rules/conclusion.hpp"
#include "rules/random.hpp"

namespace albedo {
namespace {

/// Mean and squared deviations of a panel's values, merged batch by batch [Chan, Golub & LeVeque 1983].
struct Moments {
  double count = 0, mean = 0, squares = 0;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;

  void add(const double* values, int batch) {
    const double n = batch;
    double sum = 0, batch_squares = 0;
    for (int i = 0; i < batch; ++i) sum += values[i];
    const double batch_mean = sum / n;
    for (int i = 0; i < batch; ++i) batch_squares += (values[i] - batch_mean) * (values[i] - batch_mean);
    lowest = std::min(lowest, *std::min_element(values, values + batch));
    highest = std::max(highest, *std::max_element(values, values + batch));
    const double difference = batch_mean - mean;
    squares += batch_squares + difference * difference * (count * n / (count + n));
    mean += difference * (n / (count + n));
    count += n;
  }

  /// What the point farthest from the mean has of the squares.
  [[nodiscard]] double largest_square() const {
    return std::max((highest - mean) * (highest - mean), (mean - lowest) * (mean - lowest));
  }
};

/// Adds points `begin` to `end` of a panel.
void draw(const Integrand<double>& integrand, std::size_t panel, std::uint64_t begin, std::uint64_t end,
          const RandomStream& stream, Moments& moments) {
  constexpr std::uint64_t batch = 512;
  std::array<double, batch> u{}, v{}, w{};
  for (std::uint64_t first = begin; first < end; first += batch) {
    const std::uint64_t count = std::min(batch, end - first);
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t index = first + i;
      const auto [a, b] =
          stream.uniform_pair({{static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32),
                                static_cast<std::uint32_t>(panel), monte_carlo_stream}});
      u[i] = a;
      v[i] = b;
    }
    integrand.points(static_cast<int>(panel), u.data(), v.data(), w.data(), static_cast<int>(count));
    moments.add(w.data(), static_cast<int>(count));
  }
}

}  // namespace

Estimate monte_carlo(const Integrand<double>& integrand, const RuleOptions& options) {
  constexpr std::int64_t first_size = 1024;
  constexpr double points_in_feature = 64;  // a feature is 2 × 2 of its widths: 4 × 64 points
  Estimate estimate = unaffordable(ErrorKind::standard_error);
  const auto panels = static_cast<std::int64_t>(integrand.panels().size());
  if (panels == 0) return {0, 0, ErrorKind::standard_error, 0, Status::converged};
  const RandomStream stream(options.seed);
  const std::int64_t most = options.budget / panels;
  std::vector<Moments> moments(static_cast<std::size_t>(panels));
  std::int64_t n = 0, next = std::min(first_size, most);
  while (next >= 2 && next > n) {
    double value = 0, variance = 0;
    Squares squares;
    for (std::size_t panel = 0; panel < moments.size(); ++panel) {
      Moments& m = moments[panel];
      draw(integrand, panel, static_cast<std::uint64_t>(n), static_cast<std::uint64_t>(next), stream, m);
      value += m.mean;
      variance += m.squares / (m.count * (m.count - 1));
      squares.sum += m.squares;
      squares.largest = std::max(squares.largest, m.largest_square());
    }
    n = next;
    estimate.evaluations = n * panels;
    const bool seen = every_feature(integrand, [n](const Feature& feature) {
      return static_cast<double>(n) * feature.width_u * feature.width_v >= points_in_feature;
    });
    const bool believable = seen && n >= first_size && !squares.dominated();
    if (conclude(estimate, value, std::sqrt(variance), believable, integrand, options)) return estimate;
    const double target = options.tolerance * std::abs(value);
    const double ratio = believable && target > 0 ? 1.1 * estimate.error / target : 2;
    const double wanted = static_cast<double>(n) * std::clamp(ratio * ratio, 2.0, 16.0);
    next = wanted < static_cast<double>(most) ? static_cast<std::int64_t>(wanted) : most;
  }
  return estimate;
}

}  // namespace albedo
