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

/// A run of `albedo` that nobody waits for, and whose output nobody reads. It is killed with its owner.
class RunningAlbedo {
 public:
  explicit RunningAlbedo(const std::vector<std::string>& arguments);
  ~RunningAlbedo() { kill(SIGKILL); }
  RunningAlbedo(const RunningAlbedo&) = delete;
  RunningAlbedo& operator=(const RunningAlbedo&) = delete;

  [[nodiscard]] bool has_ended();
  /// Sends a signal, if the run hasn't ended, and waits for its end.
  void kill(int signal);

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
