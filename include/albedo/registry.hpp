/// @file
/// Models of one's own: a struct like those in albedo/models/ becomes a Model, by its type or by its name.
#pragma once

#include <algorithm>
#include <concepts>
#include <memory>
#include <string>
#include <vector>

#include "albedo/core/erased_model.hpp"

namespace albedo {

namespace detail {

template <class M>
concept HasInfo = requires {
  { M::info() } -> std::same_as<ModelInfo>;
};

template <class M>
concept HasParameters = requires {
  { M::parameters() } -> std::same_as<std::vector<Parameter<M>>>;
};

template <class M>
concept HasClaims = requires(const M& model) {
  { model.claims() } -> std::same_as<Claims>;
};

template <class M>
concept HasLobes = requires(const M& model) {
  { model.lobes() } -> std::same_as<std::vector<Lobe>>;
};

template <class M, class T>
concept EvaluatesIn = requires(const M& model, const DirectionPair<T>& pair) {
  { model.evaluate(0, pair) } -> std::same_as<T>;
};

template <class M>
concept HasFormula = EvaluatesIn<M, double> && EvaluatesIn<M, float> && EvaluatesIn<M, Quad> && EvaluatesIn<M, Block>;

}  // namespace detail

/// What a model's struct consists of; doc/adding-a-model.md walks through one.
///
///     static ModelInfo info();                        name, title, source, deviation
///     static std::vector<Parameter<M>> parameters();  made by number(), reflectance(), choice(), text()
///     Claims claims() const;                          for the parameters as they are set
///     std::vector<Lobe> lobes() const;                where each lobe is, for the integration
///     template <class T> T evaluate(int component, const DirectionPair<T>&) const noexcept;   f(L,V) of one lobe
///     [1/sr]
///
/// and, where there is one, a sampler (Samplable), a template coherent_albedo<T>(l), and load(), called once the
/// parameters are set.
template <class M>
concept ModelStruct = std::default_initializable<M> && std::copyable<M> && detail::HasInfo<M> &&
    detail::HasParameters<M> && detail::HasClaims<M> && detail::HasLobes<M> && detail::HasFormula<M>;

namespace detail {

/// Says in words what a struct lacks.
template <class M>
constexpr void require_model_struct() {
  static_assert(std::default_initializable<M>, "a model struct needs a value for every member: double k = 1;");
  static_assert(std::copyable<M>, "a model struct must be copyable");
  static_assert(HasInfo<M>, "a model struct needs: static albedo::ModelInfo info()");
  static_assert(HasParameters<M>,
                "a model struct M needs: static std::vector<albedo::Parameter<M>> parameters(); it may return {}");
  static_assert(HasClaims<M>, "a model struct needs: albedo::Claims claims() const");
  static_assert(HasLobes<M>, "a model struct needs: std::vector<albedo::Lobe> lobes() const, with one lobe at least");
  static_assert(HasFormula<M>,
                "a model struct needs: template <class T> T evaluate(int component, const albedo::DirectionPair<T>&) "
                "const noexcept, for T = double, float, albedo::Quad and albedo::Block; it returns T itself");
}

/// The names that `name` stands for in the model. @throws ParameterError with a suggestion
std::vector<std::string> resolved(const ModelInfo& model, const std::string& name);
/// @throws ParameterError for a value outside the parameter's range, or not of its kind
double checked_value(const ModelInfo& model, const ParameterInfo& parameter, const ParameterValue& value);
void check_range(const ModelInfo& model, const ParameterInfo& parameter, double value);
const std::string& checked_text(const ModelInfo& model, const ParameterInfo& parameter, const ParameterValue& value);

using Factory = std::unique_ptr<Model> (*)(const Parameters&);
void register_model(const ModelInfo& info, Factory factory);

/// M::info() with its parameters and claims.
template <class M>
const ModelInfo& complete_info() {
  static const ModelInfo complete = [] {
    ModelInfo info = M::info();
    for (const Parameter<M>& parameter : M::parameters()) info.parameters.push_back(parameter.info);
    info.claims = M{}.claims();
    return info;
  }();
  return complete;
}

}  // namespace detail

/// A model of type M, registered or not; parameters that are not given have their default.
/// @throws ParameterError for an unknown name or a value outside its range
template <class M>
std::unique_ptr<Model> make_model(const Parameters& parameters = {}) {
  detail::require_model_struct<M>();
  const ModelInfo& info = detail::complete_info<M>();
  M model;
  for (const auto& [name, value] : parameters) {
    const std::vector<std::string> names = detail::resolved(info, name);
    for (const Parameter<M>& parameter : M::parameters()) {
      if (std::find(names.begin(), names.end(), parameter.info.name) == names.end()) continue;
      if (parameter.info.is_text) {
        parameter.text(model) = detail::checked_text(info, parameter.info, value);
      } else {
        parameter.set(model, detail::checked_value(info, parameter.info, value));
      }
    }
  }
  if constexpr (requires { model.load(); }) model.load();
  return std::make_unique<ErasedModel<M>>(std::move(model), info);
}

/// A model of type M as it is: make_model(Ward{.alpha_x = 0.1, .alpha_y = 0.2}).
/// @throws ParameterError for a value outside its parameter's range
template <ModelStruct M>
std::unique_ptr<Model> make_model(M model) {
  const ModelInfo& info = detail::complete_info<M>();
  for (const Parameter<M>& parameter : M::parameters()) {
    if (!parameter.info.is_text) detail::check_range(info, parameter.info, parameter.get(model));
  }
  if constexpr (requires { model.load(); }) model.load();
  return std::make_unique<ErasedModel<M>>(std::move(model), info);
}

/// Adds a model to those that make_model, model_infos and the command line know by name, behind all others.
///
/// To be called before other threads use the library.
/// @throws ParameterError if there is a model of that name, if a name is not letters, digits and underscores or means
/// something else on the command line (sum, coupled, theta, cos_theta, phi, weight), if two parameters share one, or if
/// a default is outside its range
template <class M>
void register_model() {
  detail::require_model_struct<M>();
  detail::register_model(detail::complete_info<M>(), &make_model<M>);
}

}  // namespace albedo
