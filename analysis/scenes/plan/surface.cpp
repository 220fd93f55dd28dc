#include "analysis/scenes/plan/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace albedo::analysis {
namespace {

/// Between which places x is, and how far; constant beyond the ends.
struct Between {
  std::size_t left = 0, right = 0;
  double t = 0;
};

Between between(const std::vector<double>& places, double x) {
  const auto found = std::ranges::upper_bound(places, x);
  if (found == places.begin()) return {};
  const auto i = static_cast<std::size_t>(found - places.begin());
  if (found == places.end()) return {i - 1, i - 1, 0};
  return {i - 1, i, (x - places[i - 1]) / (places[i] - places[i - 1])};
}

/// Which of the reference places a table has.
struct Chosen {
  std::vector<std::size_t> second, cosines;
};

PlannedSurface table_of(const Chosen& chosen, const SurfaceReference& reference, const CosineGrid& grid,
                        const Quantisation& held) {
  PlannedSurface table;
  table.quantisation = held;
  for (const std::size_t i : chosen.cosines) table.cosines.push_back(grid.cosine(i));
  for (const std::size_t s : chosen.second) {
    table.second.push_back(reference.second[s]);
    for (const std::size_t i : chosen.cosines) table.values.push_back(held.rounded(reference.values[s][i]));
  }
  return table;
}

/// Tries to do without each place between the first and the last.
template <class IsFine>
void prune(std::vector<std::size_t>& places, IsFine is_fine) {
  for (std::size_t i = 1; i + 1 < places.size();) {
    const std::size_t taken = places[i];
    places.erase(places.begin() + static_cast<std::ptrdiff_t>(i));
    if (is_fine()) continue;
    places.insert(places.begin() + static_cast<std::ptrdiff_t>(i), taken);
    ++i;
  }
}

SurfaceReference narrowed(SurfaceReference reference) {
  for (std::size_t s = 0; s < reference.tubes.size(); ++s) {
    Tube& tube = reference.tubes[s];
    for (std::size_t i = 0; i < tube.low.size(); ++i) {
      const double value = reference.values[s][i];
      tube.low[i] = (tube.low[i] + value) / 2, tube.high[i] = (tube.high[i] + value) / 2;
    }
  }
  return reference;
}

std::optional<PlannedSurface> least_surface(const SurfaceReference& reference, const SurfaceReference& narrow,
                                            const CosineGrid& grid, const Quantisation& held) {
  Chosen chosen{std::vector<std::size_t>(reference.second.size()), std::vector<std::size_t>(grid.size())};
  std::iota(chosen.second.begin(), chosen.second.end(), 0), std::iota(chosen.cosines.begin(), chosen.cosines.end(), 0);
  const auto is_fine = [&](const SurfaceReference& allowed) {
    return is_within(table_of(chosen, reference, grid, held), allowed, grid);
  };
  if (!is_fine(reference)) return {};
  if (is_fine(narrow)) prune(chosen.second, [&] { return is_fine(narrow); });
  for (std::size_t before = 0; before != chosen.second.size() + chosen.cosines.size();) {
    before = chosen.second.size() + chosen.cosines.size();
    prune(chosen.cosines, [&] { return is_fine(reference); });
    prune(chosen.second, [&] { return is_fine(reference); });
  }
  return table_of(chosen, reference, grid, held);
}

}  // namespace

PlannedSurface::PlannedSurface(const PlannedCurve& curve)
    : cosines(curve.cosines), values(curve.values), quantisation(curve.quantisation) {}

double PlannedSurface::operator()(double second_place, double cos_theta) const {
  const Between c = between(cosines, cos_theta);
  const auto row = [&](std::size_t s) {
    const double* const begin = values.data() + s * cosines.size();
    return std::lerp(begin[c.left], begin[c.right], c.t);
  };
  if (second.empty()) return row(0);
  const Between s = between(second, second_place);
  return std::lerp(row(s.left), row(s.right), s.t);
}

std::size_t PlannedSurface::bytes() const {
  const std::size_t bits =
      values.size() * static_cast<std::size_t>(quantisation.bits) + (values.size() > 1 ? 8 * cosines.size() : 0);
  return (bits + 7) / 8 + 4 * second.size() + (quantisation.bits < 32 && quantisation.scale != 1 ? 4 : 0);
}

PlannedSurface PlannedSurface::without_cosine(std::size_t i) const {
  PlannedSurface left = *this;
  left.cosines.erase(left.cosines.begin() + static_cast<std::ptrdiff_t>(i));
  left.values.clear();
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k % cosines.size() != i) left.values.push_back(values[k]);
  }
  return left;
}

PlannedSurface PlannedSurface::without_second(std::size_t i) const {
  PlannedSurface left = *this;
  left.second.erase(left.second.begin() + static_cast<std::ptrdiff_t>(i));
  const auto row = values.size() / second.size();
  const auto begin = left.values.begin() + static_cast<std::ptrdiff_t>(i * row);
  left.values.erase(begin, begin + static_cast<std::ptrdiff_t>(row));
  return left;
}

bool is_within(const PlannedSurface& surface, const SurfaceReference& reference, const CosineGrid& grid) {
  constexpr double rounding = 1e-12;
  const std::size_t row = surface.cosines.size();
  std::vector<double> interpolated(row);
  for (std::size_t s = 0; s < reference.second.size(); ++s) {
    const Between at = between(surface.second, reference.second[s]);
    for (std::size_t i = 0; i < row; ++i) {
      interpolated[i] = std::lerp(surface.values[at.left * row + i], surface.values[at.right * row + i], at.t);
    }
    std::size_t right = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const double x = grid.cosine(i);
      while (right < row && surface.cosines[right] <= x) ++right;
      const double value =
          right == 0 ? interpolated.front()
          : right == row
              ? interpolated.back()
              : std::lerp(interpolated[right - 1], interpolated[right],
                          (x - surface.cosines[right - 1]) / (surface.cosines[right] - surface.cosines[right - 1]));
      const Tube& tube = reference.tubes[s];
      if (!(value >= tube.low[i] - rounding && value <= tube.high[i] + rounding)) return false;
    }
  }
  return true;
}

std::optional<PlannedSurface> least_surface(const SurfaceReference& reference, const CosineGrid& grid) {
  double largest = 0;
  for (const std::vector<double>& row : reference.values) largest = std::max(largest, *std::ranges::max_element(row));
  double scale = 1;
  while (scale < largest) scale *= 2;
  const SurfaceReference narrow = narrowed(reference);
  std::optional<PlannedSurface> best;
  for (const int bits : {8, 10, 16, 32}) {
    if (bits == 32 && best) break;
    std::optional<PlannedSurface> table = least_surface(reference, narrow, grid, {bits, scale});
    if (table && (!best || table->bytes() < best->bytes())) best = std::move(table);
  }
  return best;
}

}  // namespace albedo::analysis
