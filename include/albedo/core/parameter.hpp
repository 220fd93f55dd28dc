#pragma once

#include <string>
#include <utility>
#include <vector>

#include "albedo/core/model.hpp"

namespace albedo {

/// Binds a ParameterInfo to a member of the model struct M.
template <class M>
struct Parameter {
  ParameterInfo info;  ///< default_value is filled in from M{}
  double (*get)(const M&);
  void (*set)(M&, double);
  std::string& (*text)(M&) = nullptr;  ///< of a text, in place of the two above
};

namespace detail {

template <auto First, auto... Rest>
constexpr auto& member(auto& object) {
  if constexpr (sizeof...(Rest) == 0) {
    return object.*First;
  } else {
    return member<Rest...>(object.*First);
  }
}

template <class M, auto... Path>
Parameter<M> bind(ParameterInfo info) {
  using Value = std::remove_cvref_t<decltype(member<Path...>(std::declval<M&>()))>;
  Parameter<M> parameter{std::move(info), [](const M& m) { return static_cast<double>(member<Path...>(m)); },
                         [](M& m, double value) { member<Path...>(m) = static_cast<Value>(value); }};
  parameter.info.default_value = parameter.get(M{});
  return parameter;
}

}  // namespace detail

/// A numeric parameter: the member at `Path` of M (several pointers reach into a part, e.g. &Ggx::fresnel,
/// &Fresnel::f0).
template <class M, auto... Path>
Parameter<M> number(std::string name, Range range, std::string meaning) {
  return detail::bind<M, Path...>({.name = std::move(name), .meaning = std::move(meaning), .range = range});
}

/// A reflectance: a numeric parameter that may differ for red, green and blue.
template <class M, auto... Path>
Parameter<M> reflectance(std::string name, std::string meaning, Range range = {0, 1}) {
  return detail::bind<M, Path...>(
      {.name = std::move(name), .meaning = std::move(meaning), .range = range, .per_channel = true});
}

/// A parameter that is one of several names; the member is an enumeration counted from 0 in their order.
template <class M, auto... Path>
Parameter<M> choice(std::string name, std::vector<std::string> names, std::string meaning) {
  const Range range{0, static_cast<double>(names.size() - 1)};
  return detail::bind<M, Path...>(
      {.name = std::move(name), .meaning = std::move(meaning), .range = range, .choices = std::move(names)});
}

/// A text without a default; the member is a string.
template <class M, auto Member>
Parameter<M> text(std::string name, std::string meaning) {
  return {.info = {.name = std::move(name), .meaning = std::move(meaning), .is_text = true},
          .get = nullptr,
          .set = nullptr,
          .text = [](M& m) -> std::string& { return m.*Member; }};
}

inline constexpr Range roughness_range{1e-6, 100};
inline constexpr Range exponent_range{0, 1e8};
inline constexpr Range scale_range{0, 1e6};

}  // namespace albedo
