// Vertices that draw near to the next coarser level: laws 2 and 7 as the vertex shader keeps them, and what
// is seen when nodes change places.
#include "teren/Morph.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Engine.h"
#include "teren/Hash.h"
#include "teren/PixelError.h"

#include "tests/engine/stream/FaultWorld.h"
#include "tests/engine/stream/NodeErrorsWait.h"
#include "tests/engine/stream/SeenScene.h"
#include "world/NodeErrors.h"

namespace teren {
namespace {

using test::distanceTo, test::drawnHeight, test::placeOf, test::sceneSeenFrom;
using Place = test::SamplePlace;
using Point = test::EyePoint;

/// [0, 1)
double unit(RandomSequence& random) {
  return static_cast<double>(random.nextBits(53)) * 0x1p-53;
}

class Puppet final : public Object {
 public:
  void update(double, const Ground&) override {}
  Motion motion() const override { return place; }
  Motion place;
};

struct Flight {
  explicit Flight(double pixelError)
      : detail{.pixelError = pixelError, .distance = 3000.0},
        world(test::faultWorld(3, 17, {1024.0, 64.0}, 20)) {
    auto made = Engine::create(world, {.view = {.detail = detail}});
    EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().message);
    engine = std::move(*made);
    puppet = static_cast<Puppet*>(&engine->add(std::make_unique<Puppet>()));
  }
  void settleAt(const Point& eye) {
    puppet->place.position = *Position::fromMetres(eye.east, eye.north, world->pitch());
    puppet->place.height = eye.height;
    engine->settle();
  }
  double lens() const { return lensPixels(static_cast<int>(detail.lines), detail.fieldOfView); }

  DetailSettings detail;
  std::shared_ptr<const World> world;
  std::unique_ptr<Engine> engine;
  Puppet* puppet;
};

TEST(Morph, GoesOnlySoFarThatTheErrorStaysBelowWhatTheDistanceAllows) {
  const std::vector<double> errors{0.0, 0.3, 0.9, 1.1, 4.0, 3.5, 9.0};  // the promises may be out of order
  const Morph morph(0.002, errors);
  for (int level = 0; level < 6; ++level) {
    const auto own = static_cast<float>(errors[static_cast<std::size_t>(level)]);
    const float next = std::max(static_cast<float>(errors[static_cast<std::size_t>(level) + 1]), own);
    float before = 0.0F;
    for (float distance = 0.0F; distance < 6000.0F; distance += 7.0F) {
      const float allowed = 0.002F * distance, t = morph.share(level, distance);
      ASSERT_GE(t, before) << "level " << level << " at " << distance;
      before = t;
      ASSERT_TRUE(allowed > own * 0.9999F || t == 0.0F);
      ASSERT_TRUE(allowed < next * 1.0001F + 1e-5F || t == 1.0F);
      ASSERT_LE(t * next + (1.0F - t) * own, std::max(allowed, own) * 1.0001F + 1e-6F);
    }
  }
  EXPECT_EQ(morph.share(6, 1e6F), 0.0F);
  EXPECT_EQ(morph.share(SurfaceVertex::kFixed, 1e6F), 0.0F);
  EXPECT_EQ(Morph().share(0, 1e6F), 0.0F);
  EXPECT_EQ(Morph(0.0, errors).share(3, 1e6F), 0.0F);
}

TEST(Morph, PutsAVertexBetweenItsHeightsToTheRounding) {
  const Morph morph(0.002, std::vector<double>{0.0, 1.0, 3.0});
  RandomSequence random(8);
  int beyond = 0;
  for (int trial = 0; trial < 200'000; ++trial) {
    SurfaceVertex vertex;
    vertex.height = static_cast<float>(2000.0 * unit(random) - 1000.0);
    const float coarser = trial % 2 == 0 ? static_cast<float>(2000.0 * unit(random) - 1000.0)
                                         : std::nextafter(vertex.height, 2000.0F);
    vertex.setCoarser(trial % 3, coarser, 0, 0);
    const float drawn = morph.height(vertex, static_cast<float>(2000.0 * unit(random)));
    const auto [low, high] = std::minmax(vertex.height, coarser);
    const float rounding = kMorphRounding * std::max(std::fabs(low), std::fabs(high));
    ASSERT_GE(drawn, low - rounding);
    ASSERT_LE(drawn, high + rounding);
    beyond += drawn < low || drawn > high ? 1 : 0;
  }
  EXPECT_GT(beyond, 100) << "rounding does take them beyond";
}

TEST(Morph, MovesNothingInAViewOfOneLevel) {
  const auto world = test::faultWorld(3, 17, {1024.0, 64.0}, 20);
  auto engine = Engine::create(world, {.view = {.level = 1, .radius = 2}});
  ASSERT_TRUE(engine.ok());
  (*engine)->add(std::make_unique<Puppet>());
  (*engine)->settle();
  EXPECT_EQ((*engine)->scene()->morph(), Morph());
  for (const auto& mesh : (*engine)->scene()->meshes()) {
    for (const SurfaceVertex& vertex : mesh->vertices) {
      ASSERT_EQ(vertex.level(), SurfaceVertex::kFixed);
      ASSERT_EQ(vertex.coarserHeight, vertex.height);
    }
  }
}

TEST(Morph, LeavesOneSurfaceWithoutCracksFromWhereverItIsSeen) {
  Flight flight(12.0);
  flight.settleAt({10.0, 20.0, 60.0});
  ASSERT_TRUE(test::measureNodeErrors(*flight.engine));
  flight.settleAt({12.0, 20.0, 60.0});
  const auto scene = flight.engine->scene();
  RandomSequence random(5);
  std::size_t moving = 0, between = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Point eye{4000.0 * unit(random) - 2000.0, 4000.0 * unit(random) - 2000.0, 400.0 * unit(random)};
    std::map<Place, std::pair<float, int>> drawn;
    for (const auto& mesh : scene->meshes()) {
      for (const SurfaceVertex& vertex : mesh->vertices) {
        const Place place = placeOf(*mesh, vertex);
        const float height = drawnHeight(*scene, eye, *mesh, vertex);
        ASSERT_GE(height, mesh->minHeight - 1e-3F);
        ASSERT_LE(height, mesh->maxHeight + 1e-3F);
        const auto [other, isNew] = drawn.emplace(place, std::pair(height, mesh->nodeLevel));
        ASSERT_TRUE(isNew ||
                    std::bit_cast<std::uint32_t>(other->second.first) == std::bit_cast<std::uint32_t>(height))
            << "at " << place.first << ", " << place.second << " seen from " << eye.east << ", " << eye.north;
        const bool moves = height != vertex.height && height != vertex.coarserHeight;
        moving += moves ? 1 : 0;
        between += moves && !isNew && other->second.second != mesh->nodeLevel ? 1 : 0;
      }
    }
  }
  EXPECT_GT(moving, 1000U);
  EXPECT_GT(between, 100U) << "vertices between levels";
}

TEST(Morph, ShowsNoMoreErrorThanIsTold) {
  Flight flight(12.0);
  const Point eye{10.0, 20.0, 60.0};
  flight.settleAt(eye);
  ASSERT_TRUE(test::measureNodeErrors(*flight.engine));
  flight.settleAt(eye);
  const auto scene = flight.engine->scene();
  const Eye camera{flight.puppet->place.position, eye.height, flight.lens()};
  const PixelError told = pixelError(*flight.world, *scene, camera);
  EXPECT_LE(told.max,
            1.3 * 12.0);  // choosing takes all nodes of a level for equal, telling goes by their bend
  // Of every vertex, what is promised for where it is drawn.
  std::size_t more = 0;
  for (const auto& mesh : scene->meshes()) {
    const double own = drawnError(*flight.world, *mesh),
                 of = pixelError(*flight.world, *mesh, camera, scene->morph());
    EXPECT_LE(of, told.max);
    more += of > pixelError(*flight.world, *mesh, camera) * 1.01 ? 1 : 0;
    if (mesh->nodeLevel == flight.world->topLevel()) continue;
    const double next = std::max(own, flight.world->nodeErrors().estimate(mesh->nodeLevel + 1));
    for (const SurfaceVertex& vertex : mesh->vertices) {
      if (vertex.level() != mesh->nodeLevel) continue;
      const float distance = distanceTo(*scene, eye, placeOf(*mesh, vertex), vertex.height);
      const auto t = static_cast<double>(scene->morph().share(vertex.level(), distance));
      ASSERT_LE((own + t * (next - own)) / static_cast<double>(distance) * flight.lens(), of * 1.0001);
    }
  }
  EXPECT_GT(more, scene->meshes().size() / 10) << "meshes that are more wrong for having moved";
  Eye high = camera;
  high.height += 3000.0;
  double most = 0.0, unmoved = 0.0;
  for (const auto& mesh : scene->meshes()) {
    most = std::max(most, pixelError(*flight.world, *mesh, high, scene->morph()));
    unmoved = std::max(unmoved, pixelError(*flight.world, *mesh, high));
  }
  EXPECT_EQ(pixelError(*flight.world, *scene, high).max, most);
  EXPECT_GT(most, 1.05 * unmoved) << "seen from above all have moved";
  // And the truth at random places.
  const SceneQuery query(sceneSeenFrom(*scene, eye), flight.world->intervals());
  RandomSequence random(6);
  std::size_t seen = 0;
  double worst = 0.0;
  for (int trial = 0; trial < 4000; ++trial) {
    const double reach = 2800.0 * unit(random), angle = 6.2831853 * unit(random);
    const double east = eye.east + reach * std::cos(angle), north = eye.north + reach * std::sin(angle);
    const Position position = *Position::fromMetres(east, north, flight.world->pitch());
    DrawnPoint point;
    query.points({&position, 1}, {&point, 1});
    if (!point.there) continue;
    ++seen;
    const double gap = std::fabs(point.height - flight.world->query(position).drawn);
    const double up = point.height - eye.height;
    worst = std::max(worst, gap / std::max(std::sqrt(reach * reach + up * up), 1.0) * flight.lens());
  }
  EXPECT_GT(seen, 3000U);
  EXPECT_LE(worst, told.max);
  EXPECT_GT(worst, 0.1 * told.max);
}

TEST(Morph, OfAnotherEyeShowsNoMoreErrorThanIsTold) {
  Flight flight(12.0);
  const Point eye{10.0, 20.0, 60.0};
  flight.settleAt(eye);
  ASSERT_TRUE(test::measureNodeErrors(*flight.engine));
  flight.settleAt(eye);
  const auto scene = flight.engine->scene();
  const DetailEye movedWith{flight.puppet->place.position, eye.height};
  RandomSequence random(12);
  std::size_t beyondOneEye = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const Point camera{eye.east + 800.0 * unit(random) - 400.0, eye.north + 800.0 * unit(random) - 400.0,
                       120.0 * unit(random) - 40.0};
    const Eye looks{*Position::fromMetres(camera.east, camera.north, flight.world->pitch()), camera.height,
                    flight.lens()};
    double most = 0.0;
    for (const auto& mesh : scene->meshes()) {
      const double told = pixelError(*flight.world, *mesh, looks, scene->morph(), movedWith);
      const double ofOneEye = pixelError(*flight.world, *mesh, looks, scene->morph());
      most = std::max(most, told);
      if (mesh->nodeLevel == flight.world->topLevel()) continue;
      const double own = drawnError(*flight.world, *mesh);
      const double next = std::max(own, flight.world->nodeErrors().estimate(mesh->nodeLevel + 1));
      for (const SurfaceVertex& vertex : mesh->vertices) {
        if (vertex.level() != mesh->nodeLevel) continue;
        const Place place = placeOf(*mesh, vertex);
        const auto t = static_cast<double>(
            scene->morph().share(vertex.level(), distanceTo(*scene, eye, place, vertex.height)));
        const double away =
            std::max(static_cast<double>(distanceTo(*scene, camera, place, vertex.height)), kNearestGround);
        const double seen = (own + t * (next - own)) / away * flight.lens();
        ASSERT_LE(seen, told * 1.0001 + 1e-9);
        beyondOneEye += seen > 1.01 * ofOneEye ? 1 : 0;
      }
    }
    EXPECT_EQ(pixelError(*flight.world, *scene, looks, movedWith).max, most);
  }
  EXPECT_GT(beyondOneEye, 1000U) << "more than if vertices moved with the camera";
  // An eye beside it tells what the eye itself does.
  const Eye itself{movedWith.position, movedWith.height, flight.lens()};
  Eye beside = itself;
  beside.height += 0.01;
  EXPECT_NEAR(pixelError(*flight.world, *scene, beside, movedWith).max,
              pixelError(*flight.world, *scene, itself).max, 0.01);
}

/// [px] by how much two scenes differ at the vertices of the first that are not in both, as an eye sees them.
std::vector<double> differences(const Scene& from, const Scene& to, const Point& eye, const Flight& flight) {
  const SceneQuery query(std::make_shared<const Scene>(to), flight.world->intervals());
  std::vector<double> pixels;
  for (const auto& mesh : from.meshes()) {
    for (const SurfaceVertex& vertex : mesh->vertices) {
      const Place place = placeOf(*mesh, vertex);
      const Position position =
          *Position::fromMetres(static_cast<double>(place.first) * from.spacing(),
                                static_cast<double>(place.second) * from.spacing(), flight.world->pitch());
      DrawnPoint point;
      query.points({&position, 1}, {&point, 1});
      if (!point.there) continue;
      const double gap = std::fabs(point.height - static_cast<double>(vertex.height));
      const auto distance = static_cast<double>(distanceTo(from, eye, place, vertex.height));
      if (gap > 0.0) pixels.push_back(gap / distance * flight.lens());
    }
  }
  return pixels;
}

TEST(Morph, LetsNothingJumpByMoreThanThePixelErrorWhenNodesChangePlaces) {
  constexpr double kWanted = 12.0;
  Flight flight(kWanted);
  Point eye{10.0, 20.0, 60.0};
  flight.settleAt(eye);
  ASSERT_TRUE(test::measureNodeErrors(*flight.engine));
  flight.settleAt(eye);
  std::vector<double> jumps, without;
  auto before = flight.engine->scene();
  for (int step = 0; step < 60; ++step) {
    eye.east += step < 30 ? 20.0 : -20.0;  // there and back: splits and merges on both sides
    eye.north += 3.0;
    flight.settleAt(eye);
    const auto after = flight.engine->scene();
    if (after->serial() == before->serial()) continue;
    const auto compare = [&](const Scene& a, const Scene& b, std::vector<double>& all) {
      for (const auto& pixels : {differences(a, b, eye, flight), differences(b, a, eye, flight)}) {
        all.insert(all.end(), pixels.begin(), pixels.end());
      }
    };
    compare(*sceneSeenFrom(*before, eye), *sceneSeenFrom(*after, eye), jumps);
    compare(*before, *after, without);
    before = after;
  }
  ASSERT_GT(without.size(), 1000U);
  ASSERT_FALSE(jumps.empty());
  const auto most = [](const std::vector<double>& all) { return *std::max_element(all.begin(), all.end()); };
  const auto square = [](const std::vector<double>& all) {
    double sum = 0.0;
    for (const double value : all) sum += value * value;
    return sum;
  };
  const double mean = std::sqrt(square(jumps) / static_cast<double>(without.size()));
  const double meanWithout = std::sqrt(square(without) / static_cast<double>(without.size()));
  EXPECT_LE(most(jumps), kWanted);
  EXPECT_GT(most(without), 1.3 * most(jumps));
  EXPECT_LT(mean, 0.25 * meanWithout);
}

}  // namespace
}  // namespace teren
