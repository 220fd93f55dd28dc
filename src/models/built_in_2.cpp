#include "models/built_in_part.hpp"

namespace albedo {

template <>
std::vector<BuiltInModel> built_in_part<2>() {
  return share_of<2>(AllModels{});
}

}  // namespace albedo
