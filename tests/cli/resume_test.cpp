#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "cli/journal_of.hpp"
#include "cli/program.hpp"

namespace albedo::test {
namespace {

constexpr std::size_t tiles = 150;  // of 32 entries

std::vector<std::string> table(const std::string& threads, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{
      "table", "ggx",   "alpha_x=0.1:1:20", "alpha_y=0.3", "cos_theta=0.05:1:40", "phi=0:90:6",
      "-o",    "t.npy", "--threads",        threads};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Starts a run and ends it by a signal at a random moment after another tile is finished.
void interrupt(const std::vector<std::string>& arguments, int signal, std::mt19937& random) {
  const std::size_t before = finished(tiles);
  RunningAlbedo run(arguments);
  while (finished(tiles) == before && !run.has_ended()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(std::chrono::microseconds(random() % 20'000));
  run.kill(signal);
}

TEST_F(CliTest, AnInterruptedTableIsContinuedBitForBit) {
  ASSERT_EQ(run_albedo(table("1")).code, 0);
  const std::string whole = read_text("t.npy"), sidecar = read_text("t.json");
  EXPECT_EQ(files(), (std::vector<std::string>{"t.json", "t.npy"}));
  std::filesystem::remove("t.npy");
  std::filesystem::remove("t.json");

  std::mt19937 random(8);
  for (int attempt = 0; attempt < 20 && finished(tiles) == 0; ++attempt) {  // on a busy machine the kill may be late
    std::filesystem::remove("t.npy");
    std::filesystem::remove("t.json");
    interrupt(table("1"), SIGKILL, random);
  }
  ASSERT_GT(finished(tiles), 0U);
  EXPECT_EQ(files(), (std::vector<std::string>{"t.npy.journal", "t.npy.part"}));
  const Outcome anew = run_albedo(table("1"));
  EXPECT_EQ(anew.code, 4);
  EXPECT_NE(anew.err.find("continue with --resume"), std::string::npos) << anew.err;
  const Outcome other = run_albedo(table("1", {"--resume", "--tolerance", "1e-7"}));
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("tolerance was 1e-08 and is 1e-07"), std::string::npos) << other.err;

  for (const int signal : {SIGTERM, SIGKILL, SIGKILL, SIGINT, SIGKILL}) {
    const std::size_t before = finished(tiles);
    interrupt(table(std::to_string(1 + random() % 3), {"--resume"}), signal, random);
    if (finished(tiles) == 0) break;  // it was whole
    EXPECT_GE(finished(tiles), before);
  }
  const Outcome last = run_albedo(table("2", {"--resume"}));
  EXPECT_EQ(last.code, 0) << last.err;
  EXPECT_EQ(last.out + last.err, "");
  EXPECT_EQ(read_text("t.npy"), whole);
  EXPECT_EQ(read_text("t.json"), sidecar);
  EXPECT_EQ(files(), (std::vector<std::string>{"t.json", "t.npy"}));
}

TEST_F(CliTest, ResumeBeginsWhatIsNotBegunAndRefusesWhatIsNotTiled) {
  EXPECT_EQ(run_albedo({"table", "lambert", "-o", "t.npy", "--resume"}).code, 0);
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"-o", "t.csv"}, {"-o", "t.npy", "--errors"}, {"-o", "t.npy", "--bits", "8"}}) {
    std::vector<std::string> words{"table", "lambert", "--resume"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_albedo(words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("--resume continues a .npy"), std::string::npos) << outcome.err;
  }
  std::filesystem::remove("t.npy");
  std::filesystem::remove("t.json");
  EXPECT_EQ(run_albedo({"table", "lambert", "-o", "t.npy", "--log", "nowhere/log"}).code, 4);
  EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(CliTest, AssertionsOfATiledTableAreThoseOfOneInMemory) {
  const std::vector<std::string> asserted{"table", "ward", "theta=0:80:9", "-o", "t.npy", "--assert"};
  const auto code = [&](const std::string& condition) {
    std::vector<std::string> words = asserted;
    words.push_back(condition);
    return run_albedo(words).code;
  };
  EXPECT_EQ(code("max<=1, min>0, error<=1e-6, at(60)==0.488988056+-1e-7"), 0);
  EXPECT_EQ(code("max<=0.9"), 1);
}

}  // namespace
}  // namespace albedo::test
