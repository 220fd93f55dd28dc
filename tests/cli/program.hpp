/// @file
/// Calls the built program as a user does.
#pragma once

#include <gtest/gtest.h>

#include <sys/types.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace albedo::test {

struct Outcome {
  int code;  ///< 128 + the signal's number if it was killed
  std::string out, err;
};

/// Runs `albedo` with these arguments; standard output goes to the file `out` if one is given.
Outcome run_albedo(const std::vector<std::string>& arguments, const std::string& out = "");

/// Runs `albedo` with these arguments as several ranks; the launcher adds its own complaints to `err`.
Outcome run_ranks(int ranks, const std::vector<std::string>& arguments);

/// Whether the program was built with MPI, and a launcher found.
bool has_mpi();

/// A run of `albedo` that nobody waits for; its standard error goes to the file `err`. It is killed with its owner.
class RunningAlbedo {
 public:
  explicit RunningAlbedo(const std::vector<std::string>& arguments, const std::string& err = "/dev/null");
  /// Several ranks, and their launcher, to which the signals go.
  RunningAlbedo(int ranks, const std::vector<std::string>& arguments);
  ~RunningAlbedo() { kill(SIGKILL); }
  RunningAlbedo(const RunningAlbedo&) = delete;
  RunningAlbedo& operator=(const RunningAlbedo&) = delete;

  [[nodiscard]] bool has_ended();
  /// Waits for the end.
  void wait();
  /// Sends a signal, if the run hasn't ended, and waits for its end.
  void kill(int signal);

  /// The processes that a launcher has started.
  [[nodiscard]] std::vector<pid_t> ranks() const;

 private:
  pid_t child_;
};

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

/// How many lines a text has; the last one must be ended too.
std::size_t line_count(const std::string& text);

/// A test in an empty working directory of its own.
class CliTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// The names of what the program left in the working directory.
  [[nodiscard]] static std::vector<std::string> files();

 private:
  std::filesystem::path before_, directory_;
};

}  // namespace albedo::test
