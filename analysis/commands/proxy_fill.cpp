#include <algorithm>
#include <cmath>
#include <iostream>

#include "albedo/core/errors.hpp"
#include "albedo/core/larger.hpp"
#include "analysis/commands/checks.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/table_fills.hpp"
#include "analysis/commands/text.hpp"
#include "analysis/studies/albedo_proxy.hpp"
#include "analysis/studies/table_growth.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

/// A table filled from a proxy.
class ProxyTable {
 public:
  ProxyTable(const AlbedoProxy& proxy, const std::vector<TableAxis>& axes, double node_error, int threads)
      : proxy_(proxy), values_(proxy.fill(axes, threads)) {
    double largest = 0;
    for (const double value : values_) keep_larger(largest, std::abs(value));
    worst_error_ = (proxy.error() + node_error) * std::max(proxy.largest(), largest);
    interpolation_error_ = albedo::analysis::interpolation_error(
        axes, values_, [&](const std::vector<TableAxis>& over) { return proxy.fill(over, 1); });
  }

  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  [[nodiscard]] const std::vector<double>& errors() const { return errors_; }
  [[nodiscard]] double worst_error() const { return worst_error_; }
  [[nodiscard]] double interpolation_error() const { return interpolation_error_; }
  [[nodiscard]] std::size_t unconverged() const { return proxy_.unconverged(); }
  [[nodiscard]] std::size_t divergent() const { return 0; }
  [[nodiscard]] std::int64_t evaluations() const { return proxy_.evaluations(); }

 private:
  const AlbedoProxy& proxy_;
  std::vector<double> values_, errors_;
  double worst_error_ = 0, interpolation_error_ = 0;
};

}  // namespace

int fill_from_proxy(const TableArguments& arguments, const TableRequest& request, TableOptions options, Json provenance,
                    const std::function<double()>& seconds) {
  constexpr double share = 20;  // of the tolerance
  const double tolerance = arguments.options.tolerance.value_or(ProxyOptions{}.tolerance);
  options.albedo.tolerance = is_monte_carlo(options.albedo.rule) ? tolerance : std::max(tolerance / share, 1e-13);
  const ProxyEntries entries = [&](const std::vector<TableAxis>& over) {
    const AlbedoTable table(request.model, request.fixed, over, options);
    return ProxySamples{table.values(), table.unconverged(), table.evaluations()};
  };
  const AlbedoProxy proxy(request.axes, entries,
                          {.tolerance = tolerance,
                           .verified = static_cast<std::size_t>(arguments.verified),
                           .seed = arguments.options.seed,
                           .threads = arguments.options.threads});
  if (!std::isfinite(proxy.largest())) {
    throw ParameterError(
        "--fill proxy needs finite albedos, and one within these axes is not: keep away from grazing "
        "incidence, or fill directly");
  }
  const ProxyTable table(proxy, request.axes, options.albedo.tolerance, arguments.options.threads);
  Json worst = Json::object();
  for (std::size_t i = 0; i < request.axes.size() && !proxy.worst_place().empty(); ++i) {
    worst[request.axes[i].name] = proxy.worst_place()[i];
  }
  provenance["proxy"] = {{"tolerance", tolerance},
                         {"coefficients", proxy.sizes()},
                         {"integrations", proxy.integrations()},
                         {"verified_places", arguments.verified},
                         {"relative_error", proxy.error()},
                         {"worst_place", worst},
                         {"is_reached", proxy.is_reached()}};
  const int code = conclude(arguments, Filled(request.document_axes(), table), 0, std::move(provenance), seconds());
  if (proxy.is_reached()) return code;
  std::cerr << "albedo: --fill proxy is off by up to " << number_text(proxy.error(), 3)
            << " of the largest albedo; asked for were " << number_text(tolerance, 3) << '\n';
  return code == exit_code::done ? exit_code::not_converged : code;
}

}  // namespace albedo::analysis
