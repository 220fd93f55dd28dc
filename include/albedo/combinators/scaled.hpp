#pragma once

#include <memory>

#include "albedo/core/model.hpp"

namespace albedo {

/// A model times a function k of the two polar angles, f(L,V) k(cosθ_L, cosθ_V): what pumping and the other energy
/// corrections make of a model.
///
/// Each lobe stays a lobe. Samplers and their densities are the base's, and so are the parameters behind the model's
/// own ones, as base.NAME.
class ScaledModel : public Model {
 public:
  [[nodiscard]] const Model& base() const { return *base_; }

  [[nodiscard]] const ModelInfo& info() const override { return info_; }
  /// The base's, but for its facets.
  [[nodiscard]] Claims claims() const override;
  [[nodiscard]] Parameters parameters() const override;
  [[nodiscard]] std::vector<Lobe> lobes() const override { return base_->lobes(); }
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

 protected:
  /// @param info of the model, with parameters of its own beside "model", which names the base
  ScaledModel(std::unique_ptr<Model> base, ModelInfo info);

  /// k
  [[nodiscard]] virtual double factor(double cos_l, double cos_v) const noexcept = 0;
  /// The values of its own parameters.
  [[nodiscard]] virtual Parameters own_parameters() const = 0;

 private:
  std::unique_ptr<Model> base_;
  ModelInfo info_;
};

}  // namespace albedo
