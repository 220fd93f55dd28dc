#include "albedo/combinators/wrapping.hpp"

#include "albedo/core/quad.hpp"

namespace albedo {

class WrappingModel::Formula final : public QuadFormula {
 public:
  explicit Formula(const WrappingModel& model) : model_(model) {}

  [[nodiscard]] Quad evaluate(int component, const DirectionPair<Quad>& pair) const override {
    const auto [model, of_model] = model_.source(component);
    return model->quad().evaluate(of_model, pair) *
           model_.factor(component, static_cast<double>(pair.cos_theta_l), static_cast<double>(pair.cos_theta_v));
  }
  [[nodiscard]] Sampled<Quad> sample(int component, const UnitVector<Quad>& l, const Quad& u,
                                     const Quad& v) const override {
    const auto [model, of_model] = model_.source(component);
    return model->quad().sample(of_model, l, u, v);
  }
  [[nodiscard]] Quad coherent_albedo(const Direction& l) const override {
    Quad sum = 0;
    for (const auto& [model, factor] : model_.coherent_shares(l)) sum += factor * model->quad().coherent_albedo(l);
    return sum;
  }

 private:
  const WrappingModel& model_;
};

WrappingModel::WrappingModel() : quad_(std::make_unique<Formula>(*this)) {}
WrappingModel::~WrappingModel() = default;

Block WrappingModel::factors(int component, const Block& cos_l, const Block& cos_v) const noexcept {
  return Block::generate([&](int lane) { return factor(component, cos_l[lane], cos_v[lane]); });
}

Block WrappingModel::evaluate(int component, const DirectionPair<Block>& pair) const noexcept {
  const auto [model, of_model] = source(component);
  return model->evaluate(of_model, pair) * factors(component, pair.cos_theta_l, pair.cos_theta_v);
}
double WrappingModel::evaluate(int component, const DirectionPair<double>& pair) const noexcept {
  const auto [model, of_model] = source(component);
  return model->evaluate(of_model, pair) * factor(component, pair.cos_theta_l, pair.cos_theta_v);
}
float WrappingModel::evaluate(int component, const DirectionPair<float>& pair) const noexcept {
  const auto [model, of_model] = source(component);
  return model->evaluate(of_model, pair) * static_cast<float>(factor(component, static_cast<double>(pair.cos_theta_l),
                                                                     static_cast<double>(pair.cos_theta_v)));
}

bool WrappingModel::has_sampler(int component) const noexcept {
  const auto [model, of_model] = source(component);
  return model->has_sampler(of_model);
}
Sampled<Block> WrappingModel::sample(int component, const UnitVector<Block>& l, const Block& u,
                                     const Block& v) const noexcept {
  const auto [model, of_model] = source(component);
  return model->sample(of_model, l, u, v);
}
Sampled<double> WrappingModel::sample(int component, const UnitVector<double>& l, double u, double v) const noexcept {
  const auto [model, of_model] = source(component);
  return model->sample(of_model, l, u, v);
}
double WrappingModel::density(int component, const UnitVector<double>& l, const UnitVector<double>& v) const noexcept {
  const auto [model, of_model] = source(component);
  return model->density(of_model, l, v);
}

}  // namespace albedo
