#include "generators/sand/FrontQueue.h"

#include <algorithm>
#include <cstdint>
#include <deque>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

TEST(FrontQueue, ServesFirstWhatCameFirst) {
  FrontQueue<std::uint32_t> queue;
  std::deque<std::uint32_t> plain;
  RandomSequence random(3);
  for (std::uint32_t n = 0; n < 5'000; ++n) {
    queue.push_back(n);
    plain.push_back(n);
    if (random.nextBits(2) != 0) continue;
    const std::size_t count = random.next() % (std::min<std::size_t>(plain.size(), 7) + 1);
    queue.serve(count);
    plain.erase(plain.begin(), plain.begin() + static_cast<std::ptrdiff_t>(count));
    ASSERT_EQ(queue.size(), plain.size());
    ASSERT_TRUE(std::equal(plain.begin(), plain.end(), queue.begin(), queue.end()));
  }
  EXPECT_GT(queue.size(), 0U);
  queue.serve(queue.size());
  EXPECT_EQ(queue.size(), 0U);
}

struct Counted {
  Counted() = default;
  Counted(const Counted&) = default;
  Counted& operator=(const Counted&) {
    ++*moves;
    return *this;
  }
  int* moves = nullptr;
};

TEST(FrontQueue, MovesWhatWaitsOnceAtMostInTheMean) {
  constexpr int kElements = 10'000;
  int moves = 0;
  FrontQueue<Counted> queue;
  Counted one;
  one.moves = &moves;
  for (int n = 0; n < kElements; ++n) queue.push_back(one);
  while (queue.size() > 0) queue.serve(4);
  EXPECT_LE(moves, kElements);
}

}  // namespace
}  // namespace teren
