// What edits add to the error of coarser levels: measured, against every sample's own.
#include "edits/GroundSnapshot.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

#include "teren/Hash.h"
#include "teren/HeightMap.h"

#include "edits/GroundOverrides.h"

namespace teren {
namespace {

constexpr int kIntervals = 16, kTop = 6;
constexpr int kSide = 6 * kIntervals;  // of the ground that is moved, from sample 0 on

/// Heights that are moved by what a function of the sample says.
template <class Moved>
void move(GroundOverrides& overrides, Moved moved) {
  HeightMap own(kSide + 1, kSide + 1), now(kSide + 1, kSide + 1);
  for (int y = 0; y <= kSide; ++y) {
    for (int x = 0; x <= kSide; ++x) {
      own(x, y) = static_cast<float>(3 * ((x * 7 + y * 13) % 11));
      now(x, y) = own(x, y) + static_cast<float>(moved(x, y));
    }
  }
  overrides.take(0, 0, now.view(), own.view());
}

/// [m] By how much the triangles of a level miss what samples of a node were moved by.
template <class Moved>
double brute(int level, std::int64_t i, std::int64_t j, Moved moved) {
  const int step = 1 << level, side = kIntervals << level;
  double most = 0.0;
  for (std::int64_t y = j * side; y <= (j + 1) * side; ++y) {
    for (std::int64_t x = i * side; x <= (i + 1) * side; ++x) {
      const std::int64_t west = x & ~std::int64_t{step - 1}, south = y & ~std::int64_t{step - 1};
      const double u = static_cast<double>(x - west) / step, v = static_cast<double>(y - south) / step;
      const double sw = moved(west, south), se = moved(west + step, south);
      const double nw = moved(west, south + step), ne = moved(west + step, south + step);
      const double drawn = u >= v ? sw + u * (se - sw) + v * (ne - se) : sw + u * (ne - nw) + v * (nw - sw);
      most = std::max(most, std::fabs(drawn - moved(x, y)));
    }
  }
  return most;
}

double inside(std::int64_t x, std::int64_t y, double moved) {
  return x >= 0 && y >= 0 && x <= kSide && y <= kSide ? moved : 0.0;
}

double rough(std::int64_t x, std::int64_t y) {
  const std::uint64_t bits =
      hashWith(hashWith(5, static_cast<std::uint64_t>(x)), static_cast<std::uint64_t>(y));
  return inside(x, y, static_cast<double>(bits >> 54) * 0x1p-5 - 16.0);
}

double bowl(std::int64_t x, std::int64_t y) {
  const double east = static_cast<double>(x) - 40.0, north = static_cast<double>(y) - 50.0;
  return -std::max(0.0, 8.0 - (east * east + north * north) / 128.0);
}

/// Both that a node's error is bounded and that the bound is worth something: at most three times as much, by
/// what joins to other nodes' vertices.
template <class Moved>
void expectBounds(const GroundSnapshot& snapshot, Moved moved, double worth) {
  for (int level = 1; (1 << level) <= kIntervals; ++level) {
    for (std::int64_t j = -1; j <= 3; ++j) {
      for (std::int64_t i = -1; i <= 3; ++i) {
        const double true_ = brute(level, i, j, moved), told = snapshot.moved(level, i, j);
        ASSERT_GE(told, true_ - 1e-5) << "level " << level << ", node " << i << ", " << j;
        ASSERT_LE(told, worth * true_ + 1e-4) << "level " << level << ", node " << i << ", " << j;
      }
    }
  }
  for (int level = 5; level <= kTop; ++level)
    ASSERT_GE(snapshot.moved(level, 0, 0), brute(level, 0, 0, moved));
}

TEST(GroundSnapshot, BoundsWhatEditsAddToTheErrorOfEveryNodeAboveLevelZero) {
  GroundOverrides overrides(kIntervals);
  move(overrides, rough);
  expectBounds(GroundSnapshot(overrides.share(), kTop), rough, 3.0);
}

TEST(GroundSnapshot, BoundsWhatAHeapHereAndAHoleThereAddWhereSquaresAreLargerThanPatches) {
  // A corner of the squares of every level is heaped up, the rest of one of them dug out.
  const auto both = [](std::int64_t x, std::int64_t y) {
    if (x == 0 && y == 0) return 5.0;
    return inside(x, y, x >= 35 && x < 38 && y >= 3 && y < 6 ? -5.0 : 0.0);
  };
  GroundOverrides overrides(kIntervals);
  move(overrides, both);
  const GroundSnapshot snapshot(overrides.share(), 8);
  for (int level = 5; level <= 8; ++level) {
    const double off = brute(level, 0, 0, both);
    EXPECT_GE(snapshot.moved(level, 0, 0), off) << level;
    EXPECT_GT(off, level > 6 ? 7.0 : 0.0) << "or it is no trial";
  }
}

TEST(GroundSnapshot, TellsThatSmoothHolesAreDrawnWellByCoarserLevels) {
  GroundOverrides overrides(kIntervals);
  move(overrides, bowl);
  const GroundSnapshot snapshot(overrides.share(), kTop);
  const auto worst = [&](int level) {
    double most = 0.0;
    for (std::int64_t j = -1; j <= 6; ++j) {
      for (std::int64_t i = -1; i <= 6; ++i) most = std::max(most, snapshot.moved(level, i, j));
    }
    return most;
  };
  EXPECT_LT(worst(1), 0.6) << "the rim's edge is the worst of it";
  EXPECT_LT(worst(2), 1.2);
  EXPECT_GE(worst(5), 8.0) << "nobody sees it from there";
  for (int level = 1; level < kTop; ++level) EXPECT_LE(worst(level), worst(level + 1)) << level;
}

TEST(GroundSnapshot, MeasuresAgainWhatHasChangedAlone) {
  GroundOverrides overrides(kIntervals);
  move(overrides, bowl);
  const GroundSnapshot before(overrides.share(), kTop);
  const auto both = [](std::int64_t x, std::int64_t y) {
    const bool isDeeper = x >= 30 && x <= 33 && y >= 60 && y <= 65;
    return bowl(x, y) - (isDeeper ? 3.0 : 0.0);
  };
  move(overrides, both);
  const GroundSnapshot after(overrides.share(), kTop, &before), fresh(overrides.share(), kTop);
  int changed = 0;
  for (int level = 1; level <= kTop; ++level) {
    for (std::int64_t j = -1; j <= 6; ++j) {
      for (std::int64_t i = -1; i <= 6; ++i) {
        ASSERT_EQ(after.moved(level, i, j), fresh.moved(level, i, j)) << level << ": " << i << ", " << j;
        changed += after.moved(level, i, j) != before.moved(level, i, j);
      }
    }
  }
  EXPECT_GT(changed, 4);
  expectBounds(after, both, 3.0);
}

TEST(GroundOverridesTest, FindsTheSamplesOfALevelAlsoWhereMostPatchesHaveNone) {
  GroundOverrides overrides(4);
  HeightMap before(70, 60), heights(70, 60);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 70; ++x) {
      before(x, y) = 0.0F;
      heights(x, y) = (x / 9 + y / 7) % 3 == 0 ? 0.0F : static_cast<float>(1 + x + 100 * y);
    }
  }
  overrides.take(-37, -21, std::as_const(heights).view(), std::as_const(before).view());
  for (int level = 0; level <= 6; ++level) {
    for (const std::int64_t corner : {-9, -2, -1, 0, 1}) {
      HeightMap grid(11, 7);
      overrides.overlay(GroundOverrides::Over::world, level, corner, corner + 1, grid.view());
      for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 11; ++x) {
          const auto kept = overrides.sample((corner + x) << level, (corner + 1 + y) << level);
          ASSERT_EQ(grid(x, y), kept.value_or(0.0F)) << level << ": " << x << ", " << y;
        }
      }
    }
  }
}

TEST(GroundSnapshot, CountsWhatWasGivenBackAsChanged) {
  GroundOverrides overrides(kIntervals);
  move(overrides, bowl);
  move(overrides, [](std::int64_t, std::int64_t) { return 0.0; });
  const GroundSnapshot snapshot(overrides.share(), kTop);
  EXPECT_GT(snapshot.moved(1, 1, 1), 0.0);
  EXPECT_LT(snapshot.moved(1, 1, 1), 1e-4);
  EXPECT_EQ(snapshot.moved(1, -2, -2), 0.0);
}

}  // namespace
}  // namespace teren
