#include "albedo/core/model.hpp"

#include <limits>

#include "core/brdf.hpp"

namespace albedo {

Sampled<Block> Model::sample(int, const UnitVector<Block>&, const Block&, const Block&) const noexcept {
  return Sampled<Block>::none();
}
Sampled<double> Model::sample(int, const UnitVector<double>&, double, double) const noexcept {
  return Sampled<double>::none();
}
double Model::density(int, const UnitVector<double>&, const UnitVector<double>&) const noexcept {
  return std::numeric_limits<double>::quiet_NaN();
}
double Model::facet_distribution(const DirectionPair<double>&) const noexcept {
  return std::numeric_limits<double>::quiet_NaN();
}
double Model::facet_masking(const DirectionPair<double>&) const noexcept {
  return std::numeric_limits<double>::quiet_NaN();
}

template <>
double brdf<double>(const Model& model, const Direction& l, const Direction& v) {
  return sum_of_lobes<double>(model, model.lobes(), l, v);
}
template <>
float brdf<float>(const Model& model, const Direction& l, const Direction& v) {
  return sum_of_lobes<float>(model, model.lobes(), l, v);
}

}  // namespace albedo
