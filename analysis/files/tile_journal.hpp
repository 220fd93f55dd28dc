/// @file
/// What is known of the finished tiles of an unfinished table.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "albedo/table_source.hpp"
#include "analysis/files/placed_file.hpp"

namespace albedo::analysis {

/// What a journal belongs to.
struct JournalHead {
  std::string command;                 ///< the command line that began the table, for its provenance
  nlohmann::ordered_json computation;  ///< all that the entries depend on: {"model": ..., "tolerance": ...}
  std::size_t tiles = 0;
};

/// A finished tile.
struct TileRecord {
  std::uint64_t checksum = 0;  ///< of its bytes
  TableTally tally{};
};

/// A file with a head and a record of 64 bytes for each tile, which is written in place once the tile is on the disk:
/// records of different tiles may be written at once, by threads or processes. Every failure is a WriteError.
///
/// Layout, all numbers little-endian: "albedo journal 1", the length of the head's text in 8 bytes, its checksum in 8,
/// the text (JSON) up to a multiple of 64 bytes, and the records: tile + 1 (0: not finished), checksum, worst error,
/// its entry, unconverged, divergent, evaluations, and the checksum of these seven.
class TileJournal {
 public:
  /// Writes a journal without finished tiles; the file appears when it is whole.
  static void create(const std::string& path, const JournalHead& head);

  /// Whether a journal is opened by the one process that answers for its table, or by one that works for that.
  enum class Access { owned, shared };

  /// Opens a journal; its owner locks it.
  /// @throws WriteError if it is no journal, is truncated, or has another owner
  TileJournal(const std::string& path, Access access);

  [[nodiscard]] const JournalHead& head() const { return head_; }

  /// The record of a tile, or none if it isn't finished (or was being recorded in a crash).
  [[nodiscard]] std::optional<TileRecord> find(std::size_t tile) const;

  /// Records a tile that is on the disk. The end of this process doesn't harm the record; a power cut may take the
  /// last ones, as they are forced to the disk once a second at most.
  void record(std::size_t tile, const TileRecord& record);

  /// Returns when the records are on the disk.
  void synchronise() { file_.synchronise(); }

  /// How many tiles are recorded.
  [[nodiscard]] std::size_t count() const;

 private:
  PlacedFile file_;
  JournalHead head_;
  std::uint64_t begin_ = 0;  // of the records
  std::atomic<std::chrono::steady_clock::rep> synchronised_ = 0;
};

/// What differs between two computations, in one line: "tolerance was 1e-06 and is 1e-08"; empty if nothing does.
[[nodiscard]] std::string difference(const nlohmann::ordered_json& was, const nlohmann::ordered_json& is);

}  // namespace albedo::analysis
