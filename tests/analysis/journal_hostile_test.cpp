#include "analysis/files/tile_journal.hpp"
#include "analysis/output_directory.hpp"

/// Journals that nobody's table has, with checksums that are right.
namespace albedo::analysis {
namespace {

class HostileJournal : public OutputDirectory {
 protected:
  [[nodiscard]] std::string refusal_of(const std::string& head) const {
    const std::array<std::uint64_t, 2> numbers{head.size(), checksum(std::as_bytes(std::span(head)))};
    std::ofstream file(path("t.journal"), std::ios::binary);
    file << "albedo journal 1";
    file.write(reinterpret_cast<const char*>(numbers.data()), sizeof numbers) << head;
    file << std::string((64 - (32 + head.size()) % 64) % 64, ' ');
    file.close();
    return message_of<WriteError>([&] { TileJournal journal(path("t.journal"), TileJournal::Access::owned); });
  }
  static std::string repeated(const std::string& text, std::size_t times) {
    std::string result;
    for (std::size_t i = 0; i < times; ++i) result += text;
    return result;
  }
};

TEST_F(HostileJournal, DeepNestingIsRefused) {
  const std::string begin = R"({"tiles":0,"command":"","computation":)";
  for (const std::size_t deep : {std::size_t{34}, std::size_t{100'000}}) {
    EXPECT_TRUE(contains(refusal_of(begin + repeated("[", deep) + repeated("]", deep) + "}"), "nested too deeply"));
    EXPECT_TRUE(contains(refusal_of(begin + repeated(R"({"a":)", deep) + "1" + repeated("}", deep) + "}"),
                         "nested too deeply"));
  }
}

TEST_F(HostileJournal, LongHeadsAreNotParsed) {
  const std::string head = R"({"tiles":0,"command":"","computation":[)" + repeated("[],", 1'500'000) + "1]}";
  EXPECT_TRUE(contains(refusal_of(head), "truncated or damaged"));
}

TEST_F(HostileJournal, MoreTilesThanRecordsAreRefused) {
  for (const char* tiles : {"1", "1099511627777", "18446744073709551615"}) {
    const std::string head = R"({"tiles":)" + std::string(tiles) + R"(,"command":"","computation":{}})";
    EXPECT_TRUE(contains(refusal_of(head), "truncated or damaged")) << tiles;
  }
}

}  // namespace
}  // namespace albedo::analysis
