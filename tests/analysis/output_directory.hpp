#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "albedo/core/errors.hpp"
#include "analysis/helpers.hpp"

namespace albedo::analysis {

namespace fs = std::filesystem;

inline std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A test with a directory of its own.
class OutputDirectory : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::path(testing::TempDir()) / "albedo_output_XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    directory_ = pattern;
  }
  void TearDown() override { fs::remove_all(directory_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (directory_ / name).string(); }

  /// The names in the directory, in order.
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : fs::directory_iterator(directory_)) result.push_back(entry.path().filename().string());
    std::ranges::sort(result);
    return result;
  }

  fs::path directory_;
};

/// As on a disk that is full: no file may grow beyond 100 kB.
inline void limit_file_size() {
  const rlimit limit{100'000, 100'000};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
}

/// Runs the action in a process of its own and ends it with 0, or with 4 for a WriteError that tells the reason.
template <class Action>
[[noreturn]] void exit_with(const std::string& reason, Action action) {
  try {
    action();
  } catch (const WriteError& error) {
    std::_Exit(contains(error.what(), reason) ? 4 : 5);
  }
  std::_Exit(0);
}

}  // namespace albedo::analysis
