#include "models/built_in_part.hpp"

namespace albedo {

template <>
std::vector<BuiltInModel> built_in_part<3>() {
  return share_of<3>(AllModels{});
}

}  // namespace albedo
