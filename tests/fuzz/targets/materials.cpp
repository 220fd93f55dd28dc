#include "analysis/subjects/materials.hpp"

#include <algorithm>

#include "analysis/subjects/material_table.hpp"
#include "fuzz/fuzz.hpp"

ALBEDO_FUZZ_TARGET(materials) {
  using namespace albedo;
  std::vector<analysis::Material> materials;
  if (!fuzz::accepts<FormatError>([&] { materials = analysis::parse_materials(input, "materials.json"); })) return;
  fuzz::require(!materials.empty(), "a list without materials");
  for (std::size_t i = 0; i < std::min<std::size_t>(materials.size(), 3); ++i) {
    fuzz::accepts<FormatError>([&] { analysis::make_material(materials[i], i, "materials.json"); });
  }
}
