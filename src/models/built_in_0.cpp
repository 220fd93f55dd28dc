#include "models/built_in_part.hpp"

namespace albedo {

template <>
std::vector<BuiltInModel> built_in_part<0>() {
  return share_of<0>(AllModels{});
}

}  // namespace albedo
