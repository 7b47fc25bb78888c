// The engine with detail by error: laws 2, 4, 5 and 6 while somebody flies.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Engine.h"
#include "teren/PixelError.h"

#include "tests/engine/stream/FaultWorld.h"
#include "tests/engine/stream/NodeErrorsWait.h"
#include "tests/support/AllocationCount.h"

namespace teren {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr std::size_t kMiB = std::size_t{1} << 20;

class Puppet final : public Object {
 public:
  void update(double, const Ground&) override {}
  Motion motion() const override { return place; }
  Motion place;
};

struct DetailFlight {
  explicit DetailFlight(int workers, DetailSettings detail = {.pixelError = 30.0, .distance = 3000.0},
                        std::size_t cap = 512 * kMiB)
      : world(test::faultWorld(3, 17, {1024.0, 64.0}, 20)) {
    auto made = Engine::create(world, {.view = {.detail = detail}, .workers = workers, .capBytes = cap});
    EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().message);
    engine = std::move(*made);
    puppet = static_cast<Puppet*>(&engine->add(std::make_unique<Puppet>()));
    moveTo(10.0, 20.0);
  }
  void moveTo(double east, double north) {
    puppet->place.position = *Position::fromMetres(east, north, world->pitch());
    puppet->place.height = 60.0;
  }
  std::shared_ptr<const World> world;
  std::unique_ptr<Engine> engine;
  Puppet* puppet;
};

using Place = std::pair<std::int64_t, std::int64_t>;  // level-0 samples

struct DrawnNode {
  int level = 0;
  std::int64_t i = 0, j = 0;
  auto operator<=>(const DrawnNode&) const = default;
};

/// The nodes of a scene, by their interiors: the only meshes of (n - 2)^2 squares whose origin is one sample
/// inside a node.
std::set<DrawnNode> nodesOf(const Scene& scene, int intervals) {
  std::set<DrawnNode> nodes;
  for (const auto& mesh : scene.meshes()) {
    if (mesh->columns != intervals - 2 || mesh->rows != intervals - 2) continue;
    const std::int64_t step = std::int64_t{1} << mesh->level, side = step * intervals;
    nodes.insert({mesh->level, (mesh->originColumn - step) / side, (mesh->originRow - step) / side});
  }
  return nodes;
}

/// Whether a drawn node covers the level-0 square whose south-west sample this is.
bool isCovered(const std::set<DrawnNode>& nodes, std::int64_t column, std::int64_t row, int intervals) {
  const auto floorDivide = [](std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((b - 1 - a) / b); };
  for (int level = 0; level < 8; ++level) {
    const std::int64_t side = std::int64_t{intervals} << level;
    if (nodes.contains({level, floorDivide(column, side), floorDivide(row, side)})) return true;
  }
  return false;
}

/// Of the ground that nodes cover together, all but squares of a node's ring beyond which nothing is drawn.
std::int64_t areaOf(const std::set<DrawnNode>& nodes, int intervals) {
  std::int64_t area = 0;
  for (const DrawnNode& node : nodes) {
    const std::int64_t step = std::int64_t{1} << node.level, side = step * intervals;
    const std::int64_t x = node.i * side, y = node.j * side;
    const auto allCovered = [&](std::int64_t fromX, std::int64_t toX, std::int64_t fromY, std::int64_t toY) {
      for (std::int64_t row = fromY; row < toY; ++row) {
        for (std::int64_t column = fromX; column < toX; ++column) {
          if (!isCovered(nodes, column, row, intervals)) return false;
        }
      }
      return true;
    };
    area += (intervals - 2) * (intervals - 2) * step * step;
    const std::int64_t strip = (intervals - 2) * step * step, in = step, out = side - step;
    area += allCovered(x + in, x + out, y - 1, y) ? strip : 0;
    area += allCovered(x + in, x + out, y + side, y + side + 1) ? strip : 0;
    area += allCovered(x - 1, x, y + in, y + out) ? strip : 0;
    area += allCovered(x + side, x + side + 1, y + in, y + out) ? strip : 0;
    for (const std::int64_t cornerX : {std::int64_t{0}, out}) {
      for (const std::int64_t cornerY : {std::int64_t{0}, out}) {
        const std::int64_t fromX = x + cornerX - (cornerX == 0 ? 1 : 0),
                           fromY = y + cornerY - (cornerY == 0 ? 1 : 0);
        area += allCovered(fromX, fromX + step + 1, fromY, fromY + step + 1) ? step * step : 0;
      }
    }
  }
  return area;
}

/// Every triangle looks up, no edge is used twice in one direction, and together they cover what they should.
void expectOneSurface(const Scene& scene, int intervals) {
  std::set<std::pair<Place, Place>> edges;
  std::int64_t twice = 0;
  for (const auto& mesh : scene.meshes()) {
    const std::int64_t stride = std::int64_t{1} << mesh->level;
    for (std::size_t k = 0; k < mesh->indices->size(); k += 3) {
      std::array<Place, 3> at;
      for (std::size_t c = 0; c < 3; ++c) {
        const SurfaceVertex& vertex = mesh->vertices[(*mesh->indices)[k + c]];
        at[c] = {mesh->originColumn + vertex.column * stride, mesh->originRow + vertex.row * stride};
      }
      const std::int64_t area = (at[1].first - at[0].first) * (at[2].second - at[0].second) -
                                (at[2].first - at[0].first) * (at[1].second - at[0].second);
      ASSERT_GT(area, 0);
      twice += area;
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_TRUE(edges.insert({at[c], at[(c + 1) % 3]}).second) << "overlap";
    }
  }
  ASSERT_EQ(twice, 2 * areaOf(nodesOf(scene, intervals), intervals));
}

class Detail : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Workers, Detail, testing::Values(0, 1, 3));

TEST_P(Detail, SettlesToOneSurfaceOfManyLevelsFineUnderTheEyeAndCoarseFarAway) {
  DetailFlight flight(GetParam());
  flight.engine->settle();
  const EngineFigures figures = flight.engine->figures();
  EXPECT_EQ(figures.pending, 0U);
  EXPECT_EQ(figures.pixelError, 30.0);
  ASSERT_GE(figures.nodesAtLevel.size(), 4U);
  EXPECT_GT(figures.nodesAtLevel[0], 0U);
  EXPECT_GT(figures.nodesAtLevel[3], 0U);
  std::size_t nodes = 0;
  for (const std::size_t count : figures.nodesAtLevel) nodes += count;
  EXPECT_EQ(nodes, figures.nodes);
  expectOneSurface(*flight.engine->scene(), flight.world->intervals());
  const Position eye = flight.puppet->place.position;
  DrawnPoint lying;
  flight.engine->sceneQuery()->points({&eye, 1}, {&lying, 1});
  EXPECT_EQ(lying.level, 0);
  EXPECT_EQ(lying.height, *flight.engine->finestHeight(eye));
}

TEST_P(Detail, IsOneSurfaceInEveryPictureOfAFlightAndNothingThatWasDrawnInTheViewIsMissing) {
  DetailFlight flight(GetParam());
  const int n = flight.world->intervals();
  std::uint64_t serial = 0;
  int published = 0, since = 0;
  microseconds budget(300);
  for (int step = 0; published < 40 && step < 3000; ++step) {
    flight.moveTo(12.0 * step, 300.0 * std::sin(0.02 * step));
    const bool wasThere = flight.engine->drawnHeight(flight.puppet->place.position).has_value();
    if (++since % 50 == 0) budget *= 2;  // where choosing alone takes all of it, nothing is ever begun
    flight.engine->update(1.0 / 60.0, budget);
    EXPECT_TRUE(!wasThere || flight.engine->drawnHeight(flight.puppet->place.position).has_value());
    const auto scene = flight.engine->scene();
    if (scene->serial() == serial) continue;
    serial = scene->serial();
    since = 0;
    if (++published % 3 == 0) expectOneSurface(*scene, n);
    ASSERT_FALSE(HasFatalFailure()) << "step " << step;
  }
  EXPECT_GE(published, 40);
}

using Surface = std::map<std::tuple<std::int64_t, std::int64_t, int>, std::tuple<float, int, int>>;

Surface surfaceOf(const Scene& scene) {
  Surface surface;
  for (const auto& mesh : scene.meshes()) {
    for (const SurfaceVertex& vertex : mesh->vertices) {
      const std::int64_t stride = std::int64_t{1} << mesh->level;
      surface[{mesh->originColumn + vertex.column * stride, mesh->originRow + vertex.row * stride, 0}] = {
          vertex.height, vertex.normalX, vertex.normalY};
    }
  }
  return surface;
}

TEST_P(Detail, ShowsTheSameSurfaceHoweverTheWorkWasSliced) {
  const auto surface = [](microseconds budget) {
    DetailFlight flight(GetParam());
    while (flight.engine->figures().pending > 0 || flight.engine->scene()->serial() == 0) {
      flight.engine->update(0.0, budget);
    }
    EXPECT_TRUE(test::measureNodeErrors(*flight.engine)) << "what is chosen changes with what is known";
    flight.engine->settle();
    return surfaceOf(*flight.engine->scene());
  };
  const Surface patient = surface(microseconds(1'000'000));
  EXPECT_GT(patient.size(), 10'000U);
  EXPECT_EQ(patient, surface(microseconds(50)));
}

TEST_P(Detail, HoldsTheCapAtEveryMomentAndPaysWithPixelError) {
  const DetailSettings sharp{.pixelError = 6.0, .distance = 3000.0};
  DetailFlight flight(GetParam(), sharp, 12 * kMiB), ample(GetParam(), sharp);
  for (int step = 0; step < 300; ++step) {
    const double leap = step % 100 == 99 ? 1e5 * step : 0.0;
    flight.moveTo(leap + 20.0 * step, 200.0 * std::sin(0.05 * step));
    flight.engine->update(1.0 / 60.0, microseconds(400));
    ASSERT_LE(flight.engine->figures().bytes, 12 * kMiB) << "step " << step;
  }
  for (DetailFlight* one : {&flight, &ample}) one->engine->settle();
  EXPECT_LE(flight.engine->figures().peakBytes, 12 * kMiB);
  EXPECT_EQ(flight.engine->figures().pending, 0U);
  EXPECT_GT(flight.engine->figures().pixelError, 6.0);
  EXPECT_GT(flight.engine->figures().nodes, 100U);
  EXPECT_EQ(ample.engine->figures().pixelError, 6.0);
  EXPECT_LT(flight.engine->figures().nodes, ample.engine->figures().nodes);
}

std::size_t meshBytes(const Scene& scene) {
  std::size_t sum = 0;
  for (const auto& mesh : scene.meshes()) sum += mesh->bytes();
  return sum;
}

TEST_P(Detail, IsAllThereAfterLeapsAndTurnsUnderACapThatIsFull) {
  DetailFlight flight(GetParam(), {.pixelError = 3.0, .distance = 3000.0}, 12 * kMiB);
  for (int leap = 0; leap < 6; ++leap) {
    for (int step = 0; step < 60; ++step) {
      flight.moveTo(1e5 * leap + 40.0 * step, 300.0 * leap);
      flight.engine->update(1.0 / 60.0, microseconds(400));
      flight.engine->setRendererBytes(meshBytes(*flight.engine->scene()));
      ASSERT_LE(flight.engine->figures().bytes, 12 * kMiB);
    }
    flight.engine->settle();
    flight.engine->setRendererBytes(meshBytes(*flight.engine->scene()));
    EXPECT_EQ(flight.engine->figures().pending, 0U) << "leap " << leap;
    ASSERT_LE(flight.engine->figures().bytes, 12 * kMiB);
  }
}

TEST_P(Detail, CountsAllThatItHasFromTheHeapAtEveryMoment) {
  const DetailSettings sharp{.pixelError = 6.0, .distance = 3000.0};
  DetailFlight(GetParam(), sharp).engine->settle();  // what a program takes once
  DetailFlight flight(GetParam(), sharp, 12 * kMiB);
  const std::size_t before = test::allocatedBytes() - flight.engine->figures().bytes;
  for (int step = 0; step < 400; ++step) {
    const double leap = step % 100 == 99 ? 1e5 * step : 0.0;
    flight.moveTo(leap + 20.0 * step, 200.0 * std::sin(0.05 * step));
    flight.engine->update(1.0 / 60.0, microseconds(2000));
    ASSERT_TRUE(flight.engine->sceneQuery());
    const std::size_t held = test::allocatedBytes() - before, counted = flight.engine->figures().bytes;
    ASSERT_LE(held, counted + kMiB / 32) << "step " << step;
    ASSERT_LE(counted, 12 * kMiB);
  }
  EXPECT_GE(test::allocatedBytes() - before, flight.engine->figures().bytes / 2)
      << "no cap is for so much air";
}

TEST_P(Detail, KeepsNoSnapshotButTheLastWhileItRests) {
  DetailFlight flight(GetParam());
  ASSERT_TRUE(test::measureNodeErrors(*flight.engine));
  flight.engine->settle();
  std::weak_ptr<const Scene> before;
  for (const double east : {1500.0, 0.0}) {
    flight.moveTo(east, 20.0);
    std::uint64_t updates = 0;
    do {
      const std::weak_ptr<const Scene> now = flight.engine->scene();
      flight.engine->update(0.0, microseconds(500));
      if (now.lock() != flight.engine->scene()) before = now, ++updates;
    } while (flight.engine->figures().pending > 0 || flight.engine->figures().measuring);
    EXPECT_GT(updates, 1U);
    EXPECT_TRUE(before.expired());
  }
}

TEST(DetailOfWorkers, IsGivenToThemAsFastAsTheyMakeIt) {
  DetailFlight flight(1, {.pixelError = 15.0, .distance = 3000.0});
  flight.engine->update(0.0, milliseconds(20));
  const std::size_t wanted = flight.engine->figures().pending;
  std::size_t updates = 1;
  for (; flight.engine->figures().pending > 0 && updates < wanted; ++updates) {
    while (flight.engine->figures().unfinishedTasks > 0)
      std::this_thread::yield();  // until it waits for more
    flight.engine->update(0.0, milliseconds(20));
  }
  EXPECT_GT(wanted, 200U);
  EXPECT_LT(updates, wanted / 3);
}

/// Where the land is farthest above its mean, of places 64 m apart.
Position highestPlace(const World& world, double& height) {
  Position found;
  height = -INFINITY;
  for (int row = -200; row < 200; ++row) {
    for (int column = -200; column < 200; ++column) {
      const Position place = *Position::fromMetres(64.0 * column, 64.0 * row, world.pitch());
      const double here = world.height(place);
      if (here > height) std::tie(found, height) = std::pair(place, here);
    }
  }
  return found;
}

TEST_P(Detail, IsAsFineAsWantedOverSummitsBeyondThreeDeviationsToo) {
  DetailFlight flight(GetParam(), {.pixelError = 80.0, .distance = 3000.0});
  double summit = 0.0;
  flight.puppet->place.position = highestPlace(*flight.world, summit);
  ASSERT_GT(summit, flight.world->mean() + 3.2 * flight.world->deviation());
  flight.puppet->place.height = summit + 2.0;
  flight.engine->settle();
  ASSERT_TRUE(test::measureNodeErrors(*flight.engine));
  flight.engine->settle();
  const Motion eye = flight.puppet->place;
  const DetailSettings detail = *flight.engine->options().view.detail;
  const double lens = lensPixels(detail.lines, detail.fieldOfView);
  const PixelError seen =
      pixelError(*flight.world, *flight.engine->scene(), {eye.position, eye.height, lens});
  EXPECT_LE(seen.max, detail.pixelError * (1.0 + 1e-6));
}

TEST_P(Detail, IsAsFineAsWantedThoughSomeNodesAreRougherThanOthersOfTheirLevel) {
  double summit = 0.0;
  for (const double pixelError : {5.0, 10.0, 20.0}) {
    DetailFlight flight(GetParam(), {.pixelError = pixelError, .distance = 3000.0});
    flight.puppet->place.position = highestPlace(*flight.world, summit);
    flight.puppet->place.height = summit + 30.0;
    ASSERT_TRUE(test::measureNodeErrors(*flight.engine));
    flight.engine->settle();
    const Motion eye = flight.puppet->place;
    const DetailSettings detail = *flight.engine->options().view.detail;
    const double lens = lensPixels(detail.lines, detail.fieldOfView);
    const Eye from{eye.position, eye.height, lens};
    const auto scene = flight.engine->scene();
    std::size_t looked = 0;
    for (const auto& mesh : scene->meshes()) {
      const double own = drawnError(*flight.world, *mesh);
      const double distance = own * lens / teren::pixelError(*flight.world, *mesh, from);
      if (mesh->nodeLevel == 0 || distance > 0.99 * detail.distance) continue;  // finest; not asked for
      ++looked;
      ASSERT_LE(teren::pixelError(*flight.world, *mesh, from, scene->morph()), pixelError * (1.0 + 1e-6));
    }
    EXPECT_GT(looked, 10U);
  }
}

TEST_P(Detail, ComesAndGoesWithThePixelErrorTheDistanceAndThePicture) {
  DetailFlight flight(GetParam());
  flight.engine->settle();
  ASSERT_TRUE(test::measureNodeErrors(*flight.engine)) << "what is chosen changes with what is known";
  flight.engine->settle();
  const std::size_t before = flight.engine->figures().nodes;
  const auto nodesWith = [&](const DetailSettings& detail) {
    EXPECT_TRUE(flight.engine->setDetail(detail).ok());
    EXPECT_EQ(flight.engine->options().view.detail, detail);
    flight.engine->settle();
    EXPECT_EQ(flight.engine->figures().pending, 0U);
    expectOneSurface(*flight.engine->scene(), flight.world->intervals());
    return flight.engine->figures().nodes;
  };
  EXPECT_GT(nodesWith({.pixelError = 15.0, .distance = 3000.0}), before);
  EXPECT_LT(nodesWith({.pixelError = 90.0, .distance = 3000.0}), before);
  EXPECT_GT(nodesWith({.pixelError = 30.0, .distance = 6000.0}), before);
  EXPECT_LT(nodesWith({.pixelError = 30.0, .distance = 1000.0}), before);
  EXPECT_GT(nodesWith({.pixelError = 30.0, .distance = 3000.0, .lines = 1500.0}), before);
}

TEST(DrawnHeight, IsThatOfTheSnapshotAsItIsSeenToTheBitWhereverLevelsMeet) {
  DetailFlight flight(0);
  flight.engine->settle();
  ASSERT_TRUE(flight.engine->sceneQuery()) << "which another follows";
  flight.moveTo(700.0, -400.0);
  flight.engine->settle();
  const auto lying = flight.engine->sceneQuery();
  const SceneQuery query =
      lying->seenFrom({flight.puppet->place.position, flight.puppet->place.height}, lying->scene()->morph());
  std::mt19937_64 random(20'260'807);
  std::size_t there = 0, betweenLevels = 0, moved = 0;
  const auto expectTheSame = [&](const Position& place) {
    DrawnPoint point, unmoved;
    query.points({&place, 1}, {&point, 1});
    lying->points({&place, 1}, {&unmoved, 1});
    moved += point.height != unmoved.height ? 1U : 0U;
    const std::optional<double> height = flight.engine->drawnHeight(place);
    ASSERT_EQ(height.has_value(), point.there);
    if (height) {
      ASSERT_EQ(*height, point.height);
    }
    there += point.there ? 1U : 0U;
  };
  std::uniform_real_distribution<double> metres(-6000.0, 6000.0);
  for (int trial = 0; trial < 20'000; ++trial) {
    expectTheSame(*Position::fromMetres(metres(random), metres(random), flight.world->pitch()));
  }
  for (const auto& mesh : flight.engine->scene()->meshes()) {  // their vertices, and the middles of triangles
    if (mesh->columns == mesh->rows && mesh->indices->size() == 6U * mesh->columns * mesh->rows) continue;
    const double step = flight.world->spacing(mesh->level);
    const double west = static_cast<double>(mesh->originColumn) * flight.world->spacing(0);
    const double south = static_cast<double>(mesh->originRow) * flight.world->spacing(0);
    for (std::size_t k = 0; k + 2 < mesh->indices->size(); k += 3) {
      const auto corner = [&](std::size_t c) { return mesh->vertices[(*mesh->indices)[k + c]]; };
      const SurfaceVertex a = corner(0), b = corner(1), c = corner(2);
      expectTheSame(
          *Position::fromMetres(west + step * a.column, south + step * a.row, flight.world->pitch()));
      expectTheSame(*Position::fromMetres(west + step * (a.column + b.column + c.column) / 3.0,
                                          south + step * (a.row + b.row + c.row) / 3.0,
                                          flight.world->pitch()));
      ++betweenLevels;
    }
    ASSERT_FALSE(testing::Test::HasFatalFailure());
  }
  EXPECT_GT(there, 10'000U);
  EXPECT_GT(betweenLevels, 1000U);
  EXPECT_GT(moved, 5000U);
}

TEST(DrawnHeight, AskedForInEveryUpdateKeepsNoSnapshot) {
  class Asker final : public Object {
   public:
    void update(double, const Ground& ground) override { heights += ground.height(Position{}).has_value(); }
    Motion motion() const override { return {}; }
    int heights = 0;
  };
  DetailFlight flight(0);
  flight.engine->settle();
  const auto& asker = static_cast<const Asker&>(flight.engine->add(std::make_unique<Asker>()));
  for (int turn = 0; turn < 3; ++turn) {
    flight.moveTo(100.0 * turn, 0.0);
    flight.engine->settle();
    flight.engine->update(0.0, milliseconds(1));
  }
  EXPECT_EQ(asker.heights, 3);
  const std::size_t meshes = flight.engine->scene()->meshes().size();
  EXPECT_EQ(flight.engine->sceneQuery()->newMeshes(), meshes) << "nobody has asked for an index before";
  std::weak_ptr<const Scene> asked = flight.engine->scene();
  ASSERT_TRUE(flight.engine->drawnHeight(flight.puppet->place.position).has_value());
  flight.moveTo(1e5, -2e5);
  while (!asked.expired() && asked.lock() == flight.engine->scene()) {
    flight.engine->update(0.0, milliseconds(20));
  }
  flight.engine->update(0.0, microseconds(0));  // lets go of what the last one has replaced
  EXPECT_TRUE(asked.expired()) << "the index of all triangles was made for one height";
}

TEST_P(Detail, LetsSnapshotsGoThatNobodyAsksAnyMore) {
  DetailFlight flight(GetParam());
  flight.engine->settle();
  ASSERT_TRUE(flight.engine->sceneQuery());
  const std::weak_ptr<const Scene> asked = flight.engine->scene();
  for (const double east : {1e5, 2e5, 3e5}) {  // the one it has been asked about last is kept until the next
    flight.moveTo(east, -2e5);
    flight.engine->settle();
  }
  EXPECT_TRUE(asked.expired());
}

/// Two who fly, 30 km apart, with views of their own.
struct TwoViews : DetailFlight {
  explicit TwoViews(int workers) : DetailFlight(workers) {
    other = static_cast<Puppet*>(&engine->add(std::make_unique<Puppet>()));
    moveOther(0.0);
    EXPECT_TRUE(engine->setView(1, DetailSettings{.pixelError = 60.0, .distance = 1500.0}).ok());
  }
  void moveOther(double north) {
    other->place.position = *Position::fromMetres(30'000.0, north, world->pitch());
    other->place.height = 60.0;
  }
  bool isDrawnAround(const Object& object, double away) const {
    const Position at = object.motion().position;
    return engine->drawnHeight(*at.movedBy(away, 0.0, world->pitch())).has_value() &&
           engine->drawnHeight(*at.movedBy(0.0, -away, world->pitch())).has_value();
  }
  Puppet* other;
};

TEST_P(Detail, IsDrawnAroundEveryObjectWithAViewAsFinelyAsItsOwnWants) {
  TwoViews flight(GetParam());
  flight.engine->settle();
  expectOneSurface(*flight.engine->scene(), flight.world->intervals());
  EXPECT_TRUE(flight.isDrawnAround(*flight.puppet, 2900.0));
  EXPECT_TRUE(flight.isDrawnAround(*flight.other, 1400.0));
  const auto nodesAround = [&](const Object& object) {
    std::size_t count = 0;
    const std::int64_t middle = object.motion().position.i * flight.world->intervals();
    for (const DrawnNode& node : nodesOf(*flight.engine->scene(), flight.world->intervals())) {
      const std::int64_t side = std::int64_t{flight.world->intervals()} << node.level;
      count += std::abs(node.i * side - middle) < 1000 ? 1U : 0U;
    }
    return count;
  };
  EXPECT_GT(nodesAround(*flight.puppet), nodesAround(*flight.other));
  const std::size_t both = flight.engine->figures().nodes;
  ASSERT_TRUE(flight.engine->setView(1, std::nullopt).ok());
  flight.engine->settle();
  EXPECT_FALSE(flight.isDrawnAround(*flight.other, 1400.0));
  EXPECT_LT(flight.engine->figures().nodes, both);
  flight.engine->setActive(1);
  flight.engine->settle();
  EXPECT_TRUE(flight.isDrawnAround(*flight.other, 2900.0)) << "the active one has the engine's";
}

TEST_P(Detail, FollowsSeveralObjectsAtOnce) {
  TwoViews flight(GetParam());
  flight.engine->settle();
  for (int step = 1; step <= 300; ++step) {
    flight.moveTo(10.0, 20.0 + 20.0 * step);
    flight.moveOther(-15.0 * step);
    flight.engine->update(1.0 / 60.0, milliseconds(3));
  }
  flight.engine->settle();
  expectOneSurface(*flight.engine->scene(), flight.world->intervals());
  EXPECT_TRUE(flight.isDrawnAround(*flight.puppet, 2900.0));
  EXPECT_TRUE(flight.isDrawnAround(*flight.other, 1400.0));
  EXPECT_FALSE(flight.engine->drawnHeight(*Position::fromMetres(30'000.0, 0.0, 64.0)).has_value());
}

/// [px] How far the ground within `reach` [m] of an eye, moved like this, is from level 0 at most.
double worstSeen(const TwoViews& flight, const Motion& eye, const Morph& morph, double reach, double lens) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> metres(-reach, reach);
  std::vector<Position> places;
  for (int k = 0; k < 4000; ++k) {
    places.push_back(*eye.position.movedBy(metres(random), metres(random), flight.world->pitch()));
  }
  std::vector<DrawnPoint> points(places.size());
  flight.engine->sceneQuery()->seenFrom({eye.position, eye.height}, morph).points(places, points);
  double worst = 0.0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Offset way = offset(eye.position, places[k], flight.world->pitch());
    const double finest = flight.world->query(places[k]).drawn;
    const double error = std::fabs(points[k].height - finest);
    EXPECT_TRUE(points[k].there);
    EXPECT_LE(error, points[k].error + 1e-6);
    worst =
        std::max(worst, error * lens / std::max(1.0, std::hypot(way.east, way.north, finest - eye.height)));
  }
  return worst;
}

TEST(DetailOfSeveral, EachPictureMovesTheLandWithItsOwnEyeAndPixelError) {
  TwoViews flight(0);
  flight.moveOther(0.0);
  flight.other->place.position = *flight.puppet->place.position.movedBy(900.0, 300.0, flight.world->pitch());
  const DetailSettings fine{.pixelError = 4.0, .distance = 1500.0, .lines = 600.0};
  ASSERT_TRUE(flight.engine->setView(1, fine).ok());
  flight.engine->settle();
  ASSERT_TRUE(test::measureNodeErrors(*flight.engine));
  flight.engine->settle();
  ASSERT_EQ(flight.engine->figures().pixelError, 30.0) << "not under the cap";
  const Morph &shared = flight.engine->scene()->morph(), own = flight.engine->morph(1);
  EXPECT_EQ(flight.engine->morph(0), shared);
  EXPECT_EQ(flight.engine->morph(17), shared) << "nobody's";
  const double lens = lensPixels(fine.lines, fine.fieldOfView);
  EXPECT_NEAR(static_cast<double>(own.tolerance()), 4.0 / lens, 1e-9);
  const double seen = worstSeen(flight, flight.other->place, own, 900.0, lens);
  EXPECT_LE(seen, 4.0);
  EXPECT_GT(worstSeen(flight, flight.other->place, shared, 900.0, lens), 2.0 * seen)
      << "with the pixel error of another picture";
  const DetailSettings& coarse = *flight.engine->options().view.detail;
  EXPECT_LE(
      worstSeen(flight, flight.puppet->place, shared, 900.0, lensPixels(coarse.lines, coarse.fieldOfView)),
      30.0)
      << "of land that is finer than it needs";
  flight.engine->setActive(1);
  EXPECT_EQ(flight.engine->morph(1), shared) << "the active one has the engine's";
}

TEST(DetailOfSeveral, CountTheActiveObjectOnce) {
  DetailFlight flight(0);
  const DetailSettings detail{.pixelError = 30.0, .distance = 1000.0};
  for (std::size_t count = 1; count <= Engine::kMostViews; ++count) {
    flight.engine->add(std::make_unique<Puppet>());
  }
  for (std::size_t object = 0; object < Engine::kMostViews; ++object) {
    EXPECT_TRUE(flight.engine->setView(object, detail).ok()) << object;
  }
  EXPECT_FALSE(flight.engine->setView(Engine::kMostViews, detail).ok());
}

/// Updates until the scene is another.
void awaitAnotherScene(Engine& engine) {
  for (const auto before = engine.scene(); engine.scene() == before;) engine.update(0.0, milliseconds(20));
}

TEST(DetailQuery, IsIndexedAnewOnlyWhereItIsNewHoweverManySnapshotsNobodyAskedAbout) {
  DetailFlight flight(0);
  flight.engine->settle();
  ASSERT_TRUE(test::measureNodeErrors(*flight.engine));
  flight.engine->settle();
  const auto first = flight.engine->scene();
  EXPECT_EQ(flight.engine->sceneQuery()->newMeshes(), first->meshes().size());
  std::weak_ptr<const SceneQuery> asked = flight.engine->sceneQuery();
  for (int snapshots = 0; snapshots < 3; ++snapshots) {
    flight.moveTo(70.0 * (snapshots + 1), 20.0);
    awaitAnotherScene(*flight.engine);
  }
  EXPECT_TRUE(asked.expired());
  const auto query = flight.engine->sceneQuery();
  EXPECT_EQ(query->scene(), flight.engine->scene());
  EXPECT_EQ(query->newMeshes(), difference(*first, *query->scene()).added.size());
  EXPECT_GT(query->newMeshes(), 0U);
  EXPECT_LT(query->newMeshes(), first->meshes().size() / 2);
}

TEST(DetailOfSeveral, IsRefusedWhereItCannotBe) {
  DetailFlight flight(0);
  const DetailSettings detail{.pixelError = 30.0, .distance = 1000.0};
  EXPECT_FALSE(flight.engine->setView(1, detail).ok()) << "there is one object";
  for (int count = 0; count < 16; ++count) flight.engine->add(std::make_unique<Puppet>());
  EXPECT_FALSE(flight.engine->setView(1, DetailSettings{.pixelError = std::nan("")}).ok());
  EXPECT_FALSE(flight.engine->setView(1, DetailSettings{.distance = 1e6}).ok()) << "beyond the cap";
  for (std::size_t object = 1; object < Engine::kMostViews; ++object) {
    EXPECT_TRUE(flight.engine->setView(object, detail).ok());
  }
  EXPECT_FALSE(flight.engine->setView(16, detail).ok());
  EXPECT_TRUE(flight.engine->setView(15, std::nullopt).ok());
  EXPECT_TRUE(flight.engine->setView(16, detail).ok());
  auto uniform = Engine::create(flight.world, {});
  (*uniform)->add(std::make_unique<Puppet>());
  EXPECT_FALSE((*uniform)->setView(0, detail).ok());
}

TEST(DetailSettings, TakeThePlaceOfLevelAndRadius) {
  const auto world = test::faultWorld(3, 17, {64.0}, 20);
  ASSERT_LT(world->topLevel(), ViewSettings{}.level);
  EXPECT_TRUE(Engine::create(world, {.view = {.detail = DetailSettings{}}}).ok());
}

TEST(DetailSettings, OfALandOfMoreRootsThanTheCapHoldsAreRefused) {
  const auto world = test::faultWorld(3, 17, {64.0}, 20);
  const auto made = Engine::create(world, {.view = {.detail = DetailSettings{.distance = 1e6}}});
  ASSERT_FALSE(made.ok());
  EXPECT_NE(made.error().message.find("cap"), std::string::npos) << made.error().message;
}

TEST_P(Detail, OfALeapFarAwayLeavesNothingBehind) {
  DetailFlight flight(GetParam());
  flight.engine->settle();
  const std::size_t bytes = flight.engine->figures().bytes;
  flight.moveTo(3e6, -2e6);
  flight.engine->settle();
  EXPECT_FALSE(flight.engine->drawnHeight(*Position::fromMetres(10.0, 20.0, 64.0)).has_value());
  EXPECT_TRUE(flight.engine->drawnHeight(flight.puppet->place.position).has_value());
  EXPECT_LT(flight.engine->figures().bytes, 2 * bytes);
  expectOneSurface(*flight.engine->scene(), flight.world->intervals());
}

TEST(DetailSettings, ThatCannotBeAreRefusedWithTheirValue) {
  const auto world = test::faultWorld(3, 17, {1024.0, 64.0}, 20);
  const double nan = std::nan("");
  for (const auto& [detail, word] :
       std::vector<std::pair<DetailSettings, std::string>>{{{.pixelError = 0.01}, "0.01"},
                                                           {{.pixelError = nan}, "nan"},
                                                           {{.distance = 0.0}, "distance"},
                                                           {{.distance = 2e6}, "2e+06"},
                                                           {{.lines = 0.0}, "height"},
                                                           {{.fieldOfView = 3.2}, "3.2"}}) {
    const auto made = Engine::create(world, {.view = {.detail = detail}});
    ASSERT_FALSE(made.ok());
    EXPECT_NE(made.error().message.find(word), std::string::npos) << made.error().message;
    DetailFlight flight(0);
    EXPECT_FALSE(flight.engine->setDetail(detail).ok());
  }
  auto uniform = Engine::create(world, {});
  EXPECT_FALSE((*uniform)->setDetail({}).ok());
}

}  // namespace
}  // namespace teren
