#pragma once

#include <algorithm>
#include <array>

#include "albedo/core/integrand.hpp"
#include "albedo/core/model.hpp"
#include "albedo/warps/sample.hpp"

namespace albedo {

/// One lobe of a model on a warp: w = f(L,V) cosθ_V |∂V/∂(u,v)|.
template <template <class> class WarpIn, class T>
class LobeIntegrand final : public Integrand<Scalar<T>> {
  using S = Scalar<T>;

 public:
  LobeIntegrand(const Model& model, const Lobe& lobe, const Direction& l, double tolerance, bool as_float)
      : model_(model), component_(lobe.component), as_float_(as_float), warp_(lobe, l, tolerance) {
    this->panels_ = warp_.panels();
    this->truncation_ = warp_.truncation();
  }

  void points(int panel, const S* u, const S* v, S* w, int count) const override {
    for (int i = 0; i < count; i += lanes) {
      const int filled = std::min(lanes, count - i);
      store(value(panel, warp_.line(panel, load(v + i, filled)), load(u + i, filled)), w + i, filled);
    }
  }

  /// Rays are set up several at a time, and their points packed into full blocks from one ray to the next.
  void grid(int panel, const S* u, int count_u, const S* v, int count_v, S* w) const override {
    for (int first = 0; first < count_v; first += lanes) {
      const int rays_here = std::min(lanes, count_v - first);
      auto rays = warp_.line(panel, load(v + first, rays_here));
      if constexpr (!blocks) {
        for (int i = 0; i < count_u; ++i) w[first * count_u + i] = value(panel, rays, u[i]);
      } else {
        const int count = rays_here * count_u;
        std::array<int, block_width> owner{};
        Block place;
        int ray_index = 0, along = 0;
        for (int done = 0; done < count; done += block_width) {
          for (int k = 0; k < block_width; ++k) {
            owner[static_cast<std::size_t>(k)] = ray_index;
            place.lanes[k] = u[along];
            if (done + k + 1 < count && ++along == count_u) along = 0, ++ray_index;
          }
          const auto ray = owner.front() == owner.back() ? lane(rays, owner.front()) : gather(rays, owner);
          value(panel, ray, place).store(w + first * count_u + done, std::min(block_width, count - done));
        }
      }
    }
  }

 private:
  static constexpr bool blocks = std::is_same_v<T, Block>;
  static constexpr int lanes = blocks ? block_width : 1;

  static T load(const S* values, int count) {
    if constexpr (blocks) {
      return count == block_width ? Block::load(values) : Block::load_partial(values, count);
    } else {
      return *values;
    }
  }

  static void store(const T& value, S* values, int count) {
    if constexpr (blocks) {
      value.store(values, count);
    } else {
      *values = value;
    }
  }

  /// Makes a ray's fields from those of others.
  template <class Line, class Pick>
  static Line transformed(Line& rays, const Pick& pick) {
    Line ray;
    [&]<std::size_t... I>(auto to, auto from, std::index_sequence<I...>) {
      ((std::get<I>(to) = pick(std::get<I>(from))), ...);
    }
    (ray.fields(), rays.fields(), std::make_index_sequence<std::tuple_size_v<decltype(rays.fields())>>());
    return ray;
  }

  /// One ray of several, in all lanes.
  template <class Line>
  static Line lane(Line& rays, int index) {
    return transformed(rays, [index](const Block& field) { return Block(field[index]); });
  }

  /// A ray of its own in each lane.
  template <class Line>
  static Line gather(Line& rays, const std::array<int, block_width>& index) {
    return transformed(rays, [&index](const Block& field) {
      Block picked;
      for (int k = 0; k < block_width; ++k) picked.lanes[k] = field[index[static_cast<std::size_t>(k)]];
      return picked;
    });
  }

  template <class Line>
  T value(int panel, const Line& ray, const T& u) const {
    const Sample<T> sample = warp_.point(panel, ray, u);
    if constexpr (blocks) {
      if (as_float_) return value_as_float(sample);
    }
    return model_.evaluate(component_, sample.pair) * sample.weight;
  }

  /// The formula as a shader would evaluate it, on pairs rounded to float.
  Block value_as_float(const Sample<Block>& sample) const {
    const DirectionPair<Block>& p = sample.pair;
    Block result;
    for (int i = 0; i < block_width; ++i) {
      auto at = [i](const Block& b) { return static_cast<float>(b[i]); };
      const DirectionPair<float> pair{at(p.cos_theta_l), at(p.cos_theta_v), at(p.l_x),         at(p.l_y),
                                      at(p.v_x),         at(p.v_y),         at(p.cos_theta_d), at(p.cos_theta_h),
                                      at(p.slope_x),     at(p.slope_y),     at(p.axis_gap)};
      result.lanes[i] = static_cast<double>(model_.evaluate(component_, pair)) * sample.weight[i];
    }
    return result;
  }

  const Model& model_;
  int component_;
  bool as_float_;
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

/// An integrand evaluated in 113 bits, for a rule that sums in double.
class RoundedIntegrand final : public Integrand<double> {
 public:
  explicit RoundedIntegrand(std::unique_ptr<Integrand<Quad>> exact) : exact_(std::move(exact)) {
    panels_ = exact_->panels(), truncation_ = exact_->truncation();
  }

  void points(int panel, const double* u, const double* v, double* w, int count) const override {
    for (int i = 0; i < count; ++i) {
      const Quad qu = u[i], qv = v[i];
      Quad qw;
      exact_->points(panel, &qu, &qv, &qw, 1);
      w[i] = static_cast<double>(qw);
    }
  }
  void grid(int panel, const double* u, int count_u, const double* v, int count_v, double* w) const override {
    for (int j = 0; j < count_v; ++j) {
      const std::vector<double> row(static_cast<std::size_t>(count_u), v[j]);
      points(panel, u, row.data(), w + static_cast<std::ptrdiff_t>(j) * count_u, count_u);
    }
  }

 private:
  std::unique_ptr<Integrand<Quad>> exact_;
};

}  // namespace albedo
