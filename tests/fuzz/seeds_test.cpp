#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "fuzz/fuzz.hpp"

/// The fuzz targets without libFuzzer: every seed, and every input that once was a finding.
namespace albedo::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path root = ALBEDO_FUZZ_DIR;

std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Runs the target; a copy of the size it says shows reads beyond the end to the sanitizers.
void expect_no_finding(Target target, const std::string& text) {
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  EXPECT_NO_THROW(target(bytes.data(), bytes.size()));
}

class FuzzTarget : public testing::TestWithParam<std::string> {};

TEST_P(FuzzTarget, AnswersSeedsAndRegressions) {
  const Target target = targets().at(GetParam());
  const std::vector<fs::path> seeds = files_of(root / "seeds" / GetParam());
  EXPECT_GE(seeds.size(), 2U) << "a target without seeds";
  for (const std::string folder : {"seeds", "regressions"}) {
    for (const fs::path& file : files_of(root / folder / GetParam())) {
      SCOPED_TRACE(file.string());
      expect_no_finding(target, read(file));
    }
  }
}

/// What a fuzzer tries first, of every seed: cut off, with a byte changed, with a piece twice.
TEST_P(FuzzTarget, AnswersSimpleMutationsOfSeeds) {
  const Target target = targets().at(GetParam());
  expect_no_finding(target, "");
  for (const fs::path& file : files_of(root / "seeds" / GetParam())) {
    SCOPED_TRACE(file.string());
    const std::string seed = read(file);
    for (std::size_t i = 1; i <= 8; ++i) {
      const std::size_t place = seed.size() * i / 9;
      expect_no_finding(target, seed.substr(0, place));
      std::string changed = seed;
      if (place < changed.size()) changed[place] = static_cast<char>(changed[place] ^ (1 << (i - 1)));
      expect_no_finding(target, changed);
      expect_no_finding(target, seed.substr(0, place) + seed.substr(seed.size() / 3));
    }
  }
}

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (const auto& [name, target] : targets()) result.push_back(name);
  return result;
}

INSTANTIATE_TEST_SUITE_P(All, FuzzTarget, testing::ValuesIn(names()), [](const auto& tested) { return tested.param; });

TEST(FuzzSeeds, EveryFolderIsOfATarget) {
  for (const char* folder : {"seeds", "regressions"}) {
    for (const fs::path& path : files_of(root / folder)) {
      EXPECT_TRUE(targets().contains(path.filename().string())) << path;
    }
  }
}

TEST(FuzzSeeds, AreSmall) {
  std::uintmax_t size = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root / "seeds")) {
    if (entry.is_regular_file()) size += entry.file_size();
  }
  EXPECT_LT(size, 200'000U);
}

}  // namespace
}  // namespace albedo::fuzz
