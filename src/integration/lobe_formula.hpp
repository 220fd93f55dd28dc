#pragma once

#include <type_traits>

#include "core/formula_of.hpp"
#include "integration/as_float.hpp"
#include "warps/sample.hpp"

namespace albedo {

/// One lobe's formula at what a warp makes of a point: w = f(L,V) cosθ_V |∂V/∂(u,v)|.
template <class T>
class LobeFormula {
 public:
  /// @param as_float a shader's arithmetic, for blocks
  LobeFormula(const Model& model, int component, bool as_float)
      : model_(model), formula_(FormulaOf<T>::of(model)), component_(component), as_float_(as_float) {}

  [[nodiscard]] T operator()(const Sample<T>& sample) const {
    if constexpr (std::is_same_v<T, Block>) {
      if (as_float_) return evaluate_as_float(model_, component_, sample.pair) * sample.weight;
    }
    return formula_.evaluate(component_, sample.pair) * sample.weight;
  }

 private:
  const Model& model_;
  const typename FormulaOf<T>::Type& formula_;
  int component_;
  bool as_float_;
};

}  // namespace albedo
