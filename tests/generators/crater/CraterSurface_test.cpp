#include "generators/crater/CraterSurface.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

constexpr DeformRegion kRegion{.columns = 3, .rows = 2, .intervals = 32, .spacing = 2.0};
constexpr std::uint64_t kEnd = std::numeric_limits<std::uint64_t>::max();

HeightMap hills() {
  HeightMap map(kRegion.sampleColumns(), kRegion.sampleRows());
  RandomSequence random(5);
  for (int y = 0; y < map.rows(); ++y) {
    for (int x = 0; x < map.columns(); ++x) {
      map(x, y) =
          0.03F * static_cast<float>((x - 40) * (y - 30)) + 1e-3F * static_cast<float>(random.nextBits(10));
    }
  }
  return map;
}

Stamp stamp(const std::string& tool, double east, double north, double size, double depth) {
  static constexpr std::string_view kTools[] = {"crater", "smooth"};
  static constexpr Parameter table[] = {Parameter::choice("tool", "crater", kTools, ""),
                                        Parameter::real("rim", kCraterRim, 0.0, 1.0, "", ""),
                                        Parameter::real("irregularity", 0.1, 0.0, 0.25, "", "")};
  return {.east = east,
          .north = north,
          .size = size,
          .depth = depth,
          .seed = 9,
          .values = Values::check(table, std::array{Values::Entry("tool", tool)}, "crater").value()};
}

HeightMap heights(LiveSurface& surface) {
  HeightMap map(kRegion.sampleColumns(), kRegion.sampleRows());
  surface.snapshot()->samples({0, 0, map.columns(), map.rows()}, map.view());
  return map;
}

TEST(CraterSurface, DigsACraterAtOnceIntoTheGroundAsItLies) {
  const HeightMap ground = hills();
  CraterSurface surface(kRegion, ground.view());
  ASSERT_TRUE(surface.apply(stamp("crater", 90.0, 64.0, 12.0, 4.0)).ok());
  EXPECT_TRUE(surface.atRest());
  EXPECT_EQ(surface.steps(), 0U);
  const HeightMap after = heights(surface);
  EXPECT_EQ(after(45, 32), ground(45, 32) - 4.0F);
  const CraterShape shape(12.0, 4.0, kCraterRim, 0.1, 9);
  for (int y = 0; y < after.rows(); ++y) {
    for (int x = 0; x < after.columns(); ++x) {
      EXPECT_EQ(after(x, y), static_cast<float>(ground(x, y) + shape.height(2.0 * x - 90.0, 2.0 * y - 64.0)));
    }
  }
}

TEST(CraterSurface, IsGivenBackByTheMouldOfTheSameCrater) {
  const HeightMap ground = hills();
  CraterSurface surface(kRegion, ground.view());
  ASSERT_TRUE(surface.apply(stamp("crater", 91.0, 63.0, 12.0, 4.0)).ok());
  ASSERT_TRUE(surface.apply(stamp("crater", 91.0, 63.0, 12.0, -4.0)).ok());
  EXPECT_TRUE(test::sameBits(heights(surface).view(), ground.view()));
}

TEST(CraterSurface, SmoothsForAsManyStepsAsTheDepthAsksForAndRests) {
  CraterSurface surface(kRegion, hills().view());
  ASSERT_TRUE(surface.apply(stamp("smooth", 90.0, 64.0, 20.0, 7.0)).ok());
  EXPECT_FALSE(surface.atRest());
  EXPECT_TRUE(surface.step(Slice::unlimited(), 20));
  EXPECT_EQ(surface.steps(), 20U);
  EXPECT_FALSE(surface.atRest());
  EXPECT_TRUE(surface.step(Slice::unlimited(), kEnd));
  EXPECT_EQ(surface.steps(), 49U);  // 4 (7 / 2)^2
  EXPECT_TRUE(surface.atRest());
  EXPECT_TRUE(surface.step(Slice::unlimited(), kEnd));
  EXPECT_EQ(surface.steps(), 49U);
}

TEST(CraterSurface, GivesTheThreadBackAfterEveryRow) {
  CraterSurface surface(kRegion, hills().view());
  ASSERT_TRUE(surface.apply(stamp("smooth", 90.0, 64.0, 20.0, 2.0)).ok());
  int slices = 1;
  while (!surface.step(test::shortestSlice(), kEnd)) ++slices;
  EXPECT_EQ(slices, 4 * 21);
}

TEST(CraterSurface, DoesAStepOfEverySmoothingInItsOwnStep) {
  // Two that overlap: the second began after 3 steps, so it ends 3 steps later.
  CraterSurface surface(kRegion, hills().view());
  ASSERT_TRUE(surface.apply(stamp("smooth", 90.0, 64.0, 20.0, 4.0)).ok());
  ASSERT_TRUE(surface.step(Slice::unlimited(), 3));
  ASSERT_TRUE(surface.apply(stamp("smooth", 100.0, 64.0, 20.0, 4.0)).ok());
  EXPECT_TRUE(surface.step(Slice::unlimited(), kEnd));
  EXPECT_EQ(surface.steps(), 19U);
}

TEST(CraterSurface, GoesOnAfterGrowingAsIfItHadBegunSo) {
  constexpr DeformRegion kLarge{.i = -1, .j = -2, .columns = 5, .rows = 4, .intervals = 32, .spacing = 2.0};
  HeightMap ground(kLarge.sampleColumns(), kLarge.sampleRows());
  RandomSequence random(6);
  for (int y = 0; y < ground.rows(); ++y) {
    for (int x = 0; x < ground.columns(); ++x) ground(x, y) = 1e-3F * static_cast<float>(random.nextBits(14));
  }
  CraterSurface grown(kRegion, ground.view().part(32, 64, kRegion.sampleColumns(), kRegion.sampleRows()));
  CraterSurface large(kLarge, ground.view());
  const auto press = [&](const char* tool, double east, double north, double corner) {
    ASSERT_TRUE(grown.apply(stamp(tool, east - corner * 64.0, north - corner * 128.0, 12.0, 4.0)).ok());
    ASSERT_TRUE(large.apply(stamp(tool, east, north, 12.0, 4.0)).ok());
    ASSERT_TRUE(grown.step(Slice::unlimited(), kEnd));
    ASSERT_TRUE(large.step(Slice::unlimited(), kEnd));
  };
  press("crater", 154.5, 190.0, 1.0);
  press("smooth", 150.0, 184.0, 1.0);
  ASSERT_TRUE(grown.grow(kLarge, ground.view()).ok());
  EXPECT_EQ(grown.steps(), large.steps());
  for (const double east : {156.5, 70.0, 240.0}) {
    press("crater", east, 130.0, 0.0);
    press("smooth", east, 124.0, 0.0);
  }
  EXPECT_EQ(grown.steps(), large.steps());
  const auto all = [&](CraterSurface& surface) {
    HeightMap map(ground.columns(), ground.rows());
    surface.snapshot()->samples({0, 0, map.columns(), map.rows()}, map.view());
    return map;
  };
  EXPECT_TRUE(test::sameBits(all(grown).view(), all(large).view()));
  const SampleRectangle changed = grown.snapshot()->changed(), same = large.snapshot()->changed();
  EXPECT_EQ(changed.column, same.column);
  EXPECT_EQ(changed.row, same.row);
  EXPECT_EQ(changed.columns, same.columns);
  EXPECT_EQ(changed.rows, same.rows);
}

TEST(CraterSurface, TakesTheSamplesOfAnotherOneIn) {
  constexpr DeformRegion kBoth{.i = -3, .j = -1, .columns = 6, .rows = 3, .intervals = 32, .spacing = 2.0};
  constexpr DeformRegion kOther{.i = -3, .j = -1, .columns = 3, .rows = 2, .intervals = 32, .spacing = 2.0};
  const HeightMap ground = hills();
  HeightMap level(kBoth.sampleColumns(), kBoth.sampleRows());
  CraterSurface surface(kRegion, ground.view()), other(kOther, ground.view());
  ASSERT_TRUE(surface.apply(stamp("crater", 90.0, 64.0, 12.0, 4.0)).ok());
  ASSERT_TRUE(other.apply(stamp("crater", 80.0, 60.0, 9.0, 5.0)).ok());
  const HeightMap here = heights(surface), there = heights(other);
  LiveSurface* const others[] = {&other};
  ASSERT_TRUE(surface.merge(kBoth, level.view(), others).ok());
  HeightMap all(level.columns(), level.rows());
  surface.snapshot()->samples({0, 0, all.columns(), all.rows()}, all.view());
  EXPECT_EQ(all(96 + 45, 32 + 32), here(45, 32));
  EXPECT_EQ(all(40, 30), there(40, 30));
  EXPECT_EQ(all(40, 90), 0.0F);
}

TEST(CraterSurface, PutsAStampAfterTheStepThatHasBegun) {
  const auto after = [](bool within) {
    CraterSurface surface(kRegion, hills().view());
    EXPECT_TRUE(surface.apply(stamp("smooth", 90.0, 64.0, 20.0, 4.0)).ok());
    if (within) {
      for (int slice = 0; slice < 5; ++slice) EXPECT_FALSE(surface.step(test::shortestSlice(), kEnd));
      EXPECT_EQ(surface.steps(), 0U);
    } else {
      EXPECT_TRUE(surface.step(Slice::unlimited(), 1));
    }
    EXPECT_TRUE(surface.apply(stamp("crater", 90.0, 64.0, 10.0, 4.0)).ok());
    EXPECT_EQ(surface.steps(), 1U);
    EXPECT_TRUE(surface.step(Slice::unlimited(), kEnd));
    return heights(surface);
  };
  EXPECT_TRUE(test::sameBits(after(true).view(), after(false).view()));
}

TEST(CraterSurface, TellsWhatAStampMustBeLike) {
  CraterSurface surface(kRegion, hills().view());
  const auto sentence = [&](const Stamp& wrong) {
    const Result<void> applied = surface.apply(wrong);
    return applied ? std::string() : applied.error().message;
  };
  EXPECT_EQ(sentence(stamp("crater", 90.0, 64.0, 0.0, 1.0)),
            "size is 0 m, expected a radius above 0 and up to 1e+05 m");
  EXPECT_EQ(sentence(stamp("crater", 90.0, 64.0, 10.0, -10.5)),
            "depth is -10.5 m, expected at most the size up or down");
  EXPECT_EQ(sentence(stamp("smooth", 90.0, 64.0, 10.0, 10.5)),
            "depth is 10.5 m, expected how far to blur, above 0 and up to 10 m");
  EXPECT_EQ(sentence(stamp("smooth", 90.0, 64.0, 50.0, 33.0)),
            "depth is 33 m, expected how far to blur, above 0 and up to 32 m");
  EXPECT_EQ(sentence(stamp("smooth", 90.0, 20.0, 16.0, 3.0)),
            "the stamp 90 m east and 20 m north of its region's corner reaches 17 m, expected to keep 4 m "
            "inside the region's 192 m by 128 m");
  EXPECT_TRUE(surface.atRest());
}

TEST(CraterSurface, SharesRowsWithTheLastSnapshotThatHaveNotChanged) {
  CraterSurface surface(kRegion, hills().view());
  const std::size_t bytes = surface.bytes();
  const std::size_t samples =
      static_cast<std::size_t>(kRegion.sampleColumns()) * static_cast<std::size_t>(kRegion.sampleRows());
  EXPECT_GE(bytes, 12 * samples);
  EXPECT_LT(bytes, 14 * samples);
  const auto before = surface.snapshot();
  ASSERT_TRUE(surface.apply(stamp("crater", 90.0, 64.0, 5.0, 4.0)).ok());
  const auto after = surface.snapshot();
  EXPECT_TRUE(before->changed().isEmpty());
  EXPECT_NEAR(after->height(90.0, 64.0), before->height(90.0, 64.0) - 4.0, 1e-6);
  const SampleRectangle changed = after->changed();
  EXPECT_TRUE(changed.contains(45, 32));
  EXPECT_LE(changed.columns, 23);
  EXPECT_LE(changed.rows, 23);
}

}  // namespace
}  // namespace teren
