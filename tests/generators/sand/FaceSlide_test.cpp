#include "generators/sand/FaceSlide.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "generators/numbers/Tangent.h"
#include "tests/generators/sand/Faces.h"

namespace teren {
namespace {

constexpr double kStep = 0x1p-10;  // [m]
const Repose kDry = reposeOf();

int trials(int usual) {
  return std::getenv("TEREN_FULL") != nullptr ? 100 * usual : usual;
}

/// Faces of all kinds: n picks the kind.
Face anyFace(RandomSequence& random, int n) {
  switch (n % 5) {
    case 0:
      return randomFace(random, 12, 40, 0);
    case 1:
      return randomFace(random, 12, 40, 3);
    case 2:
      return randomFace(random, 28, 51, 4);
    case 3:
      return randomFace(random, 3, 32, 6);
    default:
      return sliver(random, 12, 34);
  }
}

SixfoldVolume weighed(const Face& face) {
  SixfoldVolume sum = 0;
  for (const FaceCorner& corner : face) sum += static_cast<WideInteger>(corner.weight) * corner.height;
  return sum;
}

std::int64_t heaviest(const Face& face) {
  return std::max({face[0].weight, face[1].weight, face[2].weight});
}

TEST(FaceSlide, KeepsTheVolumeExactlyButForAnAccountOfHalfTheHeaviestWeight) {
  RandomSequence random(1);
  VolumeLedger ledger;
  std::int64_t heaviestMoved = 0;
  SixfoldVolume moved = 0;
  for (int n = 0; n < trials(200'000); ++n) {
    Face face = anyFace(random, n);
    const SixfoldVolume owedBefore = ledger.owed(), before = weighed(face);
    const auto move = slideFace(face, kDry, kStep, ledger);
    if (!move) continue;
    apply(face, *move, ledger);
    moved += *move != FaceMove{} ? 1 : 0;
    heaviestMoved = std::max(heaviestMoved, heaviest(face));
    ASSERT_TRUE(weighed(face) + ledger.owed() == before + owedBefore) << n;
    const SixfoldVolume owed = ledger.owed() < 0 ? -ledger.owed() : ledger.owed();
    ASSERT_TRUE(2 * owed <= heaviestMoved) << n;
  }
  EXPECT_TRUE(moved > trials(200'000) / 2);
}

TEST(FaceSlide, LowersTheEnergyInEveryMove) {
  RandomSequence random(2);
  VolumeLedger ledger;
  for (int n = 0; n < trials(200'000); ++n) {
    Face face = anyFace(random, n);
    const auto move = slideFace(face, kDry, kStep, ledger);
    if (!move) continue;
    ASSERT_LT(energyChange(face, *move), 0.0) << n;
    apply(face, *move, ledger);
  }
}

TEST(FaceSlide, NeverTakesMoreThanIsLoose) {
  RandomSequence random(3);
  VolumeLedger ledger;
  int bounded = 0;
  for (int n = 0; n < trials(200'000); ++n) {
    Face face = anyFace(random, n);
    const auto move = slideFace(face, kDry, kStep, ledger);
    if (!move) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      if (face[i].loose <= kBareTicks) {
        ASSERT_GE((*move)[i], 0) << n;
      }
      ASSERT_GE(face[i].loose + (*move)[i], 0) << n;
      bounded += face[i].loose + (*move)[i] < 10 ? 1 : 0;
    }
    apply(face, *move, ledger);
  }
  EXPECT_GT(bounded, 1000);  // the bound was reached, not only kept
}

TEST(FaceSlide, BringsAFaceThatMayMoveToRestAtOnce) {
  RandomSequence random(4);
  VolumeLedger ledger;
  int slid = 0;
  for (int n = 0; n < trials(100'000); ++n) {
    Face face = n % 2 == 0 ? randomFace(random, 12, 36, 0) : sliver(random, 12, 34);
    for (FaceCorner& corner : face) corner.loose = kHighestTick;
    if (!(slopeOf(face, kStep) > kDry.start)) continue;
    const auto move = slideFace(face, kDry, kStep, ledger);
    ASSERT_TRUE(move) << n;
    apply(face, *move, ledger);
    ASSERT_NEAR(slopeOf(face, kStep), kDry.rest, 0.1 * (kDry.start - kDry.rest)) << n;
    ++slid;
  }
  EXPECT_GT(slid, trials(50'000));
}

TEST(FaceSlide, ComesToRestHoweverBareItsCorners) {
  RandomSequence random(5);
  VolumeLedger ledger;
  for (int n = 0; n < trials(100'000); ++n) {
    Face face = anyFace(random, n);
    int moves = 0;
    while (const auto move = slideFace(face, kDry, kStep, ledger)) {
      apply(face, *move, ledger);
      ASSERT_LT(++moves, 200) << n;
    }
    if (isLoose(face) && n % 5 < 2) {
      ASSERT_LE(slopeOf(face, kStep), tangentOfDegrees(kDryRepose + kReposeTolerance)) << n;
    }
  }
}

TEST(FaceSlide, LetsLooseMaterialOnABareSlopeGoDown) {
  VolumeLedger ledger;
  const std::int64_t metre = ticksFromMetres(1.0);
  Face face{FaceCorner{{0, 0}, 3 * metre, 0, 4'000'000},
            FaceCorner{{1024, 0}, 2 * metre, metre / 2, 4'000'000}, FaceCorner{{0, 1024}, 0, 0, 4'000'000}};
  const auto move = slideFace(face, kDry, kStep, ledger);
  ASSERT_TRUE(move);
  EXPECT_EQ((*move)[0], 0);
  EXPECT_LT((*move)[1], -metre / 4);
  EXPECT_EQ((*move)[2], -(*move)[1]);
}

TEST(FaceSlide, LeavesFacesThatLieAlone) {
  VolumeLedger ledger;
  const auto rise = [](double degrees) { return ticksFromMetres(tangentOfDegrees(degrees)); };
  Face face{FaceCorner{{0, 0}, 0, kHighestTick, 4'000'000},
            FaceCorner{{1024, 0}, rise(30.04), kHighestTick, 4'000'000},
            FaceCorner{{0, 1024}, 0, kHighestTick, 4'000'000}};
  EXPECT_FALSE(slideFace(face, kDry, kStep, ledger));
  face[1].height = rise(30.06);
  EXPECT_TRUE(slideFace(face, kDry, kStep, ledger));
  EXPECT_FALSE(slideFace(face, reposeOf(30.0, 0.1), kStep, ledger)) << "moist sand lies steeper";
}

TEST(FaceSlide, MeasuresSlopesOfSliversAsWellAsAnyOthers) {
  RandomSequence random(6);
  for (int n = 0; n < trials(20'000); ++n) {
    const Face face = n % 2 == 0 ? sliver(random, 26, 50) : randomFace(random, 27, 50, 0);
    const long double x1 = face[1].place.x - face[0].place.x, y1 = face[1].place.y - face[0].place.y;
    const long double x2 = face[2].place.x - face[0].place.x, y2 = face[2].place.y - face[0].place.y;
    const WideInteger h1 = face[1].height - face[0].height, h2 = face[2].height - face[0].height;
    const long double gx = static_cast<long double>(h1 * (face[2].place.y - face[0].place.y) -
                                                    h2 * (face[1].place.y - face[0].place.y));
    const long double gy = static_cast<long double>(h2 * (face[1].place.x - face[0].place.x) -
                                                    h1 * (face[2].place.x - face[0].place.x));
    const long double exact = std::sqrt(gx * gx + gy * gy) / (x1 * y2 - x2 * y1) * 0x1p-38L / 0x1p-10L;
    ASSERT_NEAR(static_cast<double>(slopeOf(face, kStep) / exact), 1.0, 1e-14) << n;
  }
}

TEST(Repose, IsThirtyDegreesForDrySandAndRisesWithMoisture) {
  EXPECT_EQ(reposeOf().start, tangentOfDegrees(30.0 + kSlideThreshold));
  EXPECT_EQ(reposeOf(30.0, 1.0).start, tangentOfDegrees(45.0 + kSlideThreshold));
  EXPECT_LT(reposeOf().rest, tangentOfDegrees(30.0));
  EXPECT_EQ(reposeOf(-5.0), reposeOf(1.0));
  EXPECT_EQ(reposeOf(std::nan(""), std::nan("")), reposeOf());
  EXPECT_LT(reposeOf(60.0, 1e9).start, tangentOfDegrees(76.0));
}

}  // namespace
}  // namespace teren
