#include "rules/tanh_sinh.hpp"

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "rules/conclusion.hpp"
#include "rules/rays.hpp"

namespace albedo {
namespace {

constexpr double noise = 16 * std::numeric_limits<double>::epsilon();  // rounding of a sum, relative to magnitudes
constexpr int most_halvings = 12, first_halvings = 2;

/// The nodes of one step 2^−level that the step before hasn't; weights are those of step 1, to be halved per level.
struct Level {
  std::vector<double> position{}, weight{};
};

/// x = 1/(1 + exp(−π sinh t)) on (0, 1), from 1e-60 to where 1 − x is an ulp: singularities at 0 may be strong.
Level make_level(int level) {
  using boost::math::constants::pi;
  constexpr double lowest = 1e-60;
  Level nodes;
  const double step = std::ldexp(1.0, -level);
  const auto add = [&](double t) {
    const double e = std::exp(-pi<double>() * std::sinh(t));  // (1 − x)/x
    const double x = 1 / (1 + e);
    if (x >= 1 || x < lowest) return;
    nodes.position.push_back(x);
    nodes.weight.push_back(pi<double>() * std::cosh(t) * x * (e / (1 + e)));
  };
  constexpr double farthest = 5;
  for (int k = -static_cast<int>(farthest / step); k <= static_cast<int>(farthest / step); ++k) {
    if (level == 0 || k % 2 != 0) add(k * step);
  }
  return nodes;
}

const Level& level_of(int level) {
  static const auto all = [] {
    std::array<Level, most_halvings + 1> levels;
    for (int i = 0; i <= most_halvings; ++i) levels[static_cast<std::size_t>(i)] = make_level(i);
    return levels;
  }();
  return all[static_cast<std::size_t>(level)];
}

int size_of(int level) { return static_cast<int>(level_of(level).position.size()); }

/// Nodes of all steps down to 2^−level.
int count_to(int level) {
  int count = 0;
  for (int i = 0; i <= level; ++i) count += size_of(i);
  return count;
}

/// The integrals by successive steps, and what they tell.
struct Sequence {
  std::array<double, 4> last{};  // the latest first
  int known = 0;

  void add(double value) {
    std::rotate(last.begin(), last.end() - 1, last.end());
    last[0] = value;
    known = std::min(known + 1, 4);
  }

  /// @param edged then changes that shrink fast do so by chance
  [[nodiscard]] double error(double magnitude, bool edged) const {
    if (known < 2) return std::numeric_limits<double>::infinity();
    const double now = std::abs(last[0] - last[1]);
    if (now <= noise * magnitude) return 0;  // counted as rounding, once for all
    if (known < 3) return 16 * now;
    constexpr double power = 1.5, part = 1e-3;
    const double before = std::abs(last[1] - last[2]), first = std::abs(last[2] - last[3]);
    const auto foreseen = [&](double change) { return magnitude * std::pow(change / magnitude, power); };
    const bool analytic = !edged && known == 4 && now <= foreseen(before) && before <= foreseen(first);
    return analytic ? 2 * std::max(now, part * before) : 16 * now + before / 2;
  }
};

/// The sum over nodes that grows level by level.
struct Row {
  double sum = 0, absolute = 0;  // of the values with the weights of step 1
  int level = -1;
  double value = 0, error = 0, magnitude = 0;
  Sequence sequence{};

  void add_level(const double* values, bool edged) {
    const Level& nodes = level_of(++level);
    for (std::size_t i = 0; i < nodes.weight.size(); ++i) {
      sum += nodes.weight[i] * values[i];
      absolute += nodes.weight[i] * std::abs(values[i]);
    }
    value = std::ldexp(sum, -level);
    magnitude = std::ldexp(absolute, -level);
    sequence.add(value);
    error = sequence.error(magnitude, edged);
  }
};

/// A panel: rows at the nodes over v, in the order of their levels.
struct Table {
  int panel = 0;
  int level = -1;
  std::vector<Row> rows{};
  double value = 0, error = 0, rows_error = 0, magnitude = 0;
  bool hides_feature = false, hides_between_rows = false, rows_done = false;

  [[nodiscard]] bool finished() const { return level == most_halvings && rows_done; }
};

class Nested {
 public:
  Nested(const Integrand<double>& integrand, const RuleOptions& options) : integrand_(integrand), options_(options) {}

  Estimate run() {
    const auto panels = static_cast<std::int64_t>(integrand_.panels().size());
    first_ = first_halvings;
    while (first_ >= 0 && panels * count_to(first_) * count_to(first_) > options_.budget) --first_;
    if (first_ < 0) return unaffordable(ErrorKind::rule_difference);
    for (int panel = 0; panel < panels; ++panel) {
      Table table;
      table.panel = panel;
      for (int level = 0; level <= first_; ++level) add_level(table);
      tables_.push_back(std::move(table));
    }
    while (total()) {
      if (improve()) continue;
      total();  // rows may have been refined before the budget ended
      break;
    }
    return estimate_;
  }

 private:
  [[nodiscard]] const Panel& panel_at(int panel) const { return integrand_.panels()[static_cast<std::size_t>(panel)]; }
  [[nodiscard]] bool affordable(std::int64_t count) const { return evaluations_ + count <= options_.budget; }

  /// Adds the rows of the next step over v, each with the first steps over u.
  void add_level(Table& table) {
    const Level& nodes = level_of(++table.level);
    const auto count = static_cast<int>(nodes.position.size());
    const std::size_t begin = table.rows.size();
    table.rows.resize(begin + nodes.position.size());
    for (int level = 0; level <= first_; ++level) {
      const Level& along = level_of(level);
      const int width = size_of(level);
      values_.resize(along.position.size() * nodes.position.size());
      rays_.evaluate(integrand_, table.panel, along.position.data(), width, nodes.position.data(), count,
                     values_.data());
      evaluations_ += std::int64_t{width} * count;
      for (int j = 0; j < count; ++j) {
        table.rows[begin + static_cast<std::size_t>(j)].add_level(
            values_.data() + static_cast<std::ptrdiff_t>(j) * width, panel_at(table.panel).edged);
      }
    }
    table.rows_done = false;
    measure(table);
  }

  /// The rule over v, from the rows.
  void measure(Table& table) const {
    Sequence sequence;
    double sum = 0, rows_error = 0, magnitude = 0;
    std::size_t row = 0;
    for (int level = 0; level <= table.level; ++level) {
      for (const double weight : level_of(level).weight) {
        sum += weight * table.rows[row].value;
        rows_error += weight * table.rows[row].error;
        magnitude += weight * table.rows[row].magnitude;
        ++row;
      }
      sequence.add(std::ldexp(sum, -level));
    }
    table.value = sequence.last[0];
    table.magnitude = std::ldexp(magnitude, -table.level);
    table.rows_error = std::ldexp(rows_error, -table.level);
    const Panel& panel = panel_at(table.panel);
    table.error =
        sequence.error(table.magnitude, panel.edged) * (panel.layered ? 8 : 1);  // layers may lie between the nodes
    notice_features(table);
  }

  /// The distance of nodes around x in steps of 2^−level.
  static double spacing(double x, int level) {
    using boost::math::constants::pi;
    const double t = std::asinh(std::log(std::max(x, 1e-300) / std::max(1 - x, 1e-16)) / pi<double>());
    return std::ldexp(pi<double>() * std::cosh(t) * x * (1 - x), -level);
  }

  /// Whether a feature is narrower than the distance of nodes along v, or along u in a row that passes it.
  void notice_features(Table& table) const {
    table.hides_feature = table.hides_between_rows = false;
    for (const Feature& f : panel_at(table.panel).features) {
      if (spacing(f.v, table.level) > f.width_v) table.hides_between_rows = true;
      for_rows_at(table, f, [&](const Row& row) {
        if (spacing(f.u, row.level) > f.width_u) table.hides_feature = true;
      });
    }
    table.hides_feature = table.hides_feature || table.hides_between_rows;
  }

  template <class Rows, class Function>
  static void for_rows_at(Rows& table, const Feature& f, const Function& function) {
    std::size_t row = 0;
    for (int level = 0; level <= table.level; ++level) {
      for (const double v : level_of(level).position) {
        if (std::abs(v - f.v) <= feature_reach * f.width_v) function(table.rows[row]);
        ++row;
      }
    }
  }

  /// Sums up; false where nothing is left to do.
  bool total() {
    double value = 0, error = 0, magnitude = 0;
    bool believable = first_ == first_halvings;
    for (const Table& table : tables_) {
      value += table.value;
      error += table.error + table.rows_error;
      magnitude += table.magnitude;
      believable = believable && !table.hides_feature;
    }
    const double rounding = rounding_of(magnitude);
    estimate_ = {value, error + rounding + integrand_.truncation() * std::abs(value), ErrorKind::rule_difference,
                 evaluations_, Status::budget_exhausted};
    target_ = options_.tolerance * std::abs(value);
    if (!std::isfinite(value)) {
      estimate_.status = Status::non_finite;
    } else if (believable && estimate_.error <= target_) {
      estimate_.status = Status::converged;
    } else if (believable && error <= rounding) {
      estimate_.status = Status::rounding_limited;
    }
    return estimate_.status == Status::budget_exhausted;
  }

  /// Makes the worst panel better; false where that is impossible or exceeds the budget.
  bool improve() {
    Table* worst = nullptr;
    const auto priority = [](const Table& table) {
      return table.hides_feature ? std::numeric_limits<double>::infinity() : table.error + table.rows_error;
    };
    for (Table& table : tables_) {
      if (!table.finished() && (worst == nullptr || priority(table) > priority(*worst))) worst = &table;
    }
    if (worst == nullptr || !(priority(*worst) > 0)) return false;
    const bool rows_first = worst->hides_feature ? !worst->hides_between_rows : worst->rows_error > worst->error / 8;
    if (!worst->rows_done && (rows_first || worst->level == most_halvings)) return refine_rows(*worst);
    if (worst->level == most_halvings) {
      worst->rows_done = true;
      return true;
    }
    if (!affordable(std::int64_t{size_of(worst->level + 1)} * count_to(first_))) return false;
    add_level(*worst);
    return true;
  }

  /// Halves the steps of rows until their errors are a tenth of what is asked for and they have met the features.
  bool refine_rows(Table& table) {
    constexpr double share = 0.1;
    constexpr int ahead =
        4;  // halvings that rows have more than the rule over v: rows with kinks would take all budget
    const double wanted = share * target_ / static_cast<double>(tables_.size());
    const int most = std::min(most_halvings, table.level + ahead);
    std::vector<int> needed(table.rows.size(), 0);
    for (const Feature& f : panel_at(table.panel).features) {
      for_rows_at(table, f, [&](const Row& row) {
        int& level = needed[static_cast<std::size_t>(&row - table.rows.data())];
        while (level < most_halvings && spacing(f.u, level) > f.width_u) ++level;
      });
    }
    bool within_budget = true;
    std::size_t index = 0;
    for (int level = 0; level <= table.level && within_budget; ++level) {
      for (const double v : level_of(level).position) {
        Row& row = table.rows[index];
        within_budget =
            within_budget && refine(table.panel, v, row, std::max(wanted, noise * row.magnitude), needed[index], most);
        ++index;
      }
    }
    measure(table);
    table.rows_done = true;  // until there are new ones
    return within_budget;
  }

  /// Halves a row's step until it has a level, and an error unless that takes more than the most levels; false when the
  /// budget forbids.
  bool refine(int panel, double v, Row& row, double wanted, int level, int most) {
    while ((row.level < level || (row.level < most && row.error > wanted)) && std::isfinite(row.value)) {
      const Level& nodes = level_of(row.level + 1);
      const auto count = static_cast<int>(nodes.position.size());
      if (!affordable(count)) return false;
      values_.resize(nodes.position.size());
      integrand_.grid(panel, nodes.position.data(), count, &v, 1, values_.data());
      evaluations_ += count;
      row.add_level(values_.data(), panel_at(panel).edged);
    }
    return true;
  }

  const Integrand<double>& integrand_;
  RuleOptions options_;
  int first_ = 0;  // level of the first look
  std::vector<Table> tables_;
  std::vector<double> values_;
  std::int64_t evaluations_ = 0;
  Rays rays_;
  double target_ = 0;
  Estimate estimate_;
};

}  // namespace

Estimate tanh_sinh(const Integrand<double>& integrand, const RuleOptions& options) {
  return Nested(integrand, options).run();
}

}  // namespace albedo
