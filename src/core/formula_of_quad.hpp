#pragma once

#include "albedo/core/quad.hpp"
#include "core/formula_of.hpp"

namespace albedo {

template <>
struct FormulaOf<Quad> {
  using Type = QuadFormula;
  static const QuadFormula& of(const Model& model) { return model.quad(); }
};

}  // namespace albedo
