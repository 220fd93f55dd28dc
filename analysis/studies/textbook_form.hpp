/// @file
/// Formulas as they stand in textbooks and shaders: from two directions and their half vector.
#pragma once

#include "albedo/core/model.hpp"

namespace albedo::analysis {

/// The pair of L and V from their components alone, with the textbook's cancellations:
///
///     H = (L + V)/|L + V|,   tan²θ_H = 1/(N·H)² − 1,   φ_H from H_x and H_y (0 for H = N),   1 − A·V
///
/// In float, tan²θ_H has an absolute error of some 1e-7, which a roughness of 1e-3 no longer forgives.
template <class T>
DirectionPair<T> textbook_pair(const UnitVector<T>& l, const UnitVector<T>& v, const UnitVector<T>& axis) {
  using std::sqrt;
  const auto dot = [](const UnitVector<T>& a, const UnitVector<T>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
  const UnitVector<T> sum{l.x + v.x, l.y + v.y, l.z + v.z};
  const T length = sqrt(dot(sum, sum));
  const UnitVector<T> h{sum.x / length, sum.y / length, sum.z / length};
  const T tangent = sqrt(1 / square(h.z) - 1);
  const T planar = sqrt(square(h.x) + square(h.y));
  const T cos_phi = planar > 0 ? h.x / planar : T(1), sin_phi = planar > 0 ? h.y / planar : T(0);
  return {l.z, v.z, l.x, l.y, v.x, v.y, dot(l, h), h.z, tangent * cos_phi, tangent * sin_phi, 1 - dot(axis, v)};
}

/// A model whose formula in float is fed with textbook pairs; in other arithmetic it is the model itself.
class TextbookModel final : public Model {
 public:
  /// @param model must outlive this one
  explicit TextbookModel(const Model& model) : model_(model) {}

  [[nodiscard]] const ModelInfo& info() const override { return model_.info(); }
  [[nodiscard]] Claims claims() const override { return model_.claims(); }
  [[nodiscard]] Parameters parameters() const override { return model_.parameters(); }
  [[nodiscard]] std::vector<Lobe> lobes() const override { return model_.lobes(); }

  [[nodiscard]] float evaluate(int component, const DirectionPair<float>& pair) const noexcept override;
  [[nodiscard]] Block evaluate(int component, const DirectionPair<Block>& pair) const noexcept override {
    return model_.evaluate(component, pair);
  }
  [[nodiscard]] double evaluate(int component, const DirectionPair<double>& pair) const noexcept override {
    return model_.evaluate(component, pair);
  }
  [[nodiscard]] Quad evaluate(int component, const DirectionPair<Quad>& pair) const override {
    return model_.evaluate(component, pair);
  }

  [[nodiscard]] bool has_sampler(int component) const noexcept override { return model_.has_sampler(component); }
  [[nodiscard]] Sampled<Block> sample(int component, const UnitVector<Block>& l, const Block& u,
                                      const Block& v) const noexcept override {
    return model_.sample(component, l, u, v);
  }
  [[nodiscard]] Sampled<double> sample(int component, const UnitVector<double>& l, double u,
                                       double v) const noexcept override {
    return model_.sample(component, l, u, v);
  }
  [[nodiscard]] Sampled<Quad> sample(int component, const UnitVector<Quad>& l, const Quad& u,
                                     const Quad& v) const override {
    return model_.sample(component, l, u, v);
  }
  [[nodiscard]] double density(int component, const UnitVector<double>& l,
                               const UnitVector<double>& v) const noexcept override {
    return model_.density(component, l, v);
  }

 private:
  const Model& model_;
  std::vector<Lobe> lobes_ = model_.lobes();
};

}  // namespace albedo::analysis
