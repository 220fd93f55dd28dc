#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/formula_of.hpp"
#include "core/integrand.hpp"
#include "warps/sample.hpp"

namespace albedo {

/// The sampling that was published with a model: V as its sampler draws it, w = f cosθ_V/density, 0 below the horizon.
/// One panel.
///
/// The weights are those of Walter 2005 (eq. 10) and Kurt et al. 2010 (eq. 21). Their edge at the horizon is somewhere
/// inside of the square: a deterministic rule converges slowly, while to a Monte Carlo rule it is a part of the
/// variance. Where w changes in the lobe's tail (u close to 1), and that matters, the tail is announced as features;
/// where little of the square is above the horizon, or f cosθ_V grows without bound there, the lobe isn't tracked.
template <class T>
class PaperWarp {
  using S = Scalar<T>;

 public:
  /// @param model     must outlive the warp and have a sampler for the lobe
  /// @param tolerance relative; what weighs less than that in the lobe's tail isn't looked for
  PaperWarp(const Model& model, const Lobe& lobe, const Direction& l, double tolerance)
      : formula_(FormulaOf<T>::of(model)),
        component_(lobe.component),
        l_(broadcast<T>(unit_vector<S>(l))),
        inside_(mirrored(lobe)),
        turn_(turn_of(lobe, l)) {
    if constexpr (std::is_same_v<T, Block>) {
      Panel panel{{AxisKind::interval, 16}, {AxisKind::interval, 16}};
      if (!lobe.is<CosineLobe>()) {
        panel.tracked = lobe.horizon_exponent >= 0;
        look_at_tail(tolerance, panel);
      } else if (lobe.kink_equal_cosines) {
        constexpr double least_cosine = 0.1;  // w grows like tanθ_V up to θ_L: like 1/√(1 − u), and then ends
        panel.tracked = l.cos_theta >= least_cosine;
        panel.edged = panel.layered = true;
      }
      panels_.push_back(std::move(panel));
    } else {
      const PaperWarp<Block> fast(model, lobe, l, tolerance);
      panels_ = fast.panels();
      truncation_ = fast.truncation();
    }
  }

  [[nodiscard]] const std::vector<Panel>& panels() const { return panels_; }
  [[nodiscard]] double truncation() const { return truncation_; }

  [[nodiscard]] Sample<T> point(const T& u, const T& v) const {
    // samplers are of (0, 1): where a rule's narrowest cells round to u = 1, densities are 0 or slopes infinite
    const T last(1 - std::numeric_limits<S>::epsilon() / 2);
    const Sampled<T> drawn = formula_.sample(component_, l_, min(u, last), T(v + turn_));
    const DirectionPair<T>& d = drawn.pair;
    const auto above = d.cos_theta_v > T(0);
    const auto or_else = [&above](const T& value, const T& elsewhere) { return select(above, value, elsewhere); };
    // a formula isn't asked for directions below the horizon: it gets another one there, with the weight 0
    const DirectionPair<T>& e = inside_;
    return {{d.cos_theta_l, or_else(d.cos_theta_v, e.cos_theta_v), d.l_x, d.l_y, or_else(d.v_x, e.v_x),
             or_else(d.v_y, e.v_y), or_else(d.cos_theta_d, e.cos_theta_d), or_else(d.cos_theta_h, e.cos_theta_h),
             or_else(d.slope_x, e.slope_x), or_else(d.slope_y, e.slope_y), or_else(d.axis_gap, e.axis_gap)},
            or_else(T(d.cos_theta_v / drawn.density), T(0))};
  }

 private:
  /// Samplers are periodic in v. At grazing incidence the horizon is at quarters of a turn from L; turned to v = 1/3
  /// and 5/6 it stays away from the places where rules divide, halves or fifths of intervals.
  static double turn_of(const Lobe& lobe, const Direction& l) {
    const auto* slopes = lobe.as<SlopeLobe>();
    double azimuth = 0;
    if (slopes != nullptr && slopes->profile != Profile::ggx) {  // v is an azimuth of slopes
      azimuth = std::atan2(slopes->width_y * l.sin_phi, slopes->width_x * l.cos_phi);
    } else if (lobe.is<CosineLobe>() && lobe.kink_equal_cosines) {  // at a quarter turn from L, too
      azimuth = std::atan2(l.sin_phi, l.cos_phi);
    }
    return azimuth / (2 * pi<double>)-1.0 / 12;
  }

  /// Looks along rays of fixed v at what w does beyond u = 31/32, where only a lobe's tail is left: if that matters,
  /// rules have to look there too.
  void look_at_tail(double tolerance, Panel& panel) {
    static constexpr int sectors = 8, rays = 2, coarse = block_width, first_depth = 6, last_depth = 53;
    constexpr double little = 0.2, part = 1.0 / 16;
    std::vector<double> change(static_cast<std::size_t>(sectors * rays * (last_depth - first_depth + 1)), 0.0);
    int above = 0;
    double sum = 0;
    auto at = change.begin();
    for (int ray = 0; ray < sectors * rays; ++ray) {
      const double v = (ray + 0.5) / (sectors * rays);
      const auto weights = [&](const auto& u_of) {
        const Sample<T> sample = point(Block::generate(u_of), Block(v));
        return formula_.evaluate(component_, sample.pair) * sample.weight;
      };
      const Block here = weights([](int i) { return (i + 0.5) / coarse; });
      for (int i = 0; i < coarse; ++i) {
        above += here[i] > 0 ? 1 : 0;
        sum += here[i] / (coarse * sectors * rays);
      }
      const double last = weights([](int) { return 31.0 / 32; })[0];
      for (int depth = first_depth; depth <= last_depth; depth += block_width) {
        const Block tail = weights([depth](int i) { return 1 - std::ldexp(1.0, -std::min(depth + i, last_depth)); });
        for (int i = 0; i < block_width && depth + i <= last_depth; ++i) {
          *at++ = std::ldexp(std::abs(tail[i] - last), -depth - i);
        }
      }
    }
    constexpr int per_sector = rays * (last_depth - first_depth + 1);
    for (int sector = 0; sector < sectors; ++sector) {
      const auto begin = change.begin() + sector * per_sector;
      const auto largest = std::max_element(begin, begin + per_sector);
      if (*largest <= part * tolerance * sum) {
        // a sum over depths, and between the rays; nothing where all of the tail is below the horizon
        if (*largest > 0) truncation_ += 4 * *largest / (sectors * sum);
      } else {
        const int depth = first_depth + static_cast<int>((largest - begin) % (last_depth - first_depth + 1));
        const double tail = std::ldexp(1.0, 1 - depth);
        panel.features.push_back({1 - tail / 2, (sector + 0.5) / sectors, tail, 1.0 / sectors});
      }
    }
    if (!(above >= little * (sectors * rays * coarse))) panel.tracked = false;
    panel.edged = above < sectors * rays * coarse || !panel.features.empty();
    panel.layered = panel.edged;
  }

  /// The mirror direction, where every formula is finite.
  [[nodiscard]] DirectionPair<T> mirrored(const Lobe& lobe) const {
    const UnitVector<T> mirror{-l_.x, -l_.y, l_.z};
    DirectionPair<T> pair{l_.z, l_.z, l_.x, l_.y, mirror.x, mirror.y, l_.z, T(1), T(0), T(0), T(0)};
    if (lobe.is<MirrorLobe>()) pair.axis_gap = T(1);  // off its axis, to be finite for any exponent
    return pair;
  }

  const typename FormulaOf<T>::Type& formula_;
  int component_;
  UnitVector<T> l_;
  DirectionPair<T> inside_;
  double turn_;
  double truncation_ = 0;
  std::vector<Panel> panels_;
};

}  // namespace albedo
