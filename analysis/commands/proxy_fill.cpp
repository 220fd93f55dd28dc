#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <mutex>

#include "albedo/core/errors.hpp"
#include "albedo/proxy.hpp"
#include "albedo/table_growth.hpp"
#include "albedo/table_source.hpp"
#include "analysis/commands/checks.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/table_fills.hpp"
#include "analysis/text/text.hpp"
#include "numerics/larger.hpp"
#include "numerics/parallel.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

/// A table filled from a proxy.
FilledTable filled_from(const AlbedoProxy& proxy, const ProxyEntries& entries, const TableRequest& request,
                        int threads) {
  const std::vector<TableAxis>& axes = request.axes;
  FilledTable table{.axes = request.document_axes(), .values = proxy.fill(axes, threads)};
  table.entries = table.values.size();
  // where the tolerance is missed, no entry is known to meet it
  if (!proxy.is_reached()) table.tally.unconverged = table.entries;
  double largest = 0;
  for (const double value : table.values) keep_larger(largest, std::abs(value));
  table.tally.worst_error = proxy.error() * std::max(proxy.largest(), largest);
  table.tally.evaluations = proxy.evaluations();
  bool is_series = true;
  for (std::size_t i = 0; i < axes.size(); ++i) is_series = is_series && (proxy.is_series(i) || axes[i].size() == 1);
  table.interpolation_error = interpolation_error(axes, table.values, [&](const std::vector<TableAxis>& over) {
    std::vector<double> place;
    for (const TableAxis& axis : over) place.push_back(axis.values.front());
    if (is_series) return std::vector{proxy(place)};
    const ProxySamples sample = entries(place);  // between entries there is nothing but integration
    table.tally.evaluations += sample.evaluations;
    return sample.values;
  });
  return table;
}

/// Integrates at any places within the axes, in parallel.
class Integrations {
 public:
  Integrations(const TableRequest& request, const Corrections& corrections, const TableOptions& options)
      : source_(request.models(corrections), box(request.axes), options),
        progress_(options.progress),
        dimensions_(request.axes.size()) {}

  [[nodiscard]] ProxySamples operator()(const std::vector<double>& places) const {
    constexpr std::size_t run = 32, shown = 10'000;
    const std::size_t count = places.size() / dimensions_;
    ProxySamples samples{.values = std::vector<double>(count), .errors = std::vector<double>(count)};
    std::mutex mutex;
    in_parallel((count + run - 1) / run, source_.threads(),
                [&](std::size_t part) {
                  TableSource::Worker worker(source_);
                  std::int64_t evaluations = 0;
                  for (std::size_t k = part * run; k < std::min(count, (part + 1) * run); ++k) {
                    const auto begin = places.begin() + static_cast<std::ptrdiff_t>(k * dimensions_);
                    const Estimate a = worker.at({begin, begin + static_cast<std::ptrdiff_t>(dimensions_)});
                    samples.values[k] = a.value;
                    samples.errors[k] = a.error;
                    evaluations += a.evaluations;
                  }
                  const std::lock_guard lock(mutex);
                  samples.evaluations += evaluations;
                },
                count > shown ? progress_ : ProgressCallback{});
    return samples;
  }

 private:
  static std::vector<TableAxis> box(std::vector<TableAxis> axes) {
    for (TableAxis& axis : axes) {
      const auto [least, largest] = std::ranges::minmax(axis.values);
      axis.values = {least, largest};
    }
    return axes;
  }

  TableSource source_;
  ProgressCallback progress_;
  std::size_t dimensions_;
};

/// The proxy that was asked for.
AlbedoProxy proxy_of(const TableArguments& arguments, const TableRequest& request, const ProxyEntries& entries) {
  AlbedoProxy proxy(request.axes, entries,
                    {.tolerance = arguments.options.tolerance.value_or(ProxyOptions{}.tolerance),
                     .verified = static_cast<std::size_t>(arguments.verified),
                     .seed = arguments.options.seed,
                     .threads = arguments.options.threads});
  if (std::isfinite(proxy.largest())) return proxy;
  throw ParameterError(
      "--fill proxy needs finite albedos, and one within these axes is not: keep away from grazing "
      "incidence, or fill directly");
}

Json describe(const AlbedoProxy& proxy, const TableRequest& request) {
  Json worst = Json::object();
  for (std::size_t i = 0; i < request.axes.size() && !proxy.worst_place().empty(); ++i) {
    worst[request.axes[i].name] = proxy.worst_place()[i];
  }
  return {{"tolerance", proxy.tolerance()},       {"coefficients", proxy.sizes()},
          {"integrations", proxy.integrations()}, {"verified_places", proxy.verified()},
          {"relative_error", proxy.error()},      {"worst_place", worst},
          {"is_reached", proxy.is_reached()}};
}

/// Complains of a proxy that misses its tolerance; the exit code.
int judged(const AlbedoProxy& proxy, int code) {
  if (proxy.is_reached()) return code;
  std::cerr << "albedo: --fill proxy "
            << (std::isfinite(proxy.error())
                    ? "is off by up to " + number_text(proxy.error(), 3) + " of the largest albedo"
                    : "bounds no error, as an integration it needs did not converge")
            << "; asked for were " << number_text(proxy.tolerance(), 3) << '\n';
  return code == exit_code::done ? exit_code::not_converged : code;
}

/// Entries of tiles. Their errors are the proxy's.
TileFill proxy_entries(std::shared_ptr<const AlbedoProxy> proxy, const TableRequest& request, int threads) {
  const auto make_worker = [filler = AlbedoProxy::Filler(*proxy, request.axes)] {
    return [own = filler](std::size_t first, std::span<double> values) mutable {
      own.fill(first, values);
      return TableTally{};
    };
  };
  const auto complete = [proxy, &request](FilledTable& table, Json& provenance) {
    provenance["proxy"] = describe(*proxy, request);
    table.tally.worst_error = proxy->error() * proxy->largest();
    table.tally.evaluations += proxy->evaluations();
    if (!proxy->is_reached()) table.tally.unconverged = table.entries;
  };
  return {.entries = {.axes = request.axes, .threads = threads, .make_worker = make_worker},
          .tile = std::size_t{1} << 18U,  // there is little to lose, and the disk takes longer than the entries
          .complete = complete,
          .judge = [proxy](int code) { return judged(*proxy, code); }};
}

}  // namespace

int fill_from_proxy(const TableArguments& arguments, const TableRequest& request, TableOptions options, bool in_tiles,
                    Json provenance, const std::function<double()>& seconds) {
  constexpr double share = 20;  // of the tolerance
  const double tolerance = arguments.options.tolerance.value_or(ProxyOptions{}.tolerance);
  options.albedo.tolerance = is_monte_carlo(options.albedo.rule) ? tolerance : std::max(tolerance / share, 1e-13);
  const Integrations integrations(request, arguments.model.corrections, options);
  const ProxyEntries entries = std::cref(integrations);
  if (in_tiles) {
    options.verified_cells = TableOptions{}.verified_cells;
    const auto make_fill = [&](const TableSource& source) {
      return proxy_entries(std::make_shared<AlbedoProxy>(proxy_of(arguments, request, entries)), request,
                           source.threads());
    };
    return run_tiled(arguments, request, options, make_fill, std::move(provenance), seconds);
  }
  const AlbedoProxy proxy = proxy_of(arguments, request, entries);
  FilledTable table = filled_from(proxy, entries, request, arguments.options.threads);
  provenance["proxy"] = describe(proxy, request);
  return judged(proxy, conclude(arguments, std::move(table), 0, std::move(provenance), seconds()));
}

}  // namespace albedo::analysis
