#pragma once

#include <vector>

#include "albedo/core/number.hpp"

namespace albedo {

/// How an integrand behaves along one axis of the unit square.
enum class AxisKind {
  interval,       ///< analytic on [0, 1]
  periodic,       ///< analytic and of period 1
  even_periodic,  ///< half a turn: its mirror image continues it to a function of period 2
  gaussian,       ///< r exp(−r²) times a function that is smooth in r = range·u for r up to gaussian_reach
};

/// The largest r at which a rule evaluates along a gaussian axis.
inline constexpr double gaussian_reach = 5.8;

/// One axis of a panel.
struct Axis {
  AxisKind kind = AxisKind::interval;
  int order = 8;     ///< nodes to begin with: a hint that costs evaluations where it is wrong, never digits
  double range = 1;  ///< gaussian: the r of u = 1
};

/// A place of a panel where the integrand is known to be large, and how wide it is there: no rule may answer without
/// having looked.
struct Feature {
  double u, v;
  double width_u, width_v;
};

/// A unit square on which the integrand is smooth.
struct Panel {
  Axis u, v;
  std::vector<Feature> features{};
  bool tracked = true;   ///< false: large somewhere that isn't announced; no result is to be believed
  bool layered = false;  ///< has narrow layers of small amplitude: a rule's own reading of its error misses them
  bool turning = false;  ///< layered along v only, by what doubling a turn's nodes leaves less of than it changes
  bool edged =
      false;  ///< steps to 0 at an edge inside, which may hide between a cell's outermost points and its border
};

/// Whether a rectangle of a panel holds a feature that is narrower than the rectangle; then also along which axis to
/// divide it.
template <class S>
bool hides_feature(const Panel& panel, const S& u, const S& v, const S& width_u, const S& width_v, bool& divide_u) {
  for (const Feature& feature : panel.features) {
    if (feature.u < u || feature.u > u + width_u || feature.v < v || feature.v > v + width_v) continue;
    const S excess_u = width_u / feature.width_u, excess_v = width_v / feature.width_v;
    divide_u = excess_u >= excess_v;
    if ((divide_u ? excess_u : excess_v) > 1) return true;
  }
  return false;
}

/// What a rule integrates: the sum over panels of ∫∫ w(u, v) du dv over the unit square. Rules see nothing else.
template <class S>
class Integrand {
 public:
  virtual ~Integrand() = default;

  [[nodiscard]] const std::vector<Panel>& panels() const { return panels_; }

  /// What the panels leave out of the integral, relative to it.
  [[nodiscard]] double truncation() const { return truncation_; }

  /// Places along v where single points have a corner that sums along u don't have: rays change what ends them. For
  /// rules that don't sum along u first.
  [[nodiscard]] virtual std::vector<S> corners(int /*panel*/) const { return {}; }

  /// w at scattered points.
  virtual void points(int panel, const S* u, const S* v, S* w, int count) const = 0;
  /// w at the tensor product of nodes; w[i * count_v + j] belongs to (u[i], v[j]): rays side by side, as blocks have
  /// them.
  virtual void grid(int panel, const S* u, int count_u, const S* v, int count_v, S* w) const = 0;

 protected:
  Integrand() = default;
  Integrand(const Integrand&) = default;
  Integrand& operator=(const Integrand&) = default;

  std::vector<Panel> panels_;
  double truncation_ = 0;
};

}  // namespace albedo
