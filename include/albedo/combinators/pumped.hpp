#pragma once

#include <memory>

#include "albedo/combinators/scaled.hpp"
#include "albedo/pumping.hpp"

namespace albedo {

/// f_K = f / D_K, the albedo of f pumped up K times   [Neumann 1999, eqs. 16–21]: f_{k+1} = f_k / g_k with g_k =
/// max(a_k(L), a_k(V)), and what PumpControl adds to that.
///
/// The a_k are tables raised by their errors, so that a ≤ 1 holds for the model as it is evaluated, not only in exact
/// arithmetic; it is reciprocal because D is symmetric. Rules know the kink at equal cosines; other kinks (of control's
/// floor, of albedos that fall and rise) are no edges of their panels, but they are told.
class PumpedModel final : public ScaledModel {
 public:
  /// @param base reciprocal, with an albedo that is finite and positive above the horizon
  /// @throws ParameterError for another base, and for options outside their ranges
  explicit PumpedModel(std::unique_ptr<Model> base, const PumpOptions& options = {});

  [[nodiscard]] const PumpOptions& options() const { return options_; }
  /// What f is divided by; nullptr where times is 0.
  [[nodiscard]] std::shared_ptr<const PumpDivisor> divisor() const { return divisor_; }
  /// Status of the tables: whether each of them meets the tolerance. They are upper bounds anyway.
  [[nodiscard]] Status status() const { return status_; }

  [[nodiscard]] Claims claims() const override;
  [[nodiscard]] std::vector<Lobe> lobes() const override;

 private:
  /// 1/D_K
  [[nodiscard]] double factor_of(double cos_l, double cos_v) const noexcept override;
  [[nodiscard]] Parameters own_parameters() const override;

  PumpOptions options_;
  std::shared_ptr<const PumpDivisor> divisor_;
  Status status_ = Status::converged;
  bool hidden_kinks_ = false;  // beside that at equal cosines
};

}  // namespace albedo
