#include "albedo/rules/gauss.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "rules/resolution.hpp"

namespace albedo {
namespace {

using boost::multiprecision::isfinite;
using std::isfinite;

/// A ray of a cell's grid that stands for its neighbours when the rule along them is checked.
template <class S>
struct Probe {
  S position;             // v, in the cell
  std::vector<S> values;  // at the rule's nodes
  S sum;                  // by the rule
  S factor;               // what an error of this ray amounts to in the cell
};

/// A rectangle of a panel, integrated by a product rule. What is known of the two rules' errors is infinite until it
/// has been measured.
template <class S>
struct Cell {
  int panel;
  Axis u, v;
  S begin_u{0}, begin_v{0}, width_u{1}, width_v{1};
  int extensions = 0;     // of the rule along v
  std::vector<S> rows{};  // the rule along u at each node of v
  S value{}, magnitude{};
  S doubt{};  // mean of the rays'
  Resolution<S> along_u{}, along_v{};
  std::vector<Probe<S>> probes{};
  S error_u = std::numeric_limits<S>::infinity(), error_v = std::numeric_limits<S>::infinity();
  bool hides_feature = false;
  bool divide_u = false;
  bool rough = false;  // bisected since raising the order didn't help, or layered

  [[nodiscard]] S error() const { return error_u + error_v; }
};

/// Both rules are extended by about as many nodes as they have, and their errors are what that changes: along u on a
/// few rays that stand for all of them, along v by new rays between the others.
template <class S>
class ProductRule {
 public:
  ProductRule(const Integrand<S>& integrand, const RuleOptions& options) : integrand_(integrand), options_(options) {}

  EstimateIn<S> run() {
    for (std::size_t i = 0; i < integrand_.panels().size(); ++i) {
      const Panel& panel = integrand_.panels()[i];
      Cell<S> cell{static_cast<int>(i), panel.u, panel.v};
      cell.u.order = std::clamp(cell.u.order, 4, most_checked(cell.u.kind));
      cell.v.order = std::clamp(cell.v.order, 4, most_nodes(cell.v.kind) / 4);
      cell.rough = panel.layered;
      if (!allows(std::int64_t{cell.u.order} * cell.v.order)) return unaffordable();
      measure(cell);
      cells_.push_back(std::move(cell));
    }
    for (;;) {
      EstimateIn<S> estimate = total();
      if (estimate.status != Status::budget_exhausted || cells_.empty()) return estimate;
      const auto hiding =
          std::find_if(cells_.begin(), cells_.end(), [](const Cell<S>& cell) { return cell.hides_feature; });
      if (hiding != cells_.end()) {
        if (!bisect(*hiding, hiding->divide_u)) return estimate;
        continue;
      }
      const S size = estimate.value < 0 ? S(-estimate.value) : estimate.value;
      const auto worst = std::max_element(cells_.begin(), cells_.end(),
                                          [](const auto& a, const auto& b) { return a.error() < b.error(); });
      const S rounding = 2 * std::numeric_limits<S>::epsilon() * worst->magnitude;
      const S share = std::max<S>(S(options_.tolerance) * size / S(8 * cells_.size()), rounding);
      if (!improve(*worst, share)) return estimate;
    }
  }

 private:
  /// Nodes that check a rule along u: Kronrod's extension, or on a gaussian axis, which has none, a larger rule.
  static const Nodes<S>& checking(const Axis& axis) {
    constexpr int more = 3;
    return axis.kind == AxisKind::gaussian ? nodes_of<S>(axis.kind, axis.order + more)
                                           : nodes_of<S>(axis.kind, axis.order, 1);
  }
  /// How many of them the rule itself has evaluated.
  static std::size_t known_nodes(const Axis& axis) {
    return axis.kind == AxisKind::gaussian ? 0 : static_cast<std::size_t>(axis.order);
  }
  static int most_checked(AxisKind kind) { return kind == AxisKind::gaussian ? 13 : most_nodes(kind); }

  /// Evaluates a cell on all nodes of its rules from the given one of v on.
  void measure(Cell<S>& cell, std::size_t first = 0) {
    const Nodes<S>& nu = nodes_of<S>(cell.u.kind, cell.u.order);
    const Nodes<S>& nv = nodes_of<S>(cell.v.kind, cell.v.order, cell.extensions);
    const std::size_t count_u = nu.position.size(), count_v = nv.position.size();
    evaluate(cell, nu, 0, nv.position.data() + first, count_v - first);
    const S area = cell.width_u * cell.width_v / S(cell.u.range);
    cell.rows.resize(count_v);
    columns_.assign(count_u, S(0));
    sizes_.assign(count_u, S(0));
    doubt_.resize(count_v - first);
    S weight = 0, mean_doubt = 0;
    for (std::size_t j = first; j < count_v; ++j) {
      const S* row = values_.data() + (j - first) * count_u;
      if (first == 0) {
        for (std::size_t i = 0; i < count_u; ++i) {
          columns_[i] += nv.weight[j] * row[i];
          sizes_[i] += nv.weight[j] * (row[i] < 0 ? -row[i] : row[i]);
        }
      }
      cell.rows[j] = dot(nu.weight.data(), row, count_u);
      doubt_[j - first] = doubt(nu, row);
      weight += nv.weight[j];
      mean_doubt += nv.weight[j] * doubt_[j - first];
    }
    cell.value = area * dot(nv.weight.data(), cell.rows.data(), count_v);
    cell.along_v = resolution(nv, cell.rows);
    scale(cell.along_v, area);
    if (first == 0) {
      cell.magnitude = area * dot(nu.weight.data(), sizes_.data(), count_u);
      cell.along_u = resolution(nu, columns_);
      scale(cell.along_u, area);
      cell.hides_feature = hides_feature(integrand_.panels()[static_cast<std::size_t>(cell.panel)], cell.begin_u,
                                         cell.begin_v, cell.width_u, cell.width_v, cell.divide_u);
    }
    mean_doubt /= weight;
    // what takes a second extension, or has harder rays than those that have been checked, is checked again
    if (first == 0 || cell.extensions > 1 || mean_doubt > 2 * cell.doubt) {
      cell.doubt = mean_doubt;
      cell.probes = probes(cell, nu, nv, first, area / weight);
      cell.error_u = std::numeric_limits<S>::infinity();
    }
    cell.error_v = cell.extensions > 0 ? extension_error(cell, area) : std::numeric_limits<S>::infinity();
  }

  void evaluate(const Cell<S>& cell, const Nodes<S>& nu, std::size_t first_u, const S* place_v, std::size_t count_v) {
    positions_u_.resize(nu.position.size() - first_u);
    for (std::size_t i = 0; i < positions_u_.size(); ++i) {
      positions_u_[i] = cell.begin_u + cell.width_u * nu.position[first_u + i] / S(cell.u.range);
    }
    positions_v_.resize(count_v);
    for (std::size_t j = 0; j < count_v; ++j) positions_v_[j] = cell.begin_v + cell.width_v * place_v[j];
    values_.resize(positions_u_.size() * count_v);
    integrand_.grid(cell.panel, positions_u_.data(), static_cast<int>(positions_u_.size()), positions_v_.data(),
                    static_cast<int>(count_v), values_.data());
    evaluations_ += static_cast<std::int64_t>(values_.size());
  }

  /// Nothing is known where not every panel could be looked at.
  [[nodiscard]] EstimateIn<S> unaffordable() const {
    return {S(0), std::numeric_limits<S>::infinity(), evaluations_, Status::budget_exhausted};
  }

  static void scale(Resolution<S>& along, const S& area) {
    along.reading *= area;
    along.log_last += std::log(static_cast<double>(area));
  }

  /// How much a ray's sum is to be doubted, in some unit: its error falls about like the square of the coefficients at
  /// three quarters of the order.
  static S doubt(const Nodes<S>& nodes, const S* values) {
    const std::size_t n = nodes.position.size(), first = n * 3 / 4;
    S largest = 0;
    for (std::size_t k = first; k < std::min(first + 3, n); ++k) {
      largest = std::max<S>(largest, square(dot(nodes.transform.data() + k * n, values, n)));
    }
    return largest;
  }

  /// The outermost of the rays from the given one on, where special directions are, and the most doubtful one of each
  /// of a few groups of equal doubt.
  std::vector<Probe<S>> probes(const Cell<S>& cell, const Nodes<S>& nu, const Nodes<S>& nv, std::size_t first,
                               const S& scale) const {
    const std::size_t n = doubt_.size(), groups = std::clamp<std::size_t>(n / 4, 1, 3);
    const S largest = *std::max_element(doubt_.begin(), doubt_.end());
    S size = 0;
    for (const S& row : cell.rows) size = std::max<S>(size, row < 0 ? S(-row) : row);
    const S noise = 16 * S(nu.terms) * std::numeric_limits<S>::epsilon() * size;  // of a coefficient
    const S least = largest > 0 ? std::max<S>(largest / 1000, square(noise)) : S(1);
    const S *weight = nv.weight.data() + first, *place = nv.position.data() + first;
    const auto [lowest, highest] = std::minmax_element(place, place + n);
    std::vector<std::size_t> chosen{static_cast<std::size_t>(lowest - place)};
    if (highest != lowest) chosen.push_back(static_cast<std::size_t>(highest - place));
    S whole = 0, sum = 0;
    for (std::size_t i = 0; i < n; ++i) whole += weight[i] * (doubt_[i] + least);
    std::size_t group = 0, best = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const S share = weight[i] * (doubt_[i] + least);
      if (i == best || share > weight[best] * (doubt_[best] + least)) best = i;
      sum += share;
      if (sum * S(groups) < whole * S(group + 1) && i + 1 < n) continue;
      if (std::find(chosen.begin(), chosen.end(), best) == chosen.end()) chosen.push_back(best);
      ++group;
      best = i + 1;
    }
    std::vector<Probe<S>> result;
    for (const std::size_t i : chosen) {
      const S* values = values_.data() + i * nu.position.size();
      result.push_back(
          {place[i], {values, values + nu.position.size()}, cell.rows[first + i], scale * whole / (doubt_[i] + least)});
    }
    return result;
  }

  /// The error along u: what more nodes change on the probes.
  void check(Cell<S>& cell) {
    const Nodes<S>& nodes = checking(cell.u);
    const std::size_t known = known_nodes(cell.u), fresh = nodes.position.size() - known;
    places_.clear();
    for (const Probe<S>& probe : cell.probes) places_.push_back(probe.position);
    evaluate(cell, nodes, known, places_.data(), places_.size());
    S ratio = 0;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const Probe<S>& probe = cell.probes[k];
      S sum = 0;
      for (std::size_t i = 0; i < known; ++i) sum += nodes.weight[i] * probe.values[i];
      for (std::size_t i = 0; i < fresh; ++i) sum += nodes.weight[known + i] * values_[k * fresh + i];
      const S change = sum - probe.sum;
      ratio = std::max<S>(ratio, probe.factor * (change < 0 ? S(-change) : change));
    }
    cell.error_u = ratio;
    constexpr int rough = 8;
    if (cell.rough) cell.error_u *= rough;
    constexpr int slow = 4;  // two rules may agree by accident
    if (cell.u.kind == AxisKind::interval && above_noise(cell, cell.along_u) && cell.along_u.slow(cell.u.order)) {
      cell.error_u = std::max(cell.error_u, std::min<S>(cell.along_u.reading, slow * cell.error_u));
    }
  }

  static bool above_noise(const Cell<S>& cell, const Resolution<S>& along) {
    constexpr int noise = 200;  // of coefficients, which carry (2k + 1) times that of a value
    return along.reading > noise * std::numeric_limits<S>::epsilon() * cell.magnitude;
  }

  /// The error along v, of the extended rule, from what the extension changed.
  S extension_error(const Cell<S>& cell, const S& area) const {
    const Nodes<S>& before = nodes_of<S>(cell.v.kind, cell.v.order, cell.extensions - 1);
    S sum = 0;
    for (std::size_t j = 0; j < before.position.size(); ++j) sum += before.weight[j] * cell.rows[j];
    const S change = sum * area - cell.value;
    const S size = change < 0 ? S(-change) : change;
    constexpr int rough = 8;
    const Resolution<S>& now = cell.along_v;
    const int terms = nodes_of<S>(cell.v.kind, cell.v.order, cell.extensions).terms;
    if (cell.rough || (above_noise(cell, now) && now.slow(terms))) return rough * size;
    if (cell.extensions > 2) return size;  // it wasn't as smooth as it had been announced
    // how much of the change the extended rule has left; a third of what its coefficients promise (in digits) is
    // believed
    constexpr double believed = 0.33, least = 0.02;
    return size * S(std::clamp(std::exp((now.log_error(terms) - now.log_error(before.terms)) * believed), least, 1.0));
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
    const bool rounding_only = estimate.error <= 3 * rounding;
    estimate.error = 4 * estimate.error + rounding +
                     S(integrand_.truncation()) * size;  // four times: measured over thousands of cases
    const bool resolved = !hides_feature && estimate.error <= S(options_.tolerance) * size;
    estimate.evaluations = evaluations_;
    estimate.status = !isfinite(estimate.value)         ? Status::non_finite
                      : resolved                        ? Status::converged
                      : rounding_only && !hides_feature ? Status::rounding_limited
                                                        : Status::budget_exhausted;
    return estimate;
  }

  /// The order that should bring an error down to the target; 0 where only bisection will.
  static int raised(int order, int most, const Resolution<S>& now, const S& error, const S& target) {
    if (!now.decays)
      return order >= most ? 0 : std::min(most, order + std::max(3, isfinite(error) ? order / 4 : order / 2));
    using std::log;
    // a measured error corrects the prediction
    const double surplus = isfinite(error) ? static_cast<double>(log(error)) - now.log_error(order) : 0;
    const double wanted = static_cast<double>(log(target)) - surplus;
    const int reach = std::min(most, isfinite(error) ? order * 3 / 2 : 2 * order);
    int next = order + 1;
    while (next < reach && now.log_error(next) > wanted) ++next;
    const bool hopeless = now.log_error(2.0 * most) > wanted;
    return next > most || (hopeless && 2 * order > most) ? 0 : next;
  }

  [[nodiscard]] bool allows(std::int64_t count) const { return evaluations_ + count <= options_.budget; }

  /// Whether the errors that are known leave a share for each that isn't.
  [[nodiscard]] bool affordable(const S& share) const {
    S sum = 0;
    for (const Cell<S>& cell : cells_) {
      sum += (isfinite(cell.error_u) ? cell.error_u : share) + (isfinite(cell.error_v) ? cell.error_v : share);
    }
    return sum <= share * S(2 * cells_.size());
  }

  /// The next thing to do about a cell: more nodes along u until they suffice, then along v; false when the budget
  /// forbids.
  bool improve(Cell<S>& cell, const S& share) {
    const bool checked = isfinite(cell.error_u);
    if (checked && cell.error_u > share && !(cell.error_u < cell.error_v && affordable(share))) {
      const S margin = S(8 << cell.extensions);  // another miss would cost all of the rays again
      const int order = raised(cell.u.order, most_checked(cell.u.kind), cell.along_u, cell.error_u, share / margin);
      if (order == 0) return bisect(cell, true);
      if (!allows(order * static_cast<std::int64_t>(cell.rows.size()))) return false;
      cell.u.order = order;
      measure(cell);
      return true;
    }
    if (!checked) {
      const std::size_t fresh = checking(cell.u).position.size() - known_nodes(cell.u);
      if (!allows(static_cast<std::int64_t>(cell.probes.size() * fresh))) return false;
      check(cell);
      return true;
    }
    const bool turn = cell.v.kind != AxisKind::interval;
    if (turn || cell.extensions == 0) {
      if (turn && 2 * cell.rows.size() > static_cast<std::size_t>(most_nodes(cell.v.kind))) return bisect(cell, false);
      if (!allows(cell.u.order * static_cast<std::int64_t>(cell.rows.size() + 1))) return false;
      const std::size_t known = cell.rows.size();
      ++cell.extensions;
      measure(cell, known);
      return true;
    }
    const int order = raised(cell.v.order, most_nodes(cell.v.kind) / 2, cell.along_v, cell.error_v, share);
    if (order == 0) return bisect(cell, false);
    if (!allows(cell.u.order * std::int64_t{2 * order + 1})) return false;
    cell.v.order = order;
    measure(cell);
    return true;
  }

  bool bisect(Cell<S>& cell, bool along_u) {
    constexpr int order = 24;
    Cell<S> half = cell;
    half.rough = true;
    half.extensions = 0;
    (along_u ? half.u : half.v) = {AxisKind::interval, order};
    if (!allows(2 * std::int64_t{half.u.order} * half.v.order)) return false;
    S& width = along_u ? half.width_u : half.width_v;
    const S& begin = along_u ? half.begin_u : half.begin_v;
    width /= 2;
    if (begin + width == begin) return false;  // as narrow as the arithmetic allows
    Cell<S> other = half;
    (along_u ? other.begin_u : other.begin_v) += width;
    measure(half);
    measure(other);
    cell = std::move(half);
    cells_.push_back(std::move(other));
    return true;
  }

  const Integrand<S>& integrand_;
  RuleOptions options_;
  std::int64_t evaluations_ = 0;
  std::vector<Cell<S>> cells_;
  std::vector<S> positions_u_, positions_v_, places_, values_, columns_, sizes_, doubt_;
};

}  // namespace

template <class S>
EstimateIn<S> gauss(const Integrand<S>& integrand, const RuleOptions& options) {
  return ProductRule<S>(integrand, options).run();
}

template EstimateIn<double> gauss(const Integrand<double>&, const RuleOptions&);
template EstimateIn<Quad> gauss(const Integrand<Quad>&, const RuleOptions&);

}  // namespace albedo
