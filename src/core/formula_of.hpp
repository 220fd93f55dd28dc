#pragma once

#include "albedo/core/model.hpp"

namespace albedo {

/// What evaluates a model's formula in T: the model itself or, in 113 bits, its QuadFormula (core/formula_of_quad.hpp).
template <class T>
struct FormulaOf {
  using Type = Model;
  static const Model& of(const Model& model) { return model; }
};

}  // namespace albedo
