/// @file
/// A table that nobody holds: computed in tiles, each written to its place in the file it will be.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "albedo/table_source.hpp"
#include "analysis/files/placed_file.hpp"
#include "analysis/files/table_document.hpp"
#include "analysis/files/tile_claims.hpp"
#include "analysis/files/tile_journal.hpp"

namespace albedo::analysis {

/// What a table is filled with.
struct Entries {
  /// Computes consecutive entries from number `first` on (C order); of one thread.
  using Worker = std::function<TableTally(std::size_t first, std::span<double> values)>;

  std::vector<TableAxis> axes;
  int threads = 1;
  std::function<Worker()> make_worker;

  /// The source must outlive them.
  static Entries of(const TableSource& source);
};

/// What fill() has met; those of disjoint tiles may be merged in any order.
struct FilledTiles {
  TableTally tally{};
  std::size_t computed = 0;
  std::size_t verified = 0;  ///< that were finished before
  std::size_t damaged = 0;   ///< of those computed, with a record before and a wrong checksum

  void merge(const FilledTiles& other);
};

struct TilingOptions {
  std::string command{};                 ///< for the journal
  nlohmann::ordered_json computation{};  ///< all that the entries depend on but the axes, for the journal
  bool resume = false;                   ///< continue an unfinished table, if there is one
  bool is_owner = true;                  ///< begins and commits; others open what the owner has opened, and fill
  std::size_t tile = 0;                  ///< entries of a tile; 0: as many as suit the table
};

/// A .npy file PATH on its way: PATH.part, in the layout of the finished file, and PATH.journal, a TileJournal. Memory
/// doesn't grow with the table. The file gets its name, and the journal goes, in commit(); whatever ends the
/// process before leaves both for another one to continue with. The same bits as write_npy() of an AlbedoTable, for any
/// number of threads and processes, interrupted or not.
class TiledTable {
 public:
  /// Begins a table, or continues an unfinished one.
  /// @param axes of the file: those of the entries that aren't fixed directions
  /// @throws ParameterError if the unfinished table is of another computation; says what differs
  /// @throws WriteError for an unfinished table that isn't to be continued, is truncated, isn't one, or is being
  /// written by another process; a disk without room for the whole table
  TiledTable(Entries entries, std::vector<TableAxis> axes, const std::string& path, TilingOptions options);
  ~TiledTable();
  TiledTable(const TiledTable&) = delete;
  TiledTable& operator=(const TiledTable&) = delete;

  /// The number of tiles, to be claimed.
  [[nodiscard]] std::size_t tiles() const { return (size_ - 1) / tile_ + 1; }

  /// Computes the tiles that are claimed; what is finished is verified instead by its checksum, and computed again if
  /// that is wrong. Whatever it throws, the claims are stopped.
  /// @throws WriteError also for an entry that is neither a number nor +infinity; then nothing is left
  FilledTiles fill(TileClaims& claims);

  /// Sees what other processes have written.
  void reopen();

  /// Any entry of a tile that is written.
  [[nodiscard]] double value(std::size_t entry) const;

  /// The command line that began the table.
  [[nodiscard]] const std::string& command() const { return journal_->head().command; }

  /// Gives the file its name, and writes axes and provenance to its sidecar_path(). For the owner.
  void commit(const TableDocument& description);

 private:
  class Filling;

  void join(const JournalHead& head);
  [[nodiscard]] bool is_continued(const JournalHead& head);
  void open_part(const JournalHead& head);
  void begin(const JournalHead& head);
  void discard();

  Entries entries_;
  std::size_t size_;
  std::vector<TableAxis> axes_;
  std::string path_, target_, part_path_, journal_path_;
  TilingOptions options_;
  std::size_t tile_;
  std::string header_;
  std::unique_ptr<TileJournal> journal_;
  std::unique_ptr<PlacedFile> part_;
};

/// Whether a path is that of a .npy which is or will be a regular file.
[[nodiscard]] bool can_be_tiled(const std::string& path);

/// The checksums of files that a model's parameters name: {"file": 123}; other files are other tables.
[[nodiscard]] nlohmann::ordered_json checksums_of_files(const ModelInfo& model, const Parameters& parameters);

}  // namespace albedo::analysis
