#include "analysis/files/tiled_table.hpp"

#include "analysis/files/npy_writer.hpp"
#include "analysis/output_directory.hpp"

namespace albedo::analysis {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<TableAxis> two_axes{{"alpha", {0.2, 0.3, 0.5, 0.7, 1}}, {"cos_theta", {0.1, 0.3, 0.5, 0.7, 0.8, 1}}};

TableSource ggx(int threads) {
  return {"ggx", {}, two_axes, {.albedo = {.tolerance = 1e-6}, .threads = threads, .verified_cells = 4}};
}

std::vector<TableAxis> document_axes() {
  std::vector<TableAxis> axes;
  for (const TableAxis& axis : two_axes) axes.push_back({.name = axis.name, .values = axis.values});
  return axes;
}

TilingOptions options(bool resume, double tolerance = 1e-6) {
  return {.command = "albedo table", .computation = {{"tolerance", tolerance}}, .resume = resume, .tile = 4};
}

class TiledTableTest : public OutputDirectory {
 protected:
  /// The bytes that write_npy() writes for an AlbedoTable.
  [[nodiscard]] std::string expected() const {
    const AlbedoTable table("ggx", {}, two_axes, {.albedo = {.tolerance = 1e-6}, .verified_cells = 0});
    write_npy({.axes = document_axes(), .values = table.values().data()}, path("expected.npy"));
    const std::string bytes = read(path("expected.npy"));
    fs::remove(path("expected.npy"));
    fs::remove(path("expected.json"));
    return bytes;
  }

  /// A table of 8 tiles of which some are finished.
  void interrupted(std::size_t finished) const {
    const TableSource source = ggx(1);
    TiledTable table(Entries::of(source), document_axes(), path("t.npy"), options(false));
    LocalClaims claims(finished);  // as if the process then ended
    table.fill(claims);
  }

  void flip_byte(const std::string& name, std::size_t from_end) const {
    std::string bytes = read(path(name));
    char& byte = bytes[bytes.size() - from_end];
    byte = static_cast<char>(byte ^ 1);
    std::ofstream(path(name), std::ios::binary) << bytes;
  }

  [[nodiscard]] FilledTiles resumed(int threads) const {
    const TableSource source = ggx(threads);
    TiledTable table(Entries::of(source), document_axes(), path("t.npy"), options(true));
    LocalClaims claims(table.tiles());
    const FilledTiles filled = table.fill(claims);
    table.commit({.axes = document_axes()});
    return filled;
  }

  template <class Exception>
  [[nodiscard]] std::string refusal(bool resume, double tolerance = 1e-6) const {
    const TableSource source = ggx(1);
    return message_of<Exception>(
        [&] { TiledTable(Entries::of(source), document_axes(), path("t.npy"), options(resume, tolerance)); });
  }
};

TEST(Checksum, IsCrc64Xz) {
  const std::string digits = "123456789";
  EXPECT_EQ(checksum(std::as_bytes(std::span(digits))), 0x995DC9BBDF1939FA);  // the catalogue's check value
}

TEST(LocalClaims, HandOutEveryTileOnce) {
  constexpr std::size_t count = 1000;
  std::vector<int> claimed(count);
  LocalClaims claims(count);
#pragma omp parallel num_threads(4)
  while (const auto tile = claims.next()) {
#pragma omp atomic
    ++claimed[*tile];
  }
  EXPECT_EQ(claimed, std::vector<int>(count, 1));
  EXPECT_EQ(claims.next(), std::nullopt);
  LocalClaims stopped(count);
  stopped.stop();
  EXPECT_EQ(stopped.next(), std::nullopt);
}

TEST_F(TiledTableTest, HasTheBytesAndTheTallyOfAnAlbedoTable) {
  const AlbedoTable table("ggx", {}, two_axes, {.albedo = {.tolerance = 1e-6}, .verified_cells = 4});
  for (const int threads : {1, 3}) {
    const TableSource source = ggx(threads);
    TiledTable tiled(Entries::of(source), document_axes(), path("t.npy"), options(false));
    EXPECT_EQ(tiled.tiles(), 8U);
    EXPECT_EQ(names(), (std::vector<std::string>{"t.npy.journal", "t.npy.part"}));
    LocalClaims claims(tiled.tiles());
    const FilledTiles filled = tiled.fill(claims);
    EXPECT_EQ(filled.computed, 8U);
    EXPECT_EQ(claims.add_done(0), source.size());
    EXPECT_EQ(filled.tally.worst_error, table.worst_error());
    EXPECT_EQ(filled.tally.worst_entry, table.worst_entry());
    EXPECT_EQ(source.interpolation([&](std::size_t i) { return tiled.value(i); }).error, table.interpolation_error());
    tiled.commit({.axes = document_axes()});
    EXPECT_EQ(names(), (std::vector<std::string>{"t.json", "t.npy"}));
    EXPECT_EQ(read(path("t.npy")), expected());
    fs::remove(path("t.npy"));
    fs::remove(path("t.json"));
  }
}

TEST_F(TiledTableTest, ContinuesWithOtherThreadsAndComputesNothingTwice) {
  for (const std::size_t finished : {1U, 5U, 8U}) {
    interrupted(finished);
    const FilledTiles result = resumed(3);
    EXPECT_EQ(result.verified, finished);
    EXPECT_EQ(result.computed, 8 - finished);
    EXPECT_EQ(result.damaged, 0U);
    EXPECT_EQ(read(path("t.npy")), expected());
    const AlbedoTable table("ggx", {}, two_axes, {.albedo = {.tolerance = 1e-6}, .verified_cells = 0});
    EXPECT_EQ(result.tally.evaluations, table.evaluations());
    EXPECT_EQ(result.tally.worst_entry, table.worst_entry());
    fs::remove(path("t.npy"));
    fs::remove(path("t.json"));
  }
}

TEST_F(TiledTableTest, ComputesDamagedTilesAgain) {
  interrupted(8);
  flip_byte("t.npy.part", 1);          // an entry of the last tile
  flip_byte("t.npy.journal", 64 + 1);  // the record of the one before
  const FilledTiles result = resumed(2);
  EXPECT_EQ(result.verified, 6U);
  EXPECT_EQ(result.damaged, 1U);  // what has no valid record isn't finished
  EXPECT_EQ(read(path("t.npy")), expected());
}

TEST_F(TiledTableTest, RefusesWhatIsNotItsOwn) {
  interrupted(3);
  EXPECT_TRUE(contains(refusal<WriteError>(false), "has 3 of 8 tiles of an unfinished table; continue with --resume"));
  EXPECT_TRUE(contains(refusal<ParameterError>(true, 1e-7), "is of another table: tolerance was 1e-06 and is 1e-07"));
  {
    const TableSource source = ggx(1);
    const TiledTable other(Entries::of(source), document_axes(), path("t.npy"), options(true));
    EXPECT_TRUE(contains(refusal<WriteError>(true), "another process is writing it"));
  }
  fs::resize_file(path("t.npy.part"), fs::file_size(path("t.npy.part")) - 1);
  EXPECT_TRUE(contains(refusal<WriteError>(true), "truncated or foreign"));
  const std::string journal = read(path("t.npy.journal"));
  fs::resize_file(path("t.npy.journal"), journal.size() - 64);
  EXPECT_TRUE(contains(refusal<WriteError>(true), "the journal is truncated or damaged"));
  fs::resize_file(path("t.npy.journal"), 20);
  EXPECT_TRUE(contains(refusal<WriteError>(true), "it is no journal of a table"));
  std::ofstream(path("t.npy.journal"), std::ios::binary) << "a diary of somebody else, longer than a head";
  EXPECT_TRUE(contains(refusal<WriteError>(true), "it is no journal of a table"));
  EXPECT_TRUE(contains(refusal<WriteError>(false), "it is no journal of a table"));
  std::string damaged = journal;
  damaged[40] = static_cast<char>(damaged[40] ^ 1);
  std::ofstream(path("t.npy.journal"), std::ios::binary) << damaged;
  EXPECT_TRUE(contains(refusal<WriteError>(true), "the checksum of its head is wrong"));
  fs::remove(path("t.npy.journal"));
  EXPECT_TRUE(contains(refusal<WriteError>(true), "in the way: it has no journal"));
}

TEST_F(TiledTableTest, BeginsAnewWhereNothingIsFinished) {
  interrupted(0);
  EXPECT_EQ(resumed(1).verified, 0U);
  EXPECT_EQ(read(path("t.npy")), expected());
  fs::remove(path("t.npy"));
  interrupted(2);
  fs::remove(path("t.npy.part"));  // as after a crash between the renaming and the journal's end
  EXPECT_EQ(resumed(1).verified, 0U);
  EXPECT_EQ(read(path("t.npy")), expected());
}

TEST_F(TiledTableTest, OthersFillWhatTheOwnerHasBegun) {
  const TableSource source = ggx(2);
  TilingOptions for_others = options(false);
  for_others.is_owner = false;
  const auto open = [&](TilingOptions with) {
    return std::make_unique<TiledTable>(Entries::of(source), document_axes(), path("t.npy"), std::move(with));
  };
  EXPECT_TRUE(contains(message_of<WriteError>([&] { open(for_others); }), "No such file"));
  const auto owner = open(options(false)), other = open(for_others);
  for_others.computation["tolerance"] = 1e-7;
  EXPECT_TRUE(contains(message_of<ParameterError>([&] { open(for_others); }), "tolerance was 1e-06 and is 1e-07"));
  LocalClaims claims(owner->tiles());
  FilledTiles filled = other->fill(claims);
  filled.merge(owner->fill(claims));  // nothing is left for it
  EXPECT_EQ(filled.computed, 8U);
  owner->reopen();
  owner->commit({.axes = document_axes()});
  EXPECT_EQ(read(path("t.npy")), expected());
}

TEST_F(TiledTableTest, AVanishedFileIsSaidAtTheNextTile) {
  const TableSource source = ggx(1);
  TiledTable table(Entries::of(source), document_axes(), path("t.npy"), options(false));
  fs::remove(path("t.npy.part"));
  LocalClaims claims(table.tiles());
  EXPECT_TRUE(contains(message_of<WriteError>([&] { table.fill(claims); }), "it was removed or replaced"));
  EXPECT_EQ(claims.next(), std::nullopt);
  EXPECT_TRUE(
      contains(message_of<WriteError>([&] { table.commit({.axes = document_axes()}); }), "removed or replaced"));
}

TEST_F(TiledTableTest, AFullDiskIsSaidBeforeTheWorkAndLeavesNothing) {
  const auto attempt = [&] {
    limit_file_size();
    exit_with("File too large", [&] {
      TableAxis axis{"cos_theta", std::vector<double>(20'000, 0.5)};
      const TableSource source("lambert", {}, {axis});
      TilingOptions few = options(false);
      few.tile = 1000;  // so that the journal finds room
      TiledTable(Entries::of(source), {{.name = axis.name, .values = axis.values}}, path("t.npy"), few);
    });
  };
  EXPECT_EXIT(attempt(), testing::ExitedWithCode(4), "");
  EXPECT_EQ(names(), Names{});
}

TEST_F(TiledTableTest, AShortWriteIsNoSuccess) {
  const auto attempt = [&] {
    limit_file_size();
    exit_with("File too large", [&] {
      PlacedFile file(path("f"), PlacedFile::Mode::create);
      const std::vector<std::byte> bytes(1000);
      file.write(99'500, bytes);  // the first 500 find room
    });
  };
  EXPECT_EXIT(attempt(), testing::ExitedWithCode(4), "");
  EXPECT_EQ(fs::file_size(path("f")), 100'000U);
  PlacedFile file(path("f"), PlacedFile::Mode::reuse);
  std::vector<std::byte> bytes(1000);
  EXPECT_TRUE(contains(message_of<WriteError>([&] { file.read(99'500, bytes); }), "it ends after 100000 bytes"));
}

TEST(Difference, NamesWhatDiffers) {
  const Json was{{"model", "ggx"}, {"axes", {{"phi", {{"count", 3}}}}}, {"seed", 1}};
  const Json is{{"model", "ward"}, {"axes", {{"phi", {{"count", 4}}}}}, {"bits", 8}};
  EXPECT_EQ(difference(was, was), "");
  EXPECT_EQ(difference(was, is),
            R"(model was "ggx" and is "ward"; axes: phi: count was 3 and is 4; seed was 1 and is not given; )"
            "bits was not given and is 8");
}

}  // namespace
}  // namespace albedo::analysis
