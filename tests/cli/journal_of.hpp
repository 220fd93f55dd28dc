/// @file
/// What an interrupted `albedo table -o t.npy` has left in the working directory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "cli/program.hpp"

namespace albedo::test {

/// Whether a tile has a record of 64 bytes in the journal: one that isn't empty.
inline bool is_recorded(const std::string& journal, std::size_t tiles, std::size_t tile) {
  const std::string_view record = std::string_view(journal).substr(journal.size() - 64 * (tiles - tile), 64);
  return std::ranges::any_of(record, [](char c) { return c != 0; });
}

/// How many tiles are recorded.
inline std::size_t finished(std::size_t tiles) {
  if (!std::filesystem::exists("t.npy.journal") || !std::filesystem::exists("t.npy.part")) return 0;
  const std::string journal = read_text("t.npy.journal");
  std::size_t count = 0;
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    if (is_recorded(journal, tiles, tile)) ++count;
  }
  return count;
}

/// How many tiles of 32 entries are in the file without a record.
inline std::size_t unrecorded(std::size_t tiles) {
  const std::string journal = read_text("t.npy.journal"), part = read_text("t.npy.part");
  constexpr std::size_t bytes = 32 * sizeof(double);
  const std::size_t header = part.size() - tiles * bytes;
  std::size_t count = 0;
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    const std::string_view entries = std::string_view(part).substr(header + tile * bytes, bytes);
    const bool is_written = std::ranges::any_of(entries, [](char c) { return c != 0; });
    if (is_written && !is_recorded(journal, tiles, tile)) ++count;
  }
  return count;
}

}  // namespace albedo::test
