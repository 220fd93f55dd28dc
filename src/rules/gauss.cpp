#include "albedo/rules/gauss.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "rules/nodes.hpp"

namespace albedo {
namespace {

using boost::multiprecision::isfinite;
using std::isfinite;

/// How well an order resolves one axis of a cell, and what another order would do: a parabola through the logarithm of
/// the expansion's coefficients, read off at three places.
template <class S>
struct Resolution {
  S reading{};                                      // the error that the decay foretells
  S compared = std::numeric_limits<S>::infinity();  // the error by comparison with the order before
  bool foreseen = true;                             // whether that comparison came out as foretold
  bool decays = false;
  double last = 0, log_last = 0, slope = 0,
         curvature = 0;  // at term `last`: logarithm of the coefficient, its derivatives (both ≤ 0)
  double fallen = 0;     // what the logarithm has lost up to there

  [[nodiscard]] double log_coefficient(double term) const {
    const double ahead = term - last;
    return log_last + ahead * (slope + curvature * ahead / 2);
  }
  [[nodiscard]] S error() const { return std::max<S>(reading, compared); }

  /// The logarithm of the error of n nodes, which errs by the coefficients from 2n on. The extrapolation is trusted for
  /// two thirds, and no further than the coefficients have been seen to fall.
  [[nodiscard]] double log_error(double n) const {
    const double known = log_coefficient(n - 2);
    return known + std::max(0.67 * (log_coefficient(2 * n) - known), -1.2 * (fallen + std::max(0.0, log_last - known)));
  }
};

/// Reads the error of n nodes off the decay of the expansion of their values.
template <class S>
Resolution<S> resolution(const Nodes<S>& nodes, const std::vector<S>& values) {
  const std::size_t n = values.size();
  const std::size_t tail = std::min<std::size_t>(n, 3);
  // envelope: the largest coefficient from a third, from two thirds, and of the last three terms on
  const std::size_t third = n - tail, second = std::min((n / 3 + third) / 2 + 1, third),
                    first = std::min(n / 3, second);
  S envelope[3] = {};
  for (std::size_t k = n; k-- > first;) {
    S coefficient = 0;
    const S* row = nodes.transform.data() + k * n;
    for (std::size_t i = 0; i < n; ++i) coefficient += row[i] * values[i];
    if (coefficient < 0) coefficient = -coefficient;
    for (const auto& [begin, largest] :
         {std::pair{first, &envelope[0]}, {second, &envelope[1]}, {third, &envelope[2]}}) {
      if (k >= begin) *largest = std::max<S>(*largest, coefficient);
    }
  }
  Resolution<S> result;
  using std::exp;
  using std::log;
  if (envelope[2] == 0) {
    result.decays = true;
    result.slope = -40;
    result.fallen = 40;
    return result;
  }
  result.reading = 2 * envelope[2];
  if (first == second || second == third || !(2 * envelope[2] < envelope[0])) return result;
  const double l1 = static_cast<double>(log(envelope[0])), l2 = static_cast<double>(log(envelope[1])),
               l3 = static_cast<double>(log(envelope[2]));
  const double x1 = static_cast<double>(first), x2 = static_cast<double>(second), x3 = static_cast<double>(third);
  const double slope1 = (l2 - l1) / (x2 - x1), slope2 = (l3 - l2) / (x3 - x2);
  const double bend = (slope2 - slope1) / ((x3 - x1) / 2);
  result.decays = true;
  result.last = x3 + 1;
  result.log_last = l3;
  result.fallen = l1 - l3;
  if (bend <= 0) {  // geometric, or faster
    result.curvature = bend;
    result.slope = slope2 + bend * (x3 - x2) / 2;
  } else if (slope2 < 0.4 * slope1) {  // nearly geometric
    result.slope = slope2;
  } else {  // slower: as a power of the term
    result.slope = std::max(slope2, (l3 - l1) / std::log((x3 + 1) / (x1 + 1)) / (x3 + 1));
  }
  result.reading = std::min<S>(result.reading, exp(S(result.log_error(static_cast<double>(n)))));
  if (bend > 0) result.reading *= 4;  // a power's tail adds up
  return result;
}

/// A rectangle of a panel, integrated by a product rule.
template <class S>
struct Cell {
  int panel;
  S u0, v0, width_u, width_v;
  Axis u, v;
  S value{}, magnitude{};
  Resolution<S> along_u{}, along_v{};
  bool hides_feature = false;
  bool divide_u = false;
  bool rough = false;  // not smooth enough for readings: bisected since raising the order didn't help, or layered

  [[nodiscard]] S error() const { return along_u.error() + along_v.error(); }
};

template <class S>
class ProductRule {
 public:
  ProductRule(const Integrand<S>& integrand, const RuleOptions& options) : integrand_(integrand), options_(options) {}

  EstimateIn<S> run() {
    for (std::size_t i = 0; i < integrand_.panels().size(); ++i) {
      const Panel& panel = integrand_.panels()[i];
      Cell<S> cell{static_cast<int>(i), S(0), S(0), S(1), S(1), panel.u, panel.v};
      cell.u.order = std::clamp(cell.u.order, 4, most_nodes(cell.u.kind));
      cell.v.order = std::clamp(cell.v.order, 4, most_nodes(cell.v.kind));
      cell.rough = panel.layered;
      measure(cell);
      cells_.push_back(std::move(cell));
    }
    for (;;) {
      EstimateIn<S> estimate = total();
      if (estimate.status != Status::budget_exhausted || cells_.empty()) return estimate;
      const auto hiding =
          std::find_if(cells_.begin(), cells_.end(), [](const Cell<S>& cell) { return cell.hides_feature; });
      if (hiding != cells_.end()) {
        if (!bisect(static_cast<std::size_t>(hiding - cells_.begin()), hiding->divide_u)) return estimate;
        continue;
      }
      const S target = S(options_.tolerance) * (estimate.value < 0 ? -estimate.value : estimate.value);
      auto worst = std::max_element(cells_.begin(), cells_.end(),
                                    [](const auto& a, const auto& b) { return a.error() < b.error(); });
      if (!refine(static_cast<std::size_t>(worst - cells_.begin()), target / S(2 * cells_.size()))) return estimate;
    }
  }

 private:
  static void read(Resolution<S>& axis, const Nodes<S>& nodes, const std::vector<S>& values) {
    Resolution<S> reading = resolution(nodes, values);
    reading.compared = axis.compared;
    reading.foreseen = axis.foreseen;
    axis = reading;
  }

  void measure(Cell<S>& cell) {
    const Nodes<S>& nu = nodes_of<S>(cell.u.kind, cell.u.order);
    const Nodes<S>& nv = nodes_of<S>(cell.v.kind, cell.v.order);
    const std::size_t count_u = nu.position.size(), count_v = nv.position.size();
    positions_u_.resize(count_u);
    positions_v_.resize(count_v);
    for (std::size_t i = 0; i < count_u; ++i)
      positions_u_[i] = cell.u0 + cell.width_u * nu.position[i] / S(cell.u.range);
    for (std::size_t j = 0; j < count_v; ++j) positions_v_[j] = cell.v0 + cell.width_v * nv.position[j];
    values_.resize(count_u * count_v);
    integrand_.grid(cell.panel, positions_u_.data(), static_cast<int>(count_u), positions_v_.data(),
                    static_cast<int>(count_v), values_.data());
    evaluations_ += static_cast<std::int64_t>(values_.size());
    columns_.assign(count_u, S(0));
    rows_.resize(count_v);
    cell.value = cell.magnitude = 0;
    for (std::size_t j = 0; j < count_v; ++j) {
      const S* row = values_.data() + j * count_u;
      S sum = 0, magnitude = 0;
      for (std::size_t i = 0; i < count_u; ++i) {
        columns_[i] += nv.weight[j] * row[i];
        sum += nu.weight[i] * row[i];
        magnitude += nu.weight[i] * (row[i] < 0 ? -row[i] : row[i]);
      }
      rows_[j] = sum;
      cell.value += nv.weight[j] * sum;
      cell.magnitude += nv.weight[j] * magnitude;
    }
    read(cell.along_u, nu, columns_);
    read(cell.along_v, nv, rows_);
    const S area = cell.width_u * cell.width_v / S(cell.u.range);
    cell.value *= area;
    cell.magnitude *= area;
    cell.along_u.reading *= area;
    cell.along_v.reading *= area;
    cell.hides_feature = hides_feature(integrand_.panels()[static_cast<std::size_t>(cell.panel)], cell.u0, cell.v0,
                                       cell.width_u, cell.width_v, cell.divide_u);
  }

  [[nodiscard]] EstimateIn<S> total() const {
    EstimateIn<S> estimate;
    S magnitude = 0;
    bool hides_feature = false;
    for (const Cell<S>& cell : cells_) {
      hides_feature = hides_feature || cell.hides_feature;
      estimate.value += cell.value;
      estimate.error += cell.error();
      magnitude += cell.magnitude;
    }
    const S size = estimate.value < 0 ? -estimate.value : estimate.value;
    const S rounding = 16 * std::numeric_limits<S>::epsilon() * magnitude;
    const bool rounding_only =
        estimate.error <= 8 * rounding;  // coefficients carry (2k + 1) times the noise of a value
    estimate.error =
        2 * estimate.error + rounding + S(integrand_.truncation()) * size;  // twice: measured on rough integrands
    const bool resolved = !hides_feature && estimate.error <= S(options_.tolerance) * size;
    estimate.evaluations = evaluations_;
    estimate.status = !isfinite(estimate.value)         ? Status::non_finite
                      : resolved                        ? Status::converged
                      : rounding_only && !hides_feature ? Status::rounding_limited
                                                        : Status::budget_exhausted;
    return estimate;
  }

  /// The order that should bring an axis's error down to the target, or confirm that it is there; 0 where only
  /// bisection will.
  static int raised(const Axis& axis, const Resolution<S>& now, const S& target) {
    const int most = most_nodes(axis.kind);
    // neighbouring orders of an interval miss the same things; a turn's don't
    const int confirming =
        axis.order + (axis.kind == AxisKind::interval ? std::max(3, axis.order / 4) : std::max(2, axis.order / 8));
    if (now.reading < target / 1000 && now.foreseen) return confirming > most ? 0 : confirming;
    if (!now.decays || !now.foreseen) return axis.order >= most ? 0 : std::min(most, 1 + axis.order * 3 / 2);
    using std::log;
    const double wanted = static_cast<double>(log(target));
    const int reach = std::min(most, 2 * axis.order);
    int order = confirming;
    while (order < reach && now.log_error(order) > wanted) ++order;
    const bool hopeless = now.log_error(2.0 * most) > wanted;
    return order > most || (hopeless && 2 * axis.order > most) ? 0 : order;
  }

  /// Raises the orders of a cell or bisects it; false when the budget forbids.
  bool refine(std::size_t index, const S& target) {
    Cell<S> cell = cells_[index];
    const S share = target > 0 ? S(target / 2) : S(std::numeric_limits<S>::min());
    const bool u_is_worse = cell.along_u.error() >= cell.along_v.error();
    // both axes at first; later one at a time, so that a change tells on which axis it was needed
    const bool both = cell.along_u.error() == cell.along_v.error();
    const int order_u = both || u_is_worse ? raised(cell.u, cell.along_u, share) : cell.u.order;
    const int order_v = both || !u_is_worse ? raised(cell.v, cell.along_v, share) : cell.v.order;
    if (order_u == 0 || order_v == 0) return bisect(index, order_u == 0);
    cell.u.order = order_u;
    cell.v.order = order_v;
    if (evaluations_ + std::int64_t{cell.u.order} * cell.v.order > options_.budget) return false;
    const Cell<S> old = cell;
    measure(cell);
    if (both) {
      const S said_u = old.along_u.reading, said_v = old.along_v.reading;
      compare(old, said_u + said_v, cell.value, cell.along_u);
      compare(old, said_u + said_v, cell.value, cell.along_v);
      (said_u > said_v ? cell.along_v : cell.along_u).foreseen = true;
    } else {
      compare(old, u_is_worse ? old.along_u.reading : old.along_v.reading, cell.value,
              u_is_worse ? cell.along_u : cell.along_v);
    }
    cells_[index] = std::move(cell);
    return true;
  }

  /// What is known of an axis's new error from the change that a finer rule along it made. A change that the old
  /// reading foretold confirms the readings, and the finer rule is believed to err by a part of it; otherwise the
  /// error is four times the change, as it is where convergence is slow (32 times where the integrand isn't smooth).
  static void compare(const Cell<S>& old, const S& said, const S& value, Resolution<S>& axis) {
    constexpr int confirmed = 4, closely = 30, unconfirmed = 4, slow = 32;
    const S change = value > old.value ? S(value - old.value) : S(old.value - value);
    const S noise = 16 * std::numeric_limits<S>::epsilon() * old.magnitude;
    axis.foreseen = change <= said + noise;
    const bool confirms = axis.foreseen && axis.decays && axis.curvature < 0 && said < closely * change && !old.rough;
    axis.compared = change <= noise ? S(0)
                    : confirms      ? S(change / confirmed)
                                    : S((old.rough ? slow : unconfirmed) * change);
  }

  bool bisect(std::size_t index, bool along_u) {
    constexpr int order = 24;
    Cell<S> parent = cells_[index];
    parent.rough = true;
    Cell<S> half = parent;
    Axis& axis = along_u ? half.u : half.v;
    axis = {AxisKind::interval, order};
    S& width = along_u ? half.width_u : half.width_v;
    S& begin = along_u ? half.u0 : half.v0;
    if (evaluations_ + 2 * std::int64_t{half.u.order} * half.v.order > options_.budget) return false;
    width /= 2;
    if (begin + width == begin) return false;  // as narrow as the arithmetic allows
    Cell<S> other = half;
    (along_u ? other.u0 : other.v0) += width;
    measure(half);
    measure(other);
    const S said = along_u ? parent.along_u.reading : parent.along_v.reading;
    for (Cell<S>* child : {&half, &other}) {
      compare(parent, said, half.value + other.value, along_u ? child->along_u : child->along_v);
    }
    cells_[index] = half;
    cells_.push_back(other);
    return true;
  }

  const Integrand<S>& integrand_;
  RuleOptions options_;
  std::int64_t evaluations_ = 0;
  std::vector<Cell<S>> cells_;
  std::vector<S> positions_u_, positions_v_, values_, columns_, rows_;
};

}  // namespace

template <class S>
EstimateIn<S> gauss(const Integrand<S>& integrand, const RuleOptions& options) {
  return ProductRule<S>(integrand, options).run();
}

template EstimateIn<double> gauss(const Integrand<double>&, const RuleOptions&);
template EstimateIn<Quad> gauss(const Integrand<Quad>&, const RuleOptions&);

}  // namespace albedo
