#include "albedo/combinators/pumped.hpp"

#include <cmath>

#include "albedo/core/errors.hpp"
#include "core/text.hpp"

namespace albedo {
namespace {

ModelInfo pumped_info() {
  return {.name = "pumped",
          .title = "Pumped up",
          .source = "Neumann 1999, eqs. 16-21",
          .deviation = "albedos from tables raised by their errors",
          .parameters = {
              {.name = "times", .meaning = "how often", .range = {0, PumpOptions::most_times}, .default_value = 1},
              {.name = "control", .meaning = "floor of the divisor", .choices = {"none", "step", "total"}},
              {.name = "restriction", .meaning = "eq. 17: g <= 1", .choices = {"none", "up"}}}};
}

/// Whether all tabulated albedos fall towards grazing incidence: then the max() of two has one kink, at equal cosines.
bool falls(const PumpDivisor& divisor) {
  constexpr double same = 1e-9, step = 0.05;
  const auto orders = static_cast<std::size_t>(divisor.orders());
  std::vector<double> before(orders), now(orders);
  divisor.albedos.logs(0, before.data());
  for (double x = 0; x < CosineTables::last_x; x += x < 20 ? step : 1) {
    divisor.albedos.logs(x, now.data());
    for (std::size_t k = 0; k < orders; ++k) {
      if (now[k] > before[k] + same) return false;
    }
    before = now;
  }
  return true;
}

}  // namespace

PumpedModel::PumpedModel(std::unique_ptr<Model> base, const PumpOptions& options)
    : ScaledModel(std::move(base), pumped_info()), options_(options) {
  if (options.times < 0 || options.times > PumpOptions::most_times) {
    throw ParameterError(
        fmt::format("pumping: times is {} and must be within [0, {}]", options.times, int{PumpOptions::most_times}));
  }
  if (options.times == 0) return;
  PumpSequence sequence(this->base(), options.control, options.only_up, options.tolerance);
  for (int k = 1; k < options.times; ++k) sequence.advance();
  divisor_ = std::make_shared<PumpDivisor>(sequence.divisor());
  status_ = sequence.status();
  hidden_kinks_ = options.control != PumpControl::none || options.only_up || !falls(*divisor_);
}

Claims PumpedModel::claims() const {
  Claims claims = ScaledModel::claims();
  if (divisor_ && !options_.only_up) claims.conserves_energy = claims.bounded = true;
  return claims;
}

Parameters PumpedModel::own_parameters() const {
  return {{"times", static_cast<double>(options_.times)},
          {"control", std::string(to_string(options_.control))},
          {"restriction", options_.only_up ? "up" : "none"}};
}

std::vector<Lobe> PumpedModel::lobes() const {
  std::vector<Lobe> lobes = base().lobes();
  if (divisor_) {
    for (Lobe& lobe : lobes) lobe.kink_equal_cosines = true, lobe.hidden_kinks = hidden_kinks_;
  }
  return lobes;
}

double PumpedModel::factor_of(double cos_l, double cos_v) const noexcept {
  return divisor_ ? std::exp(-divisor_->log_divisor(divisor_->orders(), -std::log(cos_l), -std::log(cos_v))) : 1;
}

}  // namespace albedo
