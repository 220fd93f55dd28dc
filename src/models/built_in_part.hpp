#pragma once

#include "albedo/models/all.hpp"
#include "models/built_in.hpp"

namespace albedo {

/// What built_in_part<part>() returns.
template <std::size_t part, class... Models>
std::vector<BuiltInModel> share_of(ModelList<Models...>) {
  std::vector<BuiltInModel> share;
  const auto add = [&]<std::size_t... I>(std::index_sequence<I...>) {
    (
        [&] {
          if constexpr (I % built_in_parts == part) {
            using M = std::tuple_element_t<I, std::tuple<Models...>>;
            share.push_back({detail::complete_info<M>(), &make_model<M>});
          }
        }(),
        ...);
  };
  add(std::make_index_sequence<sizeof...(Models)>());
  return share;
}

}  // namespace albedo
