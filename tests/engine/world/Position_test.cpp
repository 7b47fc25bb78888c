#include "teren/Position.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kPitches[] = {64.0, 1.0, 0.001, 1e6, 0.1, 30.0, 77.7, 1.0 / 3.0};

double uniform(RandomSequence& random) {
  return std::ldexp(static_cast<double>(random.nextBits(53)), -53);
}

/// Of either sign, from 2^-40 to 2^`bits` in size.
double anySize(RandomSequence& random, int bits) {
  const double size = std::ldexp(1.0 + uniform(random),
                                 static_cast<int>(random.next() % static_cast<unsigned>(bits + 40)) - 40);
  return random.nextBits(1) == 0 ? size : -size;
}

/// Metres from zero along one axis, without loss up to about 2^64 pitches of 64 bits.
long double metres(std::int64_t index, double fraction, double pitch) {
  return (static_cast<long double>(index) + fraction) * pitch;
}

bool inside(const Position& p) {
  return p.i >= -kMaxPatch && p.i < kMaxPatch && p.j >= -kMaxPatch && p.j < kMaxPatch && p.u >= 0.0 &&
         p.u < 1.0 && p.v >= 0.0 && p.v < 1.0 && !std::signbit(p.u) && !std::signbit(p.v);
}

TEST(Position, FromMetresLiesWhereItWasAskedForWithFractionsInsideThePatch) {
  constexpr std::uint64_t kSeed = 41;
  RecordProperty("seed", static_cast<int>(kSeed));
  for (const double pitch : kPitches) {
    SCOPED_TRACE(testing::Message() << "pitch " << pitch);
    RandomSequence random(kSeed);
    for (int trial = 0; trial < 20'000; ++trial) {
      const double x = anySize(random, 50) * pitch, y = anySize(random, 50) * pitch;
      const Result<Position> at = Position::fromMetres(x, y, pitch);
      ASSERT_TRUE(at.ok()) << at.error().message;
      ASSERT_TRUE(inside(*at)) << x << ", " << y;
      // The offset's rounding (2^-53 of a pitch) and, in this check, that of the long double product.
      const auto bound = static_cast<long double>(pitch) * 0x1p-52L;
      ASSERT_LE(std::fabs(metres(at->i, at->u, pitch) - x), bound + std::fabs(x) * 0x1p-62L) << x;
      ASSERT_LE(std::fabs(metres(at->j, at->v, pitch) - y), bound + std::fabs(y) * 0x1p-62L) << y;
    }
  }
}

TEST(Position, FromMetresAndBackGivesTheSameDouble) {
  constexpr std::uint64_t kSeed = 42;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (int trial = 0; trial < 20'000; ++trial) {
    // Whole multiples of 2^-20 m up to 2^32 m: nothing need be rounded at a pitch of 64 m.
    const double x = std::ldexp(static_cast<double>(random.nextBits(53)) - 0x1p52, -20);
    const double y = std::ldexp(static_cast<double>(random.nextBits(30)) - 0x1p29, -20);
    const Result<Position> at = Position::fromMetres(x, y, 64.0);
    ASSERT_TRUE(at.ok());
    ASSERT_EQ(at->x(64.0), x);
    ASSERT_EQ(at->y(64.0), y);
  }
}

TEST(Position, PutsWholePitchesOnThePatchTheyBegin) {
  for (const double pitch : kPitches) {
    for (const int index : {0, 1, -1, 2, -2, 3, 1000, -1000, 123456, -123456}) {
      const double x = index * pitch;
      const Result<Position> at = Position::fromMetres(x, -x, pitch);
      ASSERT_TRUE(at.ok());
      // index * pitch may itself be rounded: the point is then a rounding beside the patch's border.
      EXPECT_LE(std::fabs(metres(at->i, at->u, pitch) - x), pitch * 0x1p-52L) << index << " at " << pitch;
      if (static_cast<long double>(index) * pitch == static_cast<long double>(x)) {
        EXPECT_EQ(at->i, index) << pitch;
        EXPECT_EQ(at->u, 0.0) << pitch;
        EXPECT_EQ(at->j, -index) << pitch;
      }
    }
  }
}

TEST(Position, KeepsFractionsBelowOneJustWestOfABorder) {
  for (const double pitch : kPitches) {
    for (const double x : {-5e-324, -1e-300, -1e-20, -1e-17, -1e-16, -0x1p-54, -0x1p-53}) {
      const Result<Position> at = Position::fromMetres(x * pitch, x, pitch);
      ASSERT_TRUE(at.ok());
      EXPECT_TRUE(inside(*at)) << x << " at pitch " << pitch;
    }
  }
  const Result<Position> zero = Position::fromMetres(-0.0, 0.0, 64.0);
  EXPECT_EQ(*zero, (Position{0, 0, 0.0, 0.0}));
  EXPECT_FALSE(std::signbit(zero->u));
}

TEST(Position, RefusesWhatIsNoPlaceAndNamesAxisAndValue) {
  struct Case {
    double value;
    const char* text;
  };
  const Case cases[] = {
      {kNaN, "nan"},        {kInfinity, "inf"},
      {-kInfinity, "-inf"}, {1e300, "1e+300"},
      {-1e300, "-1e+300"},  {std::numeric_limits<double>::max(), "1.7976931348623157e+308"}};
  for (const double pitch : kPitches) {
    for (const Case& c : cases) {
      const Result<Position> x = Position::fromMetres(c.value, 0.0, pitch);
      ASSERT_FALSE(x.ok()) << c.value;
      EXPECT_EQ(x.error().message.rfind("x ", 0), 0U) << x.error().message;
      EXPECT_NE(x.error().message.find(c.text), std::string::npos) << x.error().message;
      const Result<Position> y = Position::fromMetres(0.0, c.value, pitch);
      ASSERT_FALSE(y.ok()) << c.value;
      EXPECT_EQ(y.error().message.rfind("y ", 0), 0U) << y.error().message;
      EXPECT_FALSE((Position{1, 2, 0.5, 0.5}).movedBy(c.value, 0.0, pitch).ok()) << c.value;
      EXPECT_FALSE((Position{1, 2, 0.5, 0.5}).movedBy(0.0, c.value, pitch).ok()) << c.value;
    }
  }
}

TEST(Position, EndsAtTheLastPatchAndNotBefore) {
  const auto limit = static_cast<double>(kMaxPatch);
  for (const double pitch : {1.0, 64.0, 0.25}) {
    EXPECT_FALSE(Position::fromMetres(limit * pitch, 0.0, pitch).ok());
    EXPECT_FALSE(Position::fromMetres(std::nextafter(-limit * pitch, -kInfinity), 0.0, pitch).ok());
    const Result<Position> last = Position::fromMetres(std::nextafter(limit * pitch, 0.0), 0.0, pitch);
    ASSERT_TRUE(last.ok());
    EXPECT_EQ(last->i, kMaxPatch - 1);
    EXPECT_EQ(last->u, 0.5);
    const Result<Position> first = Position::fromMetres(-limit * pitch, 0.0, pitch);
    ASSERT_TRUE(first.ok());
    EXPECT_EQ(first->i, -kMaxPatch);
    EXPECT_EQ(first->u, 0.0);
    EXPECT_FALSE(first->movedBy(-1e-3 * pitch, 0.0, pitch).ok());
    EXPECT_FALSE(last->movedBy(0.5 * pitch, 0.0, pitch).ok());
    const Result<Position> back = last->movedBy(-limit * pitch, 0.0, pitch);
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(*back, (Position{-1, 0, 0.5, 0.0}));
  }
}

TEST(Position, NamesTheValueAlsoWhereItIsOnlyJustBeyond) {
  const std::string message = Position::fromMetres(0.0, std::ldexp(64.0, 52), 64.0).error().message;
  EXPECT_EQ(message.rfind("y = 288230376151711744 m", 0), 0U) << message;
}

TEST(Position, IsValidOnlyInsideTheWorldAndItsPatch) {
  EXPECT_TRUE((Position{-kMaxPatch, kMaxPatch - 1, 0.0, 1.0 - 0x1p-53}).valid());
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  for (const Position& odd :
       {Position{kMaxPatch, 0, 0.0, 0.0}, Position{0, -kMaxPatch - 1, 0.0, 0.0}, Position{kMost, 0, 0.0, 0.0},
        Position{0, -kMost - 1, 0.0, 0.0}, Position{0, 0, 1.0, 0.0}, Position{0, 0, 0.0, -0x1p-60},
        Position{0, 0, kNaN, 0.0}, Position{0, 0, 0.0, kNaN}, Position{0, 0, kInfinity, 0.0},
        Position{0, 0, 1e300, 0.0}}) {
    EXPECT_FALSE(odd.valid()) << odd.i << ", " << odd.j << ", " << odd.u << ", " << odd.v;
    EXPECT_FALSE(odd.movedBy(1.0, 1.0, 64.0).ok());
  }
}

TEST(Position, MovesByExactlyTheDistanceWhereverItIs) {
  constexpr std::uint64_t kSeed = 43;
  RecordProperty("seed", static_cast<int>(kSeed));
  for (const double pitch : kPitches) {
    SCOPED_TRACE(testing::Message() << "pitch " << pitch);
    RandomSequence random(kSeed);
    for (int trial = 0; trial < 10'000; ++trial) {
      const std::int64_t bias = trial % 3 == 0 ? 0 : trial % 3 == 1 ? kMaxPatch / 2 : -kMaxPatch / 2;
      const Position from{bias + random.nextBits(20), bias - random.nextBits(20), uniform(random),
                          uniform(random)};
      const double dx = anySize(random, 30) * pitch, dy = anySize(random, 30) * pitch;
      const Result<Position> to = from.movedBy(dx, dy, pitch);
      ASSERT_TRUE(to.ok()) << to.error().message;
      ASSERT_TRUE(inside(*to));
      const Offset moved = offset(from, *to, pitch);
      ASSERT_NEAR(moved.east, dx, pitch * 0x1p-51 + std::fabs(dx) * 0x1p-51);
      ASSERT_NEAR(moved.north, dy, pitch * 0x1p-51 + std::fabs(dy) * 0x1p-51);
    }
  }
}

TEST(Position, CreepsAcrossABorderWithoutDrifting) {
  Position at{(std::int64_t{1} << 51) - 1, 0, 0.5, 0.25};
  const Position start = at;
  for (int step = 0; step < 4096; ++step) at = *at.movedBy(1.0 / 64, -1.0 / 64, 64.0);
  EXPECT_EQ(at, (Position{start.i + 1, -1, 0.5, 0.25}));
  for (int step = 0; step < 4096; ++step) at = *at.movedBy(-1.0 / 64, 1.0 / 64, 64.0);
  EXPECT_EQ(at, start);
}

TEST(Position, MeasuresSmallOffsetsFarFromZero) {
  const Position from{kMaxPatch - 2, -kMaxPatch, 1.0 - 0x1p-53, 0.0};
  const Position to{kMaxPatch - 1, -kMaxPatch, 0.0, 0x1p-30};
  const Offset between = offset(from, to, 64.0);
  EXPECT_EQ(between.east, 64.0 * 0x1p-53);
  EXPECT_EQ(between.north, 64.0 * 0x1p-30);
}

}  // namespace
}  // namespace teren
