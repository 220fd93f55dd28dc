#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "rules/cell.hpp"
#include "rules/conclusion.hpp"
#include "rules/gauss.hpp"

namespace albedo {
template <class S>
bool is_finite(const S& x) {
  using std::isfinite;  // 113 bits have theirs beside them
  return isfinite(x);
}

/// Both rules are extended by about as many nodes as they have, and their errors are what that changes: along u on a
/// few rays that stand for all of them, along v by new rays between the others.
template <class S>
class ProductRule {
 public:
  ProductRule(const Integrand<S>& integrand, const RuleOptions& options) : integrand_(integrand), options_(options) {}

  EstimateIn<S> run() {
    for (std::size_t i = 0; i < integrand_.panels().size(); ++i) {
      const Panel& panel = integrand_.panels()[i];
      Cell<S>& cell = work_->cells.emplace_back(Cell<S>{static_cast<int>(i), panel.u, panel.v});
      cell.u.order = std::clamp(cell.u.order, 4, most_checked(cell.u.kind));
      cell.v.order = std::clamp(cell.v.order, cell.v.kind == AxisKind::interval ? 4 : 2, most_nodes(cell.v.kind) / 4);
      cell.rough = panel.layered;
      cell.turning = panel.turning && cell.v.kind != AxisKind::interval;
      if (!allows(std::int64_t{cell.u.order} * cell.v.order)) return unaffordable();
      measure(cell);
    }
    for (;;) {
      EstimateIn<S> estimate = total();
      if (estimate.status != Status::budget_exhausted || work_->cells.empty()) return estimate;
      const auto hiding = std::find_if(work_->cells.begin(), work_->cells.end(),
                                       [](const Cell<S>& cell) { return cell.hides_feature; });
      if (hiding != work_->cells.end()) {
        if (!bisect(*hiding, hiding->divide_u)) return estimate;
        continue;
      }
      const S size = estimate.value < 0 ? S(-estimate.value) : estimate.value;
      const auto worst = std::max_element(work_->cells.begin(), work_->cells.end(),
                                          [](const auto& a, const auto& b) { return a.error() < b.error(); });
      const S rounding = 2 * std::numeric_limits<S>::epsilon() * worst->magnitude;
      const S share = std::max<S>(S(options_.tolerance) * size / S(8 * work_->cells.size()), rounding);
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
    const std::size_t count_u = nu.position.size(), count_v = nv.position.size(), count = count_v - first;
    evaluate(cell, nu, 0, nv.position.data() + first, count);
    const S area = cell.width_u * cell.width_v / S(cell.u.range);
    cell.rows.resize(count_v);
    const S magnitude = sum_rays(nu, nv.weight.data() + first, count, cell.rows.data() + first);
    S weight = 0, mean_doubt = 0;
    for (std::size_t j = 0; j < count; ++j) {
      weight += nv.weight[first + j];
      mean_doubt += nv.weight[first + j] * work_->doubt[j];
    }
    cell.value = area * dot(nv.weight.data(), cell.rows.data(), count_v);
    if (first == 0) {
      cell.magnitude = area * magnitude;
      work_->columns.resize(count_u);
      for (std::size_t i = 0; i < count_u; ++i) {
        work_->columns[i] = dot(nv.weight.data(), work_->values.data() + i * count, count);
      }
      cell.along_u = resolution(nu, work_->columns.data(), work_->scratch);
      scale(cell.along_u, area);
      cell.hides_feature = hides_feature(integrand_.panels()[static_cast<std::size_t>(cell.panel)], cell.begin_u,
                                         cell.begin_v, cell.width_u, cell.width_v, cell.divide_u);
    }
    mean_doubt /= weight;
    // what takes a second extension, or has harder rays than those that have been checked, is checked again
    if (first == 0 || cell.extensions > 1 || mean_doubt > 2 * cell.doubt) {
      cell.doubt = mean_doubt;
      choose_probes(cell, nu, nv, first, area / weight);
      cell.error_u = std::numeric_limits<S>::infinity();
    }
    if (cell.extensions > 0) {
      cell.along_v = resolution(nv, cell.rows.data(), work_->scratch);
      scale(cell.along_v, area);
      cell.error_v = extension_error(cell, area);
    } else {
      cell.error_v = std::numeric_limits<S>::infinity();
    }
  }

  /// The rule's sum and the doubt of each ray; returns the weighted sum of their magnitudes.
  ///
  /// A ray's error falls about like the square of its last coefficients, or slower: that, in some unit, is how much its
  /// sum is to be doubted.
  S sum_rays(const Nodes<S>& nodes, const S* weight_v, std::size_t count, S* rows) {
    const std::size_t n = nodes.position.size(), terms = static_cast<std::size_t>(nodes.terms);
    const std::size_t some = std::min<std::size_t>(3, terms), begin = terms - some;
    work_->doubt.resize(count + lanes<S>);
    std::array<S, lanes<S>> sums, doubts, sizes;
    S magnitude = 0;
    for (std::size_t j = 0; j < count; j += lanes<S>) {
      Lanes<S> sum(S(0)), size(S(0)), coefficient[3]{S(0), S(0), S(0)};
      for (std::size_t i = 0; i < n; ++i) {
        const Lanes<S> value = load_lanes(work_->values.data() + i * count + j);
        const Lanes<S> term = nodes.weight[i] * value;
        sum += term;
        size += abs(term);
        const S* transform = nodes.transform.data() + i * terms + begin;
        for (std::size_t k = 0; k < some; ++k) coefficient[k] += transform[k] * value;
      }
      for (Lanes<S>& c : coefficient) c *= c;
      store_lanes(sum, sums.data());
      store_lanes(size, sizes.data());
      store_lanes(Lanes<S>(max(max(coefficient[0], coefficient[1]), coefficient[2])), doubts.data());
      for (std::size_t lane = 0; lane < std::min(lanes<S>, count - j); ++lane) {
        rows[j + lane] = sums[lane];
        work_->doubt[j + lane] = doubts[lane];
        magnitude += weight_v[j + lane] * sizes[lane];
      }
    }
    work_->doubt.resize(count);
    return magnitude;
  }

  void evaluate(const Cell<S>& cell, const Nodes<S>& nu, std::size_t first_u, const S* place_v, std::size_t count_v) {
    const std::size_t count_u = nu.position.size() - first_u;
    work_->positions_u.resize(count_u);
    const S per_range = cell.width_u / S(cell.u.range);
    for (std::size_t i = 0; i < count_u; ++i)
      work_->positions_u[i] = cell.begin_u + per_range * nu.position[first_u + i];
    work_->positions_v.resize(count_v);
    for (std::size_t j = 0; j < count_v; ++j) work_->positions_v[j] = cell.begin_v + cell.width_v * place_v[j];
    work_->values.resize(count_u * count_v + lanes<S>);  // sums read whole blocks
    integrand_.grid(cell.panel, work_->positions_u.data(), static_cast<int>(count_u), work_->positions_v.data(),
                    static_cast<int>(count_v), work_->values.data());
    evaluations_ += static_cast<std::int64_t>(count_u * count_v);
  }

  /// Nothing is known where not every panel could be looked at.
  [[nodiscard]] EstimateIn<S> unaffordable() const {
    return {S(0), std::numeric_limits<S>::infinity(), evaluations_, Status::budget_exhausted};
  }

  static void scale(Resolution<S>& along, const S& area) {
    along.reading *= area;
    along.log_last += std::log(static_cast<double>(area));
  }

  /// The outermost of the rays from the given one on, where special directions are, and the most doubtful one of each
  /// of a few groups of equal doubt.
  void choose_probes(Cell<S>& cell, const Nodes<S>& nu, const Nodes<S>& nv, std::size_t first, const S& scale) const {
    const std::vector<S>& doubt = work_->doubt;
    const std::size_t n = doubt.size(), groups = std::clamp<std::size_t>(n / 4, 1, 3);
    const S largest = *std::max_element(doubt.begin(), doubt.end());
    S size = 0;
    for (const S& row : cell.rows) size = std::max<S>(size, row < 0 ? S(-row) : row);
    const S noise = 16 * S(nu.terms) * std::numeric_limits<S>::epsilon() * size;  // of a coefficient
    const S least = largest > 0 ? std::max<S>(largest / 1000, square(noise)) : S(1);
    const S *weight = nv.weight.data() + first, *place = nv.position.data() + first;
    S whole = 0, sum = 0;
    for (std::size_t i = 0; i < n; ++i) whole += weight[i] * (doubt[i] + least);
    std::array<std::size_t, std::tuple_size_v<decltype(cell.probes)>> chosen;
    cell.probe_count = 0;
    const auto choose = [&](std::size_t ray) {
      const auto end = chosen.begin() + static_cast<std::ptrdiff_t>(cell.probe_count);
      if (std::find(chosen.begin(), end, ray) == end) chosen[cell.probe_count++] = ray;
    };
    const auto [lowest, highest] = std::minmax_element(place, place + n);
    choose(static_cast<std::size_t>(lowest - place));
    choose(static_cast<std::size_t>(highest - place));
    std::size_t group = 0, best = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const S share = weight[i] * (doubt[i] + least);
      if (i == best || share > weight[best] * (doubt[best] + least)) best = i;
      sum += share;
      if (group + 1 > groups || (sum * S(groups) < whole * S(group + 1) && i + 1 < n)) continue;
      choose(best);
      ++group;
      best = i + 1;
    }
    const Nodes<S>& nodes = checking(cell.u);
    for (std::size_t k = 0; k < cell.probe_count; ++k) {
      const std::size_t ray = chosen[k];
      S known = 0;
      for (std::size_t i = 0; i < known_nodes(cell.u); ++i) known += nodes.weight[i] * work_->values[i * n + ray];
      cell.probes[k] = {place[ray], cell.rows[first + ray], known, scale * whole / (doubt[ray] + least)};
    }
  }

  /// The error along u: what more nodes change on the probes.
  void check(Cell<S>& cell) {
    const Nodes<S>& nodes = checking(cell.u);
    const std::size_t known = known_nodes(cell.u), fresh = nodes.position.size() - known, count = cell.probe_count;
    work_->places.resize(count);
    for (std::size_t k = 0; k < count; ++k) work_->places[k] = cell.probes[k].position;
    evaluate(cell, nodes, known, work_->places.data(), count);
    S ratio = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Probe<S>& probe = cell.probes[k];
      S sum = probe.known;
      for (std::size_t i = 0; i < fresh; ++i) sum += nodes.weight[known + i] * work_->values[i * count + k];
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
    const Nodes<S>& after = nodes_of<S>(cell.v.kind, cell.v.order, cell.extensions);
    const S change = dot(before.weight.data(), cell.rows.data(), before.position.size()) * area - cell.value;
    S size = change < 0 ? S(-change) : change;
    // two rules may agree by accident, but hardly on other moments too
    constexpr int part = 8;
    const std::size_t moment = static_cast<std::size_t>(
        cell.v.kind == AxisKind::periodic ? std::max(1, before.terms / 8) * 2 - 1 : std::max(1, before.terms / 8));
    for (const std::size_t k : {moment, moment + 1}) {
      const S other = area * (coefficient(before, cell.rows, k) - coefficient(after, cell.rows, k)) / part;
      size = std::max<S>(size, other < 0 ? S(-other) : other);
    }
    constexpr int rough = 8, turning = 2;
    if (cell.turning) return turning * size;
    const Resolution<S>& now = cell.along_v;
    const int terms = after.terms;
    if (cell.rough || (above_noise(cell, now) && now.slow(terms))) return rough * size;
    if (cell.extensions > 2) return size;  // it wasn't as smooth as it had been announced
    // how much of the change the extended rule has left; half of what its coefficients promise (in digits) is believed
    constexpr double believed = 0.5, least = 0.005;
    return size * S(std::clamp(std::exp((now.log_error(terms) - now.log_error(before.terms)) * believed), least, 1.0));
  }

  static S coefficient(const Nodes<S>& nodes, const std::vector<S>& rows, std::size_t k) {
    const auto terms = static_cast<std::size_t>(nodes.terms);
    if (k >= terms) return S(0);
    S sum = 0;
    for (std::size_t j = 0; j < nodes.position.size(); ++j) sum += nodes.transform[j * terms + k] * rows[j];
    return sum;
  }

  [[nodiscard]] EstimateIn<S> total() const {
    EstimateIn<S> estimate;
    S magnitude = 0;
    bool hides_feature = false;
    for (const Cell<S>& cell : work_->cells) {
      hides_feature = hides_feature || cell.hides_feature;
      estimate.value += cell.value;
      estimate.error += cell.error();
      magnitude += cell.magnitude;
    }
    const S size = estimate.value < 0 ? -estimate.value : estimate.value;
    const S rounding = rounding_of(magnitude);
    const bool rounding_only = estimate.error <= 3 * rounding;
    estimate.error = 4 * estimate.error + rounding +
                     S(integrand_.truncation()) * size;  // four times: measured over thousands of cases
    const bool resolved = !hides_feature && estimate.error <= S(options_.tolerance) * size;
    estimate.evaluations = evaluations_;
    estimate.status = !is_finite(estimate.value)        ? Status::non_finite
                      : resolved                        ? Status::converged
                      : rounding_only && !hides_feature ? Status::rounding_limited
                                                        : Status::budget_exhausted;
    return estimate;
  }

  /// The order that should bring an error down to the target; 0 where only bisection will.
  static int raised(int order, int most, const Resolution<S>& now, const S& error, const S& target, const S& size) {
    if (!now.decays) return order >= most ? 0 : std::min(most, order + std::max(3, order / 4));
    using std::log;
    // by the nodes that each digit has taken so far, or by the coefficients, whichever promise more
    const double reached = static_cast<double>(log(S(size / error))),
                 wanted = static_cast<double>(log(S(size / target)));
    const double surplus = static_cast<double>(log(error)) - now.log_error(order);
    const int reach = std::min(most, order * 3 / 2);
    int next = order + 1;
    while (next < reach && next * reached < order * wanted &&
           now.log_error(next) + surplus > static_cast<double>(log(target)))
      ++next;
    const bool hopeless = now.log_error(2.0 * most) + surplus > static_cast<double>(log(target));
    return next > most || (hopeless && 2 * order > most) ? 0 : next;
  }

  [[nodiscard]] bool allows(std::int64_t count) const { return evaluations_ + count <= options_.budget; }

  /// Whether the errors that are known leave a part of a share for each that isn't: most turn out far below it.
  [[nodiscard]] bool affordable(const S& share) const {
    const S unknown = share / 8;
    S sum = 0;
    for (const Cell<S>& cell : work_->cells) {
      sum += (is_finite(cell.error_u) ? cell.error_u : unknown) + (is_finite(cell.error_v) ? cell.error_v : unknown);
    }
    return sum <= share * S(2 * work_->cells.size());
  }

  /// The next thing to do about a cell: more nodes along u until they suffice, then along v; false when the budget
  /// forbids.
  bool improve(Cell<S>& cell, const S& share) {
    const bool checked = is_finite(cell.error_u);
    const bool negligible = cell.magnitude > 0 && 4 * cell.magnitude <= share;  // nothing at all may be a missed lobe
    if (!checked && cell.extensions == 0 && negligible) {
      cell.error_u = cell.error_v = cell.magnitude;
      return true;
    }
    if (checked && cell.error_u > share && !(cell.error_u < cell.error_v && affordable(share))) {
      const S margin = S(4 << cell.extensions);  // another miss would cost all of the rays again
      const int order =
          raised(cell.u.order, most_checked(cell.u.kind), cell.along_u, cell.error_u, share / margin, cell.magnitude);
      if (order == 0) return bisect(cell, true);
      if (!allows(order * static_cast<std::int64_t>(cell.rows.size()))) return false;
      cell.u.order = order;
      measure(cell);
      return true;
    }
    if (!checked) {
      const std::size_t fresh = checking(cell.u).position.size() - known_nodes(cell.u);
      if (!allows(static_cast<std::int64_t>(cell.probe_count * fresh))) return false;
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
    const int order =
        raised(cell.v.order, most_nodes(cell.v.kind) / 2, cell.along_v, cell.error_v, share, cell.magnitude);
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
    half.turning = false;
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
    work_->cells.push_back(std::move(other));
    return true;
  }

  const Integrand<S>& integrand_;
  RuleOptions options_;
  std::int64_t evaluations_ = 0;
  Lease<S> work_;
};

template <class S>
EstimateIn<S> gauss(const Integrand<S>& integrand, const RuleOptions& options) {
  return ProductRule<S>(integrand, options).run();
}

}  // namespace albedo
