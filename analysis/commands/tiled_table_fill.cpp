#include <algorithm>
#include <cstring>
#include <iostream>
#include <optional>
#include <type_traits>

#include "albedo/core/errors.hpp"
#include "analysis/commands/commands.hpp"
#include "analysis/commands/fill_progress.hpp"
#include "analysis/commands/interruption.hpp"
#include "analysis/commands/table_fills.hpp"
#include "analysis/files/ranks.hpp"
#include "analysis/text/text.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

/// All that the entries depend on but the axes.
Json computation_of(const TableArguments& arguments, const TableRequest& request, const Json& provenance) {
  Json computation = provenance;
  computation.erase("command");
  computation["compiler"] = __VERSION__;
  if (arguments.fill == Fill::proxy) computation["proxy"] = {{"verified_places", arguments.verified}};
  if (arguments.model.corrections.any()) computation["corrections"] = corrections_json(arguments.model.corrections);
  arguments.options.describe(computation);
  computation["budget"] = arguments.options.budget;
  if (const Json files = request.checksums_of_files(); !files.empty()) {
    computation["files"] = files;
  }
  return computation;
}

/// What all ranks have filled, known to all.
FilledTiles merged(Ranks& ranks, const FilledTiles& own) {
  static_assert(std::is_trivially_copyable_v<FilledTiles>);
  std::string bytes(sizeof own, '\0');
  std::memcpy(bytes.data(), &own, sizeof own);
  FilledTiles all;
  for (const std::string& of_rank : ranks.gather(bytes)) {
    FilledTiles part;
    std::memcpy(&part, of_rank.data(), sizeof part);
    all.merge(part);
  }
  return all;
}

}  // namespace

bool is_tiled(const TableArguments& arguments, bool by_channel) {
  const bool is_plain = arguments.materials.empty() && !arguments.errors && !by_channel &&
                        arguments.growth.max_error == 0 && arguments.growth.bits == 0;
  const bool result = is_plain && can_be_tiled(arguments.output);
  const auto refuse = [&](const std::string& what) {
    if (result) return;
    throw ParameterError(what +
                         " a .npy file of one model and channel, without --errors, --max-error, --bits "
                         "and --materials");
  };
  if (arguments.resume) refuse("--resume continues");
  if (!arguments.log.empty()) refuse("--log is of");
  if (arguments.tile > 0) refuse("--tile is of");
  if (const Launch started = launch(); started.size > 1) {
    refuse(fmt::format("the {} processes of {} can only share", started.size, started.variable));
  }
  return result;
}

TileFill integrated_entries(const TableSource& source) { return {.entries = Entries::of(source)}; }

int run_tiled(const TableArguments& arguments, const TableRequest& request, const TableOptions& options,
              const MakeTileFill& make_fill, Json provenance, const std::function<double()>& seconds) {
  const std::unique_ptr<Ranks> ranks = join_ranks();
  std::optional<TableSource> source;
  TileFill fill;
  std::optional<TiledTable> table;
  const auto open = [&] {
    if (ranks->is_first()) FillProgress::check(arguments.log);
    source.emplace(request.models(arguments.model.corrections), request.axes, options);
    fill = make_fill(*source);
    table.emplace(fill.entries, request.document_axes(), arguments.output,
                  TilingOptions{.command = provenance["command"].get<std::string>(),
                                .computation = computation_of(arguments, request, provenance),
                                .resume = arguments.resume,
                                .is_owner = ranks->is_first(),
                                .tile = arguments.tile > 0 ? static_cast<std::size_t>(arguments.tile) : fill.tile});
  };
  ranks->together([&] {
    if (ranks->is_first()) open();
  });
  ranks->together([&] {
    if (!ranks->is_first()) open();
  });
  std::optional<InterruptionNotice> notice;
  if (ranks->is_first())
    notice.emplace("interrupted; the same command with --resume continues '" + arguments.output + "'");

  const std::unique_ptr<TileClaims> claims = ranks->claims(table->tiles());
  std::optional<FillProgress> progress;
  FilledTiles filled;
  ranks->together([&] {
    if (!ranks->is_first()) return;
    progress.emplace(*claims, source->size(), arguments.log);
    progress->note(fmt::format("begins: {} ({} processes of {} threads)", provenance["command"].get<std::string>(),
                               ranks->size(), source->threads()));
  });
  ranks->together([&] { filled = table->fill(*claims); });
  if (progress) progress->stop();
  filled = merged(*ranks, filled);

  int code = exit_code::done;
  ranks->together([&] {
    if (!ranks->is_first()) return;
    if (filled.damaged > 0) {
      std::cerr << "albedo: " << filled.damaged << " finished tiles had a wrong checksum and were computed again\n";
    }
    table->reopen();
    const EntryAt value = [&](std::size_t entry) { return table->value(entry); };
    const TableSource::Interpolation interpolation = source->interpolation(value);
    FilledTable whole{.axes = request.document_axes(),
                      .entries = source->size(),
                      .tally = filled.tally,
                      .interpolation_error = interpolation.error};
    if (whole.tally.worst_error >= 0) whole.worst_entry = whole.tally.worst_entry;
    whole.tally.worst_error = std::max(whole.tally.worst_error, 0.0);
    whole.tally.evaluations += interpolation.evaluations;
    if (fill.complete) fill.complete(whole, provenance);
    provenance["command"] = table->command();
    complete(provenance, arguments, whole);
    table->commit({.axes = whole.axes, .provenance = provenance});
    notice.reset();
    Json ended = summary_of(arguments, whole, provenance, seconds());
    ended["tiles"] = {{"computed", filled.computed}, {"verified", filled.verified}, {"damaged", filled.damaged}};
    progress->note("ends: " + json_text(ended));
    code = report(arguments, whole, value, provenance, seconds());
    if (fill.judge) code = fill.judge(code);
  });
  return std::stoi(ranks->gather(fmt::format("{}", code)).front());
}

}  // namespace albedo::analysis
