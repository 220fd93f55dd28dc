#pragma once

#include <memory>

#include "albedo/combinators/wrapping.hpp"

namespace albedo {

/// A model times a function k of the two polar angles, f(L,V) k(cosθ_L, cosθ_V): what pumping and the other energy
/// corrections make of a model.
///
/// Each lobe stays a lobe. Samplers and their densities are the base's, and so are the parameters behind the model's
/// own ones, as base.NAME.
class ScaledModel : public WrappingModel {
 public:
  [[nodiscard]] const Model& base() const { return *base_; }

  [[nodiscard]] const ModelInfo& info() const override { return info_; }
  /// The base's, but for its facets.
  [[nodiscard]] Claims claims() const override;
  [[nodiscard]] Parameters parameters() const override;
  [[nodiscard]] std::vector<Lobe> lobes() const override { return base_->lobes(); }

 protected:
  /// @param info of the model, with parameters of its own beside "model", which names the base
  ScaledModel(std::unique_ptr<Model> base, ModelInfo info);

  /// k
  [[nodiscard]] virtual double factor_of(double cos_l, double cos_v) const noexcept = 0;
  /// The values of its own parameters.
  [[nodiscard]] virtual Parameters own_parameters() const = 0;

 private:
  [[nodiscard]] Source source(int component) const noexcept final { return {base_.get(), component}; }
  [[nodiscard]] double factor(int /*component*/, double cos_l, double cos_v) const noexcept final {
    return factor_of(cos_l, cos_v);
  }
  [[nodiscard]] std::vector<Share> coherent_shares(const Direction& l) const final;

  std::unique_ptr<Model> base_;
  ModelInfo info_;
};

}  // namespace albedo
