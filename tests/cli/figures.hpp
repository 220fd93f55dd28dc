/// @file
/// What the tests of figures share.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace albedo::test::figures {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

inline std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

inline bool installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

struct Outcome {
  int exit_code;
  std::string out, err;
};

/// Runs albedo-figures as a user does, in a directory of its own.
class Figures : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::path(testing::TempDir()) / "albedo_figures_XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    directory_ = pattern;
    fs::create_directory(directory_ / "out");
  }
  void TearDown() override { fs::remove_all(directory_); }

  /// `environment` is written as in a shell: "PATH=/bin TZ=UTC".
  [[nodiscard]] Outcome run(const std::string& arguments, const std::string& environment = "") const {
    const std::string command = "cd '" + directory_.string() + "' && " + environment +
                                " '" ALBEDO_FIGURES_PROGRAM "' " + arguments + " >stdout.txt 2>stderr.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(directory_ / "stdout.txt"),
            read(directory_ / "stderr.txt")};
  }

  /// The names in a directory below the test's, in order.
  [[nodiscard]] Names names(const std::string& where = "out") const {
    Names result;
    for (const auto& entry : fs::directory_iterator(directory_ / where)) {
      result.push_back(entry.path().filename().string());
    }
    std::ranges::sort(result);
    return result;
  }

  /// Puts a shell script named gnuplot into bin/, to be found first with PATH=bin:$PATH.
  [[nodiscard]] std::string with_fake_gnuplot(const std::string& script) const {
    fs::create_directory(directory_ / "bin");
    std::ofstream(directory_ / "bin/gnuplot") << "#!/bin/sh\n" << script << '\n';
    fs::permissions(directory_ / "bin/gnuplot", fs::perms::owner_all);
    return "PATH='" + (directory_ / "bin").string() + "':$PATH";
  }

  fs::path directory_;
};

/// A figure's data: the "# key: value" lines, the column names, and the numbers by column.
struct Data {
  std::map<std::string, std::string> header;
  Names columns;
  std::map<std::string, std::vector<double>> values;

  explicit Data(const fs::path& path) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
      if (line.starts_with("# ")) {
        const std::size_t colon = line.find(": ");
        header[line.substr(2, colon - 2)] = line.substr(colon + 2);
        continue;
      }
      Names fields;
      std::istringstream stream(line);
      for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
      if (columns.empty()) {
        columns = fields;
        continue;
      }
      EXPECT_EQ(fields.size(), columns.size()) << line;
      for (std::size_t i = 0; i < std::min(fields.size(), columns.size()); ++i) {
        values[columns[i]].push_back(std::stod(fields[i]));
      }
    }
  }
};

}  // namespace albedo::test::figures
