#pragma once

#include <memory>

#include "albedo/balance.hpp"
#include "albedo/combinators/scaled.hpp"

namespace albedo {

/// f* = f / (s(L) s(V)), which reflects ρ of the light from everywhere, and never more: see Balance.
class BalancedModel final : public ScaledModel {
 public:
  /// @param base reciprocal and isotropic, with an albedo that is finite and positive above the horizon
  /// @throws ParameterError as Balance does
  explicit BalancedModel(std::unique_ptr<Model> base, const BalanceOptions& options = {});

  [[nodiscard]] const Balance& balance() const { return balance_; }
  [[nodiscard]] Claims claims() const override;

 private:
  /// 1/(s(L) s(V))
  [[nodiscard]] double factor_of(double cos_l, double cos_v) const noexcept override;
  [[nodiscard]] Parameters own_parameters() const override;

  Balance balance_;
};

}  // namespace albedo
