#include "albedo/table_growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "albedo/core/errors.hpp"
#include "core/text.hpp"
#include "numerics/larger.hpp"

namespace albedo {
namespace {

/// The entries of each combination of names.
std::size_t numeric_entries(std::vector<TableAxis> axes) {
  std::erase_if(axes, [](const TableAxis& axis) { return axis.is_categorical(); });
  return entry_count(axes);
}

std::vector<double> middles(const std::vector<double>& values) {
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) result.push_back(std::midpoint(values[i], values[i + 1]));
  return result;
}

bool can_grow(const TableAxis& axis) { return !axis.is_categorical() && axis.size() > 1; }

void check(const TableAxis& axis) {
  if (axis.is_categorical()) return;
  const auto rises = std::ranges::adjacent_find(axis.values, std::ranges::greater_equal{}) == axis.values.end();
  const auto falls = std::ranges::adjacent_find(axis.values, std::ranges::less_equal{}) == axis.values.end();
  if (!rises && !falls) throw ParameterError("max-error: the values of the axis '" + axis.name + "' must rise or fall");
}

/// The largest error in each gap of an axis, everything else being at nodes.
std::vector<double> gap_errors(const std::vector<TableAxis>& axes, std::size_t axis, const std::vector<double>& values,
                               const TableEntries& entries) {
  std::vector<TableAxis> between = axes;
  between[axis].values = middles(axes[axis].values);
  const std::vector<double> exact = entries(between);
  std::size_t inner = 1;
  for (std::size_t i = axis + 1; i < axes.size(); ++i) inner *= axes[i].size();
  const std::size_t gaps = between[axis].values.size();
  std::vector<double> errors(gaps);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const std::size_t gap = i / inner % gaps, outer = i / inner / gaps;
    const double* const left = values.data() + (outer * (gaps + 1) + gap) * inner + i % inner;
    const double middle = std::midpoint(left[0], left[inner]);
    if (std::isfinite(middle)) keep_larger(errors[gap], std::abs(middle - exact[i]));
  }
  return errors;
}

/// Interpolates at a share `t` of the way from each `left` node to the next.
double interpolated(const std::vector<TableAxis>& axes, const double* values, const std::vector<std::size_t>& left,
                    const std::vector<double>& t) {
  double sum = 0;
  for (std::size_t corner = 0; corner < std::size_t{1} << axes.size(); ++corner) {
    double weight = 1;
    std::size_t entry = 0;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const bool is_right = (corner >> i & 1) != 0;
      weight *= is_right ? t[i] : 1 - t[i];
      entry = entry * axes[i].size() + left[i] + (is_right && can_grow(axes[i]) ? 1 : 0);
    }
    if (weight != 0) sum += weight * values[entry];
  }
  return sum;
}

/// The share of a place along an axis, for the number of a place: spread over all of it.
double spread(std::size_t number, std::size_t axis) {
  constexpr std::array roots{0.6180339887498949, 0.7548776662466927, 0.8191725133961645, 0.8566748838545029};
  const double at = static_cast<double>(number + 1) * roots[axis % roots.size()];
  return at - std::floor(at);
}

}  // namespace

double Quantisation::step() const { return scale / (std::exp2(bits) - 1); }

double Quantisation::rounded(double value) const {
  if (bits == 32) return static_cast<double>(static_cast<float>(value));
  return std::round(value / step()) * step();
}

QuantisedEntries quantised(std::vector<double> values, int bits) {
  QuantisedEntries result;
  for (const double value : values) {
    if (std::isfinite(value)) result.scale = std::max(result.scale, value);
  }
  const Quantisation held{bits, result.scale};
  for (double& value : values) {
    if (bits == 0 || !std::isfinite(value)) continue;
    const double rounded = held.rounded(value);
    result.error = std::max(result.error, std::abs(rounded - value));
    value = rounded;
  }
  result.values = std::move(values);
  return result;
}

double interpolation_error(const std::vector<TableAxis>& axes, const std::vector<double>& values,
                           const TableEntries& entries) {
  constexpr std::size_t places = 256;
  double largest = 0;
  for (std::size_t number = 0; number < places; ++number) {
    std::vector<TableAxis> place = axes;
    std::vector<std::size_t> left(axes.size());
    std::vector<double> t(axes.size());
    std::size_t numeric = 0;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (axes[i].is_categorical()) continue;
      const std::vector<double>& nodes = axes[i].values;
      const double share = spread(number, numeric++);
      place[i].values = {nodes.front()};
      if (nodes.size() < 2) continue;
      const double at = share * static_cast<double>(nodes.size() - 1);
      left[i] = std::min(static_cast<std::size_t>(at), nodes.size() - 2);
      t[i] = number % 2 == 0 ? 0.5 : at - static_cast<double>(left[i]);
      place[i].values = {std::lerp(nodes[left[i]], nodes[left[i] + 1], t[i])};
    }
    const std::vector<double> exact = entries(place);
    for (std::size_t names = 0; names < exact.size(); ++names) {  // every combination of names has an entry
      std::size_t rest = names;
      for (std::size_t i = axes.size(); i-- > 0;) {
        if (!axes[i].is_categorical()) continue;
        left[i] = rest % axes[i].size();
        rest /= axes[i].size();
      }
      const double between = interpolated(axes, values.data(), left, t);
      if (std::isfinite(between)) keep_larger(largest, std::abs(between - exact[names]));
    }
  }
  return largest;
}

GrownTable grown(std::vector<TableAxis> axes, const TableEntries& entries, const TableGrowth& growth) {
  if (!(growth.max_error > 0)) {
    throw ParameterError(fmt::format("max-error is {} and must be positive", number_text(growth.max_error)));
  }
  std::size_t growing = 0;
  for (const TableAxis& axis : axes) {
    check(axis);
    if (can_grow(axis)) ++growing;
  }
  GrownTable table{.axes = std::move(axes)};
  for (double share = 1;;) {
    const QuantisedEntries held = quantised(entries(table.axes), growth.bits);
    const double target =
        share * (growth.max_error - held.error) / static_cast<double>(std::max(growing, std::size_t{1}));
    bool has_grown = false;
    std::vector<TableAxis> next = table.axes;
    for (std::size_t axis = 0; axis < table.axes.size() && target > 0; ++axis) {
      if (!can_grow(table.axes[axis])) continue;
      const std::vector<double>& nodes = table.axes[axis].values;
      const std::vector<double> errors = gap_errors(table.axes, axis, held.values, entries);
      std::vector<double>& more = next[axis].values;
      more.clear();
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        more.push_back(nodes[i]);
        if (i + 1 == nodes.size() || errors[i] <= target + held.error) continue;
        const double middle = std::midpoint(nodes[i], nodes[i + 1]);
        if (middle == nodes[i] || middle == nodes[i + 1]) continue;
        more.push_back(middle);
        has_grown = true;
      }
    }
    if (has_grown && numeric_entries(next) <= growth.most_entries) {
      table.axes = std::move(next);
      continue;
    }
    table.error = interpolation_error(table.axes, held.values, entries);
    table.is_reached = table.error <= growth.max_error;
    constexpr double least_share = 0.1;
    if (table.is_reached || has_grown || target <= 0 || share < least_share) return table;
    share /= 2;
  }
}

}  // namespace albedo
