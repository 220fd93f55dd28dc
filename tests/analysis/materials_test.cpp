#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "albedo/core/errors.hpp"
#include "analysis/helpers.hpp"
#include "analysis/subjects/materials.hpp"

namespace albedo::analysis {
namespace {

std::string material(const std::string& parameters) {
  return R"({"name": "gold", "model": "ward", "parameters": )" + parameters + "}";
}

TEST(Materials, ArrayAndLinesGiveTheSame) {
  const std::string first =
      R"({"name":"a]\"[,","model":"ward","parameters":{"alpha":0.1,"rho_s":[0.1,0.2,3],"masking":"none"},"source":["x",{"y":1}]})";
  const std::string second = R"({"parameters": {}, "model": "lambert", "name": "b"})";
  const std::string mark = "\xEF\xBB\xBF";
  const std::vector<Names> files{{first, "\n", second},
                                 {mark, first, "\r\n\r\n \t\n", second, "\r\n\r\n"},
                                 {"[", first, ",", second, "]"},
                                 {mark, " \n[\n", first, "\n , ", second, " ]\n\n"}};
  for (const Names& parts : files) {
    const std::string text = std::accumulate(parts.begin(), parts.end(), std::string());
    const auto materials = parse_materials(text, "m.json");
    ASSERT_EQ(materials.size(), 2U);
    EXPECT_EQ(materials[0].name, "a]\"[,");
    EXPECT_EQ(materials[0].model, "ward");
    ASSERT_EQ(materials[0].parameters.size(), 3U);
    EXPECT_EQ(materials[0].parameters[0], (std::pair<std::string, ParameterValue>("alpha", 0.1)));
    EXPECT_EQ(materials[0].parameters[1].second, (ParameterValue(std::array{0.1, 0.2, 3.0})));
    EXPECT_EQ(materials[0].parameters[2], (std::pair<std::string, ParameterValue>("masking", "none")));
    EXPECT_EQ(materials[1].name, "b");
    EXPECT_TRUE(materials[1].parameters.empty());
  }
}

TEST(Materials, KnowTheirLines) {
  const std::string pretty = "{\n  \"name\": \"a\",\n  \"model\": \"ward\",\n  \"parameters\": {}\n}";
  const auto array = parse_materials("\n[\n" + pretty + ",\n\n" + pretty + ", " + pretty + "]", "m.json");
  ASSERT_EQ(array.size(), 3U);
  EXPECT_EQ(array[0].line, 3U);
  EXPECT_EQ(array[1].line, 9U);
  EXPECT_EQ(array[2].line, 13U);
  const auto lines = parse_materials("\n" + material("{}") + "\n\n\n" + material("{}"), "m.jsonl");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].line, 2U);
  EXPECT_EQ(lines[1].line, 5U);
}

TEST(Materials, NumbersAndOrderAreKept) {
  std::mt19937_64 generator(5);
  std::string text;
  std::vector<double> expected;
  for (int i = 0; i < 1000; ++i) {
    expected.push_back(random_double(generator));
    text += material("{\"z\": " + shortest(expected.back()) + ", \"a\": 1}") + "\n";
  }
  const auto materials = parse_materials(text, "m.jsonl");
  ASSERT_EQ(materials.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(std::get<double>(materials[i].parameters[0].second), expected[i]);
    EXPECT_EQ(materials[i].parameters[1].first, "a");
  }
}

TEST(Materials, AFileWithoutAnyIsRefused) {
  for (const std::string text : {"", " \n\t\n", "\xEF\xBB\xBF", "\xEF\xBB\xBF \n"}) {
    EXPECT_EQ(message_of<FormatError>([&] { parse_materials(text, "m.json"); }),
              "'m.json' is empty; it should hold materials");
  }
  EXPECT_EQ(message_of<FormatError>([&] { parse_materials("[ ]", "m.json"); }), "'m.json' holds no materials");
}

/// Bad entries, and what the message says of each.
const std::vector<std::pair<std::string, std::string>> bad_entries{
    {"{", "ends too early"},
    {R"({"name": "gold", "model": "wa)", "ends too early"},
    {material("{}").substr(0, 40), "ends too early"},
    {"gold ward 0.1", "is not JSON"},
    {"{'name': 1}", "is not JSON"},
    {material(R"({"alpha": NaN})"), "is not JSON"},
    {material(R"({"alpha": Infinity})"), "is not JSON"},
    {material(R"({"alpha": 0x1})"), "is not JSON"},
    {material(R"({"alpha": 01})"), "is not JSON"},
    {material(R"({"alpha": 1,})"), "is not JSON"},
    {material("{\"alpha\": \"\xff\"}"), "is not JSON"},
    {material("{}") + " // gold", "is not JSON"},
    {material(R"({"alpha": 1e400})"), "beyond the range of a double"},
    {"42", "must be an object"},
    {"null", "must be an object"},
    {"\"gold\"", "must be an object"},
    {"{}", R"(has no "name")"},
    {R"({"name": "gold", "parameters": {}})", "has no \"model\""},
    {R"({"name": "gold", "model": "ward", "paramters": {}})", "has no \"parameters\""},
    {R"({"name": 1, "model": "ward", "parameters": {}})", "\"name\" must be a text"},
    {R"({"name": "", "model": "ward", "parameters": {}})", "\"name\" must be a text"},
    {R"({"name": "gold", "model": null, "parameters": {}})", "\"model\" must be a text"},
    {material("[]"), "\"parameters\" must be an object"},
    {material("null"), "\"parameters\" must be an object"},
    {material(R"({"alpha": null})"), "the parameter \"alpha\" must be"},
    {material(R"({"alpha": true})"), "the parameter \"alpha\" must be"},
    {material(R"({"alpha": {}})"), "the parameter \"alpha\" must be"},
    {material(R"({"alpha": [1, 2]})"), "the parameter \"alpha\" must be"},
    {material(R"({"alpha": [1, 2, 3, 4]})"), "the parameter \"alpha\" must be"},
    {material(R"({"alpha": [1, 2, "3"]})"), "the parameter \"alpha\" must be"},
    {material(R"({"a)" + std::string(1000, 'b') + R"(": null})"), "the parameter \"abbb"},
    {material(R"({"alpha": 1, "alpha": 2})"), "\"alpha\" is given twice"},
    {R"({"name": "gold", "name": "gold", "model": "ward", "parameters": {}})", "\"name\" is given twice"},
    {material(R"({"alpha": )" + std::string(1000, '[')), "nested too deeply"},
    {material(R"({"alpha": ")" + std::string(1U << 20U, 'x') + R"("})"), "longer than 1 MiB"}};

TEST(Materials, ABadEntryIsNamedByItsLine) {
  std::string lines;
  std::string array = "[" + material("{}");
  for (int i = 1; i < 40; ++i) lines += material("{}") + "\n";
  for (int i = 2; i < 40; ++i) array += ",\n" + material("{}");
  for (const auto& [entry, expected] : bad_entries) {
    const std::string prefix = "'m.json', line 40: ";
    std::string text = lines;
    text.append(entry).append("\n").append(material("{}"));
    const std::string of_lines = message_of<FormatError>([&] { parse_materials(text, "m.json"); });
    EXPECT_TRUE(of_lines.starts_with(prefix)) << entry.substr(0, 100) << " -> " << of_lines;
    EXPECT_TRUE(contains(of_lines, expected)) << entry.substr(0, 100) << " -> " << of_lines;
    text = array;
    text.append(",\n").append(entry).append("]");
    // Here text without an end swallows the bracket, and the message may be another one.
    const std::string of_array = message_of<FormatError>([&] { parse_materials(text, "m.json"); });
    EXPECT_TRUE(of_array.starts_with(prefix)) << entry.substr(0, 100) << " -> " << of_array;
    EXPECT_FALSE(contains(of_array, "\n"));
    EXPECT_LT(of_array.size(), 200U);
  }
}

TEST(Materials, ABrokenArrayIsNamedByItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"[", "line 1: the array has no end"},
      {"[\n" + material("{}"), "line 2: the array has no end"},
      {"[\n" + material("{}") + ",\n", "line 3: the array has no end"},
      {"[\n" + material("{}") + ",\n]", "line 3: an entry is missing"},
      {"[\n,\n" + material("{}") + "]", "line 2: an entry is missing"},
      {"[\n" + material("{}") + ",\n,\n" + material("{}") + "]", "line 3: an entry is missing"},
      {"[\n" + material("{}") + "\n" + material("{}") + "]", "line 2: the entry is not JSON (at line 3, byte 1)"},
      {"[" + material("{}") + "]\n\n]", "line 3: there is more text"},
      {"[" + material("{}") + "]\n[" + material("{}") + "]", "line 2: there is more text"},
      {"[}", "line 1: the entry is not JSON"},
      {"[\"\\", "line 1: the entry ends too early"}};
  for (const auto& [text, expected] : cases) {
    const std::string message = message_of<FormatError>([&t = text] { parse_materials(t, "m.json"); });
    EXPECT_TRUE(contains(message, expected)) << text << " -> " << message;
  }
}

TEST(Materials, AnyTruncationIsRefused) {
  const std::string array =
      "[" + material(R"({"alpha": 0.1, "rho": [1, 2, 3]})") + ",\n" + material(R"({"m": "none"})") + "]";
  for (std::size_t size = 0; size < array.size(); ++size) {
    EXPECT_THROW(parse_materials(array.substr(0, size), "m.json"), FormatError) << array.substr(0, size);
  }
  const std::string line = material(R"({"alpha": 0.1, "masking": "none"})");
  for (std::size_t size = 0; size < line.size(); ++size) {
    EXPECT_THROW(parse_materials(line.substr(0, size), "m.jsonl"), FormatError) << line.substr(0, size);
  }
}

TEST(Materials, RandomBytesAreRefusedCleanly) {
  std::mt19937_64 generator(6);
  const std::string valid = "[" + material(R"({"alpha": 0.1, "rho": [1, 2, 3]})") + ",\n" + material("{}") + "]";
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<std::size_t> place(0, valid.size() - 1);
  for (int i = 0; i < 20'000; ++i) {
    std::string text = valid;
    text[place(generator)] = static_cast<char>(byte(generator));
    if (i % 2 == 0) std::ranges::generate(text, [&] { return static_cast<char>(byte(generator)); });
    try {
      static_cast<void>(parse_materials(text, "m.json"));
    } catch (const FormatError& error) {
      EXPECT_FALSE(contains(error.what(), "json.exception"));
    }
  }
}

TEST(Materials, UnreadableFilesSayWhy) {
  const auto reason = [](const std::string& path) { return message_of<FormatError>([&] { read_materials(path); }); };
  EXPECT_EQ(reason("/no/such/file.json"), "cannot read '/no/such/file.json': No such file or directory");
  EXPECT_EQ(reason("/"), "cannot read '/': Is a directory");
  EXPECT_EQ(reason("/dev/null"), "'/dev/null' is empty; it should hold materials");
  EXPECT_EQ(reason("/dev/zero"), "cannot read '/dev/zero': it is larger than 64 MiB");
}

TEST(Materials, AreReadFromAFile) {
  const std::string path = (std::filesystem::path(testing::TempDir()) / "albedo_input_test.jsonl").string();
  std::ofstream(path) << material(R"({"alpha": 0.1})") << '\n';
  const auto materials = read_materials(path);
  std::filesystem::remove(path);
  ASSERT_EQ(materials.size(), 1U);
  EXPECT_EQ(materials.front().name, "gold");
}

}  // namespace
}  // namespace albedo::analysis
