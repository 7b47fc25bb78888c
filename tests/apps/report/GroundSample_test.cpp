// Errors of drawn ground at random places, on scenes that are known.
#include "apps/report/GroundSample.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Engine.h"

#include "apps/report/DetailTable.h"
#include "apps/report/Statistics.h"
#include "tests/apps/report/SmallWorld.h"

namespace teren {
namespace {

using test::always;
using test::faultWorld;

constexpr double kPitch = 64.0;

/// A square of flat ground at a height [m], two triangles, of 64 x 64 patches around (0, 0).
/// With `morph`, every vertex lies `coarser` metres high on the next coarser surface.
std::shared_ptr<const Scene> plate(double height, const Morph& morph = {}, double coarser = 0.0) {
  auto mesh = std::make_shared<Mesh>();
  mesh->level = 6;
  mesh->nodeLevel = 6;
  mesh->originColumn = -1024;
  mesh->originRow = -1024;
  mesh->columns = mesh->rows = 32;
  TriangleIndices indices;
  for (int row = 0; row <= 32; ++row) {
    for (int column = 0; column <= 32; ++column) {
      mesh->vertices.push_back(
          {static_cast<std::int16_t>(column), static_cast<std::int16_t>(row), static_cast<float>(height)});
      mesh->vertices.back().setCoarser(6, static_cast<float>(coarser), 0, 0);
      if (row == 32 || column == 32) continue;
      const auto at = static_cast<std::uint32_t>(row * 33 + column);
      for (const std::uint32_t corner : {at, at + 1, at + 34, at, at + 34, at + 33})
        indices.push_back(corner);
    }
  }
  mesh->indices = std::make_shared<const TriangleIndices>(indices);
  mesh->minHeight = static_cast<float>(std::min(height, coarser));
  mesh->maxHeight = static_cast<float>(std::max(height, coarser));
  return std::make_shared<const Scene>(1, 2.0, std::vector<std::shared_ptr<const Mesh>>{mesh}, morph);
}

TEST(GroundSample, IsHalfByDistanceAndHalfByAreaAndHasLevelZeroHeights) {
  const auto world = faultWorld();
  const Position centre{.i = 3, .j = -2, .u = 0.5, .v = 0.25};
  const auto sample = sampleGround(*world, centre, 5000.0, 2000, 2, always);
  ASSERT_TRUE(sample);
  ASSERT_EQ(sample->places.size(), 4000U);
  EXPECT_EQ(sample->byDistance, 2000U);
  std::vector<double> byDistance, byArea;
  for (std::size_t k = 0; k < 4000; ++k) {
    const Offset way = offset(centre, sample->places[k], kPitch);
    const double distance = std::hypot(way.east, way.north);
    EXPECT_LT(distance, 5000.0 + 2.0 * kPitch);
    (k < sample->byDistance ? byDistance : byArea).push_back(distance);
  }
  EXPECT_NEAR(quantile(byDistance, 0.5), std::sqrt(kNearestPlace * 5000.0), 40.0);
  EXPECT_NEAR(quantile(byArea, 0.5), 5000.0 * std::sqrt(0.5), 120.0);
  for (const std::size_t k : {0U, 1U, 1234U, 3999U}) {
    EXPECT_EQ(sample->heights[k], world->query(sample->places[k]).drawn);
  }
}

TEST(GroundSample, FindsHowFarAPlateIsOff) {
  GroundSample sample;
  sample.distance = 1000.0;
  sample.byDistance = 2;
  for (const double east : {30.0, 400.0, 500.0, 600.0}) {
    sample.places.push_back(*Position::fromMetres(east, 0.0, kPitch));
    sample.heights.push_back(0.0);
  }
  sample.heights[3] = 7.0;
  sample.places.push_back(*Position::fromMetres(1e6, 0.0, kPitch));  // where nothing is drawn
  sample.heights.push_back(0.0);
  const std::vector<float> promised{2.5F};
  const SceneQuery query(plate(2.0), 32, promised);
  const Eye eye{.position = *Position::fromMetres(0.0, 0.0, kPitch), .height = 40.0, .lensPixels = 500.0};
  const SurfaceErrors errors = errorsOf(query, sample, eye, kPitch);
  EXPECT_EQ(errors.places, 4U);
  ASSERT_EQ(errors.pixels.size(), 2U);
  EXPECT_NEAR(errors.pixels[0], 2.0 / 50.0 * 500.0, 1e-9) << "30 m away and 40 m below: 50 m";
  EXPECT_NEAR(errors.maxPixels, errors.pixels[0], 1e-9);
  ASSERT_EQ(errors.metres.size(), 2U);
  EXPECT_NEAR(errors.metres[0], 2.0, 1e-9);
  EXPECT_NEAR(errors.maxMetres, 5.0, 1e-9);
  EXPECT_EQ(errors.beyondPromise, 1U) << "5 m where 2.5 m are promised";
  EXPECT_EQ(errors.finest, 0U);
}

TEST(GroundSample, FindsHowFarAPlateIsOffThatMovesWithDistance) {
  GroundSample sample;
  sample.byDistance = 1;
  for (const double east : {20.0, 1500.0}) {
    sample.places.push_back(*Position::fromMetres(east, 0.0, kPitch));
    sample.heights.push_back(0.0);
  }
  // From 400 m on a vertex leaves the height of 2 m, and at 800 m it has come to 7 m.
  std::vector<double> errors(8, 1.0);
  errors[6] = 2.0;
  errors[7] = 8.0;
  const Morph morph(0.01, errors);
  const std::vector<float> promised{2.5F};
  const SceneQuery query(plate(2.0, morph, 7.0), 32, promised);
  const Eye eye{.position = *Position::fromMetres(0.0, 0.0, kPitch), .height = 2.0, .lensPixels = 500.0};
  const SurfaceErrors found = errorsOf(query, sample, eye, kPitch);
  ASSERT_EQ(found.places, 2U);
  EXPECT_NEAR(found.pixels.at(0), 2.0 / std::hypot(20.0, 2.0) * 500.0, 1e-6) << "near by nothing has moved";
  EXPECT_NEAR(found.metres.at(0), 7.0, 1e-5) << "far away all of the way";
  EXPECT_EQ(found.beyondPromise, 0U) << "what it has moved is part of the promise";
}

TEST(GroundSample, FindsNothingWrongWithLevelZero) {
  const auto world = faultWorld();
  EngineOptions options;
  options.view = {.level = 0, .radius = 3};
  auto engine = Engine::create(world, options);
  ASSERT_TRUE(engine);
  struct Standing final : Object {
    void update(double, const Ground&) override {}
    Motion motion() const override { return {.position = {}, .height = 50.0}; }
  };
  (*engine)->add(std::make_unique<Standing>());
  (*engine)->settle();
  const auto sample = sampleGround(*world, {}, 120.0, 200, 4, always);
  const SurfaceErrors errors =
      errorsOf(*(*engine)->sceneQuery(), *sample, {.height = 50.0, .lensPixels = 800.0}, kPitch);
  EXPECT_EQ(errors.places, sample->places.size());
  EXPECT_EQ(errors.finest, errors.places);
  EXPECT_LT(errors.maxMetres, 1e-9);
  EXPECT_EQ(errors.beyondPromise, 0U);
}

TEST(DetailTable, PromisesWhatIsTrue) {
  const auto world = faultWorld();
  Effort effort = Effort::ofAMinute();
  effort.detailDistances = {1e6, 1500.0};
  effort.detailCap = std::size_t{256} << 20U;
  effort.detailPlaces = 300;
  effort.repetitions = 3;
  ASSERT_TRUE(calibrate(world, always));
  const std::vector<double> wanted{4.0, 16.0};
  const auto table = measureDetail(world, wanted, effort, always);
  ASSERT_TRUE(table) << table.error().message;
  ASSERT_EQ(table->rows().size(), 2U);
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_EQ(table->number(row, "view distance"), 1500.0)
        << "the farther one does not fit, and the usual one is not nearer";
    EXPECT_GT(table->number(row, "true max"), 0.0);
    EXPECT_GE(table->number(row, "true max"), table->number(row, "true p99"));
    EXPECT_GE(table->number(row, "true p99"), table->number(row, "true RMS"));
    EXPECT_GE(table->number(row, "true max m"), table->number(row, "true p99 m"));
    EXPECT_LE(table->number(row, "true max"), table->number(row, "promised max"));
    EXPECT_LT(table->number(row, "beyond promise"), 0.2);
    EXPECT_LT(table->number(row, "finest places"), 100.0);
    EXPECT_GT(table->number(row, "time to fill"), 0.0);
    EXPECT_GT(table->number(row, "choosing median"), 0.0);
    EXPECT_GT(table->number(row, "places"), 4700.0) << "a few lie just beyond the view";
  }
  EXPECT_GT(table->number(0, "triangles"), table->number(1, "triangles"));
  EXPECT_LT(table->number(0, "true max"), table->number(1, "true max"));
}

TEST(DetailTable, SaysThatNothingFits) {
  const auto world = faultWorld();
  Effort effort = Effort::ofAMinute();
  effort.detailDistances = {2e5, 1e5};
  effort.detailCap = std::size_t{32} << 20U;
  const std::vector<double> wanted{0.25};
  const auto table = measureDetail(world, wanted, effort, always);
  ASSERT_FALSE(table);
}

}  // namespace
}  // namespace teren
