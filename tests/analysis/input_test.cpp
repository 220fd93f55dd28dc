#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "albedo/core/errors.hpp"
#include "analysis/input/assertion.hpp"
#include "analysis/input/materials.hpp"
#include "analysis/input/value.hpp"

namespace albedo::analysis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The message of the Exception that `action` throws; a test failure if it throws none.
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

using Names = std::vector<std::string>;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A random finite double of any sign and exponent.
double random_double(std::mt19937_64& generator) {
  for (;;) {
    const auto value = std::bit_cast<double>(generator());
    if (std::isfinite(value)) return value;
  }
}

std::string shortest(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

TEST(Number, EveryFiniteDoubleReadsBack) {
  std::mt19937_64 generator(1);
  for (int i = 0; i < 100'000; ++i) {
    const double value = random_double(generator);
    EXPECT_EQ(parse_number("x", shortest(value)), value);
  }
  EXPECT_EQ(parse_number("x", "5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(parse_number("x", "-.5"), -0.5);
  EXPECT_EQ(parse_number("x", "1E3"), 1000);
}

TEST(Number, AnythingElseIsRefusedByName) {
  for (const std::string text :
       {"",      " ",      "x",      "nan",   "-nan",  "inf",  "-inf", "infinity", "0x10", "0x1p3",
        "1e400", "-1e400", "1e-400", "1.2.3", "1,2",   "0.1 ", " 0.1", "+1",       "1e",   "e5",
        "--1",   "1f",     "0.1\n",  "½",     "1_000", "-",    ".",    "1e+",      "١"}) {
    const std::string message = message_of<ParameterError>([&] { parse_number("alpha", text); });
    EXPECT_TRUE(message.starts_with("alpha: '" + text + "' is not a finite number")) << message;
  }
  EXPECT_THROW(parse_number("alpha", std::string_view("1\0", 2)), ParameterError);
}

TEST(Assignment, SplitsAtTheFirstEqualsSign) {
  const Assignment assignment = parse_assignment("alpha=0.1=x");
  EXPECT_EQ(assignment.name, "alpha");
  EXPECT_EQ(assignment.text, "0.1=x");
  EXPECT_EQ(parse_assignment("alpha=").text, "");
  for (const char* const argument : {"", "alpha", "=1", "="}) {
    const std::string message = message_of<ParameterError>([&] { parse_assignment(argument); });
    EXPECT_EQ(message, "'" + std::string(argument) + "' is not of the form NAME=VALUE");
  }
}

TEST(Range, EndsAreExactAndStepsAreEven) {
  const std::vector<double> even = parse_values("alpha", "0.1:0.9:5");
  ASSERT_EQ(even.size(), 5U);
  EXPECT_EQ(even.front(), 0.1);
  EXPECT_DOUBLE_EQ(even[2], 0.5);
  EXPECT_EQ(even.back(), 0.9);
  EXPECT_EQ(parse_values("alpha", "0.001:1:4:log"), (std::vector<double>{0.001, 0.01, 0.1, 1}));
  EXPECT_EQ(parse_values("alpha", "1:0:3"), (std::vector<double>{1, 0.5, 0}));
  EXPECT_EQ(parse_values("alpha", "0.3:0.3:1"), std::vector<double>{0.3});
  EXPECT_EQ(parse_values("alpha", "-1e308:1e308:3"), (std::vector<double>{-1e308, 0, 1e308}));
  EXPECT_EQ(parse_values("alpha", "0.5"), std::vector<double>{0.5});
  EXPECT_EQ(parse_values("alpha", "0.4,0.1,0.4"), (std::vector<double>{0.4, 0.1, 0.4}));
}

TEST(Range, IsStrictlyMonotoneBetweenAnyEnds) {
  std::mt19937_64 generator(2);
  std::uniform_real_distribution<double> exponent(-300, 300);
  std::uniform_real_distribution<double> mantissa(1, 10);
  std::uniform_int_distribution<std::size_t> counts(2, 200);
  for (int i = 0; i < 2000; ++i) {
    const double from = mantissa(generator) * std::pow(10, exponent(generator));
    const double to = mantissa(generator) * std::pow(10, exponent(generator));
    for (const bool log : {false, true}) {
      const RangeAxis range{from, to, counts(generator), log};
      const std::vector<double> values = range.values("alpha");
      ASSERT_EQ(values.size(), range.count);
      EXPECT_EQ(values.front(), from);
      EXPECT_EQ(values.back(), to);
      EXPECT_TRUE(from < to ? std::ranges::is_sorted(values) : std::ranges::is_sorted(values, std::greater<>()));
      EXPECT_EQ(std::ranges::adjacent_find(values), values.end());
    }
  }
}

TEST(Range, RoundTripsThroughText) {
  std::mt19937_64 generator(3);
  for (int i = 0; i < 1000; ++i) {
    const double from = random_double(generator);
    const double to = random_double(generator);
    const RangeAxis range = parse_range("alpha", shortest(from) + ":" + shortest(to) + ":1000000000");
    EXPECT_EQ(range.from, from);
    EXPECT_EQ(range.to, to);
    EXPECT_EQ(range.count, 1'000'000'000U);
    EXPECT_FALSE(range.log);
  }
}

TEST(Range, RefusesWhatIsNone) {
  for (const std::string text : {"0:1",
                                 ":",
                                 "::",
                                 ":::",
                                 "0:1:",
                                 "0:1:2:",
                                 "0:1:2:Log",
                                 "0:1:2:log:",
                                 "0:1:2:3:4",
                                 "0:1:0",
                                 "0:1:-1",
                                 "0:1:1e3",
                                 "0:1:2.5",
                                 "0:1:+2",
                                 "0:1:1000000001",
                                 "0:1:99999999999999999999",
                                 "0:1: 2",
                                 "0:1:1",
                                 "1:1:2",
                                 "0:1:3:log",
                                 "-1:1:3:log",
                                 "1:0:3:log",
                                 "-2:-1:3:log",
                                 "nan:1:2",
                                 "0:inf:2",
                                 "0:1e400:2",
                                 "a:b:c",
                                 "0x0:1:2",
                                 "1:1.0000000000000002:3",
                                 "1:1.0000000000000004:4:log",
                                 "",
                                 ",",
                                 "1,",
                                 ",1",
                                 "1,,2",
                                 "1, 2",
                                 "1;2",
                                 "0.1,nan"}) {
    const std::string message = message_of<ParameterError>([&] { parse_values("alpha", text); });
    EXPECT_TRUE(message.starts_with("alpha: ")) << text << " -> " << message;
    EXPECT_FALSE(contains(message, "\n"));
  }
}

TEST(Angles, AreDegreesFromNormalToGrazing) {
  EXPECT_EQ(parse_angles("theta", "0,60,89.9,90"), (std::vector<double>{0, 60, 89.9, 90}));
  EXPECT_EQ(message_of<ParameterError>([] { parse_angles("theta", "0,91"); }),
            "theta: '91' is outside [0, 90] degrees");
  for (const char* const text : {"", "-1e-300", "90.00000000000002", "nan", "0,,1", "0,", "1e400", "60°", "0:90:10"}) {
    EXPECT_THROW(parse_angles("theta", text), ParameterError) << text;
  }
}

TEST(Assertions, AreParsed) {
  const auto conditions = parse_assertions(
      " max<=1, min >= 0.2 &&error<1e-6,mean>-.5 && evaluations <= 1e4,at( 60 , -30.5 )==0.488988±1e-6 ");
  ASSERT_EQ(conditions.size(), 6U);
  const std::vector<std::tuple<Quantity, Relation, double, std::string>> expected{
      {Quantity::max, Relation::less_or_equal, 1, "max<=1"},
      {Quantity::min, Relation::greater_or_equal, 0.2, "min >= 0.2"},
      {Quantity::error, Relation::less, 1e-6, "error<1e-6"},
      {Quantity::mean, Relation::greater, -0.5, "mean>-.5"},
      {Quantity::evaluations, Relation::less_or_equal, 1e4, "evaluations <= 1e4"},
      {Quantity::at, Relation::equal, 0.488988, "at( 60 , -30.5 )==0.488988±1e-6"}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Assertion& condition = conditions[i];
    EXPECT_EQ(std::tie(condition.quantity, condition.relation, condition.value, condition.text), expected[i]);
  }
  EXPECT_EQ(conditions[5].theta, 60);
  EXPECT_EQ(conditions[5].phi, -30.5);
  EXPECT_EQ(conditions[5].tolerance, 1e-6);
  EXPECT_EQ(parse_assertions("at(60)==0.5+-1e-6").front().tolerance, 1e-6);
  EXPECT_EQ(parse_assertions("at(60)==0.5 +- 0").front().phi, 0);
}

TEST(Assertions, MalformedOnesSayWhereAndWhat) {
  const std::vector<std::tuple<std::string, int, std::string>> cases{{"", 1, "max, min"},
                                                                     {"  ", 3, "max, min"},
                                                                     {"foo<1", 1, "max, min"},
                                                                     {"maximum<1", 1, "max, min"},
                                                                     {"max", 4, "one of <"},
                                                                     {"max=1", 4, "one of <"},
                                                                     {"max!=1", 4, "one of <"},
                                                                     {"max<", 5, "a finite number"},
                                                                     {"max<<1", 5, "a finite number"},
                                                                     {"max<nan", 5, "a finite number"},
                                                                     {"max<inf", 5, "a finite number"},
                                                                     {"max<1e400", 5, "a finite number"},
                                                                     {"max<0x1", 6, "',', '&&' or the end"},
                                                                     {"max<1 min>0", 7, "',', '&&' or the end"},
                                                                     {"max<1,", 7, "max, min"},
                                                                     {"max<1&min>0", 6, "',', '&&' or the end"},
                                                                     {"max<1±1", 6, "',', '&&' or the end"},
                                                                     {"max==1", 7, "'±' or '+-'"},
                                                                     {"max==1±", 8, "a tolerance of 0"},
                                                                     {"max==1±-1", 8, "a tolerance of 0"},
                                                                     {"max==1±nan", 8, "a tolerance of 0"},
                                                                     {"max==1±1x", 9, "',', '&&' or the end"},
                                                                     {"at<1", 3, "'('"},
                                                                     {"at()<1", 4, "an angle from 0 to 90"},
                                                                     {"at(91)<1", 4, "an angle from 0 to 90"},
                                                                     {"at(-1)<1", 4, "an angle from 0 to 90"},
                                                                     {"at(nan)<1", 4, "an angle from 0 to 90"},
                                                                     {"at(60,)<1", 7, "an angle in degrees"},
                                                                     {"at(60,1,2)<1", 8, "')'"},
                                                                     {"at(60<1", 6, "')'"},
                                                                     {"max(1)<1", 4, "one of <"},
                                                                     {"1<max", 1, "max, min"}};
  for (const auto& [text, character, expected] : cases) {
    const std::string message = message_of<ParameterError>([&t = text] { parse_assertions(t); });
    EXPECT_TRUE(contains(message, expected)) << text << " -> " << message;
    EXPECT_TRUE(message.ends_with("at character " + std::to_string(character))) << text << " -> " << message;
  }
}

TEST(Assertions, RandomTextIsParsedOrRefused) {
  std::mt19937_64 generator(4);
  const std::string alphabet = "maxinet(60),<=>&±+-1e. \n\xff";
  std::uniform_int_distribution<std::size_t> letter(0, alphabet.size() - 1);
  for (int i = 0; i < 100'000; ++i) {
    std::string text = i % 2 == 0 ? "max<1" : "at(6)==";
    for (int j = 0; j < 8; ++j) text += alphabet[letter(generator)];
    try {
      EXPECT_FALSE(parse_assertions(text).empty());
    } catch (const ParameterError& error) {
      EXPECT_TRUE(contains(error.what(), "at character"));
    }
  }
}

bool holds(const std::string& condition, double actual) {
  const Facts facts{
      .at = [=](double, double) { return actual; }, .max = actual, .min = 0, .mean = 0, .error = 0, .evaluations = 0};
  return evaluate(parse_assertions(condition).front(), facts).holds;
}

TEST(Assertions, CompareAsWritten) {
  EXPECT_TRUE(holds("max<=1", 1));
  EXPECT_FALSE(holds("max<1", 1));
  EXPECT_TRUE(holds("max<1", 0.9999999999999999));
  EXPECT_FALSE(holds("max<=1", 1.0000000000000002));
  EXPECT_TRUE(holds("max>=1", 1));
  EXPECT_FALSE(holds("max>1", 1));
  EXPECT_TRUE(holds("at(60)==0.5±0.25", 0.25));
  EXPECT_TRUE(holds("at(60)==0.5±0.25", 0.75));
  EXPECT_FALSE(holds("at(60)==0.5±0.25", 0.7500000000000001));
  EXPECT_TRUE(holds("at(60)==0.5±0", 0.5));
  EXPECT_FALSE(holds("max<=1", infinity));
  EXPECT_TRUE(holds("max>1", infinity));
  EXPECT_FALSE(holds("max==1±1e308", infinity));
}

TEST(Assertions, NaNSatisfiesNothing) {
  for (const char* const condition : {"max<1", "max<=1", "max>1", "max>=1", "max==1±1e308", "at(0)<1", "at(0)==0±1"}) {
    EXPECT_FALSE(holds(condition, not_a_number)) << condition;
  }
}

TEST(Assertions, EachQuantityIsItsOwnFact) {
  const Facts facts{.at = [](double theta, double phi) { return theta + phi / 100; },
                    .max = 1,
                    .min = 2,
                    .mean = 3,
                    .error = 4,
                    .evaluations = 5};
  const std::vector<std::pair<std::string, double>> cases{{"max<9", 1},         {"min<9", 2},         {"mean<9", 3},
                                                          {"error<9", 4},       {"evaluations<9", 5}, {"at(60)<9", 60},
                                                          {"at(60,30)<9", 60.3}};
  for (const auto& [condition, actual] : cases) {
    EXPECT_EQ(evaluate(parse_assertions(condition).front(), facts).actual, actual) << condition;
  }
  EXPECT_EQ(evaluate(parse_assertions("min <= 1").front(), facts).text, "assertion 'min <= 1' fails: the value is 2");
  EXPECT_EQ(evaluate(parse_assertions("max<=1").front(), facts).text, "assertion 'max<=1' holds: the value is 1");
}

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
