#pragma once

#include <memory>

#include "albedo/core/model.hpp"

namespace albedo {

/// A model each of whose lobes is another model's lobe times a function of the two polar angles: what sums, pumping and
/// the other energy corrections have in common. Samplers and their densities are those of the wrapped lobes.
class WrappingModel : public Model {
 public:
  ~WrappingModel() override;
  WrappingModel(const WrappingModel&) = delete;
  WrappingModel& operator=(const WrappingModel&) = delete;

  [[nodiscard]] const QuadFormula& quad() const override { return *quad_; }

  [[nodiscard]] Block evaluate(int component, const DirectionPair<Block>& pair) const noexcept override;
  [[nodiscard]] double evaluate(int component, const DirectionPair<double>& pair) const noexcept override;
  [[nodiscard]] float evaluate(int component, const DirectionPair<float>& pair) const noexcept override;

  [[nodiscard]] bool has_sampler(int component) const noexcept override;
  [[nodiscard]] Sampled<Block> sample(int component, const UnitVector<Block>& l, const Block& u,
                                      const Block& v) const noexcept override;
  [[nodiscard]] Sampled<double> sample(int component, const UnitVector<double>& l, double u,
                                       double v) const noexcept override;
  [[nodiscard]] double density(int component, const UnitVector<double>& l,
                               const UnitVector<double>& v) const noexcept override;

 protected:
  /// Where a component is found.
  struct Source {
    const Model* model;
    int component;
  };

  WrappingModel();

  [[nodiscard]] virtual Source source(int component) const noexcept = 0;
  /// What that lobe is multiplied by.
  [[nodiscard]] virtual double factor(int component, double cos_l, double cos_v) const noexcept = 0;
  [[nodiscard]] virtual Block factors(int component, const Block& cos_l, const Block& cos_v) const noexcept;
  /// The models whose coherent albedos are this one's, each with what it is multiplied by for L.
  struct Share {
    const Model* model;
    double factor;
  };
  [[nodiscard]] virtual std::vector<Share> coherent_shares(const Direction& l) const = 0;

 private:
  class Formula;

  std::unique_ptr<const QuadFormula> quad_;
};

}  // namespace albedo
