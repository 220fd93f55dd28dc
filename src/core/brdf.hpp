#pragma once

#include "albedo/core/model.hpp"
#include "core/lobe_axis.hpp"

namespace albedo {

/// Σ over the lobes of evaluator.evaluate(component, pair), from a model or its QuadFormula.
template <class T, class Evaluator>
T sum_of_lobes(const Evaluator& evaluator, const std::vector<Lobe>& lobes, const Direction& l, const Direction& v) {
  T sum = 0;
  for (const Lobe& lobe : lobes) {
    const UnitVector<T> light = unit_vector<T>(l);
    sum += evaluator.evaluate(lobe.component, direction_pair(light, unit_vector<T>(v), lobe_axis(lobe, light)));
  }
  return sum;
}

}  // namespace albedo
