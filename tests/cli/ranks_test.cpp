#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "cli/journal_of.hpp"
#include "cli/program.hpp"

namespace albedo::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

Words table(int threads, const Words& more = {}) {
  Words words{"table",
              "ggx",
              "alpha_x=0.1:1:20",
              "alpha_y=0.3",
              "cos_theta=0.05:1:40",
              "phi=0:90:12",
              "--tolerance",
              "1e-6",
              "-o",
              "t.npy",
              "--threads",
              std::to_string(threads)};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

constexpr std::size_t tiles = 300;  // of 32 entries

/// The end of the log's last line.
nlohmann::json last_summary() {
  const std::string log = read_text("t.log");
  const std::size_t begin = log.rfind("ends: ");
  return begin == std::string::npos ? nlohmann::json() : nlohmann::json::parse(log.substr(begin + 6));
}

/// Whether a process could still write; one that nobody has waited for can't.
bool is_alive(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  const std::string text{std::istreambuf_iterator<char>(stat), {}};
  const std::size_t name_end = text.rfind(')');
  return name_end != std::string::npos && text.compare(name_end, 3, ") Z") != 0;
}

class RanksTest : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    if (!has_mpi()) GTEST_SKIP() << "built without MPI";
  }

  static void remove_table() {
    for (const char* const name : {"t.npy", "t.json", "t.log", "t.npy.part", "t.npy.journal"}) fs::remove(name);
  }
};

TEST_F(RanksTest, FillTheSameTable) {
  ASSERT_EQ(run_albedo(table(1)).code, 0);
  const std::string whole = read_text("t.npy"), sidecar = read_text("t.json");
  remove_table();
  for (const int ranks : {1, 2, 5}) {
    const Outcome outcome = run_ranks(ranks, table(1));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err.find("albedo: "), std::string::npos)
        << outcome.err;  // the launcher may have something to say
    EXPECT_EQ(read_text("t.npy"), whole);
    EXPECT_EQ(read_text("t.json"), sidecar);
    EXPECT_EQ(files(), (Words{"t.json", "t.npy"}));
    remove_table();
  }
  const Outcome told = run_ranks(3, table(2, {"--json", "--log", "t.log", "--assert", "max<=1"}));
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_EQ(line_count(told.out), 1U);
  EXPECT_EQ(last_summary()["tiles"]["computed"], tiles);
  EXPECT_EQ(nlohmann::json::parse(told.out)["worst_at"], last_summary()["worst_at"]);
  EXPECT_NE(read_text("t.log").find("3 processes of 2 threads"), std::string::npos);
  EXPECT_EQ(run_ranks(3, table(2, {"--assert", "max<=0.5"})).code, 1);
}

TEST_F(RanksTest, FailTogetherInOneVoice) {
  const auto said = [](const Outcome& outcome) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = outcome.err.find("albedo: ", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  const Outcome value = run_ranks(3, table(1, {"alpha=-1"}));
  EXPECT_EQ(value.code, 2);
  EXPECT_EQ(said(value), 1U) << value.err;
  const Outcome folder = run_ranks(3, {"table", "lambert", "-o", "nowhere/t.npy"});
  EXPECT_EQ(folder.code, 4);
  EXPECT_EQ(said(folder), 1U) << folder.err;
  const Outcome format = run_ranks(3, {"table", "lambert", "-o", "t.csv"});
  EXPECT_EQ(format.code, 2);
  EXPECT_NE(format.err.find("can only share a .npy file"), std::string::npos) << format.err;
  EXPECT_EQ(files(), Words{});
  write_text("t.npy.journal", "a diary");
  const Outcome journal = run_ranks(3, table(1));
  EXPECT_EQ(journal.code, 4);
  EXPECT_EQ(said(journal), 1U) << journal.err;
}

// ALBEDO_KILLS: how many; a few otherwise.
TEST_F(RanksTest, KilledAtAnyMomentAreContinuedBitForBit) {
  const char* const asked = std::getenv("ALBEDO_KILLS");
  const int kills = asked == nullptr ? 4 : std::atoi(asked);
  ASSERT_EQ(run_ranks(4, table(1, {"--log", "t.log"})).code, 0);
  const std::string whole = read_text("t.npy"), sidecar = read_text("t.json");
  std::mt19937 random(200);
  int in_time = 0, left_most = 0;
  for (int k = 0; k < kills; ++k) {
    remove_table();
    RunningAlbedo run(4, table(1, {"--log", "t.log"}));
    const std::size_t moment = random() % (tiles - 20);
    while (finished(tiles) < moment && !run.has_ended()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 5000));
    const std::vector<pid_t> ranks = run.ranks();
    if (random() % 2 == 0 && !ranks.empty()) {
      ::kill(ranks[random() % ranks.size()], SIGKILL);  // and the launcher ends the others
      run.wait();
    } else {
      for (const pid_t rank : ranks) ::kill(rank, SIGKILL);
      run.kill(SIGKILL);
    }
    while (std::ranges::any_of(ranks, is_alive)) std::this_thread::sleep_for(std::chrono::milliseconds(1));

    const std::size_t recorded = finished(tiles);
    const bool is_whole = fs::exists("t.npy");
    if (!is_whole && recorded > 0) {
      ++in_time;
      left_most = std::max(left_most, static_cast<int>(unrecorded(tiles)));
      EXPECT_LE(unrecorded(tiles), 4U) << "kill " << k;  // a tile a thread
    }
    static constexpr int others[] = {1, 2, 3, 5};
    const Outcome resumed =
        run_ranks(others[random() % 4], table(1 + static_cast<int>(random() % 2), {"--log", "t.log", "--resume"}));
    ASSERT_EQ(resumed.code, 0) << "kill " << k << ": " << resumed.err;
    if (!is_whole && recorded > 0) {
      EXPECT_EQ(last_summary()["tiles"]["verified"], recorded);
      EXPECT_EQ(last_summary()["tiles"]["damaged"], 0);
      EXPECT_EQ(last_summary()["tiles"]["computed"], tiles - recorded);
    }
    ASSERT_EQ(read_text("t.npy"), whole) << "kill " << k;
    if (!is_whole && recorded > 0) {
      EXPECT_EQ(read_text("t.json"), sidecar) << "kill " << k;
    }
    ASSERT_EQ(files(), (Words{"t.json", "t.log", "t.npy"}));
  }
  RecordProperty("kills_in_time", in_time);
  RecordProperty("most_tiles_lost", left_most);
  EXPECT_GT(in_time, kills / 2);
}

TEST_F(CliTest, ABuildWithoutMpiSharesNoTable) {
  if (has_mpi()) GTEST_SKIP() << "built with MPI";
  ASSERT_EQ(::setenv("OMPI_COMM_WORLD_SIZE", "4", 1), 0);
  ASSERT_EQ(::setenv("OMPI_COMM_WORLD_RANK", "0", 1), 0);
  const Outcome outcome = run_albedo({"table", "lambert", "-o", "t.npy"});
  ::unsetenv("OMPI_COMM_WORLD_SIZE");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("built without MPI"), std::string::npos) << outcome.err;
  EXPECT_EQ(files(), Words{});
}

}  // namespace
}  // namespace albedo::test
