#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "albedo/core/errors.hpp"
#include "analysis/output/atomic_file.hpp"
#include "analysis/output/csv_writer.hpp"
#include "analysis/output/exr_writer.hpp"
#include "analysis/output/table_document.hpp"

namespace albedo::analysis {
namespace {

namespace fs = std::filesystem;

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class Exception, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A test with a directory of its own.
class Output : public testing::Test {
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

using AtomicFiles = Output;
using Tables = Output;
using Names = std::vector<std::string>;

void write_file(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

mode_t permissions(const std::string& path) {
  struct stat info {};
  EXPECT_EQ(::stat(path.c_str(), &info), 0);
  return info.st_mode & 0777U;
}

TEST_F(AtomicFiles, AppearWhenTheyAreWhole) {
  AtomicFile file(path("a.txt"));
  file.stream() << "whole";
  EXPECT_FALSE(fs::exists(path("a.txt")));
  EXPECT_EQ(names().size(), 1U);
  file.finish();
  EXPECT_FALSE(fs::exists(path("a.txt")));
  file.commit();
  EXPECT_EQ(names(), Names{"a.txt"});
  EXPECT_EQ(read(path("a.txt")), "whole");
}

TEST_F(AtomicFiles, WithoutCommitLeaveEverythingAsItWas) {
  write_file(path("a.txt"), "old");
  {
    AtomicFile file(path("a.txt"));
    file.stream() << "new" << std::flush;
    AtomicFile other(path("b.txt"));
    other.stream() << "new";
    other.finish();
  }
  EXPECT_EQ(names(), Names{"a.txt"});
  EXPECT_EQ(read(path("a.txt")), "old");
}

TEST_F(AtomicFiles, TwoOfOneNameDontMix) {
  AtomicFile first(path("a.txt"));
  AtomicFile second(path("a.txt"));
  first.stream() << "first";
  second.stream() << "second";
  second.commit();
  EXPECT_EQ(read(path("a.txt")), "second");
  first.commit();
  EXPECT_EQ(read(path("a.txt")), "first");
  EXPECT_EQ(names(), Names{"a.txt"});
}

TEST_F(AtomicFiles, PermissionsFollowTheUmaskOrTheReplacedFile) {
  const mode_t before = ::umask(027);
  write_file(path("new.txt"), "x");
  ::umask(before);
  EXPECT_EQ(permissions(path("new.txt")), 0640U);
  ASSERT_EQ(::chmod(path("new.txt").c_str(), 0606), 0);
  write_file(path("new.txt"), "y");
  EXPECT_EQ(permissions(path("new.txt")), 0606U);
}

TEST_F(AtomicFiles, FollowSymbolicLinks) {
  fs::create_directory(path("data"));
  write_file(path("data/a.txt"), "old");
  fs::create_symlink("data/a.txt", path("link.txt"));
  write_file(path("link.txt"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link.txt")));
  EXPECT_EQ(read(path("data/a.txt")), "new");
  fs::create_symlink(path("link.txt"), path("data/absolute.txt"));
  write_file(path("data/absolute.txt"), "newer");
  EXPECT_EQ(read(path("data/a.txt")), "newer");
  fs::create_symlink("data/b.txt", path("dangling.txt"));
  write_file(path("dangling.txt"), "b");
  EXPECT_EQ(read(path("data/b.txt")), "b");
  EXPECT_TRUE(fs::is_symlink(path("dangling.txt")));
  fs::create_symlink("circle.txt", path("circle.txt"));
  EXPECT_THROW(write_file(path("circle.txt"), "x"), WriteError);
}

TEST_F(AtomicFiles, LongNamesAndRelativePathsWork) {
  const std::string longest(255, 'n');
  write_file(path(longest), "x");
  EXPECT_EQ(names(), Names{longest});
  const fs::path before = fs::current_path();
  fs::current_path(directory_);
  write_file("relative.txt", "x");
  fs::current_path(before);
  EXPECT_EQ(read(path("relative.txt")), "x");
  EXPECT_TRUE(contains(message_of<WriteError>([&] { AtomicFile(path(longest + "n")); }), "File name too long"));
}

TEST_F(AtomicFiles, AnyMixOfWritesArrivesInOrder) {
  std::mt19937_64 generator(1);
  std::uniform_int_distribution<std::size_t> sizes(0, 3'000'000);
  std::string expected;
  {
    AtomicFile file(path("a.bin"));
    for (int i = 0; i < 60; ++i) {
      const std::string block(i % 3 == 0 ? sizes(generator) : sizes(generator) % 100, static_cast<char>('a' + i % 26));
      if (i % 7 == 0) file.stream() << std::flush;
      if (i % 2 == 0) {
        file.stream().write(block.data(), static_cast<std::streamsize>(block.size()));
      } else {
        for (const char c : block) file.stream().put(c);
      }
      expected += block;
      ASSERT_EQ(file.stream().tellp(), std::streampos(static_cast<std::streamoff>(expected.size())));
    }
    file.stream().seekp(5);
    file.stream() << "12345";
    expected.replace(5, 5, "12345");
    file.commit();
  }
  EXPECT_TRUE(read(path("a.bin")) == expected);
}

TEST_F(AtomicFiles, BadPlacesSayWhy) {
  write_file(path("file"), "x");
  const std::vector<std::pair<std::string, std::string>> cases{
      {path("none/a.txt"), "the directory '" + path("none") + "' does not exist"},
      {directory_.string(), "Is a directory"},
      {directory_.string() + "/", "Is a directory"},
      {path("file/a.txt"), "Not a directory"},
      {"", "No such file or directory"},
      {"/proc/albedo.txt", "No such file or directory"}};
  for (const auto& [target, reason] : cases) {
    const std::string expected = cannot_write(target, reason).what();
    EXPECT_TRUE(expected.starts_with("cannot write '" + target)) << expected;
    EXPECT_EQ(message_of<WriteError>([&t = target] { AtomicFile file(t); }), expected);
    EXPECT_EQ(message_of<WriteError>([&t = target] { AtomicFile::check(t); }), expected);
  }
  EXPECT_EQ(names(), Names{"file"});
}

TEST_F(AtomicFiles, CheckLeavesNothing) {
  AtomicFile::check(path("a.txt"));
  EXPECT_EQ(names(), Names{});
  write_file(path("a.txt"), "x");
  AtomicFile::check(path("a.txt"));
  EXPECT_EQ(names(), Names{"a.txt"});
  EXPECT_EQ(read(path("a.txt")), "x");
}

TEST_F(AtomicFiles, AFullDeviceIsAnError) {
  const std::string expected = "cannot write '/dev/full': No space left on device";
  AtomicFile::check("/dev/full");
  EXPECT_EQ(message_of<WriteError>([] { write_file("/dev/full", "x"); }), expected);
  EXPECT_EQ(message_of<WriteError>([] { write_file("/dev/full", std::string(5'000'000, 'x')); }), expected);
  EXPECT_EQ(message_of<WriteError>([] {
              AtomicFile file("/dev/full");
              for (;;) file.stream() << "one line after the other\n";
            }),
            expected);
}

TEST_F(AtomicFiles, ASwallowedFailureIsStillOneAtTheCommit) {
  AtomicFile file("/dev/full");
  const std::string block(5'000'000, 'x');
  EXPECT_THROW(file.stream().write(block.data(), 5'000'000), WriteError);
  EXPECT_EQ(message_of<WriteError>([&] { file.commit(); }), "cannot write '/dev/full': No space left on device");
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

/// As on a disk that is full: no file may grow beyond 100 kB.
void limit_file_size() {
  const rlimit limit{100'000, 100'000};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
}

TEST_F(AtomicFiles, WithNoRoomLeaveNothing) {
  const auto write_much = [&] {
    limit_file_size();
    exit_with("File too large", [&] { write_file(path("a.txt"), std::string(200'000, 'x')); });
  };
  EXPECT_EXIT(write_much(), testing::ExitedWithCode(4), "");
  EXPECT_EQ(names(), Names{});
}

TEST_F(AtomicFiles, WithoutPermissionSaySo) {
  write_file(path("read_only.txt"), "x");
  ASSERT_EQ(::chmod(path("read_only.txt").c_str(), 0444), 0);
  ASSERT_EQ(::chmod(directory_.c_str(), 0555), 0);
  const auto as_nobody = [&](const std::string& name) {
    if (::geteuid() == 0 && (::setgid(65534) != 0 || ::setuid(65534) != 0)) std::_Exit(6);
    exit_with("Permission denied", [&] { write_file(path(name), "y"); });
  };
  EXPECT_EXIT(as_nobody("new.txt"), testing::ExitedWithCode(4), "");
  ASSERT_EQ(::chmod(directory_.c_str(), 0777), 0);
  EXPECT_EXIT(as_nobody("new.txt"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(as_nobody("read_only.txt"), testing::ExitedWithCode(4), "");
  EXPECT_EQ(read(path("read_only.txt")), "x");
}

TEST_F(AtomicFiles, PipesAreWrittenDirectly) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  AtomicFile::check(path("pipe"));
  std::string received;
  std::thread reader([&] { received = read(path("pipe")); });
  write_file(path("pipe"), "through the pipe");
  reader.join();
  EXPECT_EQ(received, "through the pipe");
  EXPECT_EQ(names(), Names{"pipe"});
}

TEST_F(AtomicFiles, DashIsStandardOutput) {
  testing::internal::CaptureStdout();
  std::cout << "before ";
  write_file("-", "x");
  write_file("/dev/stdout", "y");
  std::cout << " after";
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "before xy after");
}

TEST(Numbers, SeventeenDigitsReadBack) {
  std::mt19937_64 generator(2);
  for (int i = 0; i < 100'000; ++i) {
    const auto value = std::bit_cast<double>(generator());
    if (!std::isfinite(value)) continue;
    std::string text;
    append_number(text, value);
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), value) << text;
    std::ostringstream expected;
    expected << std::setprecision(17) << value;
    EXPECT_EQ(text, expected.str());
  }
}

/// A table with its entries: rank axes of 2, 3, 4, ... numbers.
struct Sample {
  explicit Sample(std::size_t rank, bool with_errors = false) {
    std::mt19937_64 generator(rank);
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto random = [&] { return uniform(generator); };
    const Names axis_names{"alpha", "theta", "phi", "ior"};
    for (std::size_t i = 0; i < rank; ++i) {
      Axis& axis = table.axes.emplace_back();
      axis.name = axis_names[i];
      axis.unit = i == 0 ? "" : "deg";
      axis.values.resize(i + 2);
      std::ranges::generate(axis.values, random);
    }
    table.name = "sample";
    table.provenance = {{"version", "1.2.3"}, {"command", "albedo table ggx"}, {"tolerance", 1e-8}};
    values.resize(table.size());
    errors.resize(table.size());
    std::ranges::generate(values, random);
    std::ranges::generate(errors, random);
    table.values = values.data();
    if (with_errors) table.errors = errors.data();
  }

  std::vector<double> values;
  std::vector<double> errors;
  TableDocument table;
};

TEST_F(Tables, CsvHasALineForEveryEntry) {
  Sample sample(3, true);
  sample.values[5] = infinity;
  write_table(sample.table, path("t.csv"));
  const std::vector<std::string> lines = lines_of(read(path("t.csv")));
  ASSERT_EQ(lines.size(), 6 + sample.values.size());
  EXPECT_EQ(lines[0], "# version: 1.2.3");
  EXPECT_EQ(lines[1], "# command: albedo table ggx");
  EXPECT_EQ(lines[2], "# tolerance: 1e-08");
  EXPECT_EQ(lines[3], "# unit of theta: deg");
  EXPECT_EQ(lines[5], "alpha,theta,phi,albedo,error");
  const auto& axes = sample.table.axes;
  for (std::size_t i = 0; i < sample.values.size(); ++i) {
    std::vector<double> fields;
    std::istringstream line(lines[6 + i]);
    for (std::string field; std::getline(line, field, ',');) fields.push_back(std::strtod(field.c_str(), nullptr));
    const std::vector<double> expected{axes[0].values[i / 12], axes[1].values[i / 4 % 3], axes[2].values[i % 4],
                                       sample.values[i], sample.errors[i]};
    EXPECT_EQ(fields, expected);
  }
  EXPECT_TRUE(contains(lines[6 + 5], ",inf,"));
}

TEST_F(Tables, CsvQuotesWhatNeedsIt) {
  EXPECT_EQ(csv_field("gold"), "gold");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("6\" pipe"), "\"6\"\" pipe\"");
  EXPECT_EQ(csv_field("a\nb"), "\"a\nb\"");
  EXPECT_EQ(csv_field("#a"), "\"#a\"");
  Sample sample(1);
  sample.table.axes[0] = {.name = "material, or not", .labels = {"gold", "blue, metallic"}};
  sample.table.provenance = {{"command", "two\nlines"}, {"model", {{"name", "ward"}}}};
  write_table(sample.table, path("t.csv"));
  const std::vector<std::string> lines = lines_of(read(path("t.csv")));
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0], R"(# command: "two\nlines")");
  EXPECT_EQ(lines[1], R"(# model: {"name":"ward"})");
  EXPECT_EQ(lines[2], "\"material, or not\",albedo");
  EXPECT_TRUE(lines[4].starts_with("\"blue, metallic\",0."));
}

TEST_F(Tables, DashIsCsvOnStandardOutput) {
  const Sample sample(2);
  check_table_path("-", sample.table.axes);
  testing::internal::CaptureStdout();
  write_table(sample.table, "-");
  const std::string shown = testing::internal::GetCapturedStdout();
  write_table(sample.table, path("t.csv"));
  EXPECT_EQ(shown, read(path("t.csv")));
}

TEST_F(Tables, JsonReadsBack) {
  for (std::size_t rank = 0; rank <= 4; ++rank) {
    Sample sample(rank, rank % 2 == 1);
    write_table(sample.table, path("t.json"));
    const auto json = nlohmann::json::parse(read(path("t.json")));
    EXPECT_EQ(json.size(), rank % 2 == 1 ? 5U : 4U);
    EXPECT_EQ(json["provenance"], nlohmann::json(sample.table.provenance));
    EXPECT_EQ(json["albedo"].flatten().size(), sample.values.size());
    for (const bool is_error : {false, true}) {
      if (is_error && sample.table.errors == nullptr) continue;
      for (std::size_t i = 0; i < sample.values.size(); ++i) {
        nlohmann::json entry = json[is_error ? "error" : "albedo"];
        std::size_t block = sample.values.size();
        for (const Axis& axis : sample.table.axes) {
          ASSERT_EQ(entry.size(), axis.size());
          entry = nlohmann::json(entry[i % block / (block / axis.size())]);
          block /= axis.size();
        }
        EXPECT_EQ(entry.get<double>(), is_error ? sample.errors[i] : sample.values[i]);
      }
    }
    for (std::size_t i = 0; i < rank; ++i) {
      EXPECT_EQ(json["shape"][i], sample.table.axes[i].size());
      EXPECT_EQ(json["axes"][i]["name"], sample.table.axes[i].name);
      EXPECT_EQ(json["axes"][i]["unit"], sample.table.axes[i].unit);
      EXPECT_EQ(json["axes"][i]["values"].get<std::vector<double>>(), sample.table.axes[i].values);
    }
  }
}

TEST_F(Tables, JsonHasNoInfinityAndAnyText) {
  Sample sample(1, true);
  sample.values[0] = infinity;
  sample.errors[0] = std::numeric_limits<double>::quiet_NaN();
  sample.table.axes[0] = {.name = "material", .labels = {"6\"\n\xff", "b"}};
  sample.table.provenance["command"] = "albedo \xff \"quoted\"";
  write_table(sample.table, path("t.json"));
  const auto json = nlohmann::json::parse(read(path("t.json")));
  EXPECT_TRUE(json["albedo"][0].is_null());
  EXPECT_TRUE(json["error"][0].is_null());
  EXPECT_EQ(json["axes"][0]["labels"][0], "6\"\n\uFFFD");
  EXPECT_FALSE(json["axes"][0].contains("values"));
  EXPECT_EQ(json["provenance"]["command"], "albedo \uFFFD \"quoted\"");
}

TEST_F(Tables, NpyIsAnArrayWithItsSidecar) {
  const Names shapes{"()", "(2,)", "(2, 3)", "(2, 3, 4)", "(2, 3, 4, 5)"};
  for (std::size_t rank = 0; rank <= 4; ++rank) {
    Sample sample(rank);
    sample.values[0] = infinity;
    write_table(sample.table, path("t.NPY"));
    const std::string file = read(path("t.NPY"));
    ASSERT_EQ(file.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
    const std::size_t length = static_cast<unsigned char>(file[8]) + 256U * static_cast<unsigned char>(file[9]);
    EXPECT_EQ((10 + length) % 64, 0U);
    const std::string header = file.substr(10, length);
    const std::string dictionary = "{'descr': '<f8', 'fortran_order': False, 'shape': " + shapes[rank] + ", }";
    EXPECT_EQ(header, dictionary + std::string(length - dictionary.size() - 1, ' ') + "\n");
    ASSERT_EQ(file.size(), 10 + length + 8 * sample.values.size());
    std::vector<double> values(sample.values.size());
    std::memcpy(values.data(), file.data() + 10 + length, 8 * values.size());
    EXPECT_EQ(values, sample.values);

    const auto sidecar = nlohmann::json::parse(read(path("t.json")));
    EXPECT_EQ(sidecar["provenance"], nlohmann::json(sample.table.provenance));
    EXPECT_EQ(sidecar["shape"].size(), rank);
    EXPECT_EQ(sidecar["axes"].size(), rank);
    EXPECT_FALSE(sidecar.contains("albedo"));
  }
  EXPECT_EQ(names(), (Names{"t.NPY", "t.json"}));
}

TEST_F(Tables, NpyWithNoRoomLeavesNeitherFile) {
  Sample sample(1);
  sample.table.axes[0].labels.assign(20'000, "x");
  sample.values.assign(20'000, 0.5);
  sample.table.values = sample.values.data();
  const auto write = [&] {
    limit_file_size();
    exit_with("File too large", [&] { write_table(sample.table, path("t.npy")); });
  };
  EXPECT_EXIT(write(), testing::ExitedWithCode(4), "");
  EXPECT_EQ(names(), Names{});
}

/// The pixels of one channel, row by row.
std::vector<float> pixels(const std::string& path, const std::string& channel) {
  Imf::InputFile image(path.c_str());
  const auto window = image.header().dataWindow();
  EXPECT_NE(image.header().channels().findChannel(channel), nullptr) << channel;
  const auto width = static_cast<std::size_t>(window.max.x) + 1;
  std::vector<float> result(width * (static_cast<std::size_t>(window.max.y) + 1));
  Imf::FrameBuffer frame;
  frame.insert(channel,
               Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(result.data()), sizeof(float), sizeof(float) * width));
  image.setFrameBuffer(frame);
  image.readPixels(window.min.y, window.max.y);
  return result;
}

/// The table's entries from `first` on, `step` apart, as floats.
std::vector<float> entries(const Sample& sample, std::size_t first, std::size_t step, std::size_t count) {
  std::vector<float> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(static_cast<float>(sample.values[first + i * step]));
  return result;
}

TEST_F(Tables, ExrIsOneChannelForOneOrTwoAxes) {
  Sample row(1);
  row.values[0] = infinity;
  write_table(row.table, path("row.exr"));
  EXPECT_EQ(pixels(path("row.exr"), "Y"), entries(row, 0, 1, 2));
  const Sample image(2);
  write_table(image.table, path("image.exr"));
  EXPECT_EQ(pixels(path("image.exr"), "Y"), entries(image, 0, 1, 6));
  const Imf::InputFile file(path("image.exr").c_str());
  EXPECT_EQ(file.header().dataWindow().max.x, 2);
  EXPECT_EQ(file.header().dataWindow().max.y, 1);
  const auto description = nlohmann::json::parse(file.header().typedAttribute<Imf::StringAttribute>("albedo").value());
  EXPECT_EQ(description["provenance"], nlohmann::json(image.table.provenance));
  EXPECT_EQ(description["axes"][1]["name"], "theta");
}

TEST_F(Tables, ExrHasColoursForRgb) {
  Sample last(3);
  last.table.axes = {{.name = "alpha", .values = {1, 2}},
                     {.name = "theta", .values = {1, 2, 3, 4}},
                     {.name = "channel", .labels = {"R", "G", "B"}}};
  write_table(last.table, path("last.exr"));
  EXPECT_EQ(pixels(path("last.exr"), "G"), entries(last, 1, 3, 8));
  EXPECT_EQ(pixels(path("last.exr"), "B"), entries(last, 2, 3, 8));
  Sample first(3);
  first.table.axes = {{.name = "channel", .labels = {"B", "G", "R"}},
                      {.name = "alpha", .values = {1, 2}},
                      {.name = "theta", .values = {1, 2, 3, 4}}};
  write_table(first.table, path("first.exr"));
  EXPECT_EQ(pixels(path("first.exr"), "B"), entries(first, 0, 1, 8));
  EXPECT_EQ(pixels(path("first.exr"), "R"), entries(first, 16, 1, 8));
}

TEST_F(Tables, ExrHasLayersForThreeAxes) {
  Sample sample(3);
  sample.table.axes[0].values = {0.1, 1e-4};
  write_table(sample.table, path("t.exr"));
  EXPECT_EQ(pixels(path("t.exr"), "alpha=0.1.Y"), entries(sample, 0, 1, 12));
  EXPECT_EQ(pixels(path("t.exr"), "alpha=1e-04.Y"), entries(sample, 12, 1, 12));
  sample.table.axes[0] = {.name = "material", .labels = {"gold", "gold-paint"}};
  write_table(sample.table, path("t.exr"));
  EXPECT_EQ(pixels(path("t.exr"), "material=gold-paint.Y"), entries(sample, 12, 1, 12));
}

TEST_F(Tables, ExrRefusesWhatItCannotHold) {
  const auto refused = [](const std::vector<Axis>& axes) {
    return message_of<ParameterError>([&] { check_exr_axes(axes); });
  };
  const Axis axis{.name = "alpha", .values = {1, 2}};
  EXPECT_EQ(refused({axis, axis, axis, axis}), "output: .exr holds 1 to 3 axes, not 4; .npy holds any number");
  EXPECT_TRUE(contains(refused({}), "1 to 3 axes, not 0"));
  EXPECT_TRUE(contains(refused({axis, Axis{.name = "theta"}}), "not 0 along 'theta'"));
  EXPECT_TRUE(
      contains(refused({Axis{.name = "material", .labels = {"a", "a"}}, axis, axis}), "two channels 'material=a.Y'"));
  EXPECT_TRUE(
      contains(refused({Axis{.name = "material", .labels = {std::string(250, 'a')}}, axis, axis}), "255 bytes"));
  EXPECT_THROW(check_table_path(path("t.exr"), {axis, axis, axis, axis}), ParameterError);
  EXPECT_THROW(write_table(Sample(4).table, path("t.exr")), ParameterError);
  EXPECT_EQ(names(), Names{});
}

TEST_F(Tables, ExrTurnsNoNumberIntoInfinity) {
  Sample sample(2);
  sample.values[4] = 1e39;
  const std::string message = message_of<WriteError>([&] { write_table(sample.table, path("t.exr")); });
  EXPECT_TRUE(message.starts_with("cannot write '" + path("t.exr") + "': the entry 9.9999999999999994e+38 at alpha="))
      << message;
  EXPECT_EQ(names(), Names{});
}

TEST_F(Tables, ExrWithNoRoomLeavesNothing) {
  Sample sample(1);
  sample.table.axes = {{.name = "y", .labels = Names(300, "y")}, {.name = "x", .labels = Names(300, "x")}};
  std::mt19937_64 generator(7);
  sample.values.resize(90'000);
  std::ranges::generate(sample.values, [&] { return static_cast<double>(generator()); });
  sample.table.values = sample.values.data();
  const auto write = [&] {
    limit_file_size();
    exit_with("File too large", [&] { write_table(sample.table, path("t.exr")); });
  };
  EXPECT_EXIT(write(), testing::ExitedWithCode(4), "");
  EXPECT_EQ(names(), Names{});
}

TEST_F(Tables, HppIsTheTableAsConstants) {
  Sample sample(2);
  sample.table.name = "ggx albedo";
  sample.table.axes[0] = {.name = "material", .labels = {"6\" \\ \n", "b"}};
  sample.values = {0.1, infinity, 1, 12345678901234568.0, 1e300, 5e-324};
  sample.table.values = sample.values.data();
  sample.table.axes[1].values = {0, 0.5, 90};
  sample.table.provenance["note"] = "no continuation \\";
  write_table(sample.table, path("t.hpp"));
  EXPECT_EQ(read(path("t.hpp")), R"(#pragma once

// version: 1.2.3
// command: albedo table ggx
// tolerance: 1e-08
// note: "no continuation \\"

#include <array>
#include <cstddef>
#include <limits>

/// The number of entries along each axis.
inline constexpr std::array<std::size_t, 2> ggx_albedo_shape{{
    2, 3,
}};

/// Axis 'material'
inline constexpr std::array<const char*, 2> ggx_albedo_axis_material{{
    "6\" \\ \012", "b",
}};

/// Axis 'theta', unit: deg
inline constexpr std::array<double, 3> ggx_albedo_axis_theta{{
    0.0, 0.5, 90.0,
}};

/// Directional albedo in C order: the last axis runs fastest.
inline constexpr std::array<double, 6> ggx_albedo_values{{
    0.10000000000000001, std::numeric_limits<double>::infinity(), 1.0, 12345678901234568.0,
    1.0000000000000001e+300, 4.9406564584124654e-324,
}};
)");
}

TEST_F(Tables, TheEndingIsTheFormatInAnyCase) {
  const Sample sample(2);
  for (const char* const name : {"a.CSV", "a.Json", "a.b.npy", "a.EXR", "a.hPP"}) {
    check_table_path(path(name), sample.table.axes);
    EXPECT_FALSE(fs::exists(path(name)));
    write_table(sample.table, path(name));
    EXPECT_TRUE(fs::exists(path(name)));
  }
  EXPECT_EQ(names(), (Names{"a.CSV", "a.EXR", "a.Json", "a.b.json", "a.b.npy", "a.hPP"}));
}

TEST_F(Tables, AnUnknownEndingIsRefused) {
  const Sample sample(2);
  for (const bool early : {true, false}) {
    const auto message = [&](const std::string& name) {
      return message_of<ParameterError>(
          [&] { early ? check_table_path(name, sample.table.axes) : write_table(sample.table, name); });
    };
    EXPECT_EQ(message("x.foo"),
              "output: 'x.foo' has the unknown ending '.foo'; valid are .csv, .json, .npy, .exr, .hpp");
    EXPECT_EQ(message("x"), "output: 'x' has no ending; valid are .csv, .json, .npy, .exr, .hpp");
    for (const char* const name : {"", ".csv", "x.", "x.csv/", "csv", "x.csv.gz", "/dev/full", "."}) {
      EXPECT_TRUE(message(name).starts_with("output: '" + std::string(name) + "' has ")) << name;
    }
  }
}

TEST_F(Tables, ABadPlaceIsRefusedEarly) {
  const Sample sample(2);
  fs::create_directory(path("d.csv"));
  fs::create_directory(path("e.json"));
  for (const char* const name : {"d.csv", "none/x.csv", "none/x.npy", "none/x.exr", "e.npy"}) {
    EXPECT_THROW(check_table_path(path(name), sample.table.axes), WriteError) << name;
    EXPECT_THROW(write_table(sample.table, path(name)), WriteError) << name;
  }
  EXPECT_EQ(names(), (Names{"d.csv", "e.json"}));
}

TEST_F(Tables, AFullDeviceIsAnErrorInEveryFormat) {
  const Sample sample(2);
  for (const char* const name : {"t.csv", "t.json", "t.npy", "t.exr", "t.hpp"}) {
    fs::create_symlink("/dev/full", path(name));
    EXPECT_EQ(message_of<WriteError>([&] { write_table(sample.table, path(name)); }).substr(0, 13), "cannot write ")
        << name;
    fs::remove(path(name));
    EXPECT_EQ(names(), Names{}) << name;
  }
}

TEST_F(Tables, AnEntryThatIsNoNumberIsRefusedByItsPlace) {
  Sample sample(2);
  sample.table.axes[0].values = {0.5, 1};
  sample.table.axes[1].values = {0, 30, 60};
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), -infinity}) {
    sample.values[4] = bad;
    const std::string message = message_of<WriteError>([&] { write_table(sample.table, path("t.csv")); });
    EXPECT_TRUE(contains(message, "the entry at alpha=1, theta=30 is ")) << message;
  }
  EXPECT_EQ(names(), Names{});
}

}  // namespace
}  // namespace albedo::analysis
