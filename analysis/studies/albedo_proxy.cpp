#include "analysis/studies/albedo_proxy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "albedo/core/errors.hpp"
#include "analysis/studies/parallel.hpp"

namespace albedo::analysis {
namespace {

constexpr std::size_t first_points = 9, most_points = 1025;  // along an axis
constexpr double grazing_shift = 1e-4;

bool is_direction(const std::string& name) { return name == "cos_theta" || name == "theta"; }

std::size_t product(const std::vector<std::size_t>& sizes) {
  std::size_t count = 1;
  for (const std::size_t size : sizes) count *= size;
  return count;
}

/// Applies a matrix of `rows` × sizes[axis] along one axis of a tensor.
std::vector<double> along(const std::vector<double>& tensor, const std::vector<std::size_t>& sizes, std::size_t axis,
                          const std::vector<double>& matrix, std::size_t rows, int threads) {
  std::size_t before = 1, after = 1;
  for (std::size_t i = 0; i < axis; ++i) before *= sizes[i];
  for (std::size_t i = axis + 1; i < sizes.size(); ++i) after *= sizes[i];
  const std::size_t columns = sizes[axis];
  std::vector<double> result(before * rows * after, 0);
  in_parallel(before * rows, threads, [&](std::size_t task) {
    const std::size_t b = task / rows, r = task % rows;
    double* const out = &result[task * after];
    for (std::size_t c = 0; c < columns; ++c) {
      const double factor = matrix[r * columns + c];
      const double* const in = &tensor[(b * columns + c) * after];
      for (std::size_t a = 0; a < after; ++a) out[a] += factor * in[a];
    }
  });
  return result;
}

/// Values at cos(πj/n) to Chebyshev coefficients, as a matrix.
std::vector<double> transform(std::size_t size) {
  if (size == 1) return {1};
  const std::size_t n = size - 1;
  std::vector<double> matrix(size * size);
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t j = 0; j < size; ++j) {
      const double half_ends = (j == 0 || j == n ? 0.5 : 1) * (k == 0 || k == n ? 0.5 : 1);
      const double angle = std::numbers::pi * static_cast<double>((j * k) % (2 * n)) / static_cast<double>(n);
      matrix[k * size + j] = 2 * half_ends / static_cast<double>(n) * std::cos(angle);
    }
  }
  return matrix;
}

/// T_0(u) … T_{size−1}(u)
void chebyshev(double u, std::size_t size, double* out) {
  for (std::size_t k = 0; k < size; ++k) out[k] = k == 0 ? 1 : k == 1 ? u : 2 * u * out[k - 1] - out[k - 2];
}

/// The largest sum of magnitudes over the last third of the coefficients along an axis.
double tail(const std::vector<double>& coefficients, const std::vector<std::size_t>& sizes, std::size_t axis) {
  std::size_t after = 1;
  for (std::size_t i = axis + 1; i < sizes.size(); ++i) after *= sizes[i];
  const std::size_t columns = sizes[axis], begin = columns - columns / 3;
  double largest = 0;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (i / after % columns >= begin) largest = std::max(largest, std::abs(coefficients[i]));
  }
  return largest;
}

}  // namespace

double AlbedoProxy::Variable::raw(double value) const {
  if (scale == ProxyScale::linear) return value;
  return scale == ProxyScale::logarithmic ? std::log(value) : -std::log(value + shift);
}

double AlbedoProxy::Variable::of(double value) const {
  if (least == largest) return 0;
  const double a = raw(least), b = raw(largest);
  return std::clamp((2 * raw(value) - a - b) / (b - a), -1.0, 1.0);
}

double AlbedoProxy::Variable::value_at(double u) const {
  if (u == -1) return least;
  if (u == 1) return largest;
  const double r = raw(least) + (raw(largest) - raw(least)) * (1 + u) / 2;
  const double value = scale == ProxyScale::linear        ? r
                       : scale == ProxyScale::logarithmic ? std::exp(r)
                                                          : std::exp(-r) - shift;
  return std::clamp(value, least, largest);
}

AlbedoProxy::AlbedoProxy(const std::vector<TableAxis>& axes, const ProxyEntries& entries, const ProxyOptions& options) {
  if (!(options.tolerance > 0 && options.tolerance < 1)) {
    throw ParameterError("the tolerance of a proxy is " + std::to_string(options.tolerance) +
                         " and must be within (0, 1)");
  }
  for (const TableAxis& axis : axes) {
    names_.push_back(axis.name);
    if (axis.values.empty()) throw ParameterError("the axis '" + axis.name + "' has no values");
    const auto [least, largest] = std::ranges::minmax(axis.values);
    Variable variable{.least = least, .largest = largest};
    if (axis.name == "cos_theta") {
      variable.scale = ProxyScale::grazing, variable.shift = grazing_shift;
    } else if (!is_direction(axis.name) && axis.name != "phi" && least > 0 && largest >= 10 * least) {
      variable.scale = ProxyScale::logarithmic;
    }
    variables_.push_back(variable);
    sizes_.push_back(least == largest ? 1 : first_points);
  }
  const auto grid_of = [&](const std::vector<std::size_t>& sizes) {
    std::vector<TableAxis> grid;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      TableAxis axis{names_[i], {}};
      for (std::size_t j = 0; j < sizes[i]; ++j) {
        const double n = static_cast<double>(sizes[i] - 1);
        axis.values.push_back(
            sizes[i] == 1 ? variables_[i].least
                          : variables_[i].value_at(std::sin(std::numbers::pi * (n - 2 * static_cast<double>(j)) /
                                                            (2 * n))));  // exactly antisymmetric
      }
      grid.push_back(std::move(axis));
    }
    return grid;
  };
  const auto integrate = [&](const std::vector<TableAxis>& grid) {
    ProxySamples samples = entries(grid);
    integrations_ += samples.values.size();
    unconverged_ += samples.unconverged;
    evaluations_ += samples.evaluations;
    return std::move(samples.values);
  };

  std::vector<double> values = integrate(grid_of(sizes_));
  double& largest = largest_;
  for (;;) {
    coefficients_ = values;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
      coefficients_ = along(coefficients_, sizes_, i, transform(sizes_[i]), sizes_[i], 1);
    }
    largest = 0;
    for (const double value : values) largest = std::isnan(value) ? value : std::max(largest, std::abs(value));
    if (!std::isfinite(largest)) break;  // a series holds no infinite albedo
    std::size_t widest = sizes_.size();
    double worst = options.tolerance / 4 * largest;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
      const double here = sizes_[i] == 1 ? 0 : tail(coefficients_, sizes_, i);
      if (here > worst) worst = here, widest = i;
    }
    if (widest == sizes_.size() || 2 * sizes_[widest] - 1 > most_points) break;
    std::vector<std::size_t> finer = sizes_;
    finer[widest] = 2 * sizes_[widest] - 1;
    if (product(finer) > options.most_integrations) break;
    std::vector<TableAxis> between = grid_of(finer);  // odd points are new, even ones are there
    std::vector<double> odd;
    for (std::size_t j = 1; j < finer[widest]; j += 2) odd.push_back(between[widest].values[j]);
    between[widest].values = odd;
    const std::vector<double> added = integrate(between);
    std::size_t after = 1;
    for (std::size_t i = widest + 1; i < sizes_.size(); ++i) after *= sizes_[i];
    std::vector<double> merged(product(finer));
    for (std::size_t e = 0; e < merged.size(); ++e) {
      const std::size_t a = e % after, j = e / after % finer[widest], b = e / after / finer[widest];
      merged[e] =
          j % 2 == 0 ? values[(b * sizes_[widest] + j / 2) * after + a] : added[(b * odd.size() + j / 2) * after + a];
    }
    values = std::move(merged);
    sizes_ = finer;
  }

  error_ = std::isfinite(largest) ? 0 : std::numeric_limits<double>::infinity();
  if (std::isfinite(largest)) verify(entries, options);
  is_reached_ = error_ <= options.tolerance && unconverged_ == 0;
}

void AlbedoProxy::verify(const ProxyEntries& entries, const ProxyOptions& options) {
  std::mt19937_64 random(options.seed);
  std::vector<std::vector<double>> places(options.verified);
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (const Variable& variable : variables_) {
      const double unit = static_cast<double>(random() >> 11) * 0x1p-53;
      // half of the places evenly over the axes, as tables are read, half over the variables, where errors hide
      places[k].push_back(k % 2 == 0 ? std::lerp(variable.least, variable.largest, unit)
                                     : variable.value_at(2 * unit - 1));
    }
  }
  std::vector<ProxySamples> samples(places.size());
  in_parallel(places.size(), options.threads, [&](std::size_t k) {
    std::vector<TableAxis> at;
    for (std::size_t i = 0; i < names_.size(); ++i) at.push_back({names_[i], {places[k][i]}});
    samples[k] = entries(at);
  });
  for (std::size_t k = 0; k < places.size(); ++k) {
    ++integrations_;
    unconverged_ += samples[k].unconverged;
    evaluations_ += samples[k].evaluations;
    const double difference = std::abs((*this)(places[k]) - samples[k].values.front());
    const double error = largest_ == 0 ? difference : difference / largest_;
    if (!(error <= error_)) error_ = error, worst_place_ = places[k];
  }
}

double AlbedoProxy::operator()(const std::vector<double>& place) const {
  std::vector<TableAxis> axes;
  for (std::size_t i = 0; i < names_.size(); ++i) axes.push_back({names_[i], {place[i]}});
  return fill(axes, 1).front();
}

std::vector<double> AlbedoProxy::fill(const std::vector<TableAxis>& axes, int threads) const {
  std::vector<double> tensor = coefficients_;
  std::vector<std::size_t> sizes = sizes_;
  for (std::size_t i = axes.size(); i-- > 0;) {  // the last axis first: then the rows of the large tensor are long
    const std::size_t rows = axes[i].values.size();
    std::vector<double> matrix(rows * sizes_[i]);
    for (std::size_t r = 0; r < rows; ++r) {
      chebyshev(variables_[i].of(axes[i].values[r]), sizes_[i], &matrix[r * sizes_[i]]);
    }
    tensor = along(tensor, sizes, i, matrix, rows, threads);
    sizes[i] = rows;
  }
  return tensor;
}

}  // namespace albedo::analysis
