#include "analysis/commands/table_report.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "analysis/commands/checks.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/files/provenance.hpp"
#include "analysis/text/text.hpp"
#include "core/text.hpp"
#include "numerics/larger.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

/// The table at one direction, linearly interpolated along its only axis. The axis is `theta` or `cos_theta`, in any
/// order.
double interpolated(const TableAxis& axis, const EntryAt& value, double theta) {
  const double place = axis.name == "theta" ? theta : Direction::from_degrees(theta).cos_theta;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    if (axis.values[i] == place) return value(i);
    if (i + 1 == axis.size() || (axis.values[i] < place) == (axis.values[i + 1] < place)) continue;
    return std::lerp(value(i), value(i + 1), (place - axis.values[i]) / (axis.values[i + 1] - axis.values[i]));
  }
  return NAN;  // unreachable after check_at()
}

/// What --bits asks for, and --max-error: the entries as they are held, and what is said of them.
void hold(const TableArguments& arguments, FilledTable& table, double grown_error, Json& provenance) {
  if (arguments.growth.bits != 0) {
    QuantisedEntries entries = quantised(std::move(table.values), arguments.growth.bits);
    table.values = std::move(entries.values);
    provenance["bits"] = arguments.growth.bits;
    if (arguments.growth.bits < 32) provenance["scale"] = entries.scale;
    provenance["quantisation_error"] = entries.error;
    table.tally.worst_error += entries.error;
    if (arguments.growth.max_error == 0) table.interpolation_error += entries.error;
  }
  if (arguments.growth.max_error == 0) return;
  provenance["max_error"] = arguments.growth.max_error;
  keep_larger(table.interpolation_error, grown_error);  // which is met with the entries as they are held
}

/// {"alpha": 0.1, "cos_theta": 0.5}: where an entry stands.
Json place_of(const std::vector<TableAxis>& axes, std::size_t entry) {
  std::vector<std::size_t> indices(axes.size());
  for (std::size_t i = axes.size(); i-- > 0; entry /= axes[i].size()) indices[i] = entry % axes[i].size();
  Json place = Json::object();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const TableAxis& axis = axes[i];
    place[axis.name] = axis.is_categorical() ? Json(axis.labels[indices[i]]) : Json(axis.values[indices[i]]);
  }
  return place;
}

/// Whether --max-error is met; says so if not.
bool complain_of_growth(const TableArguments& arguments, const FilledTable& table) {
  const double allowed = arguments.growth.max_error;
  if (allowed == 0 || (table.interpolation_error <= allowed && table.tally.divergent == 0)) return true;
  std::cerr << "albedo: --max-error " << number_text(allowed, 3) << " isn't met: ";
  if (table.tally.divergent > 0) {
    std::cerr << "an albedo is infinite, and nothing is interpolated towards it\n";
  } else {
    const int bits = arguments.growth.bits;
    const double rounding = bits == 0 || bits == 32 ? 0 : 0.5 / (std::exp2(bits) - 1);
    std::cerr << "interpolation is off by up to " << number_text(table.interpolation_error, 3) << " with "
              << table.entries << " entries"
              << (rounding > allowed ? fmt::format(", and {} bits alone by {}", bits, number_text(rounding, 3)) : "")
              << '\n';
  }
  return false;
}

}  // namespace

FilledTable filled(std::vector<TableAxis> axes, AlbedoTable table) {
  FilledTable result{.axes = std::move(axes),
                     .entries = table.values().size(),
                     .tally = table.tally(),
                     .worst_entry = table.worst_entry(),
                     .interpolation_error = table.interpolation_error()};
  result.tally.worst_error = table.worst_error();
  result.tally.evaluations = table.evaluations();
  result.errors = std::move(table).errors();
  result.values = std::move(table).values();
  return result;
}

void complete(Json& provenance, const TableArguments& arguments, const FilledTable& table) {
  provenance["axes"] = describe_axes(table.axes);
  if (arguments.model.corrections.any()) provenance["corrections"] = corrections_json(arguments.model.corrections);
  arguments.options.describe(provenance);
  provenance["largest_error"] = table.tally.worst_error;
  provenance["interpolation_error"] = table.interpolation_error;
  provenance["unconverged"] = table.tally.unconverged;
  provenance["divergent"] = table.tally.divergent;
  provenance["evaluations"] = table.tally.evaluations;
}

Json summary_of(const TableArguments& arguments, const FilledTable& table, const Json& provenance, double seconds) {
  Json summary{{"entries", table.entries}, {"worst_error", table.tally.worst_error}};
  if (table.worst_entry) summary["worst_at"] = place_of(table.axes, *table.worst_entry);
  summary["interpolation_error"] = table.interpolation_error;
  summary["unconverged"] = table.tally.unconverged;
  summary["divergent"] = table.tally.divergent;
  summary["evaluations"] = table.tally.evaluations;
  summary["seconds"] = seconds;
  summary["output"] = arguments.output;
  if (provenance.contains("proxy")) summary["proxy"] = provenance["proxy"];
  return summary;
}

int report(const TableArguments& arguments, const FilledTable& table, const EntryAt& value, const Json& provenance,
           double seconds) {
  const Json summary = summary_of(arguments, table, provenance, seconds);
  if (arguments.options.json) std::cout << json_text(summary) << '\n';
  if (arguments.summary) std::cerr << json_text(summary) << '\n';
  const bool is_reached = complain_of_growth(arguments, table);
  const int unreached = is_reached ? exit_code::done : exit_code::not_converged;
  if (arguments.assertions.empty() && table.tally.unconverged == 0) return unreached;

  const Extent extent = extent_of(table.entries, value);
  const Facts facts{.at = [&](double theta, double) { return interpolated(table.axes.back(), value, theta); },
                    .max = extent.max,
                    .min = extent.min,
                    .mean = extent.mean,
                    .error = table.tally.worst_error,
                    .evaluations = static_cast<double>(table.tally.evaluations)};
  const int code = concluding_exit_code(arguments.assertions, facts, {table.entries, table.tally.unconverged});
  return code == exit_code::done ? unreached : code;
}

int conclude(const TableArguments& arguments, FilledTable table, double grown_error, Json provenance, double seconds) {
  hold(arguments, table, grown_error, provenance);
  complete(provenance, arguments, table);
  const std::string name = provenance.value("model", "materials") + "_albedo";
  write_table({.name = name,
               .axes = table.axes,
               .values = table.values.data(),
               .errors = table.errors.empty() ? nullptr : table.errors.data(),
               .provenance = provenance},
              arguments.output);
  return report(
      arguments, table, [&](std::size_t i) { return table.values[i]; }, provenance, seconds);
}

}  // namespace albedo::analysis
