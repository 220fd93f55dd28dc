#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/text.hpp"
#include "models/measured.hpp"

namespace albedo {
namespace {

class MerlTable final : public MeasuredTable {
 public:
  MerlTable(const std::array<std::size_t, 3>& counts, std::vector<double> values)
      : counts_(counts), values_(std::move(values)) {}

  [[nodiscard]] bool reciprocal() const noexcept override { return true; }

  [[nodiscard]] double evaluate(const DirectionPair<double>& pair) const noexcept override {
    if (!(pair.cos_theta_v > 0)) return 0;
    const HalfAngles half = half_angles(pair);
    const double theta_d = std::atan2(std::sqrt((1 - pair.cos_theta_d) * (1 + pair.cos_theta_d)), pair.cos_theta_d);
    // L turned so that H is the normal
    const double planar = std::hypot(pair.l_x, pair.l_y);
    const double x = planar * std::cos(half.phi) * std::cos(half.theta) - pair.cos_theta_l * std::sin(half.theta);
    const double y = -planar * std::sin(half.phi);
    double phi_d = std::atan2(y, x);
    if (phi_d < 0) phi_d += pi<double>;  // L and V exchanged
    const Between h = centred(std::sqrt(2 * half.theta / pi<double>), counts_[0]),
                  d = centred(2 * theta_d / pi<double>, counts_[1]);
    const double turn = phi_d / pi<double> * static_cast<double>(counts_[2]) - 0.5;
    const double first = std::floor(turn);
    const std::size_t count = counts_[2];
    const std::size_t p0 = static_cast<std::size_t>(first + static_cast<double>(count)) % count, p1 = (p0 + 1) % count;
    const auto over_turn = [&](std::size_t i, std::size_t j) {
      const double* row = values_.data() + (i * counts_[1] + j) * count;
      return std::lerp(row[p0], row[p1], turn - first);
    };
    const auto over_difference = [&](std::size_t i) {
      return std::lerp(over_turn(i, d.index), over_turn(i, d.index + 1), d.share);
    };
    return std::lerp(over_difference(h.index), over_difference(h.index + 1), h.share);
  }

 private:
  /// Entries are at the centres of `count` cells of [0, 1], and hold beyond the outermost.
  static Between centred(double x, std::size_t count) {
    const auto n = static_cast<double>(count);
    return between(std::clamp((x * n - 0.5) / (n - 1), 0.0, 1.0), count);
  }

  std::array<std::size_t, 3> counts_;
  std::vector<double> values_;
};

}  // namespace

std::shared_ptr<const MeasuredTable> read_merl(const MeasuredFile& file, int channel) {
  constexpr std::size_t head = 3 * sizeof(std::int32_t), channels = 3;
  constexpr std::array<double, 3> scales{1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
  if (file.bytes.size() < head) file.refuse("is too short to be an RGL .bsdf or a MERL .binary file");
  std::array<std::size_t, 3> counts{};
  std::uint64_t entries = 1;
  const std::uint64_t room = (file.bytes.size() - head) / (channels * sizeof(double));
  for (std::size_t i = 0; i < 3; ++i) {
    std::int32_t count = 0;
    std::memcpy(&count, file.bytes.data() + i * sizeof count, sizeof count);
    if (count < 2 || static_cast<std::uint64_t>(count) > room / entries) {
      file.refuse(fmt::format(
          "is neither an RGL .bsdf file nor a whole MERL .binary file: as the latter its header has a dimension of {} "
          "in {} bytes",
          count, file.bytes.size()));
    }
    entries *= static_cast<std::uint64_t>(count);
    counts[i] = static_cast<std::size_t>(count);
  }
  const std::uint64_t expected = head + entries * channels * sizeof(double);
  if (expected != file.bytes.size()) {
    file.refuse(
        fmt::format("has {} bytes and must have {} as a MERL .binary file of its header", file.bytes.size(), expected));
  }
  std::vector<double> values(static_cast<std::size_t>(entries));
  const auto index = static_cast<std::size_t>(channel);
  const unsigned char* begin = file.bytes.data() + head + index * values.size() * sizeof(double);
  for (std::size_t i = 0; i < values.size(); ++i) {
    double value = 0;
    std::memcpy(&value, begin + i * sizeof value, sizeof value);
    if (!std::isfinite(value)) file.refuse("has a number that isn't finite");
    values[i] = value > 0 ? value * scales[index] : 0;  // negative: not measured, below the horizon
  }
  return std::make_shared<MerlTable>(counts, std::move(values));
}

}  // namespace albedo
