#include "albedo/balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "core/check.hpp"
#include "numerics/larger.hpp"
#include "pumping/kernel_row.hpp"

namespace albedo {
namespace {

constexpr int terms = CosineTables::terms;
constexpr std::size_t most_panels = 64;
constexpr double narrowest_panel = 1e-3;
constexpr double row_share = 0.2;       // of the tolerance: errors of the kernel
constexpr double settled_share = 0.05;  // change of ln s that ends the iteration
constexpr double measured_share = 0.1;  // errors at the test places
constexpr double rounding = 1e-13;

/// The kernel's rows and the table that is to balance them.
class Balancing {
 public:
  Balancing(const Model& model, const BalanceOptions& options, CosineTables& table)
      : model_(model), options_(options), table_(table) {
    std::vector<double> values;
    for (std::size_t panel = 0; panel < table.panels(); ++panel) {
      std::array<double, terms> logs;
      for (int i = 0; i < terms; ++i) {
        logs[static_cast<std::size_t>(i)] = 0.5 * std::log(row(node(panel, i)).value() / options.rho);
      }
      append(values, CosineTables::expansion(logs));
    }
    table.add(values);
  }

  /// One iteration; returns the largest change of ln s.
  double iterate() {
    double change = 0;
    std::vector<double> values;
    for (std::size_t panel = 0; panel < table_.panels(); ++panel) {
      std::array<double, terms> logs;
      for (int i = 0; i < terms; ++i) {
        const double x = node(panel, i), step = 0.5 * excess(x).value;
        keep_larger(change, std::abs(step));
        logs[static_cast<std::size_t>(i)] = table_.log(0, x) + step;
      }
      append(values, CosineTables::expansion(logs));
    }
    table_.replace_last(values);
    return change;
  }

  /// Halves the panels between whose nodes the albedo is off; returns whether there were any. Otherwise bound() is
  /// known.
  bool refine() {
    bool halved = false;
    double worst = 0, at_nodes = 0;  // what the iteration has left is at the nodes, too
    row_error_ = 0;
    for (std::size_t panel = 0; panel < table_.panels(); ++panel) {
      const double begin = table_.edges()[panel], end = table_.edges()[panel + 1];
      double off = 0;
      for (const double t : CosineTables::test_places) {
        const KernelRow::Sum log_excess = excess(CosineTables::place(begin, end, t));
        keep_larger(off, std::abs(log_excess.value));
        keep_larger(row_error_, log_excess.error);
      }
      for (int i = 0; i < terms; ++i) keep_larger(at_nodes, std::abs(excess(node(panel, i)).value));
      keep_larger(worst, off);
      if (off < measured_share * options_.tolerance || table_.panels() >= most_panels || end - begin < narrowest_panel)
        continue;
      table_.split(panel++, CosineTables::place(begin, end, 0));
      halved = true;
    }
    worst *= CosineTables::unmeasured;
    keep_larger(worst, at_nodes);
    bound_ = worst + row_error_ + rounding;
    return halved;
  }

  [[nodiscard]] double bound() const { return bound_; }
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

 private:
  [[nodiscard]] double node(std::size_t panel, int i) const {
    return CosineTables::node(table_.edges()[panel], table_.edges()[panel + 1], i);
  }

  static void append(std::vector<double>& values, const std::array<double, terms>& expansion) {
    values.insert(values.end(), expansion.begin(), expansion.end());
  }

  KernelRow& row(double x) {
    const auto found = rows_.find(x);
    if (found != rows_.end()) return found->second;
    KernelRow& made =
        rows_.try_emplace(x, model_, x, 0.0, row_share * options_.tolerance, KernelRow::Least::viewer).first->second;
    evaluations_ += made.evaluations();
    check_positive_albedo("balance", model_, made.value(), std::exp(-x));
    return made;
  }

  /// ln (a/ρ) of the model divided by s(L) s(V), and its error.
  KernelRow::Sum excess(double x) {
    const KernelRow::Sum sum = row(x).divided_by(table_);
    return {std::log(sum.value / options_.rho) - table_.log(0, x), sum.error / sum.value};
  }

  const Model& model_;
  const BalanceOptions& options_;
  CosineTables& table_;
  std::map<double, KernelRow> rows_;
  double bound_ = 0, row_error_ = 0;
  std::int64_t evaluations_ = 0;
};

}  // namespace

Balance::Balance(const Model& model, const BalanceOptions& options) : options_(options) {
  check_number("balance: rho", options.rho, {std::numeric_limits<double>::min(), 1}, "(0, 1]");
  check_number("balance: tolerance", options.tolerance, {1e-12, 0.1}, "[1e-12, 0.1]");
  check_reciprocal("balance", model);
  check_isotropic("balance", model);
  Balancing balancing(model, options, table_);
  do {
    double before = 0;
    settled_ = false;
    for (int i = 0; !settled_ && i < most_iterations; ++i, ++iterations_) {
      const double change = balancing.iterate();
      if (before > 0) rate_ = change / before;
      before = change;
      settled_ = change < settled_share * options.tolerance;
    }
  } while (settled_ && balancing.refine());
  if (!settled_) balancing.refine();
  evaluations_ = balancing.evaluations();
  table_.raise_last(balancing.bound() / 2);
  bound_ = -std::expm1(-2 * balancing.bound());
  if (!(settled_ && bound_ <= options.tolerance)) status_ = Status::budget_exhausted;
}

double Balance::log_s(double cos_theta) const { return table_.log(0, -std::log(cos_theta)); }

}  // namespace albedo
