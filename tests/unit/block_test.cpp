#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "albedo/core/number.hpp"
#include "albedo/core/quad.hpp"
#include "warps/turn.hpp"

namespace albedo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The distance of a double from what it should be, in units in the last place of that.
double ulps(double value, const Quad& exact) {
  const double rounded = static_cast<double>(exact);
  if (!std::isfinite(rounded) || !std::isfinite(value)) return value == rounded ? 0 : infinity;
  const double size = std::max(std::abs(rounded), std::numeric_limits<double>::min());
  const double unit = std::ldexp(1.0, std::ilogb(size) - 52);
  return static_cast<double>(abs(Quad((value - exact) / unit)));
}

using BlockFunction = std::function<Block(const Block&)>;
using QuadFunction = std::function<Quad(const Quad&)>;

/// The largest error of a function at these places; every lane is one.
double worst_error(const BlockFunction& function, const QuadFunction& exact, const std::vector<double>& places) {
  double worst = 0;
  for (std::size_t first = 0; first < places.size(); first += block_width) {
    const int count = static_cast<int>(std::min<std::size_t>(block_width, places.size() - first));
    const Block x = Block::load_partial(places.data() + first, count);
    const Block y = function(x);
    for (int lane = 0; lane < count; ++lane) worst = std::max(worst, ulps(y[lane], exact(Quad(x[lane]))));
  }
  return worst;
}

/// Places spread evenly, and evenly in the logarithm of their size, on both sides of 0 where asked for.
std::vector<double> places(double least, double most, double smallest, int count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> even(least, most);
  std::vector<double> result;
  for (int i = 0; i < count; ++i) result.push_back(even(random));
  for (const double end : {least, most}) {
    if (end == 0) continue;
    std::uniform_real_distribution<double> exponent(std::log2(smallest), std::log2(std::abs(end)));
    for (int i = 0; i < count; ++i) result.push_back(std::copysign(std::exp2(exponent(random)), end));
  }
  return result;
}

constexpr int many = 4000;

TEST(BlockMath, Exp) {
  EXPECT_LE(worst_error([](const Block& x) { return exp(x); }, [](const Quad& x) { return Quad(exp(x)); },
                        places(-708, 709, 1e-300, many)),
            1.0);
}
TEST(BlockMath, Expm1) {
  EXPECT_LE(worst_error([](const Block& x) { return expm1(x); }, [](const Quad& x) { return Quad(expm1(x)); },
                        places(-60, 709, 1e-300, many)),
            2.5);
  EXPECT_LE(worst_error([](const Block& x) { return expm1(x); }, [](const Quad& x) { return Quad(expm1(x)); },
                        places(-1, 1, 1e-300, many)),
            2.5);
}
TEST(BlockMath, Log) {
  EXPECT_LE(worst_error([](const Block& x) { return log(x); }, [](const Quad& x) { return Quad(log(x)); },
                        places(0, 1e308, 1e-320, many)),
            1.0);
  EXPECT_LE(worst_error([](const Block& x) { return log(x); }, [](const Quad& x) { return Quad(log(x)); },
                        places(0.5, 2, 0.1, many)),
            1.0);
}
TEST(BlockMath, Log1p) {
  const auto ours = [](const Block& x) { return log1p(x); };
  const auto exact = [](const Quad& x) { return Quad(log(Quad(1 + x))); };  // exact to 1e-34/x
  EXPECT_LE(worst_error(ours, exact, places(0, 1e308, 1e-12, many)), 2.0);
  EXPECT_LE(worst_error(ours, exact, places(-1 + 1e-16, 1, 1e-12, many)), 2.0);
  const auto series = [](const Quad& x) { return Quad(x - x * x / 2 + x * x * x / 3); };
  EXPECT_LE(worst_error(ours, series, places(-1e-12, 1e-12, 1e-308, many)), 2.0);
  std::vector<double> near_minus_one;
  for (int i = 1; i <= 53; ++i) near_minus_one.push_back(-1 + std::ldexp(1.0, -i));
  EXPECT_LE(worst_error(ours, exact, near_minus_one), 2.0);
}
TEST(BlockMath, Atan) {
  EXPECT_LE(worst_error([](const Block& x) { return atan(x); }, [](const Quad& x) { return Quad(atan(x)); },
                        places(-4, 4, 1e-300, many)),
            2.5);
  EXPECT_LE(worst_error([](const Block& x) { return atan(x); }, [](const Quad& x) { return Quad(atan(x)); },
                        places(-1e300, 1e300, 1, many)),
            2.5);
}
TEST(BlockMath, Sqrt) {
  EXPECT_LE(worst_error([](const Block& x) { return sqrt(x); }, [](const Quad& x) { return Quad(sqrt(x)); },
                        places(0, 1e308, 1e-320, many)),
            0.5);
}
TEST(BlockMath, SincosQuarter) {
  const Quad half_pi = boost::math::constants::half_pi<Quad>();
  const auto sine = [](const Block& x) {
    Block s, c;
    sincos_quarter(x, s, c);
    return s;
  };
  const auto cosine = [](const Block& x) {
    Block s, c;
    sincos_quarter(x, s, c);
    return c;
  };
  const std::vector<double> turns = places(-4.3, 4.3, 1e-300, many);
  // relative to the nearest zero, which is at an integer: reduced exactly
  const auto exact_sine = [&](const Quad& f) {
    const Quad n = round(f);
    const Quad s = sin(Quad((f - n) * half_pi)), c = cos(Quad((f - n) * half_pi));
    const int quarter = static_cast<int>(n) & 3;
    return quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? Quad(-s) : Quad(-c);
  };
  EXPECT_LE(worst_error(sine, exact_sine, turns), 2.0);
  EXPECT_LE(worst_error(
                cosine, [&](const Quad& f) { return exact_sine(Quad(f + 1)); }, turns),
            2.0);
}
TEST(BlockMath, SincosQuarterIsExactAtIntegers) {
  for (int n = -9; n <= 9; ++n) {
    Block s, c;
    sincos_quarter(Block(n), s, c);
    double scalar_s = 0, scalar_c = 0;
    const double here = n;
    sincos_quarter<double>(here, scalar_s, scalar_c);
    EXPECT_EQ(s[0], scalar_s) << n;
    EXPECT_EQ(c[0], scalar_c) << n;
    EXPECT_EQ(s[0] * c[0], 0) << n;
  }
}
TEST(BlockMath, Pow) {
  for (const double exponent : {0.5, 2.5, 5.0, -3.0, 100.0}) {
    for (const double x : places(0, 30, 1e-3, many / 10)) {
      const Quad exact = pow(Quad(x), Quad(exponent));
      EXPECT_LE(ulps(pow(Block(x), exponent)[0], exact), 2 + 2 * std::abs(exponent * std::log(x)))
          << x << "^" << exponent;
    }
  }
  EXPECT_EQ(pow(Block(0), 2.5)[0], 0);
  EXPECT_EQ(pow(Block(0), 0)[0], 1);
  EXPECT_EQ(pow(Block(0), -1)[0], infinity);
  EXPECT_EQ(pow(Block(1), 1e6)[0], 1);
}

/// At the ends of a function's domain, and beyond: what the C library says, with its sign.
TEST(BlockMath, LimitsAreThoseOfDouble) {
  struct Row {
    const char* name;
    BlockFunction ours;
    std::function<double(double)> standard;
  };
  const Row rows[] = {
      {"exp", [](const Block& x) { return exp(x); }, [](double x) { return std::exp(x); }},
      {"expm1", [](const Block& x) { return expm1(x); }, [](double x) { return std::expm1(x); }},
      {"log", [](const Block& x) { return log(x); }, [](double x) { return std::log(x); }},
      {"log1p", [](const Block& x) { return log1p(x); }, [](double x) { return std::log1p(x); }},
      {"sqrt", [](const Block& x) { return sqrt(x); }, [](double x) { return std::sqrt(x); }},
      {"abs", [](const Block& x) { return abs(x); }, [](double x) { return std::abs(x); }},
      {"atan", [](const Block& x) { return atan(x); }, [](double x) { return std::atan(x); }},
  };
  const double ends[] = {0.0,    -0.0,    1.0,     -1.0,     infinity, -infinity, std::nan(""), 5e-324,    -5e-324,
                         1e-310, -1e-310, 1.7e308, -1.7e308, 709.78,   709.79,    -745.1,       -745.2,    -1e5,
                         1e5,    -2.0,    2.0,     1e-17,    -1e-17,   6.4e307,   9.1e15,       -1 + 1e-16};
  for (const Row& row : rows) {
    for (const double x : ends) {
      const double expected = row.standard(x);
      const Block y = row.ours(Block(x));
      for (int lane = 0; lane < block_width; ++lane) {
        if (std::isnan(expected)) {
          EXPECT_TRUE(std::isnan(y[lane])) << row.name << "(" << x << ") is " << y[lane];
          continue;
        }
        EXPECT_LE(ulps(y[lane], Quad(expected)), 3) << row.name << "(" << x << ") is " << y[lane];
        EXPECT_EQ(std::signbit(y[lane]), std::signbit(expected)) << row.name << "(" << x << ")";
      }
    }
  }
}

/// One lane's neighbours don't matter, nor which lane it is.
TEST(BlockMath, LanesAreIndependent) {
  const std::vector<double> x = places(0, 3, 1e-8, 500);
  for (std::size_t first = 0; first + block_width <= x.size(); first += block_width) {
    const Block together = Block::load(x.data() + first);
    for (int lane = 0; lane < block_width; ++lane) {
      const Block alone(together[lane]);
      EXPECT_EQ(exp(together)[lane], exp(alone)[0]);
      EXPECT_EQ(expm1(together)[lane], expm1(alone)[7]);
      EXPECT_EQ(log(together)[lane], log(alone)[3]);
      EXPECT_EQ(log1p(together)[lane], log1p(alone)[1]);
      EXPECT_EQ(atan(together)[lane], atan(alone)[5]);
    }
  }
}

TEST(Block, LoadsAndStoresItsLanes) {
  double values[block_width];
  const Block x = Block::generate([](int lane) { return lane * lane + 0.5; });
  x.store(values);
  for (int lane = 0; lane < block_width; ++lane) {
    EXPECT_EQ(values[lane], lane * lane + 0.5);
    EXPECT_EQ(x[lane], values[lane]);
  }
  Block y = Block::load(values);
  y.set(5, -1);
  double some[block_width] = {9, 9, 9, 9, 9, 9, 9, 9};
  y.store(some, 6);
  EXPECT_EQ(some[4], 16.5);
  EXPECT_EQ(some[5], -1);
  EXPECT_EQ(some[6], 9);
}

TEST(Block, ComparesAndSelectsLaneByLane) {
  const Block x = Block::generate([](int lane) { return lane - 3.0; });
  for (int lane = 0; lane < block_width; ++lane) {
    const double v = x[lane];
    EXPECT_EQ(select(x < Block(0), Block(1), Block(2))[lane], v < 0 ? 1 : 2);
    EXPECT_EQ(select(x <= Block(0), Block(1), Block(2))[lane], v <= 0 ? 1 : 2);
    EXPECT_EQ(select(x > Block(0), Block(1), Block(2))[lane], v > 0 ? 1 : 2);
    EXPECT_EQ(select(x >= Block(0), Block(1), Block(2))[lane], v >= 0 ? 1 : 2);
    EXPECT_EQ(select(x == Block(0), Block(1), Block(2))[lane], v == 0 ? 1 : 2);
    EXPECT_EQ((-x * x + 2 * x / 4 - 1)[lane], -v * v + 2 * v / 4 - 1);
  }
  EXPECT_TRUE(all(x > Block(-4)));
  EXPECT_FALSE(all(x < Block(4)));
}

/// min and max choose as the scalar ones do, NaN included.
TEST(Block, SmallerAndLargerAreThoseOfDouble) {
  const double nan = std::nan("");
  for (const double a : {1.0, 2.0, nan, -infinity}) {
    for (const double b : {1.0, 3.0, nan, infinity}) {
      const double smaller = min(Block(a), Block(b))[0], larger = max(Block(a), Block(b))[0];
      EXPECT_EQ(std::isnan(smaller), std::isnan(min(a, b)));
      EXPECT_EQ(std::isnan(larger), std::isnan(max(a, b)));
      if (!std::isnan(smaller)) {
        EXPECT_EQ(smaller, min(a, b));
      }
      if (!std::isnan(larger)) {
        EXPECT_EQ(larger, max(a, b));
      }
    }
  }
}

}  // namespace
}  // namespace albedo
