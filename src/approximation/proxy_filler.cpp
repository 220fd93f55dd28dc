#include <algorithm>
#include <cmath>

#include "albedo/core/errors.hpp"
#include "albedo/proxy.hpp"
#include "core/text.hpp"
#include "numerics/parallel.hpp"

namespace albedo {
namespace {

/// out = Σ matrix[k] rows[k], where the rows follow one another; four at a time.
void add_rows(const double* matrix, const double* rows, std::size_t count, std::vector<double>& out) {
  const std::size_t width = out.size();
  std::ranges::fill(out, 0);
  double* const to = out.data();
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4) {
    const double *m = matrix + k, *a = rows + k * width, *b = a + width, *c = b + width, *d = c + width;
    for (std::size_t i = 0; i < width; ++i) to[i] += (m[0] * a[i] + m[1] * b[i]) + (m[2] * c[i] + m[3] * d[i]);
  }
  for (; k < count; ++k) {
    const double* a = rows + k * width;
    for (std::size_t i = 0; i < width; ++i) to[i] += matrix[k] * a[i];
  }
}

}  // namespace

AlbedoProxy::Filler::Filler(const AlbedoProxy& proxy, const std::vector<TableAxis>& axes) : proxy_(&proxy) {
  if (axes.size() != proxy.axes_.size()) {
    throw ParameterError(fmt::format("a proxy of {} axes fills no table of {}", proxy.axes_.size(), axes.size()));
  }
  auto factors = std::make_shared<std::vector<Factor>>();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const AxisOfProxy& axis = proxy.axes_[i];
    const std::vector<double>& values = axes[i].values;
    const bool is_last = i + 1 == axes.size();
    Factor factor{.rows = values.size(), .columns = axis.size};
    if (axis.variable) {
      for (const double value : values) {
        if (axis.variable->contains(value)) continue;
        throw ParameterError(fmt::format("the proxy ends before {:g} on the axis '{}'", value, axis.name));
      }
      factor.matrix.resize(factor.rows * factor.columns);
      for (std::size_t r = 0; r < factor.rows; ++r) {
        chebyshev(axis.variable->of(values[r]), axis.size, &factor.matrix[is_last ? r : r * axis.size],
                  is_last ? factor.rows : 1);
      }
    } else {
      for (std::size_t r = 0; r < values.size(); ++r) {
        const bool is_same = r < axis.values.size() && values[r] == axis.values[r];
        const auto found =
            is_same ? axis.values.begin() + static_cast<std::ptrdiff_t>(r) : std::ranges::find(axis.values, values[r]);
        if (found == axis.values.end()) {
          throw ParameterError(
              fmt::format("the proxy is known at the values of the axis '{}' only, and {:g} is none of them", axis.name,
                          values[r]));
        }
        factor.chosen.push_back(static_cast<std::size_t>(found - axis.values.begin()));
      }
    }
    size_ *= factor.rows;
    factors->push_back(std::move(factor));
  }
  std::size_t width = proxy.coefficients_.size();
  for (const Factor& factor : *factors) partial_.emplace_back(width /= factor.columns);
  partial_.back().resize(factors->back().rows);
  factors_ = std::move(factors);
}

void AlbedoProxy::Filler::compute(std::size_t row) {
  const std::vector<Factor>& factors = *factors_;
  std::size_t below = 1;  // rows that share an index
  for (std::size_t i = 1; i + 1 < factors.size(); ++i) below *= factors[i].rows;
  const double* tensor = proxy_->coefficients_.data();
  bool is_kept = row_.has_value();
  for (std::size_t i = 0; i + 1 < factors.size(); ++i) {
    is_kept = is_kept && row / below == *row_ / below;
    std::vector<double>& sum = partial_[i];
    if (!is_kept) {
      const Factor& factor = factors[i];
      const std::size_t r = row / below % factor.rows;
      if (factor.chosen.empty()) {
        add_rows(&factor.matrix[r * factor.columns], tensor, factor.columns, sum);
      } else {
        std::copy_n(tensor + factor.chosen[r] * sum.size(), sum.size(), sum.data());
      }
    }
    tensor = sum.data();
    if (i + 2 < factors.size()) below /= factors[i + 1].rows;
  }
  const Factor& last = factors.back();
  if (last.chosen.empty()) {
    add_rows(tensor, last.matrix.data(), last.columns, partial_.back());
  } else {
    for (std::size_t i = 0; i < last.rows; ++i) partial_.back()[i] = tensor[last.chosen[i]];
  }
  row_ = row;
}

void AlbedoProxy::Filler::fill(std::size_t first, std::span<double> entries) {
  const std::size_t width = partial_.back().size();
  while (!entries.empty()) {
    const std::size_t row = first / width, begin = first % width, count = std::min(width - begin, entries.size());
    if (row_ != row) compute(row);
    std::copy_n(partial_.back().data() + begin, count, entries.data());
    entries = entries.subspan(count);
    first += count;
  }
}

double AlbedoProxy::operator()(const std::vector<double>& place) const {
  std::vector<TableAxis> axes;
  for (std::size_t i = 0; i < place.size(); ++i) axes.push_back({{}, {place[i]}});
  double value = 0;
  Filler(*this, axes).fill(0, {&value, 1});
  return value;
}

std::vector<double> AlbedoProxy::fill(const std::vector<TableAxis>& axes, int threads) const {
  constexpr std::size_t run = 1 << 15;
  const Filler filler(*this, axes);
  std::vector<double> entries(filler.size());
  const std::size_t runs = (entries.size() - 1) / run + 1;
  const std::size_t stretches = std::min<std::size_t>(runs, 64);  // long ones: neighbours share rows and sums
  in_parallel(stretches, threads, [&](std::size_t k) {
    const std::size_t begin = k * entries.size() / stretches, end = (k + 1) * entries.size() / stretches;
    Filler own(filler);
    own.fill(begin, std::span(entries).subspan(begin, end - begin));
  });
  return entries;
}

}  // namespace albedo
