#include "teren/ContinuousGenerator.h"

#include <limits>

#include <gtest/gtest.h>

#include "teren/RowTask.h"

#include "tests/engine/world/HashNoise.h"

namespace teren {
namespace {

/// Remembers what it was asked for.
class Asked : public ContinuousGenerator {
 public:
  HeightRange range() const override { return {}; }
  double residual(int, int, double) const override { return 0.0; }
  double fieldError(double) const override { return 0.0; }
  std::unique_ptr<GenerationTask> beginField(const FieldRequest& request, HeightView out) const override {
    last = request;
    return makeRowTask(out, [](int) {});
  }
  mutable FieldRequest last;
};

FieldRequest fieldOf(const MapRequest& map) {
  const Asked asked;
  HeightMap out(map.samples, map.samples);
  asked.begin(map, out.view());
  return asked.last;
}

TEST(ContinuousGenerator, MakesMapsOfThePitchAroundTheirLatticePoint) {
  // A pitch of 64 m in 32 intervals, so the finest map has 65 samples; at level 2 it has 17.
  const FieldRequest field = fieldOf(
      {.i = 7, .j = -3, .seed = 99, .samples = 17, .level = 2, .spacing = 8.0, .finestIntervals = 64});
  EXPECT_EQ(field.i, 6);
  EXPECT_EQ(field.j, -4);
  EXPECT_EQ(field.u, 0.0);
  EXPECT_EQ(field.v, 0.0);
  EXPECT_EQ(field.seed, 99U);
  EXPECT_EQ(field.pitch, 64.0);
  EXPECT_EQ(field.spacing, 8.0);
  EXPECT_EQ(field.columns, 17);
  EXPECT_EQ(field.rows, 17);
  EXPECT_EQ(field.level, 2);
}

TEST(ContinuousGenerator, MakesAMapOfOneSampleAtItsLatticePoint) {
  const FieldRequest field =
      fieldOf({.i = 7, .j = -3, .samples = 1, .level = 6, .spacing = 128.0, .finestIntervals = 64});
  EXPECT_EQ(field.i, 7);
  EXPECT_EQ(field.j, -3);
  EXPECT_EQ(field.columns, 1);
  EXPECT_EQ(field.pitch, 64.0);
}

TEST(ContinuousGenerator, TakesTheLastLatticePointsOfAll) {
  constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(fieldOf({.i = least, .samples = 65}).i, ~least);
}

TEST(ContinuousGenerator, IsFoundByItsTraits) {
  class Shy final : public Asked {
    Traits traits() const override { return {}; }
  };
  class Boaster final : public Generator {
   public:
    Traits traits() const override { return {.continuous = true}; }
    HeightRange range() const override { return {}; }
    double residual(int, int, double) const override { return 0.0; }
    std::unique_ptr<GenerationTask> begin(const MapRequest&, HeightView) const override { return nullptr; }
  };
  const Asked asked;
  EXPECT_EQ(asContinuous(asked), &asked);
  EXPECT_EQ(asContinuous(Shy()), nullptr);
  EXPECT_EQ(asContinuous(Boaster()), nullptr) << "it has no field to ask for";
  EXPECT_EQ(asContinuous(HashNoise(0.0, 1.0)), nullptr);
}

}  // namespace
}  // namespace teren
