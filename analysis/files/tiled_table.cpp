#include "analysis/files/tiled_table.hpp"

#include <omp.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "albedo/core/errors.hpp"
#include "analysis/files/atomic_file.hpp"
#include "analysis/files/json_writer.hpp"
#include "analysis/files/npy_writer.hpp"
#include "core/text.hpp"

namespace albedo::analysis {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// An entry that no file may hold: the table can't be finished.
struct ImpossibleEntry : WriteError {
  using WriteError::WriteError;
};

/// Large enough for the disk, small enough to lose, and a thousand of them.
std::size_t suitable_tile(std::size_t entries) {
  return std::clamp<std::size_t>(std::bit_floor(entries / 1024), 32, 16384);
}

Json describe(const std::vector<TableAxis>& axes) {
  Json result = Json::object();
  for (const TableAxis& axis : axes) {
    if (axis.is_categorical()) {
      result[axis.name] = axis.labels;
      continue;
    }
    result[axis.name] = {{"from", axis.values.front()},
                         {"to", axis.values.back()},
                         {"count", axis.values.size()},
                         {"checksum", checksum(std::as_bytes(std::span(axis.values)))}};
  }
  return result;
}

}  // namespace

Entries Entries::of(const TableSource& source) {
  return {.axes = source.axes(), .threads = source.threads(), .make_worker = [&source] {
            return [worker = TableSource::Worker(source)](std::size_t first, std::span<double> values) mutable {
              return worker.fill(first, values);
            };
          }};
}

void FilledTiles::merge(const FilledTiles& other) {
  tally.merge(other.tally);
  computed += other.computed;
  verified += other.verified;
  damaged += other.damaged;
}

TiledTable::TiledTable(Entries entries, std::vector<TableAxis> axes, const std::string& path, TilingOptions options)
    : entries_(std::move(entries)),
      size_(entry_count(entries_.axes)),
      axes_(std::move(axes)),
      path_(path),
      target_(AtomicFile::target_of(path)),
      part_path_(target_ + ".part"),
      journal_path_(target_ + ".journal"),
      options_(std::move(options)),
      tile_(options_.tile > 0 ? options_.tile : suitable_tile(size_)),
      header_(npy_header(axes_)) {
  Json computation = options_.computation;
  computation["axes"] = describe(entries_.axes);
  computation["tile"] = tile_;
  // As it will be read again: a name of a file may hold any byte, JSON may not.
  computation = Json::parse(computation.dump(-1, ' ', false, Json::error_handler_t::replace));
  const JournalHead head{options_.command, std::move(computation), tiles()};
  if (!options_.is_owner) {
    join(head);
  } else if (!is_continued(head)) {
    begin(head);
  }
}

TiledTable::~TiledTable() = default;

/// Opens what the owner has opened before. Another node may have another version of this program.
void TiledTable::join(const JournalHead& head) {
  journal_ = std::make_unique<TileJournal>(journal_path_, TileJournal::Access::shared);
  open_part(head);
}

/// Opens the unfinished table, if there is one in which any tile is finished.
bool TiledTable::is_continued(const JournalHead& head) {
  if (!fs::exists(journal_path_)) {
    if (!fs::exists(part_path_)) return false;
    throw cannot_write(path_, "'" + part_path_ + "' is in the way: it has no journal; remove it");
  }
  journal_ = std::make_unique<TileJournal>(journal_path_, TileJournal::Access::owned);
  const std::size_t finished = fs::exists(part_path_) ? journal_->count() : 0;
  if (finished == 0) return false;
  if (!options_.resume) {
    throw cannot_write(path_, fmt::format("'{}' has {} of {} tiles of an unfinished table; continue with "
                                          "--resume, or remove it and '{}'",
                                          part_path_, finished, journal_->head().tiles, journal_path_));
  }
  open_part(head);
  return true;
}

/// Opens the entries, if the journal and they are those of this computation.
void TiledTable::open_part(const JournalHead& head) {
  const std::string differs = difference(journal_->head().computation, head.computation);
  if (!differs.empty()) throw ParameterError("--resume: '" + part_path_ + "' is of another table: " + differs);
  part_ = std::make_unique<PlacedFile>(part_path_, PlacedFile::Mode::reuse);
  const std::uint64_t size = header_.size() + size_ * sizeof(double);
  if (part_->size() != size) {
    throw cannot_write(part_path_,
                       fmt::format("it is truncated or foreign: it has {} bytes, not {}", part_->size(), size));
  }
  std::string header(header_.size(), '\0');
  part_->read(0, std::as_writable_bytes(std::span(header)));
  if (header != header_) throw cannot_write(part_path_, "it is damaged: its header is not that of the table");
}

/// The journal first: a .part without one is never ours.
void TiledTable::begin(const JournalHead& head) {
  TileJournal::create(journal_path_, head);
  journal_ = std::make_unique<TileJournal>(journal_path_, TileJournal::Access::owned);
  try {
    part_ = std::make_unique<PlacedFile>(part_path_, PlacedFile::Mode::create);
    part_->reserve(header_.size() + size_ * sizeof(double));
    part_->write(0, std::as_bytes(std::span(header_)));
    part_->synchronise();
    synchronise_directory_of(part_path_);
  } catch (...) {
    discard();
    throw;
  }
}

void TiledTable::discard() {
  std::error_code ignored;
  fs::remove(part_path_, ignored);
  fs::remove(journal_path_, ignored);
}

/// What one thread fills tiles with.
class TiledTable::Filling {
 public:
  explicit Filling(TiledTable& table) : table_(table), worker_(table.entries_.make_worker()) {}

  /// Returns the number of entries.
  std::size_t fill(std::size_t tile) {
    const std::size_t first = tile * table_.tile_;
    values_.resize(std::min(table_.tile_, table_.size_ - first));
    const std::uint64_t place = table_.header_.size() + first * sizeof(double);
    if (const auto record = table_.journal_->find(tile)) {
      table_.part_->read(place, std::as_writable_bytes(std::span(values_)));
      if (checksum(std::as_bytes(std::span(values_))) == record->checksum) {
        filled_.merge({.tally = record->tally, .verified = 1});
        return values_.size();
      }
      ++filled_.damaged;
    }
    const TableTally tally = worker_(first, values_);
    check(first);
    const auto bytes = std::as_bytes(std::span(std::as_const(values_)));
    table_.part_->write(place, bytes);
    table_.part_->synchronise();
    table_.part_->check_in_place();
    table_.journal_->record(tile, {.checksum = checksum(bytes), .tally = tally});
    filled_.merge({.tally = tally, .computed = 1});
    return values_.size();
  }

  [[nodiscard]] const FilledTiles& filled() const { return filled_; }

 private:
  void check(std::size_t first) const {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (std::isfinite(values_[i]) || values_[i] == std::numeric_limits<double>::infinity()) continue;
      std::string text = "the entry at " + describe_entry({.axes = table_.axes_}, first + i) + " is ";
      append_number(text, values_[i]);
      throw ImpossibleEntry(cannot_write(table_.path_, text).what());
    }
  }

  TiledTable& table_;
  Entries::Worker worker_;
  std::vector<double> values_;
  FilledTiles filled_;
};

FilledTiles TiledTable::fill(TileClaims& claims) {
  FilledTiles whole;
  std::exception_ptr thrown;
#pragma omp parallel num_threads(entries_.threads)
  {
    try {
      Filling filling(*this);
      while (const std::optional<std::size_t> tile = claims.next()) claims.add_done(filling.fill(*tile));
#pragma omp critical(albedo_tiles)
      whole.merge(filling.filled());
    } catch (...) {
      claims.stop();
#pragma omp critical(albedo_tiles)
      if (!thrown) thrown = std::current_exception();
    }
  }
  if (!thrown) {
    journal_->synchronise();
    return whole;
  }
  try {
    std::rethrow_exception(thrown);
  } catch (const ImpossibleEntry&) {
    discard();
    throw;
  } catch (const ParameterError&) {
    discard();
    throw;
  }
}

void TiledTable::reopen() { part_ = std::make_unique<PlacedFile>(part_path_, PlacedFile::Mode::reuse); }

double TiledTable::value(std::size_t entry) const {
  double result = 0;
  part_->read(header_.size() + entry * sizeof(double), std::as_writable_bytes(std::span(&result, 1)));
  return result;
}

void TiledTable::commit(const TableDocument& description) {
  part_->check_in_place();
  AtomicFile sidecar(sidecar_path(path_));
  write_json_description(description, sidecar.stream());
  sidecar.finish();
  std::error_code failure;
  if (const auto before = fs::status(target_, failure); fs::is_regular_file(before)) {
    fs::permissions(part_path_, before.permissions(), failure);
  }
  sidecar.commit();
  fs::rename(part_path_, target_, failure);
  if (failure) throw cannot_write(path_, failure.message());
  synchronise_directory_of(target_);
  fs::remove(journal_path_, failure);
}

bool can_be_tiled(const std::string& path) {
  std::error_code ignored;
  const fs::file_type type = fs::status(path, ignored).type();
  return ending_of(path) == ".npy" && (type == fs::file_type::not_found || type == fs::file_type::regular);
}

Json checksums_of_files(const ModelInfo& model, const Parameters& parameters) {
  Json result = Json::object();
  for (const auto& [name, value] : parameters) {
    const ParameterInfo* const info = model.find(name);
    if (info == nullptr || !info->is_text) continue;
    const auto& path = std::get<std::string>(value);
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    result[path] = checksum(std::as_bytes(std::span(bytes)));
  }
  return result;
}

}  // namespace albedo::analysis
