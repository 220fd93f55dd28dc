#include "rules/kronrod.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "rules/conclusion.hpp"
#include "rules/rays.hpp"

namespace albedo {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double noise = 16 * epsilon;  // rounding of a sum, relative to the sum of magnitudes

/// Kronrod's rule of N nodes on [0, 1] and the Gauss rule of every other node.
template <unsigned N>
struct Nodes {
  std::array<double, N> position{}, weight{}, gauss{};

  Nodes() {
    using Kronrod = boost::math::quadrature::gauss_kronrod<double, N>;
    using Gauss = boost::math::quadrature::gauss<double, (N - 1) / 2>;
    constexpr std::size_t middle = N / 2;
    for (std::size_t i = 0; i <= middle; ++i) {  // Boost has the nodes from the centre to the right
      const double x = Kronrod::abscissa()[i], w = Kronrod::weights()[i] / 2;
      const bool in_gauss = i % 2 == (middle % 2 == 0 ? 1 : 0);
      const double g = in_gauss ? Gauss::weights()[i / 2] / 2 : 0;
      for (const std::size_t k : {middle - i, middle + i}) {
        position[k] = k < middle ? (1 - x) / 2 : (1 + x) / 2;
        weight[k] = w;
        gauss[k] = g;
      }
    }
  }
};

/// An interval and what the rule says of it.
struct Part {
  double begin = 0, width = 1;
  double value = 0, error = 0, magnitude = 0;
  std::array<double, 2> hidden{};  // what an edge of the integrand could have beyond the outermost nodes, at each end

  [[nodiscard]] double density() const { return magnitude / width; }
};

/// Applies the rule to values at an interval's nodes.
template <unsigned N>
void measure(const Nodes<N>& nodes, const double* values, Part& part) {
  double kronrod = 0, gauss = 0, magnitude = 0;
  for (std::size_t i = 0; i < N; ++i) {
    kronrod += nodes.weight[i] * values[i];
    gauss += nodes.gauss[i] * values[i];
    magnitude += nodes.weight[i] * std::abs(values[i]);
  }
  double deviation = 0;
  for (std::size_t i = 0; i < N; ++i) deviation += nodes.weight[i] * std::abs(values[i] - kronrod);
  // QUADPACK's rescaling reports less than the difference where that is very small: only smooth integrands keep it
  const double difference = std::abs(kronrod - gauss);
  const double rescaled = deviation > 0 ? deviation * std::min(1.0, std::pow(200 * difference / deviation, 1.5)) : 0;
  part.value = kronrod * part.width;
  part.magnitude = magnitude * part.width;
  part.error = std::max(difference, rescaled) * part.width;
  if (part.error <= noise * part.magnitude) part.error = 0;  // counted as rounding, once for all
  // nodes are rounded like their positions, which tells where the interval is far narrower
  part.error += epsilon / 4 * (part.begin + part.width) * deviation;
  part.error = std::max(part.error, part.hidden[0] + part.hidden[1]);
}

/// The part of an interval between its outermost node and an end: an edge of the integrand there isn't seen.
template <unsigned N>
double hidden_end(const Nodes<N>& nodes) {
  return nodes.position.front();
}

/// Where halves differ, an edge may hide at the end that they share.
void keep_hidden(const Part& parent, double end, Part& a, Part& b) {
  const double step = end * std::abs(a.value - b.value);
  a.hidden = {parent.hidden[0] / 2, step};
  b.hidden = {step, parent.hidden[1] / 2};
}

/// What is added to a half's own error where bisecting changed more than had been reported: that change is nearly the
/// whole's true error, and the halves' own errors are as much too small.
struct Surprise {
  double factor = 1, floor = 0;

  [[nodiscard]] double raised(double error) const { return std::max(error * factor, floor); }
};

Surprise surprise(double before, double error, double magnitude, double after) {
  const double change = std::abs(after - before);
  if (!(change > error + noise * magnitude)) return {};
  return {error > 0 ? change / error : 1, change / 2};
}

/// Whether halving an interval still makes narrower ones.
bool divisible(const Part& part) { return part.begin + part.width / 2 > part.begin && part.width > 4 * epsilon; }

std::array<Part, 2> halves(const Part& part) {
  const double half = part.width / 2;
  return {Part{part.begin, half}, Part{part.begin + half, half}};
}

/// The integral over u at one v: intervals whose values, errors and magnitudes sum up.
struct Row {
  std::vector<Part> parts{};
  double value = 0, error = 0, magnitude = 0;

  void sum() {
    value = error = magnitude = 0;
    for (const Part& part : parts) value += part.value, error += part.error, magnitude += part.magnitude;
  }
};

constexpr unsigned row_nodes = 21, column_nodes = 15;

/// An interval of v with a row at each of its nodes.
struct Strip {
  int panel = 0;
  Part part{};            // its error is that of the rule over v
  double rows_error = 0;  // the rows' errors, integrated over v
  Surprise surprise{};    // of the bisection it came from
  bool hides_feature = false;
  bool rows_done = false;  // their errors can't be made smaller
  bool stuck = false;      // too narrow to be divided
  std::vector<Row> rows{};

  [[nodiscard]] double error() const { return part.error + rows_error; }
};

class Nested {
 public:
  Nested(const Integrand<double>& integrand, const RuleOptions& options) : integrand_(integrand), options_(options) {}

  Estimate run() {
    const auto panels = static_cast<int>(integrand_.panels().size());
    if (std::int64_t{panels} * first_look > options_.budget) return unaffordable(ErrorKind::rule_difference);
    for (int panel = 0; panel < panels; ++panel) {
      strips_.push_back(look(panel, Part{}, (panels - panel - 1) * first_look));
    }
    while (total()) {
      if (improve()) continue;
      total();  // rows may have been refined before the budget ended
      break;
    }
    return estimate_;
  }

 private:
  static constexpr std::int64_t first_look = std::int64_t{row_nodes} * column_nodes;

  [[nodiscard]] bool affordable(std::int64_t count) const { return evaluations_ + count <= options_.budget; }
  [[nodiscard]] const Panel& panel_of(const Strip& strip) const {
    return integrand_.panels()[static_cast<std::size_t>(strip.panel)];
  }

  /// Integrates a strip's rows at a first look that leaves as much of the budget as is reserved.
  Strip look(int panel, const Part& part, std::int64_t reserved) {
    Strip strip;
    strip.panel = panel;
    strip.part = part;
    const bool edged = panel_of(strip).edged;
    strip.hides_feature = std::any_of(panel_of(strip).features.begin(), panel_of(strip).features.end(),
                                      [&](const Feature& f) { return too_wide(part, f.v, f.width_v); });
    strip.rows.resize(column_nodes);
    std::array<double, column_nodes> v{};
    for (std::size_t j = 0; j < column_nodes; ++j) v[j] = part.begin + part.width * columns_.position[j];
    std::vector<Part> parts = strip.hides_feature ? std::vector<Part>{Part{}} : divided_at_features(strip);
    if (!affordable(static_cast<std::int64_t>(parts.size()) * first_look + reserved)) {
      parts.assign(1, Part{});
      strip.hides_feature = true;
    }
    std::array<double, row_nodes * column_nodes> w{};
    for (Part& along : parts) {
      const auto u = positions(along);
      rays_.evaluate(integrand_, panel, u.data(), row_nodes, v.data(), column_nodes, w.data());
      evaluations_ += first_look;
      for (std::size_t j = 0; j < column_nodes; ++j) {
        measure(nodes_, w.data() + j * row_nodes, along);
        strip.rows[j].parts.push_back(along);
      }
    }
    for (Row& row : strip.rows) {
      if (edged) hide_at_ends(row);
      row.sum();
    }
    measure_strip(strip);
    if (edged) {
      strip.part.hidden.fill(hidden_end(columns_) * strip.part.magnitude);
      measure_strip(strip);
    }
    return strip;
  }

  static double distance(const Part& part, double place) {
    return std::max({part.begin - place, place - part.begin - part.width, 0.0});
  }
  /// Whether an interval's nodes could miss a feature in it, or the tails of one beside it. Nodes are a tenth of their
  /// interval apart.
  static bool too_wide(const Part& part, double place, double width) {
    constexpr double seen = 4;
    return part.width > std::max(seen * width, distance(part, place));
  }

  /// What may hide at the ends of a row's first intervals, which follow one another.
  static void hide_at_ends(Row& row) {
    for (std::size_t i = 0; i < row.parts.size(); ++i) {
      Part& part = row.parts[i];
      const double before = i > 0 ? row.parts[i - 1].density() : 0;
      const double after = i + 1 < row.parts.size() ? row.parts[i + 1].density() : 0;
      const double end = hidden_end(nodes_) * part.width;
      part.hidden = {end * std::max(part.density(), before), end * std::max(part.density(), after)};
      part.error = std::max(part.error, part.hidden[0] + part.hidden[1]);
    }
  }

  /// The intervals of u that none of the features that reach into a strip is narrower than.
  [[nodiscard]] std::vector<Part> divided_at_features(const Strip& strip) const {
    std::vector<Part> open{Part{}}, done;
    while (!open.empty()) {
      const Part part = open.back();
      open.pop_back();
      const bool hides =
          std::any_of(panel_of(strip).features.begin(), panel_of(strip).features.end(), [&](const Feature& f) {
            return distance(strip.part, f.v) <= feature_reach * f.width_v && too_wide(part, f.u, f.width_u);
          });
      if (hides && divisible(part)) {
        for (const Part& half : halves(part)) open.push_back(half);
      } else {
        done.push_back(part);
      }
    }
    std::sort(done.begin(), done.end(), [](const Part& a, const Part& b) { return a.begin < b.begin; });
    return done;
  }

  [[nodiscard]] std::array<double, row_nodes> positions(const Part& part) const {
    std::array<double, row_nodes> u{};
    for (std::size_t i = 0; i < row_nodes; ++i) u[i] = part.begin + part.width * nodes_.position[i];
    return u;
  }

  /// The rule over v, from the rows.
  void measure_strip(Strip& strip) const {
    constexpr double layered = 8;  // narrow layers of small amplitude may lie between the nodes
    std::array<double, column_nodes> values{};
    strip.rows_error = 0;
    double magnitude = 0;
    for (std::size_t j = 0; j < column_nodes; ++j) {
      values[j] = strip.rows[j].value;
      strip.rows_error += columns_.weight[j] * strip.part.width * strip.rows[j].error;
      magnitude += columns_.weight[j] * strip.part.width * strip.rows[j].magnitude;
    }
    measure(columns_, values.data(), strip.part);
    strip.part.magnitude = magnitude;
    strip.part.error = strip.surprise.raised(strip.part.error * (panel_of(strip).layered ? layered : 1));
  }

  /// Sums up; false where nothing is left to do.
  bool total() {
    double value = 0, error = 0, magnitude = 0;
    bool hides_feature = false;
    for (const Strip& strip : strips_) {
      value += strip.part.value;
      error += strip.error();
      magnitude += strip.part.magnitude;
      hides_feature = hides_feature || strip.hides_feature;
    }
    const double rounding = rounding_of(magnitude);
    estimate_ = {value, error + rounding + integrand_.truncation() * std::abs(value), ErrorKind::rule_difference,
                 evaluations_, Status::budget_exhausted};
    target_ = options_.tolerance * std::abs(value);
    if (!std::isfinite(value) || !std::isfinite(error)) {
      estimate_.status = Status::non_finite;
    } else if (!hides_feature && estimate_.error <= target_) {
      estimate_.status = Status::converged;
    } else if (!hides_feature && error <= rounding) {
      estimate_.status = Status::rounding_limited;
    }
    return estimate_.status == Status::budget_exhausted;
  }

  /// Makes the worst strip better; false where that is impossible or exceeds the budget.
  bool improve() {
    Strip* worst = nullptr;
    const auto priority = [](const Strip& strip) {
      return strip.hides_feature ? std::numeric_limits<double>::infinity() : strip.error();
    };
    for (Strip& strip : strips_) {
      const bool finished = strip.stuck && strip.rows_done;
      if (!finished && (worst == nullptr || priority(strip) > priority(*worst))) worst = &strip;
    }
    if (worst == nullptr || !(priority(*worst) > 0)) return false;
    const bool rows_first = worst->rows_error > worst->part.error / 8 && !worst->hides_feature;
    if (!worst->rows_done && (rows_first || worst->stuck)) return refine_rows(*worst);
    if (!divisible(worst->part)) {
      worst->stuck = true;
      return true;
    }
    return bisect(*worst);
  }

  bool bisect(Strip& strip) {
    if (!affordable(2 * first_look)) return false;
    const auto [left, right] = halves(strip.part);
    Strip a = look(strip.panel, left, first_look), b = look(strip.panel, right, 0);
    if (!strip.hides_feature) {
      a.surprise = b.surprise = surprise(strip.part.value, strip.error() + a.rows_error + b.rows_error,
                                         strip.part.magnitude, a.part.value + b.part.value);
      if (panel_of(strip).edged) keep_hidden(strip.part, hidden_end(columns_), a.part, b.part);
      measure_strip(a);
      measure_strip(b);
    }
    strip = std::move(a);
    strips_.push_back(std::move(b));
    return true;
  }

  /// Bisects intervals of a strip's rows until their errors are a tenth of what is asked for, or far below that of the
  /// rule over v.
  bool refine_rows(Strip& strip) {
    constexpr double share = 0.1, balanced = 1.0 / 16;
    bool within_budget = true, done = true;
    const double wanted = std::max(share * target_ / static_cast<double>(integrand_.panels().size()),
                                   balanced * strip.part.error / strip.part.width);
    for (std::size_t j = 0; j < column_nodes && within_budget; ++j) {
      Row& row = strip.rows[j];
      const double v = strip.part.begin + strip.part.width * columns_.position[j];
      const double limit = std::max(wanted, noise * row.magnitude);
      while (row.error > limit && std::isfinite(row.error)) {
        const auto worst = std::max_element(row.parts.begin(), row.parts.end(),
                                            [](const Part& x, const Part& y) { return x.error < y.error; });
        if (!divisible(*worst)) break;
        if (!affordable(2 * row_nodes)) {
          within_budget = false;
          break;
        }
        bisect(strip.panel, v, row, static_cast<std::size_t>(worst - row.parts.begin()));
      }
      done = done && (row.error <= limit && limit > wanted);
    }
    const double before = strip.rows_error;
    measure_strip(strip);
    strip.rows_done = done || !(strip.rows_error < before);
    return within_budget;
  }

  void bisect(int panel, double v, Row& row, std::size_t index) {
    const Part parent = row.parts[index];
    auto [a, b] = halves(parent);
    std::array<double, 2 * row_nodes> u{}, same_v{}, w{};
    const auto left = positions(a), right = positions(b);
    std::copy(left.begin(), left.end(), u.begin());
    std::copy(right.begin(), right.end(), u.begin() + row_nodes);
    same_v.fill(v);
    integrand_.points(panel, u.data(), same_v.data(), w.data(), 2 * row_nodes);
    const bool edged = integrand_.panels()[static_cast<std::size_t>(panel)].edged;
    evaluations_ += 2 * row_nodes;
    measure(nodes_, w.data(), a);
    measure(nodes_, w.data() + row_nodes, b);
    const Surprise change = surprise(parent.value, parent.error, parent.magnitude, a.value + b.value);
    if (edged) keep_hidden(parent, hidden_end(nodes_), a, b);
    for (Part* half : {&a, &b}) half->error = std::max(change.raised(half->error), half->hidden[0] + half->hidden[1]);
    row.parts[index] = a;
    row.parts.push_back(b);
    row.sum();
  }

  inline static const Nodes<row_nodes> nodes_;
  inline static const Nodes<column_nodes> columns_;

  const Integrand<double>& integrand_;
  RuleOptions options_;
  std::vector<Strip> strips_;
  std::int64_t evaluations_ = 0;
  Rays rays_;
  double target_ = 0;
  Estimate estimate_;
};

}  // namespace

Estimate kronrod(const Integrand<double>& integrand, const RuleOptions& options) {
  return Nested(integrand, options).run();
}

}  // namespace albedo
