/// @file
/// Formulas as they stand in textbooks and shaders: from two directions and their half vector.
#pragma once

#include "albedo/combinators/wrapping.hpp"

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
class TextbookModel final : public WrappingModel {
 public:
  /// @param model must outlive this one
  explicit TextbookModel(const Model& model) : model_(model) {}

  [[nodiscard]] const ModelInfo& info() const override { return model_.info(); }
  [[nodiscard]] Claims claims() const override { return model_.claims(); }
  [[nodiscard]] Parameters parameters() const override { return model_.parameters(); }
  [[nodiscard]] std::vector<Lobe> lobes() const override { return model_.lobes(); }

  using WrappingModel::evaluate;
  [[nodiscard]] float evaluate(int component, const DirectionPair<float>& pair) const noexcept override;

 private:
  [[nodiscard]] Source source(int component) const noexcept override { return {&model_, component}; }
  [[nodiscard]] double factor(int, double, double) const noexcept override { return 1; }
  [[nodiscard]] Block factors(int, const Block&, const Block&) const noexcept override { return 1; }
  [[nodiscard]] std::vector<Share> coherent_shares(const Direction&) const override { return {{&model_, 1}}; }

  const Model& model_;
  std::vector<Lobe> lobes_ = model_.lobes();
};

}  // namespace albedo::analysis
