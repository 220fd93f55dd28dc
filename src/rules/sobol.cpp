#include "rules/sobol.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "rules/conclusion.hpp"
#include "rules/random.hpp"

namespace albedo {
namespace {

// A coordinate's binary digits are kept in the order of an integer's bits: the leading digit (1/2) is bit 0. The first
// coordinate of Sobol's sequence, van der Corput's, then is the index itself.

/// The second coordinate: digit i is the sum over the index's bits j of C(j, i), modulo 2. By Lucas C(j, i) is odd
/// where the bits of i are among those of j, so that it is a sum over supersets.
std::uint64_t second_digits(std::uint64_t index) {
  index ^= (index >> 1) & 0x5555'5555'5555'5555;
  index ^= (index >> 2) & 0x3333'3333'3333'3333;
  index ^= (index >> 4) & 0x0F0F'0F0F'0F0F'0F0F;
  index ^= (index >> 8) & 0x00FF'00FF'00FF'00FF;
  index ^= (index >> 16) & 0x0000'FFFF'0000'FFFF;
  index ^= (index >> 32) & 0x0000'0000'FFFF'FFFF;
  return index;
}

std::uint64_t reversed(std::uint64_t bits) {
  bits = ((bits & 0x5555'5555'5555'5555) << 1) | ((bits >> 1) & 0x5555'5555'5555'5555);
  bits = ((bits & 0x3333'3333'3333'3333) << 2) | ((bits >> 2) & 0x3333'3333'3333'3333);
  bits = ((bits & 0x0F0F'0F0F'0F0F'0F0F) << 4) | ((bits >> 4) & 0x0F0F'0F0F'0F0F'0F0F);
  bits = ((bits & 0x00FF'00FF'00FF'00FF) << 8) | ((bits >> 8) & 0x00FF'00FF'00FF'00FF);
  bits = ((bits & 0x0000'FFFF'0000'FFFF) << 16) | ((bits >> 16) & 0x0000'FFFF'0000'FFFF);
  return (bits << 32) | (bits >> 32);
}

/// A random nested permutation of digits: sums and products modulo 2^64 change a bit by the bits below it only, which
/// are the digits before it.
class Scramble {
 public:
  Scramble(const RandomStream& stream, std::uint32_t replicate, std::uint32_t panel, std::uint32_t axis) {
    for (std::uint32_t i = 0; i < rounds; ++i) {
      const auto [shift, factor] = stream.bits({{replicate, panel, axis * rounds + i, sobol_stream}});
      shifts_[i] = shift;
      factors_[i] = factor & ~std::uint64_t{1};  // even: a bit isn't changed by itself
    }
  }

  /// The coordinate in (0, 1) of these digits.
  [[nodiscard]] double operator()(std::uint64_t digits) const {
    for (std::size_t i = 0; i < rounds; ++i) {
      digits += shifts_[i];
      digits ^= digits * factors_[i];
    }
    return RandomStream::unit(reversed(digits));
  }

 private:
  static constexpr std::uint32_t rounds = 4;
  std::array<std::uint64_t, rounds> shifts_{}, factors_{};
};

/// The sum of w (and its squares) over points `begin` to `end` of one replicate in one panel.
double sum(const Integrand<double>& integrand, const RandomStream& stream, std::uint32_t replicate, std::uint32_t panel,
           std::uint64_t begin, std::uint64_t end, Squares& squares) {
  constexpr std::uint64_t batch = 512;
  const Scramble along_u(stream, replicate, panel, 0), along_v(stream, replicate, panel, 1);
  std::array<double, batch> u{}, v{}, w{};
  double total = 0;
  for (std::uint64_t first = begin; first < end; first += batch) {
    const std::uint64_t count = std::min(batch, end - first);
    for (std::uint64_t i = 0; i < count; ++i) {
      u[i] = along_u(first + i);
      v[i] = along_v(second_digits(first + i));
    }
    integrand.points(static_cast<int>(panel), u.data(), v.data(), w.data(), static_cast<int>(count));
    for (std::uint64_t i = 0; i < count; ++i) {
      total += w[i];
      squares.add(w[i]);
    }
  }
  return total;
}

}  // namespace

Estimate sobol(const Integrand<double>& integrand, const RuleOptions& options) {
  constexpr std::int64_t first_size = 32;  // a look, and no answer
  constexpr double fastest = 4;          // by which doubling divides the error: 2^1.5 for smooth integrands, and chance
  constexpr double widths_of_boxes = 4;  // a feature is 2 × 2 widths: it holds a binary box of a quarter of its area
  Estimate estimate = unaffordable(ErrorKind::standard_error);
  const auto panels = static_cast<std::uint32_t>(integrand.panels().size());
  if (panels == 0) return {0, 0, ErrorKind::standard_error, 0, Status::converged};
  const RandomStream stream(options.seed);
  const std::int64_t most = options.budget / (std::int64_t{replicate_count} * panels);
  std::int64_t n = 0, next = first_size;
  while (next > most) next /= 2;
  std::array<double, replicate_count> sums{};
  Squares squares;
  double before = 0;  // the standard error of half the points
  while (next >= 1 && next <= most) {
    std::array<double, replicate_count> values{};
    for (std::uint32_t replicate = 0; replicate < replicate_count; ++replicate) {
      for (std::uint32_t panel = 0; panel < panels; ++panel) {
        sums[replicate] += sum(integrand, stream, replicate, panel, static_cast<std::uint64_t>(n),
                               static_cast<std::uint64_t>(next), squares);
      }
      values[replicate] = sums[replicate] / static_cast<double>(next);
    }
    n = next;
    estimate.evaluations = n * replicate_count * panels;
    const auto [mean, of_replicates] = statistics(values);
    // where all replicates meet an edge equally often by chance, half of the points didn't
    double standard_error = std::max(of_replicates, before / fastest);
    // where they all agree about an integrand that isn't constant, such as one that is 0 or 1: one point of all of them
    if (of_replicates <= rounding_of(std::abs(mean))) {
      standard_error = std::max(standard_error, squares.range() / static_cast<double>(n * replicate_count));
    }
    before = of_replicates;
    const bool seen = every_feature(integrand, [n](const Feature& feature) {
      return static_cast<double>(n) * feature.width_u * feature.width_v >= widths_of_boxes;
    });
    const bool believable = seen && n > first_size && !squares.dominated();
    if (conclude(estimate, mean, standard_error, believable, integrand, options)) return estimate;
    next = 2 * n;
  }
  return estimate;
}

}  // namespace albedo
