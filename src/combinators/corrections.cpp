#include "albedo/corrections.hpp"

#include "albedo/combinators/balanced.hpp"
#include "albedo/combinators/compensated.hpp"
#include "albedo/combinators/coupled.hpp"
#include "albedo/combinators/pumped.hpp"

namespace albedo {

std::string_view name_of(Correction correction) {
  constexpr std::array<std::string_view, 4> names{"none", "balance", "multiscatter", "turquin"};
  return names[static_cast<std::size_t>(correction)];
}

std::unique_ptr<Model> Corrections::applied_to(std::unique_ptr<Model> model) const {
  if (pump.times > 0) model = std::make_unique<PumpedModel>(std::move(model), pump);
  switch (correct) {
    case Correction::none:
      return model;
    case Correction::balance:
      return std::make_unique<BalancedModel>(std::move(model), BalanceOptions{.rho = rho});
    case Correction::multiscatter:
      return coupled(std::move(model), rho);
    case Correction::turquin:
      break;
  }
  return std::make_unique<CompensatedModel>(std::move(model), rho);
}

}  // namespace albedo
