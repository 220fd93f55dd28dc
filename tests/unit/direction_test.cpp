#include "albedo/core/direction.hpp"
#include "albedo/core/quad.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "albedo/core/errors.hpp"

namespace albedo {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Direction, IsExactAtMultiplesOf90Degrees) {
  const Direction normal = Direction::from_degrees(0), grazing = Direction::from_degrees(90);
  EXPECT_EQ(normal.cos_theta, 1);
  EXPECT_EQ(normal.sin_theta, 0);
  EXPECT_EQ(grazing.cos_theta, 0);
  EXPECT_EQ(grazing.sin_theta, 1);
  struct Turn {
    double phi, cosine, sine;
  };
  for (const Turn& t :
       {Turn{0, 1, 0}, {90, 0, 1}, {180, -1, 0}, {270, 0, -1}, {-90, 0, -1}, {360, 1, 0}, {3690, 0, 1}}) {
    const Direction d = Direction::from_degrees(45, t.phi);
    EXPECT_EQ(d.cos_phi, t.cosine) << t.phi;
    EXPECT_EQ(d.sin_phi, t.sine) << t.phi;
  }
}

/// cos 89.99° from 90° − θ: 1.7453292431333680334e-4.
TEST(Direction, KeepsItsDigitsNearGrazing) {
  EXPECT_NEAR(Direction::from_degrees(89.99).cos_theta, 1.7453292431333680334e-4, 1e-16);
  EXPECT_NEAR(Direction::from_degrees(60).cos_theta, 0.5, 1e-16);
  EXPECT_NEAR(Direction::from_degrees(30).sin_theta, 0.5, 1e-16);
}

TEST(Direction, FromCosine) {
  const Direction d = Direction::from_cosine(0.6, 90);
  EXPECT_EQ(d.cos_theta, 0.6);
  EXPECT_NEAR(d.sin_theta, 0.8, 1e-16);
  EXPECT_EQ(d.cos_phi, 0);
  EXPECT_EQ(Direction::from_cosine(0).sin_theta, 1);
  EXPECT_EQ(Direction::from_cosine(1).sin_theta, 0);
  EXPECT_NEAR(Direction::from_cosine(0.5).theta_degrees(), 60, 1e-13);
  EXPECT_NEAR(Direction::from_degrees(89.99).theta_degrees(), 89.99, 1e-12);
}

TEST(Direction, WrongInputIsNamed) {
  for (const double theta : {-1e-9, 90.0000001, 91.0, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(Direction::from_degrees(theta), ParameterError) << theta;
  }
  for (const double cosine : {-1e-300, 1.0000001, nan}) {
    EXPECT_THROW(Direction::from_cosine(cosine), ParameterError) << cosine;
  }
  for (const double phi : {nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(Direction::from_degrees(10, phi), ParameterError) << phi;
    EXPECT_THROW(Direction::from_cosine(0.5, phi), ParameterError) << phi;
  }
  try {
    Direction::from_degrees(91);
    FAIL();
  } catch (const ParameterError& e) {
    const std::string message = e.what();
    EXPECT_NE(message.find("theta"), std::string::npos) << message;
    EXPECT_NE(message.find("91"), std::string::npos) << message;
    EXPECT_NE(message.find("90]"), std::string::npos) << message;
  }
}

TEST(UnitVector, HasUnitLengthInItsOwnArithmetic) {
  for (const double theta : {0.0, 1e-6, 12.3, 45.0, 60.0, 89.999999, 90.0}) {
    for (const double phi : {0.0, 33.3, 135.0, 201.0, 350.0}) {
      const Direction d = Direction::from_degrees(theta, phi);
      const auto q = unit_vector<Quad>(d);
      const Quad excess = square(q.x) + square(q.y) + square(q.z) - 1;
      EXPECT_LE(std::abs(static_cast<double>(excess)), 1e-32) << theta << " " << phi;
      const auto x = unit_vector<double>(d);
      EXPECT_NEAR(x.x * x.x + x.y * x.y + x.z * x.z, 1, 1e-15);
      EXPECT_NEAR(x.x, d.sin_theta * d.cos_phi, 1e-15);
      EXPECT_NEAR(x.y, d.sin_theta * d.sin_phi, 1e-15);
    }
  }
}

/// L at 60° along x, V along the normal: H is at 30°.
TEST(DirectionPair, InvariantsOfAKnownPair) {
  const auto l = unit_vector<double>(Direction::from_degrees(60)), v = unit_vector<double>(Direction::from_degrees(0));
  const UnitVector<double> mirror{-l.x, -l.y, l.z};
  const auto d = direction_pair(l, v, mirror);
  EXPECT_NEAR(d.cos_theta_l, 0.5, 1e-15);
  EXPECT_NEAR(d.cos_theta_v, 1, 1e-15);
  EXPECT_NEAR(d.cos_theta_d, std::sqrt(3.0) / 2, 1e-15);
  EXPECT_NEAR(d.cos_theta_h, std::sqrt(3.0) / 2, 1e-15);
  EXPECT_NEAR(d.slope_x, 1 / std::sqrt(3.0), 1e-15);
  EXPECT_EQ(d.slope_y, 0);
  EXPECT_NEAR(tan2_theta_h(d), 1.0 / 3, 1e-15);
  EXPECT_NEAR(d.axis_gap, 0.5, 1e-15);  // 1 − R·V = 1 − cos60°
}

TEST(DirectionPair, GapsKeepTheirDigits) {
  const UnitVector<double> a{0, 0, 1}, b{1e-9, 0, 1};
  EXPECT_NEAR(gap(a, b), 5e-19, 1e-33);
}

TEST(DirectionPair, ExchangedSwapsLAndV) {
  const auto l = unit_vector<double>(Direction::from_degrees(70, 15)),
             v = unit_vector<double>(Direction::from_degrees(25, 200));
  const UnitVector<double> mirror_l{-l.x, -l.y, l.z}, mirror_v{-v.x, -v.y, v.z};
  const auto there = exchanged(direction_pair(l, v, mirror_l)), back = direction_pair(v, l, mirror_v);
  EXPECT_EQ(there.cos_theta_l, back.cos_theta_l);
  EXPECT_EQ(there.cos_theta_v, back.cos_theta_v);
  EXPECT_EQ(there.l_x, back.l_x);
  EXPECT_EQ(there.v_y, back.v_y);
  EXPECT_NEAR(there.slope_x, back.slope_x, 1e-15);
  EXPECT_NEAR(there.slope_y, back.slope_y, 1e-15);
  EXPECT_NEAR(there.axis_gap, back.axis_gap, 1e-15);
}

TEST(Block, DoesWhatDoubleDoes) {
  const Block x = Block::generate([](int i) { return 0.1 + 0.2 * i; });
  for (int i = 0; i < block_width; ++i) {
    const double y = x[i];
    EXPECT_NEAR(exp(x)[i], std::exp(y), 1e-15 * std::exp(y));
    EXPECT_NEAR(log1p(x)[i], std::log1p(y), 1e-15);
    EXPECT_NEAR(expm1(x)[i], std::expm1(y), 1e-15 * std::expm1(y));
    EXPECT_NEAR(sqrt(x)[i], std::sqrt(y), 1e-15);
    EXPECT_NEAR(pow(x, 2.5)[i], std::pow(y, 2.5), 1e-15 * std::pow(y, 2.5));
    EXPECT_NEAR(atan(x)[i], std::atan(y), 1e-15);
    EXPECT_EQ(select(x > Block(0.5), x, Block(-1))[i], y > 0.5 ? y : -1);
    EXPECT_EQ(min(x, Block(0.5))[i], std::min(y, 0.5));
    EXPECT_EQ(max(x, Block(0.5))[i], std::max(y, 0.5));
  }
}

TEST(Block, PartlyLoadedRepeatsItsLastValue) {
  const double values[3] = {1, 2, 3};
  const Block block = Block::load_partial(values, 3);
  for (int i = 0; i < block_width; ++i) EXPECT_EQ(block[i], i < 3 ? i + 1 : 3);
  double stored[block_width] = {};
  block.store(stored, 2);
  EXPECT_EQ(stored[1], 2);
  EXPECT_EQ(stored[2], 0);
}

/// Small arguments, where log(1 + x) of a naive kind has no digits.
TEST(Block, LogarithmAndExponentialOfSmallNumbers) {
  for (const double small : {1e-300, 1e-16, 1e-9, -1e-12}) {
    const Block x(small);
    EXPECT_NEAR(log1p(x)[0] / small, std::log1p(small) / small, 1e-14) << small;
    EXPECT_NEAR(expm1(x)[0] / small, std::expm1(small) / small, 1e-14) << small;
  }
}

}  // namespace
}  // namespace albedo
