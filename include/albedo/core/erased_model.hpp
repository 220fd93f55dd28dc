#pragma once

#include <concepts>

#include "albedo/core/parameter.hpp"
#include "albedo/core/quad.hpp"

namespace albedo {

/// A model struct with samplers for its lobes: sample and density for every number type, without branches.
template <class M>
concept Samplable = requires(const M& model, const UnitVector<double>& l, double u) {
  { model.sample(0, l, u, u) } -> std::same_as<Sampled<double>>;
  { model.density(0, l, l) } -> std::same_as<double>;
};

/// A model struct with a distribution of half vectors.
template <class M>
concept HasDistribution = requires(const M& model, const DirectionPair<double>& d) {
  { model.facet_distribution(d) } -> std::same_as<double>;
};

/// A model struct with a masking function of its facets.
template <class M>
concept HasMasking = requires(const M& model, const DirectionPair<double>& d) {
  { model.facet_masking(d) } -> std::same_as<double>;
};

/// The 113-bit formula of a model struct, which it looks at.
template <class M>
class ErasedQuad final : public QuadFormula {
 public:
  explicit ErasedQuad(const M& model) : model_(model) {}

  [[nodiscard]] Quad evaluate(int component, const DirectionPair<Quad>& pair) const override {
    return model_.evaluate(component, pair);
  }
  [[nodiscard]] Sampled<Quad> sample(int component, const UnitVector<Quad>& l, const Quad& u,
                                     const Quad& v) const override {
    if constexpr (Samplable<M>) {
      return model_.sample(component, l, u, v);
    } else {
      return Sampled<Quad>::none();
    }
  }
  [[nodiscard]] Quad coherent_albedo(const Direction& l) const override {
    if constexpr (requires { model_.template coherent_albedo<Quad>(l); })
      return model_.template coherent_albedo<Quad>(l);
    return 0;
  }

 private:
  const M& model_;
};

/// A model struct behind the Model interface.
template <class M>
class ErasedModel final : public Model {
 public:
  explicit ErasedModel(M model, const ModelInfo& info) : model_(std::move(model)), info_(info), quad_(model_) {}
  ErasedModel(const ErasedModel&) = delete;
  ErasedModel& operator=(const ErasedModel&) = delete;

  [[nodiscard]] const ModelInfo& info() const override { return info_; }
  [[nodiscard]] Claims claims() const override { return model_.claims(); }

  [[nodiscard]] Parameters parameters() const override {
    Parameters values;
    for (const Parameter<M>& p : M::parameters()) {
      if (p.info.is_text) {
        M copy = model_;
        values.emplace_back(p.info.name, p.text(copy));
        continue;
      }
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

  [[nodiscard]] const QuadFormula& quad() const override { return quad_; }

  [[nodiscard]] Block evaluate(int component, const DirectionPair<Block>& pair) const noexcept override {
    return model_.evaluate(component, pair);
  }
  [[nodiscard]] double evaluate(int component, const DirectionPair<double>& pair) const noexcept override {
    return model_.evaluate(component, pair);
  }
  [[nodiscard]] float evaluate(int component, const DirectionPair<float>& pair) const noexcept override {
    return model_.evaluate(component, pair);
  }

  [[nodiscard]] bool has_sampler(int /*component*/) const noexcept override { return Samplable<M>; }
  [[nodiscard]] Sampled<Block> sample(int component, const UnitVector<Block>& l, const Block& u,
                                      const Block& v) const noexcept override {
    return sampled(component, l, u, v);
  }
  [[nodiscard]] Sampled<double> sample(int component, const UnitVector<double>& l, double u,
                                       double v) const noexcept override {
    return sampled(component, l, u, v);
  }
  [[nodiscard]] double density(int component, const UnitVector<double>& l,
                               const UnitVector<double>& v) const noexcept override {
    if constexpr (Samplable<M>) {
      return model_.density(component, l, v);
    } else {
      return Model::density(component, l, v);
    }
  }

  [[nodiscard]] bool has_facet_distribution() const noexcept override { return HasDistribution<M>; }
  [[nodiscard]] bool has_facet_masking() const noexcept override { return HasMasking<M>; }
  [[nodiscard]] double facet_distribution(const DirectionPair<double>& pair) const noexcept override {
    if constexpr (HasDistribution<M>) {
      return model_.facet_distribution(pair);
    } else {
      return Model::facet_distribution(pair);
    }
  }
  [[nodiscard]] double facet_masking(const DirectionPair<double>& pair) const noexcept override {
    if constexpr (HasMasking<M>) {
      return model_.facet_masking(pair);
    } else {
      return Model::facet_masking(pair);
    }
  }

 private:
  template <class T>
  Sampled<T> sampled(int component, const UnitVector<T>& l, const T& u, const T& v) const {
    if constexpr (Samplable<M>) {
      return model_.sample(component, l, u, v);
    } else {
      return Model::sample(component, l, u, v);
    }
  }

  M model_;
  const ModelInfo& info_;
  ErasedQuad<M> quad_;
};

}  // namespace albedo
