#include "analysis/scenes/plan/tube.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace albedo::analysis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t levels = 12;  // tried at each place where there are more values than can be

double cosine_of(double degrees) { return degrees == 90 ? 0 : std::cos(degrees * std::numbers::pi / 180); }

/// The values that a node may have at each place, rising.
std::vector<std::vector<double>> levels_of(const Tube& tube, const Quantisation& held) {
  std::vector<std::vector<double>> all(tube.low.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double low = std::max(tube.low[i], 0.0), high = std::min(tube.high[i], held.scale);
    if (held.bits < 16) {
      for (double k = std::ceil(low / held.step()); k * held.step() <= high; ++k) all[i].push_back(k * held.step());
      continue;
    }
    for (std::size_t k = 0; k < levels; ++k) {
      const double at = std::lerp(low, high, (static_cast<double>(k) + 0.5) / levels), value = held.rounded(at);
      if (value >= low && value <= high && (all[i].empty() || value > all[i].back())) all[i].push_back(value);
    }
  }
  return all;
}

/// A node on the way: which one comes before it.
struct Step {
  std::size_t place = 0, level = 0;
};

/// Breadth first from all nodes that may be the first. The first that may be the last has the fewest before it.
class Search {
 public:
  Search(const Tube& tube, const CosineGrid& grid, std::vector<std::vector<double>> values)
      : tube_(tube),
        grid_(grid),
        values_(std::move(values)),
        before_(values_.size()),
        is_seen_(values_.size()),
        least_beyond_(tube.low),
        most_beyond_(tube.high) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      before_[i].resize(values_[i].size());
      is_seen_[i].resize(values_[i].size());
    }
    for (std::size_t i = values_.size() - 1; i-- > 0;) {
      least_beyond_[i] = std::max(least_beyond_[i + 1], tube.low[i]);
      most_beyond_[i] = std::min(most_beyond_[i + 1], tube.high[i]);
    }
  }

  /// The nodes of the shortest path, backwards; empty if there is none.
  std::vector<Step> run() {
    std::vector<Step> frontier = starts(), next;
    while (!frontier.empty()) {
      for (const Step& step : frontier) {
        if (is_end(step)) return path_to(step);
      }
      next.clear();
      for (const Step& from : frontier) extend(from, next);
      std::swap(frontier, next);
    }
    return {};
  }

  [[nodiscard]] double value(const Step& step) const { return values_[step.place][step.level]; }

 private:
  /// All nodes from which a constant stays within the tube back to the first place. Each comes before itself.
  std::vector<Step> starts() {
    std::vector<Step> all;
    double least = -infinity, most = infinity;
    for (std::size_t i = 0; i < values_.size() && least <= most; ++i) {
      least = std::max(least, tube_.low[i]), most = std::min(most, tube_.high[i]);
      for (std::size_t k = 0; k < values_[i].size(); ++k) {
        if (values_[i][k] < least || values_[i][k] > most) continue;
        is_seen_[i][k] = true;
        before_[i][k] = {i, k};
        all.push_back({i, k});
      }
    }
    return all;
  }

  /// Whether a constant stays within the tube from here to the last place.
  [[nodiscard]] bool is_end(const Step& step) const {
    return value(step) >= least_beyond_[step.place] && value(step) <= most_beyond_[step.place];
  }

  /// Marks all that a chord from this node reaches within the tube.
  void extend(const Step& from, std::vector<Step>& reached) {
    const double x = grid_.cosine(from.place), y = value(from);
    double least = -infinity, most = infinity;  // slopes
    for (std::size_t i = from.place + 1; i < values_.size(); ++i) {
      const double run = grid_.cosine(i) - x;
      least = std::max(least, (tube_.low[i] - y) / run), most = std::min(most, (tube_.high[i] - y) / run);
      if (least > most) return;
      const auto begin = std::ranges::lower_bound(values_[i], y + least * run);
      for (auto level = begin; level != values_[i].end() && *level <= y + most * run; ++level) {
        const auto k = static_cast<std::size_t>(level - values_[i].begin());
        if (is_seen_[i][k]) continue;
        is_seen_[i][k] = true;
        before_[i][k] = from;
        reached.push_back({i, k});
      }
    }
  }

  [[nodiscard]] std::vector<Step> path_to(Step step) const {
    std::vector<Step> path{step};
    for (;;) {
      const Step before = before_[step.place][step.level];
      if (before.place == step.place) return path;
      path.push_back(step = before);
    }
  }

  const Tube& tube_;
  const CosineGrid& grid_;
  std::vector<std::vector<double>> values_;
  std::vector<std::vector<Step>> before_;
  std::vector<std::vector<char>> is_seen_;
  std::vector<double> least_beyond_, most_beyond_;  // of the tube, from a place on
};

/// 1, or the least power of two that the tube needs.
double scale_of(const Tube& tube) {
  const double needed = *std::ranges::max_element(tube.low);
  double scale = 1;
  while (scale < needed) scale *= 2;
  return scale;
}

}  // namespace

CosineGrid::CosineGrid(double least_theta, double largest_theta) {
  const int first = static_cast<int>(std::floor(steps * std::sqrt(cosine_of(largest_theta)) + 1e-9));
  const int last = static_cast<int>(std::ceil(steps * std::sqrt(cosine_of(least_theta)) - 1e-9));
  for (int j = first; j <= std::max(last, first + 1); ++j) {
    const double root = static_cast<double>(j) / steps;
    cosines_.push_back(root * root);
  }
  if (cosines_.front() == 0) cosines_.front() = std::max(cosine_of(largest_theta), 0.0);
}

Tube::Tube(std::size_t size) : low(size, -infinity), high(size, infinity) {}

void Tube::intersect(const Tube& other) {
  for (std::size_t i = 0; i < low.size(); ++i) {
    low[i] = std::max(low[i], other.low[i]);
    high[i] = std::min(high[i], other.high[i]);
  }
}

bool Tube::is_empty() const {
  for (std::size_t i = 0; i < low.size(); ++i) {
    if (!(low[i] <= high[i])) return true;
  }
  return false;
}

bool Tube::holds(double constant) const {
  return *std::ranges::max_element(low) <= constant && constant <= *std::ranges::min_element(high);
}

std::optional<double> Tube::constant() const {
  const double least = *std::ranges::max_element(low), most = *std::ranges::min_element(high);
  if (least > most) return {};
  return most < infinity ? (std::max(least, 0.0) + most) / 2 : std::max(least, 0.0);
}

double PlannedCurve::operator()(double cos_theta) const {
  const auto right = std::ranges::upper_bound(cosines, cos_theta);
  if (right == cosines.begin()) return values.front();
  if (right == cosines.end()) return values.back();
  const auto i = static_cast<std::size_t>(right - cosines.begin());
  return std::lerp(values[i - 1], values[i], (cos_theta - cosines[i - 1]) / (cosines[i] - cosines[i - 1]));
}

std::size_t PlannedCurve::bytes() const {
  const std::size_t places_too = values.size() > 1 ? 8 : 0;
  const std::size_t all = values.size() * (static_cast<std::size_t>(quantisation.bits) + places_too);
  return (all + 7) / 8 + (quantisation.bits < 32 && quantisation.scale != 1 ? 4 : 0);
}

bool is_within(const PlannedCurve& curve, const Tube& tube, const CosineGrid& grid) {
  constexpr double rounding = 1e-12;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double value = curve(grid.cosine(i));
    if (!(value >= tube.low[i] - rounding && value <= tube.high[i] + rounding)) return false;
  }
  return true;
}

std::optional<PlannedCurve> least_curve(const Tube& tube, const CosineGrid& grid, int bits) {
  const Quantisation held{bits, scale_of(tube)};
  if (const auto constant = tube.constant()) {
    const double value = held.rounded(std::min(*constant, held.scale));
    if (tube.holds(value))
      return PlannedCurve{.places = {grid.size() - 1}, .cosines = {1}, .values = {value}, .quantisation = held};
  }
  Search search(tube, grid, levels_of(tube, held));
  const std::vector<Step> path = search.run();
  if (path.empty()) return {};
  PlannedCurve curve{.quantisation = held};
  for (auto step = path.rbegin(); step != path.rend(); ++step) {
    curve.places.push_back(step->place);
    curve.cosines.push_back(grid.cosine(step->place));
    curve.values.push_back(search.value(*step));
  }
  return curve;
}

std::optional<PlannedCurve> smallest_curve(const Tube& tube, const CosineGrid& grid) {
  std::optional<PlannedCurve> best;
  if (tube.is_empty()) return best;
  for (const int bits : {8, 10, 16, 32}) {
    if (bits == 32 && best) break;  // a float is never smaller than 16 bits, which have answered already
    std::optional<PlannedCurve> curve = least_curve(tube, grid, bits);
    if (curve && (!best || curve->bytes() < best->bytes())) best = std::move(curve);
    if (best && best->values.size() <= 2) break;  // no more bits need fewer
  }
  return best;
}

}  // namespace albedo::analysis
