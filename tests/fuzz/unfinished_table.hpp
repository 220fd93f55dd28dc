/// @file
/// A small table that was interrupted: what --resume reads.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "analysis/files/placed_file.hpp"
#include "analysis/files/tiled_table.hpp"
#include "fuzz/files.hpp"
#include "fuzz/fuzz.hpp"

namespace albedo::fuzz {

class UnfinishedTable {
 public:
  static constexpr std::size_t tiles = 3;

  /// Computes two of the three tiles, then all of them elsewhere.
  UnfinishedTable() {
    {
      analysis::TiledTable table(analysis::Entries::of(source_), document_axes(), directory_.path("t.npy"),
                                 options(false));
      analysis::LocalClaims claims(tiles - 1);
      table.fill(claims);
    }
    part_ = directory_.read("t.npy.part");
    journal_ = directory_.read("t.npy.journal");
    analysis::TiledTable whole(analysis::Entries::of(source_), document_axes(), directory_.path("whole.npy"),
                               options(false));
    analysis::LocalClaims claims(tiles);
    whole.fill(claims);
    values_ = values_of(whole);
  }

  [[nodiscard]] const std::string& part() const { return part_; }
  [[nodiscard]] const std::string& journal() const { return journal_; }

  /// Resumes from these files: refused, or the same entries in the end.
  void resume(std::string_view part, std::string_view journal) const {
    static_cast<void>(directory_.write("t.npy.part", part));
    static_cast<void>(directory_.write("t.npy.journal", journal));
    accepts<Error>([&] {
      analysis::TiledTable table(analysis::Entries::of(source_), document_axes(), directory_.path("t.npy"),
                                 options(true));
      analysis::LocalClaims claims(tiles);
      const analysis::FilledTiles all = table.fill(claims);
      require(values_of(table) == values_, "a resumed table with other entries");
      require(all.verified + all.computed == tiles && all.damaged <= all.computed, "tiles that don't add up");
    });
  }

 private:
  static analysis::TilingOptions options(bool resume) {
    return {.command = "albedo table lambert", .computation = {{"tolerance", 1e-3}}, .resume = resume, .tile = 2};
  }

  [[nodiscard]] std::vector<TableAxis> document_axes() const {
    std::vector<TableAxis> result;
    for (const TableAxis& axis : source_.axes()) result.push_back({.name = axis.name, .values = axis.values});
    return result;
  }

  std::vector<double> values_of(const analysis::TiledTable& table) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < source_.size(); ++i) values.push_back(table.value(i));
    return values;
  }

  Directory directory_;
  TableSource source_{"lambert",
                      {},
                      {{"rho", {0.25, 0.5, 0.75}}, {"cos_theta", {0.5, 1}}},
                      {.albedo = {.tolerance = 1e-3}, .threads = 1, .verified_cells = 0}};
  std::string part_, journal_;
  std::vector<double> values_;
};

/// A journal with its checksums set right, so that what is behind them is read.
inline std::string repaired(std::string journal) {
  constexpr std::size_t magic = 16, number = sizeof(std::uint64_t), head = magic + 2 * number, record = 64;
  const auto set_checksum = [&](std::size_t begin, std::size_t length, std::size_t place) {
    const std::uint64_t sum = analysis::checksum(std::as_bytes(std::span(journal).subspan(begin, length)));
    std::memcpy(journal.data() + place, &sum, sizeof sum);
  };
  if (journal.size() < head) return journal;
  std::uint64_t length = 0;
  std::memcpy(&length, journal.data() + magic, sizeof length);
  if (length > journal.size() - head) return journal;
  set_checksum(head, length, magic + number);
  for (std::size_t at = (head + length + record - 1) / record * record; at + record <= journal.size(); at += record) {
    set_checksum(at, record - number, at + record - number);
  }
  return journal;
}

}  // namespace albedo::fuzz
