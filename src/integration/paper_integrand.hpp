#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "integration/lobe_formula.hpp"
#include "warps/paper.hpp"

namespace albedo {

/// One lobe of a model on its own sampling: w = f(L,V) cosθ_V/density(V).
template <class T>
class PaperIntegrand final : public Integrand<Scalar<T>> {
  using S = Scalar<T>;

 public:
  PaperIntegrand(const Model& model, const Lobe& lobe, const Direction& l, double tolerance, bool as_float)
      : formula_(model, lobe.component, as_float), warp_(model, lobe, l, tolerance) {
    this->panels_ = warp_.panels();
    this->truncation_ = warp_.truncation();
  }

  void points(int, const S* u, const S* v, S* w, int count) const override {
    if constexpr (std::is_same_v<T, Block>) {
      for (int i = 0; i < count; i += block_width) {
        const int filled = std::min(block_width, count - i);
        value(Block::load_partial(u + i, filled), Block::load_partial(v + i, filled)).store(w + i, filled);
      }
    } else {
      for (int i = 0; i < count; ++i) w[i] = value(u[i], v[i]);
    }
  }

  void grid(int panel, const S* u, int count_u, const S* v, int count_v, S* w) const override {
    const auto width = static_cast<std::size_t>(count_u), height = static_cast<std::size_t>(count_v);
    std::vector<S> all_u(width * height), all_v(width * height);
    for (std::size_t i = 0; i < width; ++i) {
      for (std::size_t j = 0; j < height; ++j) all_u[i * height + j] = u[i], all_v[i * height + j] = v[j];
    }
    points(panel, all_u.data(), all_v.data(), w, count_u * count_v);
  }

 private:
  [[nodiscard]] T value(const T& u, const T& v) const { return formula_(warp_.point(u, v)); }

  LobeFormula<T> formula_;
  PaperWarp<T> warp_;
};

}  // namespace albedo
