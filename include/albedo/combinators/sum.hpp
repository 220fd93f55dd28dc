#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "albedo/core/model.hpp"

namespace albedo {

/// f = Σ w_i f_i: a model made of models. Each lobe of each part stays a lobe of its own, integrated on its own warp,
/// so that a diffuse part and any number of specular lobes cost the sum of what they cost alone. Kurt et al. 2010, eq.
/// 14, is lambert and any number of kurt.
///
/// It claims what follows from its parts' claims: energy conservation if they all claim it and the weights add up to 1
/// at most, the rest if they all do. Its parameters are theirs, numbered by part: "1.model", "1.weight", "1.rho",
/// "2.model", …
class SumModel final : public Model {
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
  [[nodiscard]] Quad coherent_albedo(const Direction& l) const override;

  [[nodiscard]] Block evaluate(int component, const DirectionPair<Block>& pair) const noexcept override;
  [[nodiscard]] double evaluate(int component, const DirectionPair<double>& pair) const noexcept override;
  [[nodiscard]] float evaluate(int component, const DirectionPair<float>& pair) const noexcept override;
  [[nodiscard]] Quad evaluate(int component, const DirectionPair<Quad>& pair) const override;

  [[nodiscard]] bool has_sampler(int component) const noexcept override;
  [[nodiscard]] Sampled<Block> sample(int component, const UnitVector<Block>& l, const Block& u,
                                      const Block& v) const noexcept override;
  [[nodiscard]] Sampled<double> sample(int component, const UnitVector<double>& l, double u,
                                       double v) const noexcept override;
  [[nodiscard]] Sampled<Quad> sample(int component, const UnitVector<Quad>& l, const Quad& u,
                                     const Quad& v) const override;
  [[nodiscard]] double density(int component, const UnitVector<double>& l,
                               const UnitVector<double>& v) const noexcept override;

 private:
  /// Where a component is found.
  struct Source {
    std::size_t part;
    int component;
  };

  [[nodiscard]] const Source& source(int component) const { return sources_[static_cast<std::size_t>(component)]; }
  [[nodiscard]] const Model& model(const Source& source) const { return *parts_[source.part].model; }

  template <class T>
  [[nodiscard]] T weighted(int component, const DirectionPair<T>& pair) const;

  std::vector<Part> parts_;
  std::vector<Source> sources_;  // of the components
  std::vector<Lobe> lobes_;
  ModelInfo info_;
  std::optional<Claims> claims_{};
};

}  // namespace albedo
