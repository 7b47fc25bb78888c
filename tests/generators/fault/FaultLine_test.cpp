#include "generators/fault/FaultLine.h"

#include <initializer_list>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

/// Words written down in advance instead of drawn.
class WrittenWords {
 public:
  WrittenWords(std::initializer_list<std::uint64_t> words) : words_(words) {}
  std::uint64_t next() { return words_.at(used_++); }
  std::size_t used() const { return used_; }

 private:
  std::vector<std::uint64_t> words_;
  std::size_t used_ = 0;
};

std::uint64_t endWord(std::uint64_t x, std::uint64_t y, std::uint64_t lowBits = 0) {
  return x << 44 | y << 24 | lowBits;
}

TEST(FaultLine, TakesItsEndsFromTheUpperBitsAndItsSignFromTheLowestBit) {
  WrittenWords words{endWord(3, 5, 1), endWord(0xfffff, 0)};
  const FaultLine line = drawFaultLine(words, 7);
  EXPECT_EQ(line.ax, 3);
  EXPECT_EQ(line.ay, 5);
  EXPECT_EQ(line.bx, kFaultUnits - 1);
  EXPECT_EQ(line.by, 0);
  EXPECT_EQ(line.left, 7);
  WrittenWords other{endWord(3, 5, 0xfffffe), endWord(0xfffff, 0)};
  EXPECT_EQ(drawFaultLine(other, 7).left, -7);
}

TEST(FaultLine, DrawsEqualEndsAgainUntilTheyDiffer) {
  WrittenWords words{endWord(9, 9, 1), endWord(9, 9, 5), endWord(0, 0), endWord(0, 0),
                     endWord(1, 2, 0), endWord(1, 3, 1), endWord(4, 4), endWord(5, 5)};
  const FaultLine line = drawFaultLine(words, 7);
  EXPECT_EQ(words.used(), 6u);
  EXPECT_EQ(line.ay, 2);
  EXPECT_EQ(line.by, 3);
  EXPECT_EQ(line.left, -7) << "the sign comes from the pair that was kept";
}

TEST(FaultLine, CountsTheLineItselfToItsRight) {
  const FaultLine line{.ax = 10, .ay = 10, .bx = 30, .by = 20, .left = 4};
  EXPECT_EQ(line.move(20, 15), -4);
  EXPECT_EQ(line.move(10, 10), -4);
  EXPECT_EQ(line.move(0, 5), -4);
  EXPECT_EQ(line.move(20, 16), 4);
  EXPECT_EQ(line.move(20, 14), -4);
  const FaultLine reversed{.ax = 30, .ay = 20, .bx = 10, .by = 10, .left = 4};
  EXPECT_EQ(reversed.move(20, 15), -4);
  EXPECT_EQ(reversed.move(20, 14), 4);
}

TEST(FaultLine, IsExactAtTheRimsOfTheSquare) {
  constexpr std::int64_t last = kFaultUnits - 1;
  const FaultLine line{.ax = 0, .ay = 0, .bx = last, .by = last - 1, .left = 1};
  EXPECT_EQ(line.move(last, last - 1), -1);
  EXPECT_EQ(line.move(last, last), 1);
  EXPECT_EQ(line.move(kFaultUnits, last), 1) << "the line passes a millionth of a unit below";
  EXPECT_EQ(line.move(kFaultUnits, last - 1), -1);
}

TEST(FaultLine, RaisesEitherSideEquallyOften) {
  RandomSequence random(20240607);
  int left = 0;
  for (int n = 0; n < 10000; ++n) left += drawFaultLine(random, 1).left;
  EXPECT_LT(std::abs(left), 400) << "four standard deviations";
}

}  // namespace
}  // namespace teren
