#include "models/built_in_part.hpp"

namespace albedo {

template <>
std::vector<BuiltInModel> built_in_part<1>() {
  return share_of<1>(AllModels{});
}

}  // namespace albedo
