#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "albedo/core/errors.hpp"
#include "analysis/helpers.hpp"
#include "analysis/text/value.hpp"

namespace albedo::analysis {
namespace {

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
    const RangeAxis range = parse_range("alpha", shortest(from) + ":" + shortest(to) + ":1000000");
    EXPECT_EQ(range.from, from);
    EXPECT_EQ(range.to, to);
    EXPECT_EQ(range.count, 1'000'000U);
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
                                 "0:1:1000001",
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

}  // namespace
}  // namespace albedo::analysis
