#include <sys/mount.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "cli/journal_of.hpp"
#include "cli/program.hpp"

namespace albedo::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr std::size_t page = 4096;

Words table(const Words& more = {}) {
  Words words{"table", "lambert", "rho=0:1:64", "cos_theta=0.1:1:64", "-o", "t.npy", "--threads", "2"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// A small disk of its own, for those who may mount one.
class SmallDisk : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    fs::create_directory("disk");
    is_mounted_ = ::mount("tmpfs", "disk", "tmpfs", 0, "size=256k") == 0;
    if (!is_mounted_) GTEST_SKIP() << "may not mount a tmpfs";
    disk_ = fs::absolute("disk");
    fs::current_path(disk_);
  }

  void TearDown() override {
    fs::current_path("/");
    if (is_mounted_) ::umount2(disk_.c_str(), MNT_DETACH);
    CliTest::TearDown();
  }

  [[nodiscard]] const fs::path& disk() const { return disk_; }

 private:
  fs::path disk_;
  bool is_mounted_ = false;
};

TEST_F(SmallDisk, FullAtAnyMomentIsSaidAndNothingIsLost) {
  ASSERT_EQ(run_albedo(table()).code, 0);
  const std::string whole = read_text("t.npy"), sidecar = read_text("t.json");
  int refused = 0, interrupted = 0, done = 0;
  for (std::size_t pages = 0; pages < 24; ++pages) {
    for (const auto& name : files()) fs::remove(name);
    write_text("ballast", std::string(fs::space(".").available - pages * page, 'x'));
    ASSERT_EQ(fs::space(".").available, pages * page);
    const Outcome outcome = run_albedo(table());
    if (outcome.code == 0) {
      ++done;
      EXPECT_EQ(read_text("t.npy"), whole);
      continue;
    }
    EXPECT_EQ(outcome.code, 4) << pages << ": " << outcome.err;
    EXPECT_NE(outcome.err.find("No space left on device"), std::string::npos) << outcome.err;
    EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
    EXPECT_FALSE(fs::exists("t.npy")) << pages;
    fs::remove("ballast");
    const Words left = files();
    if (left.empty()) {
      ++refused;
      continue;
    }
    ++interrupted;
    EXPECT_EQ(left, (Words{"t.npy.journal", "t.npy.part"})) << pages;
    EXPECT_EQ(run_albedo(table({"--resume"})).code, 0);
    EXPECT_EQ(read_text("t.npy"), whole);
    EXPECT_EQ(read_text("t.json"), sidecar);
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(interrupted, 0);
  EXPECT_GT(done, 0);
}

TEST_F(SmallDisk, ReadOnlyIsSaid) {
  ASSERT_EQ(::mount(nullptr, disk().c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr), 0);
  const Outcome outcome = run_albedo(table());
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("Read-only file system"), std::string::npos) << outcome.err;
}

TEST_F(CliTest, AVanishedPartIsSaid) {
  const Words slow{
      "table",     "ggx", "alpha_x=0.1:1:40", "alpha_y=0.3", "cos_theta=0.05:1:40", "phi=0:90:12", "-o", "t.npy",
      "--threads", "1"};
  RunningAlbedo run(slow, "said");
  while (finished(600) == 0 && !run.has_ended()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  fs::remove("t.npy.part");
  run.wait();
  EXPECT_NE(read_text("said").find("removed or replaced while it was being written"), std::string::npos);
  EXPECT_FALSE(fs::exists("t.npy"));
  Words anew = slow;
  anew.insert(anew.end(), {"--resume", "--tolerance", "1e-3"});
  EXPECT_EQ(run_albedo(anew).code, 0);  // with nothing left to continue, it begins
}

TEST_F(CliTest, AnInterruptionSaysHowToContinue) {
  const Words slow{
      "table",     "ggx", "alpha_x=0.1:1:40", "alpha_y=0.3", "cos_theta=0.05:1:40", "phi=0:90:12", "-o", "t.npy",
      "--threads", "1"};
  for (const int signal : {SIGTERM, SIGINT}) {
    RunningAlbedo run(slow, "said");
    while (finished(600) == 0 && !run.has_ended()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    run.kill(signal);
    EXPECT_EQ(read_text("said"), "albedo: interrupted; the same command with --resume continues 't.npy'\n");
    fs::remove("t.npy.part");
  }
}

}  // namespace
}  // namespace albedo::test
