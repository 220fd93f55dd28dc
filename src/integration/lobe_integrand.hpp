#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include "core/integrand.hpp"
#include "integration/lobe_formula.hpp"

namespace albedo {

/// One lobe of a model on a warp: w = f(L,V) cosθ_V |∂V/∂(u,v)|.
template <template <class> class WarpIn, class T>
class LobeIntegrand final : public Integrand<Scalar<T>> {
  using S = Scalar<T>;

 public:
  LobeIntegrand(const Model& model, const Lobe& lobe, const Direction& l, double tolerance, bool as_float)
      : formula_(model, lobe.component, as_float), warp_(lobe, l, tolerance) {
    this->panels_ = warp_.panels();
    this->truncation_ = warp_.truncation();
    for (Panel& panel : this->panels_) panel.layered = panel.layered || lobe.hidden_kinks;
  }

  /// Where the lobe's own end begins or ends to be nearer than the horizon.
  [[nodiscard]] std::vector<S> corners(int panel) const override {
    std::vector<S> places;
    if constexpr (blocks && requires { WarpIn<T>::Line::gap; }) {
      constexpr int steps = 64, halvings = 50;
      const auto by_itself = [&](double v) { return warp_.line(panel, Block(v)).gap[0] > 0; };
      for (int i = 0; i < steps; ++i) {
        double low = static_cast<double>(i) / steps, high = static_cast<double>(i + 1) / steps;
        const bool before = by_itself(low);
        if (by_itself(high) == before) continue;
        for (int k = 0; k < halvings; ++k) {
          const double middle = (low + high) / 2;
          (by_itself(middle) == before ? low : high) = middle;
        }
        places.push_back(high);
      }
    }
    return places;
  }

  void points(int panel, const S* u, const S* v, S* w, int count) const override {
    if constexpr (blocks) {
      for (int i = 0; i < count; i += block_width) {
        const int filled = std::min(block_width, count - i);
        const auto line = warp_.line(panel, Block::load_partial(v + i, filled));
        formula_(warp_.point(panel, line, Block::load_partial(u + i, filled))).store(w + i, filled);
      }
    } else {
      for (int i = 0; i < count; ++i) w[i] = formula_(warp_.point(panel, warp_.line(panel, v[i]), u[i]));
    }
  }

  /// Eight rays at a time, each in a lane of its own; the last ones in several lanes each, for several points at once.
  void grid(int panel, const S* u, int count_u, const S* v, int count_v, S* w) const override {
    if constexpr (blocks) {
      for (int first = 0, rays = 0; first < count_v; first += rays) {
        const int left = count_v - first;
        if (left >= 7) {  // one lane may idle
          rays = group<8>(panel, u, count_u, v + first, left, w + first, count_v);
        } else if (left >= 3) {
          rays = group<4>(panel, u, count_u, v + first, left, w + first, count_v);
        } else if (left == 2) {
          rays = group<2>(panel, u, count_u, v + first, left, w + first, count_v);
        } else {
          rays = group<1>(panel, u, count_u, v + first, left, w + first, count_v);
        }
      }
    } else {
      for (int j = 0; j < count_v; ++j) {
        const auto line = warp_.line(panel, v[j]);
        for (int i = 0; i < count_u; ++i) {
          w[std::ptrdiff_t{i} * count_v + j] = formula_(warp_.point(panel, line, u[i]));
        }
      }
    }
  }

 private:
  static constexpr bool blocks = std::is_same_v<T, Block>;

  /// The first `most` rays, or those there are; returns their number. `pitch` is from a point's values to the next's.
  template <int most>
  int group(int panel, const S* u, int count_u, const S* v, int count_v, S* w, int pitch) const {
    constexpr int points = block_width / most;  // side by side in a block, each on all rays
    const int rays = std::min(most, count_v);
    const auto line = warp_.line(panel, rays == block_width ? Block::load(v) : Block::generate([=](int lane) {
                                   return v[std::min(lane % most, rays - 1)];
                                 }));
    const auto sample = [&](int i, auto filled) {
      const auto place = [&](int lane) { return u[i + std::min(lane / most, filled - 1)]; };
      return warp_.point(panel, line, points == 1 ? Block(u[i]) : Block::generate(place));
    };
    const auto put = [&](const Block& result, int i, auto filled) {
      S* to = w + std::ptrdiff_t{i} * pitch;
      if constexpr (points == 1) {
        result.store(to, rays);
      } else {
        std::array<double, block_width> values;
        result.store(values.data());
        for (int point = 0; point < filled; ++point, to += pitch) std::copy_n(values.data() + point * most, rays, to);
      }
    };
    constexpr std::integral_constant<int, points> all;
    int i = 0;
    for (; i + 2 * points <= count_u; i += 2 * points) {  // in pairs: one works while the other waits for a root
      const Sample<Block> samples[]{sample(i, all), sample(i + points, all)};
      const Block results[]{formula_(samples[0]), formula_(samples[1])};
      put(results[0], i, all);
      put(results[1], i + points, all);
    }
    for (; i < count_u; i += points) {
      const int filled = std::min(points, count_u - i);
      put(formula_(sample(i, filled)), i, filled);
    }
    return rays;
  }

  LobeFormula<T> formula_;
  WarpIn<T> warp_;
};

/// All lobes of a model, each on its own warp; their panels follow one another.
template <class S>
class SumIntegrand final : public Integrand<S> {
 public:
  explicit SumIntegrand(std::vector<std::unique_ptr<Integrand<S>>> parts) : parts_(std::move(parts)) {
    for (const auto& part : parts_) {
      this->truncation_ = std::max(this->truncation_, part->truncation());
      for (std::size_t i = 0; i < part->panels().size(); ++i) {
        this->panels_.push_back(part->panels()[i]);
        owners_.push_back({part.get(), static_cast<int>(i)});
      }
    }
  }

  [[nodiscard]] std::vector<S> corners(int panel) const override {
    const Owner& owner = owners_[static_cast<std::size_t>(panel)];
    return owner.part->corners(owner.panel);
  }

  void points(int panel, const S* u, const S* v, S* w, int count) const override {
    const Owner& owner = owners_[static_cast<std::size_t>(panel)];
    owner.part->points(owner.panel, u, v, w, count);
  }
  void grid(int panel, const S* u, int count_u, const S* v, int count_v, S* w) const override {
    const Owner& owner = owners_[static_cast<std::size_t>(panel)];
    owner.part->grid(owner.panel, u, count_u, v, count_v, w);
  }

 private:
  struct Owner {
    const Integrand<S>* part;
    int panel;
  };
  std::vector<std::unique_ptr<Integrand<S>>> parts_;
  std::vector<Owner> owners_;
};

}  // namespace albedo
