#include "albedo/core/quad.hpp"

#include "core/brdf.hpp"

namespace albedo {

double Model::coherent_albedo(const Direction& l) const { return static_cast<double>(quad().coherent_albedo(l)); }

template <>
Quad brdf<Quad>(const Model& model, const Direction& l, const Direction& v) {
  return sum_of_lobes<Quad>(model.quad(), model.lobes(), l, v);
}

}  // namespace albedo
