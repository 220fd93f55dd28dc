#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "albedo/core/errors.hpp"
#include "analysis/files/atomic_file.hpp"
#include "analysis/files/csv_writer.hpp"
#include "analysis/files/exr_writer.hpp"
#include "analysis/files/table_document.hpp"
#include "analysis/output_directory.hpp"

namespace albedo::analysis {
namespace {

using Tables = OutputDirectory;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
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
      TableAxis& axis = table.axes.emplace_back();
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
        for (const TableAxis& axis : sample.table.axes) {
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
  const auto refused = [](const std::vector<TableAxis>& axes) {
    return message_of<ParameterError>([&] { check_exr_axes(axes); });
  };
  const TableAxis axis{.name = "alpha", .values = {1, 2}};
  EXPECT_EQ(refused({axis, axis, axis, axis}), "output: .exr holds 1 to 3 axes, not 4; .npy holds any number");
  EXPECT_TRUE(contains(refused({}), "1 to 3 axes, not 0"));
  EXPECT_TRUE(contains(refused({axis, TableAxis{.name = "theta"}}), "not 0 along 'theta'"));
  EXPECT_TRUE(contains(refused({TableAxis{.name = "material", .labels = {"a", "a"}}, axis, axis}),
                       "two channels 'material=a.Y'"));
  EXPECT_TRUE(
      contains(refused({TableAxis{.name = "material", .labels = {std::string(250, 'a')}}, axis, axis}), "255 bytes"));
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

/// Entries in C order: the last axis runs fastest.
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
