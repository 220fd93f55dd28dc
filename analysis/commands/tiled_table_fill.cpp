#include <algorithm>
#include <iostream>

#include "albedo/core/errors.hpp"
#include "analysis/commands/table_fills.hpp"
#include "analysis/tiles/tiled_table.hpp"

namespace albedo::analysis {

using Json = nlohmann::ordered_json;

bool is_tiled(const TableArguments& arguments, bool by_channel) {
  const bool is_plain = arguments.materials.empty() && arguments.fill == Fill::direct && !arguments.errors &&
                        !by_channel && arguments.growth.max_error == 0 && arguments.growth.bits == 0;
  const bool result = is_plain && can_be_tiled(arguments.output);
  if (arguments.resume && !result) {
    throw ParameterError(
        "--resume continues a .npy file of one model and channel, without --errors, --max-error, --bits, "
        "--fill proxy and --materials");
  }
  return result;
}

int run_tiled(const TableArguments& arguments, const TableRequest& request, const TableOptions& options,
              Json provenance, const std::function<double()>& seconds) {
  const TableSource source(request.model, request.fixed, request.axes, options);
  Json computation = provenance;
  computation.erase("command");
  computation["compiler"] = __VERSION__;
  if (arguments.model.corrections.any()) computation["corrections"] = corrections_json(arguments.model.corrections);
  arguments.options.describe(computation);
  computation["budget"] = arguments.options.budget;
  if (const Json files = checksums_of_files(model_info(request.model), request.fixed); !files.empty()) {
    computation["files"] = files;
  }
  TiledTable table(source, request.document_axes(), arguments.output,
                   {.command = provenance["command"].get<std::string>(),
                    .computation = std::move(computation),
                    .resume = arguments.resume,
                    .progress = options.progress});
  LocalClaims claims(table.tiles());
  table.fill(claims);
  if (table.damaged() > 0) {
    std::cerr << "albedo: " << table.damaged() << " finished tiles had a wrong checksum and were computed again\n";
  }
  const EntryAt value = [&](std::size_t entry) { return table.value(entry); };
  const TableSource::Interpolation interpolation = source.interpolation(value);
  const TableTally& tally = table.tally();
  const Known known{.axes = request.document_axes(),
                    .entries = source.size(),
                    .worst_error = std::max(tally.worst_error, 0.0),
                    .interpolation_error = interpolation.error,
                    .unconverged = tally.unconverged,
                    .divergent = tally.divergent,
                    .evaluations = tally.evaluations + interpolation.evaluations};
  provenance["command"] = table.command();
  complete(provenance, arguments, known);
  table.commit({.axes = known.axes, .provenance = provenance});
  return report(arguments, known, value, provenance, seconds());
}

}  // namespace albedo::analysis
