#include "teren/SceneQuery.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Engine.h"

#include "tests/engine/stream/FaultWorld.h"
#include "tests/engine/stream/PatchGround.h"
#include "tests/engine/stream/PatchworkScene.h"
#include "tests/engine/stream/SeenScene.h"

namespace teren {
namespace {

constexpr int kIntervals = 8;
constexpr double kSpacing = 2.0;

float rough(std::int64_t column, std::int64_t row) {
  const std::uint64_t bits =
      hashWith(hashWith(7, static_cast<std::uint64_t>(column)), static_cast<std::uint64_t>(row));
  return static_cast<float>(bits % 6001) / 100.0F - 30.0F;
}

/// Four squares of 64 samples divided at random into nodes of levels 0 to 3, to the east, behind a gap, one
/// node more, and to the south even ground of level 1, whose outermost ring is not drawn.
/// Vertices move wherever their place's number says, not with their nodes: a surface without cracks all the
/// same.
Patchwork moving() {
  Patchwork patchwork(kIntervals, kSpacing, rough);
  const std::vector<double> errors{2.0, 3.0, 5.0, 8.0, 13.0};
  patchwork.letMove([](std::int64_t column, std::int64_t row) { return 2.0F * rough(row, column); },
                    [](std::int64_t column, std::int64_t row) {
                      const int level = static_cast<int>(std::fabs(rough(row, row + column))) % 5;
                      return level < 4 ? level : SurfaceVertex::kFixed;
                    },
                    Morph(0.06, errors));
  return patchwork;
}

Patchwork mixed(std::uint64_t seed, std::int64_t westernmost = -64,
                Patchwork patchwork = {kIntervals, kSpacing, rough}) {
  Dice dice(seed);
  for (const std::int64_t x : {westernmost, westernmost + 64}) {
    for (const std::int64_t y : {-64, 0}) patchwork.addDivided(PatchworkNode{x, y, 3}, dice);
  }
  patchwork.add({westernmost + 192, 8, 0});
  patchwork.addEven({westernmost, -128, 1}, 4, 3);
  return patchwork;
}

/// The triangles' height at a place in level-0 samples, the normal that belongs to it, and by what the height
/// may err; in long double, looking at every triangle. Where several meet any of their normals is right.
struct Expected {
  long double height = 0.0L, largest = 1.0L;
  std::vector<std::array<long double, 3>> normals;
};
std::optional<Expected> expectedAt(const std::vector<SampleTriangle>& triangles, long double x,
                                   long double y) {
  std::optional<Expected> expected;
  for (const SampleTriangle& t : triangles) {
    const auto side = [&](std::size_t a, std::size_t b) {
      return (t.column[a] - x) * (t.row[b] - y) - (t.column[b] - x) * (t.row[a] - y);
    };
    const long double u = side(1, 2), v = side(2, 0), w = side(0, 1);
    if (u < 0.0L || v < 0.0L || w < 0.0L) continue;
    if (!expected) expected.emplace();
    const long double sum = u + v + w;
    expected->height = (u * t.height[0] + v * t.height[1] + w * t.height[2]) / sum;
    for (const float height : t.height)
      expected->largest = std::max(expected->largest, std::fabs(height) + 0.0L);
    const Point ab{(t.column[1] - t.column[0]) * 2.0L, (t.row[1] - t.row[0]) * 2.0L,
                   static_cast<long double>(t.height[1]) - t.height[0]};
    const Point ac{(t.column[2] - t.column[0]) * 2.0L, (t.row[2] - t.row[0]) * 2.0L,
                   static_cast<long double>(t.height[2]) - t.height[0]};
    const Point normal{ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2],
                       ab[0] * ac[1] - ab[1] * ac[0]};
    const long double size = length(normal);
    expected->normals.push_back({normal[0] / size, normal[1] / size, normal[2] / size});
  }
  return expected;
}

Position placeOf(double column, double row) {
  return *Position::fromMetres(column * kSpacing, row * kSpacing, kSpacing * kIntervals);
}

std::vector<DrawnPoint> ask(const SceneQuery& query, const std::vector<Position>& places) {
  std::vector<DrawnPoint> answers(places.size());
  query.points(places, answers);
  return answers;
}

void expectTriangles(const SceneQuery& query, const std::vector<std::array<double, 2>>& samples,
                     std::size_t& found) {
  const std::vector<SampleTriangle> triangles = trianglesOf(*query.scene());
  std::vector<Position> places;
  for (const auto& sample : samples) places.push_back(placeOf(sample[0], sample[1]));
  const std::vector<DrawnPoint> answers = ask(query, places);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const long double x = samples[k][0], y = samples[k][1], little = 0x1p-40L;
    // On northern and eastern rims there is what follows there.
    const bool beyond = std::floor(x) != x && std::floor(y) != y;
    const bool there = beyond || expectedAt(triangles, x + little, y + little).has_value();
    const auto expected = there ? expectedAt(triangles, x, y) : std::nullopt;
    ASSERT_EQ(answers[k].there, expected.has_value()) << samples[k][0] << ", " << samples[k][1];
    if (!expected) continue;
    ++found;
    ASSERT_NEAR(answers[k].height, static_cast<double>(expected->height),
                static_cast<double>(expected->largest) * kDrawnPointError)
        << samples[k][0] << ", " << samples[k][1];
    long double nearest = 1.0L;
    for (const auto& normal : expected->normals) {
      long double furthest = 0.0L;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        furthest = std::max(furthest, std::fabs(normal[axis] - answers[k].normal[axis]));
      }
      nearest = std::min(nearest, furthest);
    }
    ASSERT_LE(nearest, static_cast<long double>(kDrawnPointError));
  }
}

TEST(SceneQuery, FindsTheTriangleAtEveryPlaceOfAnyMixOfLevels) {
  std::size_t there = 0, asked = 0;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const SceneQuery query(mixed(seed).scene(), kIntervals);
    Dice dice(seed);
    std::vector<std::array<double, 2>> samples;
    for (int k = 0; k < 300; ++k) samples.push_back({dice.between(-70, 150), dice.between(-130, 70)});
    // Vertices, and places on lines and diagonals, but for the rims on which nothing is drawn.
    for (int k = 0; k < 300; ++k) {
      const double x = dice.whole(-62, 63), y = dice.whole(-126, 63);
      samples.push_back({x, y});
      samples.push_back({x, y + 0.37});
      samples.push_back({x + 0.625, y + 0.625});
    }
    asked += samples.size();
    expectTriangles(query, samples, there);
  }
  EXPECT_GT(there, asked / 2);
  EXPECT_LT(there, asked);
}

TEST(SceneQuery, KeepsNorthernAndEasternRimsForWhatFollowsThere) {
  Patchwork patchwork(kIntervals, kSpacing, rough);
  patchwork.add({0, 0, 1});
  const SceneQuery query(patchwork.scene(), kIntervals);
  const auto there = [&](double column, double row) { return ask(query, {placeOf(column, row)})[0].there; };
  EXPECT_TRUE(there(0.0, 0.0));
  EXPECT_TRUE(there(std::nextafter(16.0, 0.0), std::nextafter(16.0, 0.0)));
  EXPECT_FALSE(there(16.0, 5.0));
  EXPECT_FALSE(there(5.0, 16.0));
  EXPECT_FALSE(there(-1e-9, 5.0));
  EXPECT_FALSE(there(5.0, -1e-9));
}

TEST(SceneQuery, AnswersNothingWhereThereIsNothing) {
  const SceneQuery empty(std::make_shared<const Scene>(), kIntervals);
  EXPECT_FALSE(ask(empty, {Position{}})[0].there);
  const SceneQuery query(mixed(1).scene(), kIntervals);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Position> places{
      {0, 0, nan, 0.0},         {0, 0, 0.0, nan},         {0, 0, 1.0, 0.0},       {0, 0, -1e-9, 0.0},
      {kMaxPatch, 0, 0.0, 0.0}, {-kMaxPatch, -kMaxPatch}, {kMaxPatch + 1, 0, 0.5}};
  for (const DrawnPoint& answer : ask(query, places)) EXPECT_FALSE(answer.there);
  query.points({}, {});
}

TEST(SceneQuery, AnswersTheSameAtTheWorldsEnd) {
  const std::int64_t far = (kMaxPatch - 16) * kIntervals;
  Patchwork here(kIntervals, kSpacing, rough);
  Patchwork there(kIntervals, kSpacing,
                  [&](std::int64_t column, std::int64_t row) { return rough(column - far, row); });
  Dice dice(3), same(3);
  here.addDivided(PatchworkNode{0, 0, 3}, dice);
  there.addDivided(PatchworkNode{far, 0, 3}, same);
  const SceneQuery near(here.scene(), kIntervals), distant(there.scene(), kIntervals);
  for (int k = 0; k < 200; ++k) {
    Position place{dice.whole(0, 7), dice.whole(0, 7), dice.between(0, 1), dice.between(0, 1)};
    const DrawnPoint expected = ask(near, {place})[0];
    place.i += kMaxPatch - 16;
    const DrawnPoint answer = ask(distant, {place})[0];
    ASSERT_TRUE(expected.there && answer.there);
    ASSERT_EQ(answer.height, expected.height);
    ASSERT_EQ(answer.normal, expected.normal);
  }
}

TEST(SceneQuery, WhatItTakesOverFromTheSnapshotBeforeChangesNoAnswer) {
  Patchwork patchwork(kIntervals, kSpacing, rough);
  Dice dice(11);
  patchwork.addDivided(PatchworkNode{0, 0, 3}, dice);
  const auto first = patchwork.scene();
  patchwork.addDivided(PatchworkNode{-64, -64, 3}, dice);  // moves the corner too
  const auto added = patchwork.scene(1000);
  // The old meshes but every third, and those of the node that came.
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (std::size_t k = 0; k < first->meshes().size(); ++k) {
    if (k % 3 != 1) meshes.push_back(first->meshes()[k]);
  }
  for (std::size_t k = first->meshes().size(); k < added->meshes().size(); ++k) {
    meshes.push_back(added->meshes()[k]);
  }
  const auto second = std::make_shared<const Scene>(2, kSpacing, std::move(meshes));
  const SceneQuery fresh(second, kIntervals);
  std::optional<SceneQuery> before(std::in_place, first, kIntervals);
  const SceneQuery query(second, kIntervals, {}, &*before);
  before.reset();
  int there = 0;
  for (int k = 0; k < 3000; ++k) {
    const std::vector<Position> place{placeOf(dice.between(-64, 64), dice.between(-64, 64))};
    const DrawnPoint expected = ask(fresh, place)[0], answer = ask(query, place)[0];
    ASSERT_EQ(answer.there, expected.there);
    there += answer.there ? 1 : 0;
    ASSERT_EQ(answer.height, expected.height);
    ASSERT_EQ(answer.normal, expected.normal);
  }
  EXPECT_GT(there, 1000);
}

TEST(SceneQuery, ManyThreadsMayAskAtOnce) {
  const SceneQuery query(mixed(5).scene(), kIntervals);
  Dice dice(5);
  std::vector<Position> places;
  for (int k = 0; k < 1000; ++k) places.push_back(placeOf(dice.between(-64, 64), dice.between(-64, 64)));
  const std::vector<DrawnPoint> expected = ask(query, places);
  std::vector<std::vector<DrawnPoint>> answers(4);
  std::vector<std::thread> threads;
  for (auto& own : answers) threads.emplace_back([&] { own = ask(query, places); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& own : answers) {
    for (std::size_t k = 0; k < places.size(); ++k) EXPECT_EQ(own[k].height, expected[k].height);
  }
}

TEST(SceneQuery, SaysTheErrorOfTheMeshThatAnswers) {
  const auto scene = mixed(2).scene();
  std::vector<float> errors;
  for (const auto& mesh : scene->meshes()) errors.push_back(0.5F * static_cast<float>(mesh->id));
  const SceneQuery query(scene, kIntervals, errors), silent(scene, kIntervals);
  Dice dice(2);
  for (int k = 0; k < 500; ++k) {
    const Position place = placeOf(dice.between(-64, 64), dice.between(-64, 64));
    const DrawnPoint answer = ask(query, {place})[0];
    RayHit hit;
    const Ray down{place, 100.0};
    query.firstHits({&down, 1}, {&hit, 1});
    ASSERT_EQ(hit.error, answer.error);
    ASSERT_EQ(ask(silent, {place})[0].error, 0.0);
    const auto name = static_cast<std::uint64_t>(2.0 * answer.error);
    const auto mesh = std::find_if(scene->meshes().begin(), scene->meshes().end(),
                                   [&](const auto& one) { return one->id == name; });
    ASSERT_NE(mesh, scene->meshes().end());
    ASSERT_EQ(answer.level, (*mesh)->level);
    ASSERT_LE(answer.height, static_cast<double>((*mesh)->maxHeight));
    ASSERT_GE(answer.height, static_cast<double>((*mesh)->minHeight));
  }
}

// ---- As an eye sees it

test::EyePoint randomEye(Dice& dice) {
  return {dice.between(-200, 300), dice.between(-300, 200), dice.between(-50, 150)};
}
DetailEye eyeAt(const test::EyePoint& eye) {
  return {*Position::fromMetres(eye.east, eye.north, kSpacing * kIntervals), eye.height};
}

TEST(SceneQuery, SeesTheTrianglesThatAreDrawnForAnEye) {
  std::size_t there = 0, moved = 0;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const SceneQuery lying(mixed(seed, -64, moving()).scene(), kIntervals);
    Dice dice(seed);
    for (int trial = 0; trial < 4; ++trial) {
      const test::EyePoint eye = randomEye(dice);
      const SceneQuery drawn(test::sceneSeenFrom(*lying.scene(), eye), kIntervals);
      const SceneQuery seen = lying.seenFrom(eyeAt(eye));
      std::vector<Position> places;
      for (int k = 0; k < 500; ++k) {
        const double x = dice.whole(-62, 63), y = dice.whole(-126, 63);
        places.push_back(placeOf(dice.between(-70, 150), dice.between(-130, 70)));
        places.push_back(placeOf(x, y));
        places.push_back(placeOf(x + 0.625, y + 0.625));
      }
      const std::vector<DrawnPoint> expected = ask(drawn, places), answers = ask(seen, places),
                                    own = ask(lying, places);
      for (std::size_t k = 0; k < places.size(); ++k) {
        ASSERT_EQ(answers[k].there, expected[k].there);
        if (!answers[k].there) continue;
        ++there;
        moved += answers[k].height != own[k].height ? 1 : 0;
        ASSERT_EQ(answers[k].height, expected[k].height) << "bit for bit";
        ASSERT_EQ(answers[k].normal, expected[k].normal);
        ASSERT_EQ(answers[k].error, std::fabs(answers[k].height - own[k].height));
      }
    }
  }
  EXPECT_GT(there, 9000U);
  EXPECT_GT(moved, there / 2);
}

TEST(SceneQuery, SeesForAnyEyeAtTheWorldsEndAsInItsMiddle) {
  const std::int64_t far = kMaxPatch - 16;
  Patchwork here = moving();
  Dice dice(3);
  here.addDivided(PatchworkNode{0, 0, 3}, dice);
  const auto near = here.scene();
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (const auto& mesh : near->meshes()) {
    auto away = std::make_shared<Mesh>(*mesh);
    away->originColumn += far * kIntervals;
    meshes.push_back(std::move(away));
  }
  const auto there = std::make_shared<const Scene>(1, kSpacing, std::move(meshes), near->morph());
  const SceneQuery middle(near, kIntervals), end(there, kIntervals);
  for (int k = 0; k < 200; ++k) {
    DetailEye eye = eyeAt(randomEye(dice)), farEye = eye;
    farEye.position.i += far;
    if (!farEye.position.valid()) continue;
    Position place{dice.whole(0, 7), dice.whole(0, 7), dice.between(0, 1), dice.between(0, 1)};
    const DrawnPoint expected = ask(middle.seenFrom(eye), {place})[0];
    place.i += far;
    const DrawnPoint answer = ask(end.seenFrom(farEye), {place})[0];
    ASSERT_TRUE(expected.there && answer.there);
    ASSERT_EQ(answer.height, expected.height);
  }
}

TEST(SceneQuery, MovesNothingForAnEyeThatIsNowhere) {
  const SceneQuery lying(mixed(4, -64, moving()).scene(), kIntervals);
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  const std::vector<Position> places{placeOf(3.3, 4.4), placeOf(-20.1, 33.0)};
  const std::vector<DrawnPoint> own = ask(lying, places);
  ASSERT_NE(ask(lying.seenFrom({{}, 500.0}), places)[0].height, own[0].height);
  for (const DetailEye& eye : {DetailEye{{0, 0, nan, 0.0}, 1.0}, DetailEye{{0, 0, 1.0, 0.0}, 1.0},
                               DetailEye{{}, nan}, DetailEye{{}, infinity}, DetailEye{{}, -1e300}}) {
    const std::vector<DrawnPoint> answers = ask(lying.seenFrom(eye), places);
    for (std::size_t k = 0; k < places.size(); ++k) ASSERT_EQ(answers[k].height, own[k].height);
  }
  EXPECT_EQ(ask(lying.seenFrom({{}, 500.0}, Morph()), places)[0].height, own[0].height);
}

TEST(SceneQuery, WithoutItsSceneKnowsAllAndAnswersNothing) {
  const auto scene = mixed(1).scene();
  std::optional<SceneQuery> query(std::in_place, std::make_shared<const Scene>(*scene), kIntervals);
  EXPECT_EQ(query->newMeshes(), scene->meshes().size());
  const std::weak_ptr<const Scene> watched = query->scene();
  const SceneQuery left = query->withoutScene();
  query.reset();
  EXPECT_TRUE(watched.expired()) << "it keeps the snapshot";
  EXPECT_TRUE(left.scene()->meshes().empty());
  EXPECT_FALSE(ask(left, {placeOf(3.3, 4.4)})[0].there);
  RayHit hit;
  const Ray down{placeOf(3.3, 4.4), 100.0};
  left.firstHits({&down, 1}, {&hit, 1});
  EXPECT_EQ(hit.end, RayEnd::nothing);
  const SceneQuery again(scene, kIntervals, {}, &left);
  EXPECT_EQ(again.newMeshes(), 0U);
  EXPECT_EQ(ask(again, {placeOf(3.3, 4.4)})[0].height,
            ask(SceneQuery(scene, kIntervals), {placeOf(3.3, 4.4)})[0].height);
}

/// Stands at the world's zero.
class Post final : public Object {
 public:
  void update(double, const Ground&) override {}
  Motion motion() const override { return {}; }
};

TEST(SceneQuery, SaysOfFinestGroundWhatTheWorldSays) {
  const auto world = test::faultWorld(3, 17, {1024.0, 64.0}, 20);
  auto engine = Engine::create(world, {.view = {0, 2}});
  ASSERT_TRUE(engine.ok());
  (*engine)->add(std::make_unique<Post>());
  (*engine)->settle();
  const SceneQuery query((*engine)->scene(), world->intervals());
  Dice dice(1);
  for (int k = 0; k < 500; ++k) {
    const Position place = *Position::fromMetres(dice.between(-100, 100), dice.between(-100, 100), 64.0);
    const DrawnPoint answer = ask(query, {place})[0];
    const SurfacePoint expected = world->query(place);
    ASSERT_TRUE(answer.there);
    ASSERT_EQ(answer.height, expected.drawn);
    ASSERT_EQ(answer.normal, expected.normal);
  }
}

TEST(SceneQuery, CoarseGroundIsAsNearToTheFinestAsItSays) {
  const auto world = test::faultWorld(3, 17, {1024.0, 64.0}, 20);
  auto engine = Engine::create(world, {.view = {2, 2}});
  ASSERT_TRUE(engine.ok());
  (*engine)->add(std::make_unique<Post>());
  (*engine)->settle();
  const auto query = (*engine)->sceneQuery();
  ASSERT_EQ(query->scene(), (*engine)->scene());
  Dice dice(8);
  std::vector<Position> places;
  for (int k = 0; k < 2000; ++k) {
    places.push_back(*Position::fromMetres(dice.between(-450, 450), dice.between(-450, 450), 64.0));
  }
  const std::vector<DrawnPoint> answers = ask(*query, places);
  double largest = 0.0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    ASSERT_TRUE(answers[k].there);
    const SurfacePoint exact = world->query(places[k]);
    ASSERT_LE(std::fabs(answers[k].height - exact.drawn), answers[k].error);
    ASSERT_LE(std::fabs(answers[k].height - exact.height), answers[k].error + exact.error);
    largest = std::max(largest, std::fabs(answers[k].height - exact.drawn));
  }
  EXPECT_GT(largest, 0.0);
}

}  // namespace
}  // namespace teren
