#include "albedo/combinators/pumped.hpp"

#include <cmath>

#include "albedo/core/errors.hpp"

namespace albedo {
namespace {

ModelInfo pumped_info(const ModelInfo& base) {
  ModelInfo info{.name = "pumped",
                 .title = "Pumped up: " + base.title,
                 .source = "Neumann 1999, eqs. 16-21",
                 .deviation = "albedos from tables raised by their errors"};
  info.parameters = {
      {.name = "model", .meaning = base.title, .choices = {base.name}},
      {.name = "times", .meaning = "how often", .range = {0, PumpOptions::most_times}, .default_value = 1},
      {.name = "control", .meaning = "floor of the divisor", .range = {0, 2}, .choices = {"none", "step", "total"}},
      {.name = "restriction", .meaning = "eq. 17: g <= 1", .range = {0, 1}, .choices = {"none", "up"}}};
  for (ParameterInfo parameter : base.parameters) {
    parameter.name = "base." + parameter.name;
    info.parameters.push_back(std::move(parameter));
  }
  return info;
}

/// Whether all tabulated albedos fall towards grazing incidence: then the max() of two has one kink, at equal cosines.
bool falls(const PumpDivisor& divisor) {
  constexpr double same = 1e-9, step = 0.05;
  const auto orders = static_cast<std::size_t>(divisor.orders());
  std::vector<double> before(orders), now(orders);
  divisor.log_albedos(0, before.data());
  for (double x = 0; x < PumpDivisor::last_x; x += x < 20 ? step : 1) {
    divisor.log_albedos(x, now.data());
    for (std::size_t k = 0; k < orders; ++k) {
      if (now[k] > before[k] + same) return false;
    }
    before = now;
  }
  return true;
}

}  // namespace

PumpedModel::PumpedModel(std::unique_ptr<Model> base, const PumpOptions& options)
    : base_(std::move(base)), options_(options) {
  if (!base_) throw ParameterError("pumping: there is no model and there must be one");
  if (options.times < 0 || options.times > PumpOptions::most_times) {
    throw ParameterError("pumping: times is " + std::to_string(options.times) + " and must be within [0, " +
                         std::to_string(PumpOptions::most_times) + "]");
  }
  info_ = pumped_info(base_->info());
  if (options.times == 0) return;
  PumpSequence sequence(*base_, options.control, options.only_up, options.tolerance);
  for (int k = 1; k < options.times; ++k) sequence.advance();
  divisor_ = std::make_unique<PumpDivisor>(sequence.divisor());
  status_ = sequence.status();
  hidden_kinks_ = options.control != PumpControl::none || options.only_up || !falls(*divisor_);
}

Claims PumpedModel::claims() const {
  Claims claims = base_->claims();
  claims.distribution = Measure::none;
  claims.consistent_masking = false;
  if (divisor_ && !options_.only_up) claims.conserves_energy = claims.bounded = true;
  return claims;
}

Parameters PumpedModel::parameters() const {
  Parameters values{{"model", base_->info().name},
                    {"times", static_cast<double>(options_.times)},
                    {"control", std::string(to_string(options_.control))},
                    {"restriction", options_.only_up ? "up" : "none"}};
  for (const auto& [name, value] : base_->parameters()) values.emplace_back("base." + name, value);
  return values;
}

std::vector<Lobe> PumpedModel::lobes() const {
  std::vector<Lobe> lobes = base_->lobes();
  if (divisor_) {
    for (Lobe& lobe : lobes) lobe.kink_equal_cosines = true, lobe.hidden_kinks = hidden_kinks_;
  }
  return lobes;
}

double PumpedModel::factor(double cos_l, double cos_v) const noexcept {
  return divisor_ ? std::exp(-divisor_->log_divisor(divisor_->orders(), -std::log(cos_l), -std::log(cos_v))) : 1;
}

Quad PumpedModel::coherent_albedo(const Direction& l) const {
  const Quad coherent = base_->coherent_albedo(l);
  return coherent == 0 ? coherent : Quad(coherent * factor(l.cos_theta, l.cos_theta));
}

Block PumpedModel::evaluate(int component, const DirectionPair<Block>& pair) const noexcept {
  const Block f = base_->evaluate(component, pair);
  return f * Block::generate([&](int lane) { return factor(pair.cos_theta_l[lane], pair.cos_theta_v[lane]); });
}
double PumpedModel::evaluate(int component, const DirectionPair<double>& pair) const noexcept {
  return base_->evaluate(component, pair) * factor(pair.cos_theta_l, pair.cos_theta_v);
}
float PumpedModel::evaluate(int component, const DirectionPair<float>& pair) const noexcept {
  return base_->evaluate(component, pair) *
         static_cast<float>(factor(static_cast<double>(pair.cos_theta_l), static_cast<double>(pair.cos_theta_v)));
}
Quad PumpedModel::evaluate(int component, const DirectionPair<Quad>& pair) const {
  return base_->evaluate(component, pair) *
         factor(static_cast<double>(pair.cos_theta_l), static_cast<double>(pair.cos_theta_v));
}

}  // namespace albedo
