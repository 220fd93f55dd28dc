#include <limits>
#include <random>
#include <string>
#include <vector>

#include "albedo/core/errors.hpp"
#include "analysis/helpers.hpp"
#include "analysis/text/assertion.hpp"

namespace albedo::analysis {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

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

}  // namespace
}  // namespace albedo::analysis
