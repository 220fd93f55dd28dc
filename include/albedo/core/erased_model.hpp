#pragma once

#include "albedo/core/parameter.hpp"

namespace albedo {

/// A model struct behind the Model interface.
template <class M>
class ErasedModel final : public Model {
 public:
  explicit ErasedModel(M model, const ModelInfo& info) : model_(std::move(model)), info_(info) {}

  [[nodiscard]] const ModelInfo& info() const override { return info_; }
  [[nodiscard]] Claims claims() const override { return model_.claims(); }

  [[nodiscard]] Parameters parameters() const override {
    Parameters values;
    for (const Parameter<M>& p : M::parameters()) {
      const double value = p.get(model_);
      if (p.info.is_choice()) {
        values.emplace_back(p.info.name, p.info.choices[static_cast<std::size_t>(value)]);
      } else {
        values.emplace_back(p.info.name, value);
      }
    }
    return values;
  }

  [[nodiscard]] std::vector<Lobe> lobes() const override {
    std::vector<Lobe> lobes = model_.lobes();
    std::erase_if(lobes, [](const Lobe& lobe) { return lobe.weight == 0; });
    return lobes;
  }

  [[nodiscard]] double coherent_albedo(const Direction& l) const override {
    if constexpr (requires { model_.coherent_albedo(l); }) return model_.coherent_albedo(l);
    return 0;
  }

  [[nodiscard]] Block evaluate(int component, const DirectionPair<Block>& pair) const noexcept override {
    return model_.evaluate(component, pair);
  }
  [[nodiscard]] double evaluate(int component, const DirectionPair<double>& pair) const noexcept override {
    return model_.evaluate(component, pair);
  }
  [[nodiscard]] float evaluate(int component, const DirectionPair<float>& pair) const noexcept override {
    return model_.evaluate(component, pair);
  }
  [[nodiscard]] Quad evaluate(int component, const DirectionPair<Quad>& pair) const override {
    return model_.evaluate(component, pair);
  }

 private:
  M model_;
  const ModelInfo& info_;
};

}  // namespace albedo
