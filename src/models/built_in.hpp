/// @file
/// The library's own models, instantiated by a few sources that share them out, so that none takes long to compile.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "albedo/registry.hpp"

namespace albedo {

struct BuiltInModel {
  const ModelInfo& info;
  detail::Factory factory;
};

inline constexpr std::size_t built_in_parts = 4;

/// Every built_in_parts-th model of models/all.hpp, from number `part` on.
template <std::size_t part>
std::vector<BuiltInModel> built_in_part();
template <>
std::vector<BuiltInModel> built_in_part<0>();
template <>
std::vector<BuiltInModel> built_in_part<1>();
template <>
std::vector<BuiltInModel> built_in_part<2>();
template <>
std::vector<BuiltInModel> built_in_part<3>();

/// All of them, in the order of models/all.hpp.
inline std::vector<BuiltInModel> built_in_models() {
  const std::array<std::vector<BuiltInModel>, built_in_parts> parts{built_in_part<0>(), built_in_part<1>(),
                                                                    built_in_part<2>(), built_in_part<3>()};
  std::size_t count = 0;
  for (const auto& part : parts) count += part.size();
  std::vector<BuiltInModel> models;
  for (std::size_t i = 0; i < count; ++i) models.push_back(parts[i % built_in_parts][i / built_in_parts]);
  return models;
}

}  // namespace albedo
