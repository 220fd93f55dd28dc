#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "albedo/combinators/wrapping.hpp"

namespace albedo {

/// f = Σ w_i f_i: a model made of models. Each lobe of each part stays a lobe of its own, integrated on its own warp,
/// so that a diffuse part and any number of specular lobes cost the sum of what they cost alone. Kurt et al. 2010, eq.
/// 14, is lambert and any number of kurt.
///
/// It claims what follows from its parts' claims: energy conservation if they all claim it and the weights add up to 1
/// at most, the rest if they all do. Its parameters are theirs, numbered by part: "1.model", "1.weight", "1.rho",
/// "2.model", …
class SumModel final : public WrappingModel {
 public:
  struct Part {
    double weight = 1;
    std::unique_ptr<Model> model{};
  };

  /// @throws ParameterError unless there is a part, every part has a model and every weight is within [0, 1e6]
  explicit SumModel(std::vector<Part> parts);

  /// A sum that is a model of its own: its name, title, source and deviation, and what it claims by construction, if
  /// that isn't what follows from its parts.
  SumModel(std::vector<Part> parts, ModelInfo info, std::optional<Claims> claims = {});

  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }

  [[nodiscard]] const ModelInfo& info() const override { return info_; }
  [[nodiscard]] Claims claims() const override;
  [[nodiscard]] Parameters parameters() const override;
  [[nodiscard]] std::vector<Lobe> lobes() const override { return lobes_; }

 private:
  [[nodiscard]] Source source(int component) const noexcept override {
    const Place& place = places_[static_cast<std::size_t>(component)];
    return {parts_[place.part].model.get(), place.component};
  }
  [[nodiscard]] double factor(int component, double /*cos_l*/, double /*cos_v*/) const noexcept override {
    return parts_[places_[static_cast<std::size_t>(component)].part].weight;
  }
  [[nodiscard]] Block factors(int component, const Block& /*cos_l*/, const Block& /*cos_v*/) const noexcept override {
    return factor(component, 0, 0);
  }
  [[nodiscard]] std::vector<Share> coherent_shares(const Direction& l) const override;

  /// Where a component is found.
  struct Place {
    std::size_t part;
    int component;
  };

  std::vector<Part> parts_;
  std::vector<Place> places_;  // of the components
  std::vector<Lobe> lobes_;
  ModelInfo info_;
  std::optional<Claims> claims_{};
};

}  // namespace albedo
