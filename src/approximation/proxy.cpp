#include "albedo/proxy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "albedo/core/errors.hpp"
#include "core/text.hpp"
#include "numerics/larger.hpp"
#include "numerics/parallel.hpp"

namespace albedo {
namespace {

constexpr std::size_t first_points = 9, most_points = 257;  // of a line

/// A matrix of `rows` rows applied along one axis of a tensor, which has so many columns and entries after it.
std::vector<double> along(const std::vector<double>& tensor, std::size_t columns, std::size_t after,
                          const std::vector<double>& matrix) {
  const std::size_t rows = matrix.size() / columns, before = tensor.size() / (columns * after);
  std::vector<double> result(before * rows * after, 0);
  for (std::size_t b = 0; b < before; ++b) {
    for (std::size_t r = 0; r < rows; ++r) {
      double* const out = &result[(b * rows + r) * after];
      for (std::size_t c = 0; c < columns; ++c) {
        const double factor = matrix[r * columns + c];
        const double* const in = &tensor[(b * columns + c) * after];
        for (std::size_t a = 0; a < after; ++a) out[a] += factor * in[a];
      }
    }
  }
  return result;
}

/// The terms that a series needs for the rest to sum to no more than `allowed`, but for what `noise` makes of each.
std::size_t terms_needed(const std::vector<double>& coefficients, double allowed, double noise) {
  double rest = 0;
  std::size_t needed = coefficients.size();
  while (needed > 0) {
    rest += std::max(std::abs(coefficients[needed - 1]) - noise, 0.0);
    if (!(rest <= allowed)) break;
    --needed;
  }
  return needed;
}

std::size_t product(const std::vector<std::size_t>& sizes) {
  std::size_t count = 1;
  for (const std::size_t size : sizes) {
    if (size > std::numeric_limits<std::size_t>::max() / count) return std::numeric_limits<std::size_t>::max();
    count *= size;
  }
  return count;
}

/// All combinations of the points of axes, C order.
std::vector<double> grid(const std::vector<std::vector<double>>& points) {
  std::vector<double> places{};
  std::vector<std::size_t> sizes;
  for (const std::vector<double>& axis : points) sizes.push_back(axis.size());
  const std::size_t count = product(sizes);
  places.reserve(count * points.size());
  std::vector<std::size_t> index(points.size(), 0);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < points.size(); ++i) places.push_back(points[i][index[i]]);
    for (std::size_t i = points.size(); i-- > 0 && ++index[i] == points[i].size();) index[i] = 0;
  }
  return places;
}

double unit_random(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

}  // namespace

std::vector<double> AlbedoProxy::AxisOfProxy::points() const {
  if (!variable) return values;
  std::vector<double> points = lobatto_points(size);
  for (double& point : points) point = variable->value_at(point);
  return points;
}

AlbedoProxy::AlbedoProxy(const std::vector<TableAxis>& axes, const ProxyEntries& entries, const ProxyOptions& options)
    : tolerance_(options.tolerance) {
  if (!(options.tolerance > 0 && options.tolerance < 1)) {
    throw ParameterError(fmt::format("the tolerance of a proxy is {:g} and must be within (0, 1)", options.tolerance));
  }
  for (const TableAxis& axis : axes) {
    if (axis.is_categorical()) {
      throw ParameterError(fmt::format("a proxy is over numbers, and the axis '{}' holds names", axis.name));
    }
    if (axis.values.empty()) throw ParameterError(fmt::format("the axis '{}' has no values", axis.name));
    axes_.push_back({.name = axis.name, .values = axis.values, .size = axis.values.size()});
  }
  look_along_axes(entries);
  double before = std::numeric_limits<double>::infinity();
  for (std::uint64_t attempt = 0; std::isfinite(largest_); ++attempt) {
    const std::size_t count = product(sizes());
    if (count > options.most_integrations) {
      throw ParameterError(fmt::format("a proxy would take {} integrations, and {} is the most it may", count,
                                       options.most_integrations));
    }
    fit(entries);
    if (!std::isfinite(largest_) || !is_reached()) break;  // what the integrations can't reach, no series can
    if (std::ranges::none_of(axes_, [](const AxisOfProxy& axis) { return axis.variable.has_value(); })) break;
    verify(entries, options, options.seed + attempt);
    const bool is_hopeless = !(error_ <= before / 3);
    before = error_;
    if (is_reached() || is_hopeless || !grow(options.most_integrations)) break;
  }
  if (!std::isfinite(largest_)) error_ = std::numeric_limits<double>::infinity();  // a series holds none
}

std::vector<std::size_t> AlbedoProxy::sizes() const {
  std::vector<std::size_t> sizes;
  for (const AxisOfProxy& axis : axes_) sizes.push_back(axis.size);
  return sizes;
}

ProxySamples AlbedoProxy::integrate(const std::vector<double>& places, const ProxyEntries& entries) {
  ProxySamples samples = entries(places);
  integrations_ += samples.values.size();
  evaluations_ += samples.evaluations;
  return samples;
}

bool AlbedoProxy::is_elliptic(std::size_t axis, const ProxyEntries& entries) {
  constexpr int most = 8;
  std::mt19937_64 random(most);
  std::vector<double> places;
  for (int k = 0; k < most; ++k) {
    std::vector<double> place;
    for (const AxisOfProxy& other : axes_) place.push_back(other.values[random() % other.values.size()]);
    const auto [least, largest] = std::ranges::minmax(axes_[axis].values);
    place[axis] = std::lerp(least, largest, unit_random(random));
    places.insert(places.end(), place.begin(), place.end());
    place[axis] = folded_azimuth(place[axis]);
    places.insert(places.end(), place.begin(), place.end());
  }
  const std::vector<double> values = integrate(places, entries).values;
  for (std::size_t k = 0; k < values.size(); k += 2) {
    if (!(std::abs(values[k] - values[k + 1]) <= tolerance_ / 4 * std::abs(values[k]))) return false;
  }
  return true;
}

void AlbedoProxy::look_along_axes(const ProxyEntries& entries) {
  std::size_t extended = 0;
  std::vector<std::vector<ProxyVariable>> candidates;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const auto [least, largest] = std::ranges::minmax(axes_[i].values);
    if (axes_[i].size > first_points) ++extended;
    constexpr double quarter_turn = 90;
    const bool folds = axes_[i].name == "phi" && largest - least >= quarter_turn && is_elliptic(i, entries);
    candidates.push_back(proxy_variables(axes_[i].name, least, largest, folds));
  }
  // the other axes at their ends and in the middle
  const auto lines_along = [&](std::size_t axis) {
    constexpr std::size_t most_corners = 8;
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (i != axis && axes_[i].values.size() > 1) others.push_back(i);
    }
    const std::size_t corners = others.size() < 3 ? std::size_t{1} << others.size() : most_corners;
    std::vector<std::vector<double>> lines;
    std::mt19937_64 random(axis + 1);
    for (std::size_t k = 0; k < corners + (others.empty() ? 0 : 1); ++k) {
      std::vector<double> line;
      for (std::size_t i = 0; i < axes_.size(); ++i) {
        const std::vector<double>& values = axes_[i].values;
        line.push_back(values.size() > first_points ? candidates[i].front().value_at(0) : values[values.size() / 2]);
      }
      const std::size_t corner = others.size() <= 3 ? k : static_cast<std::size_t>(random());
      for (std::size_t i = 0; k < corners && i < others.size(); ++i) {
        const std::vector<double>& values = axes_[others[i]].values;
        line[others[i]] = (corner >> i) % 2 == 0 ? std::ranges::min(values) : std::ranges::max(values);
      }
      lines.push_back(std::move(line));
    }
    return lines;
  };
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (axes_[i].size > first_points) {
      look_along(i, lines_along(i), candidates[i], tolerance_ / static_cast<double>(2 * extended), entries);
    }
  }
}

void AlbedoProxy::look_along(std::size_t i, const std::vector<std::vector<double>>& lines,
                             const std::vector<ProxyVariable>& candidates, double share, const ProxyEntries& entries) {
  AxisOfProxy& axis = axes_[i];
  const ProxyVariable& base = candidates.front();
  std::vector<std::vector<double>> series(lines.size());  // first values, then coefficients
  std::size_t size = 0;
  double claimed = 0;
  const auto sample = [&](std::size_t finer) {
    const std::vector<double> points = lobatto_points(finer);
    const bool is_first = size == 0;
    std::vector<double> places;
    for (const std::vector<double>& line : lines) {
      for (std::size_t j = is_first ? 0 : 1; j < finer; j += is_first ? 1 : 2) {
        places.insert(places.end(), line.begin(), line.end());
        places[places.size() - line.size() + i] = base.value_at(points[j]);
      }
    }
    const ProxySamples samples = integrate(places, entries);
    const std::vector<double>& fresh = samples.values;
    for (const double value : fresh) keep_larger(largest_, std::abs(value));
    for (const double error : samples.errors) keep_larger(claimed, error);
    const std::size_t count = fresh.size() / lines.size();
    for (std::size_t l = 0; l < lines.size(); ++l) {
      std::vector<double> merged;
      for (std::size_t j = 0; j < count; ++j) {
        if (!is_first) merged.push_back(series[l][j]);
        merged.push_back(fresh[l * count + j]);
      }
      if (!is_first) merged.push_back(series[l].back());
      series[l] = std::move(merged);
    }
    size = finer;
  };
  const auto is_resolved = [](std::size_t needed, std::size_t points) { return 4 * needed <= 3 * points; };
  const auto terms = [&](const std::vector<std::vector<double>>& values, double allowed) {
    const std::vector<double> transform = chebyshev_transform(size);
    const double noise = claimed <= tolerance_ / 4 * largest_ ? claimed / 4 : 0;
    std::size_t needed = 0;
    for (const std::vector<double>& line : values) {
      needed = std::max(needed, terms_needed(along(line, size, 1, transform), allowed, noise));
    }
    return needed;
  };
  constexpr double better = 8;  // than the tensor: others are made from it
  for (sample(first_points); std::isfinite(largest_); sample(2 * size - 1)) {
    if (is_resolved(terms(series, share / better * largest_), size)) break;
    if (size >= axis.values.size() || 2 * size - 1 > most_points) return;
  }
  if (!std::isfinite(largest_)) return;

  std::size_t best = terms(series, share * largest_);
  axis.variable = base;
  const std::vector<double> points = lobatto_points(size), transform = chebyshev_transform(size);
  std::vector<double> matrix(size * size);
  for (std::size_t k = 1; k < candidates.size(); ++k) {
    for (std::size_t j = 0; j < size; ++j)
      chebyshev(base.of(candidates[k].value_at(points[j])), size, &matrix[j * size]);
    std::vector<std::vector<double>> values;
    for (const std::vector<double>& line : series) {
      values.push_back(along(along(line, size, 1, transform), size, 1, matrix));
    }
    const std::size_t needed = terms(values, share * largest_);
    if (is_resolved(needed, size) && needed < best) best = needed, axis.variable = candidates[k];
  }
  axis.size = std::max<std::size_t>(best, 1) + 1;
  if (axis.size >= axis.values.size()) hold(axis);
}

void AlbedoProxy::hold(AxisOfProxy& axis) {
  axis.variable.reset();
  axis.size = axis.values.size();
}

void AlbedoProxy::fit(const ProxyEntries& entries) {
  std::vector<std::vector<double>> points;
  for (const AxisOfProxy& axis : axes_) points.push_back(axis.points());
  ProxySamples samples = integrate(grid(points), entries);
  coefficients_ = std::move(samples.values);
  for (const double value : coefficients_) keep_larger(largest_, std::abs(value));
  error_ = 0;
  for (const double error : samples.errors) keep_larger(error_, error / (largest_ == 0 ? 1 : largest_));
  worst_place_.clear();
  verified_ = 0;
  std::size_t after = coefficients_.size();
  for (const AxisOfProxy& axis : axes_) {
    after /= axis.size;
    if (axis.variable) coefficients_ = along(coefficients_, axis.size, after, chebyshev_transform(axis.size));
  }
}

void AlbedoProxy::verify(const ProxyEntries& entries, const ProxyOptions& options, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::size_t dimensions = axes_.size();
  std::vector<double> places;
  for (std::size_t k = 0; k < options.verified; ++k) {
    for (const AxisOfProxy& axis : axes_) {
      if (!axis.variable) {
        places.push_back(axis.values[random() % axis.values.size()]);
        continue;
      }
      const auto [least, largest] = std::ranges::minmax(axis.values);
      const double unit = unit_random(random);
      // half of the places evenly over the axes, as tables are read, half over the variables, where errors hide
      places.push_back(k % 2 == 0 ? std::lerp(least, largest, unit) : axis.variable->value_at(2 * unit - 1));
    }
  }
  const ProxySamples samples = integrate(places, entries);
  verified_ = options.verified;
  std::vector<double> errors(options.verified);
  constexpr std::size_t some = 64;
  in_parallel((options.verified + some - 1) / some, options.threads, [&](std::size_t part) {
    for (std::size_t k = part * some; k < std::min(errors.size(), (part + 1) * some); ++k) {
      const auto begin = places.begin() + static_cast<std::ptrdiff_t>(k * dimensions);
      const double difference =
          std::abs((*this)({begin, begin + static_cast<std::ptrdiff_t>(dimensions)}) - samples.values[k]);
      errors[k] = (difference + samples.errors[k]) / (largest_ == 0 ? 1 : largest_);
    }
  });
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const double before = error_;
    keep_larger(error_, errors[k]);
    if (error_ == before || std::isnan(before)) continue;
    const auto begin = places.begin() + static_cast<std::ptrdiff_t>(k * dimensions);
    worst_place_.assign(begin, begin + static_cast<std::ptrdiff_t>(dimensions));
  }
}

bool AlbedoProxy::grow(std::size_t most) {
  std::vector<double> tails(axes_.size(), 0);
  std::size_t after = coefficients_.size();
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const std::size_t size = axes_[i].size;
    after /= size;
    if (!axes_[i].variable) continue;
    for (std::size_t e = 0; e < coefficients_.size(); ++e) {
      if (e / after % size + 2 >= size) tails[i] = std::max(tails[i], std::abs(coefficients_[e]));
    }
  }
  const std::vector<AxisOfProxy> before = axes_;
  const double largest = std::ranges::max(tails);
  bool has_grown = false;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    AxisOfProxy& axis = axes_[i];
    if (!axis.variable || tails[i] < largest / 4) continue;
    axis.size += axis.size / 4 + 1;
    if (axis.size >= axis.values.size()) hold(axis);
    has_grown = true;
  }
  if (has_grown && product(sizes()) <= most) return true;
  axes_ = before;
  return false;
}

}  // namespace albedo
