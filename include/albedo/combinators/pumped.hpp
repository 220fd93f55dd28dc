#pragma once

#include <memory>

#include "albedo/pumping.hpp"

namespace albedo {

/// f_K = f / D_K, the albedo of f pumped up K times   [Neumann 1999, eqs. 16–21]: f_{k+1} = f_k / g_k with g_k =
/// max(a_k(L), a_k(V)), and what PumpControl adds to that.
///
/// The a_k are tables raised by their errors, so that a ≤ 1 holds for the model as it is evaluated, not only in exact
/// arithmetic; it is reciprocal because D is symmetric. Each lobe stays a lobe, with a kink at equal cosines;
/// other kinks (of control's floor, of albedos that fall and rise) are no edges of its panels, but rules are told.
/// Samplers are the base's, with the base's densities; so are parameters, after "times", "control" and "restriction".
class PumpedModel final : public Model {
 public:
  /// @param base reciprocal, with an albedo that is finite and positive above the horizon
  /// @throws ParameterError for another base, and for options outside their ranges
  explicit PumpedModel(std::unique_ptr<Model> base, const PumpOptions& options = {});

  [[nodiscard]] const Model& base() const { return *base_; }
  [[nodiscard]] const PumpOptions& options() const { return options_; }
  /// Status of the tables: whether each of them meets the tolerance. They are upper bounds anyway.
  [[nodiscard]] Status status() const { return status_; }

  [[nodiscard]] const ModelInfo& info() const override { return info_; }
  [[nodiscard]] Claims claims() const override;
  [[nodiscard]] Parameters parameters() const override;
  [[nodiscard]] std::vector<Lobe> lobes() const override;
  [[nodiscard]] Quad coherent_albedo(const Direction& l) const override;

  [[nodiscard]] Block evaluate(int component, const DirectionPair<Block>& pair) const noexcept override;
  [[nodiscard]] double evaluate(int component, const DirectionPair<double>& pair) const noexcept override;
  [[nodiscard]] float evaluate(int component, const DirectionPair<float>& pair) const noexcept override;
  [[nodiscard]] Quad evaluate(int component, const DirectionPair<Quad>& pair) const override;

  [[nodiscard]] bool has_sampler(int component) const noexcept override { return base_->has_sampler(component); }
  [[nodiscard]] Sampled<Block> sample(int component, const UnitVector<Block>& l, const Block& u,
                                      const Block& v) const noexcept override {
    return base_->sample(component, l, u, v);
  }
  [[nodiscard]] Sampled<double> sample(int component, const UnitVector<double>& l, double u,
                                       double v) const noexcept override {
    return base_->sample(component, l, u, v);
  }
  [[nodiscard]] Sampled<Quad> sample(int component, const UnitVector<Quad>& l, const Quad& u,
                                     const Quad& v) const override {
    return base_->sample(component, l, u, v);
  }
  [[nodiscard]] double density(int component, const UnitVector<double>& l,
                               const UnitVector<double>& v) const noexcept override {
    return base_->density(component, l, v);
  }

 private:
  /// 1/D_K
  [[nodiscard]] double factor(double cos_l, double cos_v) const noexcept;

  std::unique_ptr<Model> base_;
  PumpOptions options_;
  std::unique_ptr<const PumpDivisor> divisor_;  // none where times is 0
  Status status_ = Status::converged;
  bool hidden_kinks_ = false;  // beside that at equal cosines
  ModelInfo info_;
};

}  // namespace albedo
