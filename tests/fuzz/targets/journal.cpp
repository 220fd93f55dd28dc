#include "analysis/files/tile_journal.hpp"

#include "fuzz/unfinished_table.hpp"

ALBEDO_FUZZ_TARGET(journal) {
  using namespace albedo;
  static const fuzz::Directory directory;
  static const auto computation = nlohmann::ordered_json::parse(
      R"({"tolerance": 1e-3, "axes": {"rho": {"from": 0.25, "to": 0.75, "count": 3}}, "tile": 2})");
  for (const std::string& bytes : {std::string(input), fuzz::repaired(std::string(input))}) {
    fuzz::accepts<WriteError>([&] {
      const analysis::TileJournal journal(directory.write("journal", bytes), analysis::TileJournal::Access::owned);
      const std::size_t count = journal.count();
      fuzz::require(count <= journal.head().tiles, "more finished tiles than there are");
      static_cast<void>(analysis::difference(journal.head().computation, computation));
    });
  }
}
