#include "teren/Engine.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "height/Surface.h"
#include "tests/engine/stream/FaultWorld.h"
#include "tests/engine/stream/NodeErrorsWait.h"
#include "world/NodeErrors.h"

namespace teren {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

std::shared_ptr<const World> smallWorld() {
  return test::faultWorld(3, 17, {1024.0, 64.0}, 20);
}

/// Goes where it is told.
class Puppet final : public Object {
 public:
  explicit Puppet(Position position) { motion_.position = position; }
  void update(double, const Ground& ground) override { groundSeen = ground.height(motion_.position); }
  Motion motion() const override { return motion_; }
  void moveTo(const Position& position) { motion_.position = position; }
  void setVelocity(double east, double north) { motion_.east = east, motion_.north = north; }
  std::optional<double> groundSeen;

 private:
  Motion motion_;
};

struct Flight {
  explicit Flight(int workers, ViewSettings view = {1, 2}, Position start = {}) : world(smallWorld()) {
    auto made = Engine::create(world, {.view = view, .workers = workers});
    EXPECT_TRUE(made.ok());
    engine = std::move(*made);
    puppet = static_cast<Puppet*>(&engine->add(std::make_unique<Puppet>(start)));
  }
  std::shared_ptr<const World> world;
  std::unique_ptr<Engine> engine;
  Puppet* puppet;
};

/// Every law of the engine holds with work in slices on the caller's thread as with workers.
class EngineWithWorkers : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Workers, EngineWithWorkers, testing::Values(0, 1, 3));

using Place = std::pair<std::int64_t, std::int64_t>;

/// Every square of the grid that the scene's triangles cover, and whether any is covered twice.
std::set<Place> coveredSquares(const Scene& scene, bool& twice) {
  std::map<Place, int> halves;
  for (const auto& mesh : scene.meshes()) {
    for (std::size_t k = 0; k < mesh->indices->size(); k += 3) {
      std::int64_t column = INT64_MAX, row = INT64_MAX;
      for (std::size_t c = 0; c < 3; ++c) {
        const SurfaceVertex& vertex = mesh->vertices[(*mesh->indices)[k + c]];
        column = std::min(column, mesh->originColumn + (std::int64_t{vertex.column} << mesh->level));
        row = std::min(row, mesh->originRow + (std::int64_t{vertex.row} << mesh->level));
      }
      ++halves[{column, row}];
    }
  }
  std::set<Place> squares;
  for (const auto& [square, count] : halves) {
    if (count != 2) twice = true;
    squares.insert(square);
  }
  return squares;
}

TEST_P(EngineWithWorkers, SettlesToAViewWithoutHoles) {
  Flight flight(GetParam());
  flight.engine->settle();
  const Scene& scene = *flight.engine->scene();
  EXPECT_EQ(flight.engine->figures().pending, 0U);
  EXPECT_EQ(flight.engine->figures().nodes, 25U);
  bool twice = false;
  const auto squares = coveredSquares(scene, twice);
  EXPECT_FALSE(twice);
  const std::int64_t n = flight.world->intervals();
  EXPECT_EQ(static_cast<std::int64_t>(squares.size()), (5 * n - 2) * (5 * n - 2));
  EXPECT_EQ(scene.triangles(), squares.size() * 2);
  EXPECT_EQ(flight.engine->figures().triangles, squares.size() * 2);
}

TEST_P(EngineWithWorkers, MeasuresTheWorldsNodeErrorsWhenAllIsThere) {
  Flight flight(GetParam());
  const NodeErrors& errors = flight.world->nodeErrors();
  EXPECT_LE(errors.nextToCalibrate(), errors.topLevel());
  flight.engine->settle();
  const auto scene = flight.engine->scene();
  EXPECT_TRUE(test::measureNodeErrors(*flight.engine));
  EXPECT_EQ(flight.engine->scene(), scene);
  for (const auto& mesh : scene->meshes()) {
    EXPECT_EQ(mesh->nodeLevel, flight.engine->options().view.level);
    EXPECT_GT(mesh->bend, 0.0F);
  }
  flight.engine->update(0.0, std::chrono::milliseconds(1));
  EXPECT_EQ(flight.engine->figures().unfinishedTasks, 0U);
}

TEST_P(EngineWithWorkers, NeverPublishesACrackBetweenDrawnNodes) {
  Flight flight(GetParam());
  flight.engine->settle();
  std::uint64_t serial = 0;
  int published = 0;
  // A winding path; tiny budgets, so that many snapshots are taken half way. Slow machines (and sanitizers)
  // fly on until they have shown as many.
  for (int step = 0; step < 400 || (published <= 20 && step < 20'000); ++step) {
    const double angle = 0.02 * step;
    const auto place = Position::fromMetres(4.0 * step, 300.0 * std::sin(angle), flight.world->pitch());
    flight.puppet->moveTo(*place);
    flight.engine->update(1.0 / 60.0, microseconds(30));
    const auto scene = flight.engine->scene();
    if (scene->serial() == serial) continue;
    serial = scene->serial();
    ++published;
    bool twice = false;
    const auto squares = coveredSquares(*scene, twice);
    ASSERT_FALSE(twice) << "overlap in step " << step;
    // A crack is an uncovered square whose western and eastern, or southern and northern, neighbours are
    // covered within the two strips of a seam.
    const std::int64_t stride = std::int64_t{1} << flight.engine->options().view.level;
    for (const auto& [column, row] : squares) {
      for (std::int64_t gap = 1; gap <= 2; ++gap) {
        const Place east{column + (gap + 1) * stride, row}, between{column + gap * stride, row};
        const Place north{column, row + (gap + 1) * stride}, above{column, row + gap * stride};
        ASSERT_FALSE(squares.contains(east) && !squares.contains(between)) << "crack in step " << step;
        ASSERT_FALSE(squares.contains(north) && !squares.contains(above)) << "crack in step " << step;
      }
    }
  }
  EXPECT_GT(published, 20);
}

TEST_P(EngineWithWorkers, ShowsTheSameSurfaceHoweverTheWorkWasSliced) {
  const auto surface = [](microseconds budget) {
    Flight flight(GetParam());
    while (flight.engine->figures().pending > 0 || flight.engine->scene()->serial() == 0) {
      flight.engine->update(0.0, budget);
    }
    std::map<std::tuple<std::int64_t, std::int64_t>, std::tuple<float, int, int>> vertices;
    for (const auto& mesh : flight.engine->scene()->meshes()) {
      for (const SurfaceVertex& vertex : mesh->vertices) {
        vertices[{mesh->originColumn + (std::int64_t{vertex.column} << mesh->level),
                  mesh->originRow + (std::int64_t{vertex.row} << mesh->level)}] = {
            vertex.height, vertex.normalX, vertex.normalY};
      }
    }
    return vertices;
  };
  const auto patient = surface(microseconds(1000000));
  EXPECT_EQ(patient, surface(microseconds(20)));
  EXPECT_FALSE(patient.empty());
}

TEST_P(EngineWithWorkers, DrawnHeightIsThatOfTheTrianglesInTheScene) {
  Flight flight(GetParam());
  flight.engine->settle();
  const double n = flight.world->intervals();
  int compared = 0;
  for (const auto& mesh : flight.engine->scene()->meshes()) {
    for (std::size_t k = 0; k < mesh->indices->size(); k += 3 * 17) {
      double column = 0.0, row = 0.0, height = 0.0;
      for (std::size_t c = 0; c < 3; ++c) {
        const SurfaceVertex& vertex = mesh->vertices[(*mesh->indices)[k + c]];
        column +=
            static_cast<double>(mesh->originColumn + (std::int64_t{vertex.column} << mesh->level)) / 3.0;
        row += static_cast<double>(mesh->originRow + (std::int64_t{vertex.row} << mesh->level)) / 3.0;
        height += vertex.height / 3.0;
      }
      const double pitch = flight.world->pitch();
      const auto position = Position::fromMetres(column / n * pitch, row / n * pitch, pitch);
      const auto drawn = flight.engine->drawnHeight(*position);
      ASSERT_TRUE(drawn.has_value());
      ASSERT_NEAR(*drawn, height, 1e-4);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST_P(EngineWithWorkers, KnowsNoHeightWhereNothingIsDrawn) {
  Flight flight(GetParam());
  EXPECT_FALSE(flight.engine->drawnHeight({}).has_value());
  EXPECT_FALSE(flight.engine->ground().height({}).has_value());
  flight.engine->settle();
  EXPECT_TRUE(flight.engine->drawnHeight({}).has_value());
  EXPECT_FALSE(flight.engine->drawnHeight({1000, 0, 0.5, 0.5}).has_value());
}

TEST_P(EngineWithWorkers, HasFinestGroundUnderEveryObject) {
  Flight flight(GetParam(), {3, 1});
  auto& second =
      static_cast<Puppet&>(flight.engine->add(std::make_unique<Puppet>(Position{5000, -70, 0.25, 0.75})));
  flight.engine->settle();
  flight.engine->update(0.0, milliseconds(1));
  ASSERT_TRUE(second.groundSeen.has_value());
  const double n = flight.world->intervals();
  // At a sample of level 0, the finest ground is the landscape's function itself.
  const Position sample{5000, -70, std::floor(0.25 * n) / n, std::floor(0.75 * n) / n};
  EXPECT_EQ(*flight.engine->ground().height(sample), static_cast<float>(flight.world->height(sample)));
}

TEST_P(EngineWithWorkers, KeepsFinestGroundWithTheBitsOfAQuery) {
  Flight flight(GetParam(), {3, 1}, {-7, 12, 0.4, 0.6});
  EXPECT_FALSE(flight.engine->finestHeight({-7, 12, 0.4, 0.6}).has_value());
  flight.engine->settle();
  EXPECT_FALSE(flight.engine->finestHeight({-4, 12, 0.4, 0.6}).has_value());  // drawn, but at level 3 only
  for (int k = 0; k < 200; ++k) {
    const Position place{-7, 12, k / 200.0, (k * 73 % 200) / 200.0};
    const auto finest = flight.engine->finestHeight(place);
    ASSERT_TRUE(finest.has_value());
    ASSERT_EQ(*finest, flight.world->query(place).drawn) << place.u << ", " << place.v;
  }
}

TEST_P(EngineWithWorkers, GroundIsNeitherBelowTheFinestNorBelowTheDrawnTriangles) {
  Flight flight(GetParam(), {3, 1});
  flight.engine->settle();
  for (int k = 0; k < 100; ++k) {
    const Position place{0, 0, k / 100.0, (99 - k) / 100.0};
    const auto ground = flight.engine->ground().height(place);
    const auto drawn = flight.engine->drawnHeight(place);
    ASSERT_TRUE(ground && drawn);
    EXPECT_GE(*ground, *drawn);
    EXPECT_GE(*ground, flight.world->query(place).drawn - 1e-6);
  }
}

TEST_P(EngineWithWorkers, PreparesTheGroundAheadOfAMovingObject) {
  Flight flight(GetParam(), {2, 1});
  flight.puppet->setVelocity(0.0, 400.0);
  flight.engine->settle();
  const double pitch = flight.world->pitch();
  const double n = flight.world->intervals();
  for (double north = 0.0; north <= 790.0; north += 64.0) {
    Position place = *Position::fromMetres(0.0, north, pitch);
    place.v = std::floor(place.v * n) / n;
    const auto ground = flight.engine->ground().height(place);
    ASSERT_TRUE(ground.has_value()) << north;
    EXPECT_GE(*ground, static_cast<double>(static_cast<float>(flight.world->height(place)))) << north;
  }
}

TEST_P(EngineWithWorkers, ForgetsWhatLiesFarBehind) {
  Flight flight(GetParam());
  flight.engine->settle();
  const std::size_t bytes = flight.engine->figures().bytes;
  for (int step = 1; step <= 40; ++step) {
    flight.puppet->moveTo({step * 4, 0, 0.5, 0.5});
    flight.engine->settle();
    EXPECT_LE(flight.engine->figures().nodes, 49U);
  }
  EXPECT_FALSE(flight.engine->drawnHeight({}).has_value());
  // Base maps stay for a while; a world of 17 samples a map and 40 steps makes less than two megabytes of
  // them.
  EXPECT_LT(flight.engine->figures().bytes, bytes + (std::size_t{2} << 20));
}

TEST_P(EngineWithWorkers, DrawsNothingBeyondTheViewThoughGroundIsKeptThere) {
  Flight flight(GetParam(), {0, 2});
  auto& second = static_cast<Puppet&>(flight.engine->add(std::make_unique<Puppet>(Position{1, 1, 0.5, 0.5})));
  flight.engine->settle();
  flight.puppet->moveTo({50, 0, 0.5, 0.5});
  flight.engine->settle();
  EXPECT_FALSE(flight.engine->drawnHeight(second.motion().position).has_value());
  EXPECT_TRUE(flight.engine->ground().height(second.motion().position).has_value());
  flight.puppet->moveTo({0, 0, 0.5, 0.5});
  flight.engine->settle();
  EXPECT_TRUE(flight.engine->drawnHeight(second.motion().position).has_value());
}

TEST_P(EngineWithWorkers, GoesOnAtTheWorldsEnd) {
  Flight flight(GetParam(), {1, 2}, Position{kMaxPatch - 1, -kMaxPatch, 0.5, 0.5});
  flight.engine->settle();
  EXPECT_EQ(flight.engine->figures().pending, 0U);
  flight.puppet->setVelocity(1e308, -1e308);
  flight.engine->update(0.1, milliseconds(1));
  flight.puppet->setVelocity(std::nan(""), 0.0);
  flight.engine->update(0.1, milliseconds(1));
}

TEST_P(EngineWithWorkers, DoesNothingButMoveObjectsWithAZeroBudget) {
  Flight flight(GetParam());
  flight.engine->update(0.1, milliseconds(0));
  EXPECT_EQ(flight.engine->figures().slices, 0U);
  EXPECT_EQ(flight.engine->scene()->serial(), 0U);
}

/// Who comes to another node may change what thousands of others are: to look at them is work like any other.
TEST_P(EngineWithWorkers, LooksThroughAViewAgainWithinTheBudget) {
  constexpr int kRadius = 12, kAcross = 2 * kRadius + 1;
  Flight flight(GetParam(), {0, kRadius}, {0, 0, 0.5, 0.5});
  flight.engine->settle();
  const std::size_t nodes = flight.engine->figures().nodes;
  EXPECT_EQ(flight.engine->figures().pending, 0U);
  flight.puppet->moveTo({1, 0, 0.5, 0.5});
  flight.engine->update(0.1, milliseconds(0));
  EXPECT_GT(flight.engine->figures().pending, std::size_t{kAcross * (kAcross - 4)});  // all but ground
  EXPECT_EQ(flight.engine->figures().nodes, nodes);
  flight.engine->settle();
  EXPECT_EQ(flight.engine->figures().pending, 0U);
  EXPECT_GE(flight.engine->figures().nodes, std::size_t{kAcross * kAcross});
  flight.puppet->moveTo({100, 0, 0.5, 0.5});  // what was begun to be looked at is of no account any more
  flight.engine->update(0.1, microseconds(1));
  flight.puppet->moveTo({1, 0, 0.5, 0.5});
  flight.engine->settle();
  EXPECT_EQ(flight.engine->figures().pending, 0U);
  EXPECT_TRUE(flight.engine->drawnHeight({-kRadius + 1, 0, 0.5, 0.5}).has_value());
}

TEST_P(EngineWithWorkers, StopsSettlingWhenProgressSaysSo) {
  Flight flight(GetParam(), {0, 60});
  std::size_t calls = 0;
  flight.engine->settle([&](std::size_t done, std::size_t wanted) {
    ++calls;
    EXPECT_LE(done, wanted);
    return false;
  });
  EXPECT_EQ(calls, 1U);
  EXPECT_GT(flight.engine->figures().pending, 0U);
}

TEST(Engine, RefusesViewsThatMakeNoSense) {
  const auto world = smallWorld();
  for (const ViewSettings view : {ViewSettings{-1, 2}, ViewSettings{world->topLevel() + 1, 2},
                                  ViewSettings{1, 0}, ViewSettings{1, 65}}) {
    EXPECT_FALSE(Engine::create(world, {.view = view}).ok()) << view.level << ", " << view.radius;
  }
}

TEST(Engine, RefusesWorkersAndCapsOutOfRange) {
  const auto world = smallWorld();
  for (const int workers : {-1, 65})
    EXPECT_FALSE(Engine::create(world, {.view = {1, 2}, .workers = workers}).ok());
  const auto tiny = Engine::create(world, {.view = {1, 2}, .capBytes = EngineOptions::kLeastCap - 1});
  ASSERT_FALSE(tiny.ok());
  EXPECT_NE(tiny.error().message.find("8388608"), std::string::npos) << tiny.error().message;
}

TEST(ViewSettings, ReachesAtLeastTheDistanceItsRadiusWasChosenFor) {
  const auto world = smallWorld();
  for (const double distance : {10.0, 128.0, 129.0, 1500.0}) {
    const ViewSettings view{1, ViewSettings::radiusFor(distance, 1, *world)};
    EXPECT_GE(view.reach(*world), distance);
    EXPECT_LT(view.reach(*world) - 128.0, std::max(distance, 128.0));
  }
}

TEST(Scene, DifferencesAreWhatARendererHasToChange) {
  const auto mesh = [](std::uint64_t id) {
    auto made = std::make_shared<Mesh>();
    made->id = id;
    made->indices = std::make_shared<TriangleIndices>();
    return std::shared_ptr<const Mesh>(made);
  };
  const auto one = mesh(1), two = mesh(2), three = mesh(3), five = mesh(5);
  const Scene before(1, 1.0, {one, two, five}), after(2, 1.0, {two, three});
  const SceneDifference change = difference(before, after);
  EXPECT_EQ(change.removed, (std::vector<std::uint64_t>{1, 5}));
  EXPECT_EQ(change.added, (std::vector<std::shared_ptr<const Mesh>>{three}));
  const SceneDifference back = difference(after, before);
  EXPECT_EQ(back.removed, (std::vector<std::uint64_t>{3}));
  EXPECT_EQ(back.added, (std::vector<std::shared_ptr<const Mesh>>{one, five}));
}

}  // namespace
}  // namespace teren
