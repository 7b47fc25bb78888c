#include "stream/SceneRay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/engine/stream/PatchGround.h"
#include "tests/engine/stream/PatchworkScene.h"
#include "tests/engine/stream/SeenScene.h"

namespace teren {
namespace {

constexpr int kIntervals = 8;

/// Whole metres between -8 and 8.
float rough(std::int64_t column, std::int64_t row) {
  const std::uint64_t bits =
      hashWith(hashWith(9, static_cast<std::uint64_t>(column)), static_cast<std::uint64_t>(row));
  return static_cast<float>(bits % 17) - 8.0F;
}

/// 128 x 128 samples around zero, a metre apart: nodes of levels 0 to 3 at random.
std::shared_ptr<const Scene> mixed(std::uint64_t seed) {
  Patchwork patchwork(kIntervals, 1.0, rough);
  Dice dice(seed);
  for (const std::int64_t x : {-64, 0}) {
    for (const std::int64_t y : {-64, 0}) patchwork.addDivided(PatchworkNode{x, y, 3}, dice);
  }
  return patchwork.scene();
}

Ray ray(const Point& from, const Point& direction, double length) {
  Ray made;
  made.from = *Position::fromMetres(static_cast<double>(from[0]), static_cast<double>(from[1]), kIntervals);
  made.height = static_cast<double>(from[2]);
  for (std::size_t axis = 0; axis < 3; ++axis) made.direction[axis] = static_cast<double>(direction[axis]);
  made.length = length;
  return made;
}

RayHit ask(const SceneQuery& query, const Ray& ray) {
  RayHit hit;
  query.firstHits({&ray, 1}, {&hit, 1});
  return hit;
}

/// A time at which the line of a ray meets a triangle, and the triangle.
struct Candidate {
  long double time;
  std::size_t triangle;
};

/// All of them, sorted; looks at every triangle. The signs of the three volumes decide: exact as long as the
/// numbers are multiples of 1/16 below 2^11, in 64 bits of mantissa. A triangle on edge counts as nothing.
std::vector<Candidate> candidates(const std::vector<SampleTriangle>& triangles, const Point& from,
                                  const Point& direction) {
  std::vector<Candidate> found;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const SampleTriangle& t = triangles[k];
    std::array<Point, 3> corner;
    for (std::size_t c = 0; c < 3; ++c) {
      corner[c] = minus(Point{static_cast<long double>(t.column[c]), static_cast<long double>(t.row[c]),
                              static_cast<long double>(t.height[c])},
                        from);
    }
    const auto volume = [&](const Point& a, const Point& b) {
      return direction[0] * (a[1] * b[2] - a[2] * b[1]) + direction[1] * (a[2] * b[0] - a[0] * b[2]) +
             direction[2] * (a[0] * b[1] - a[1] * b[0]);
    };
    const long double u = volume(corner[1], corner[2]), v = volume(corner[2], corner[0]),
                      w = volume(corner[0], corner[1]), sum = u + v + w;
    if (sum == 0.0L || std::min({u, v, w}) * std::max({u, v, w}) < 0.0L) continue;
    const long double size = times(direction, direction);
    const long double time = (u * times(corner[0], direction) + v * times(corner[1], direction) +
                              w * times(corner[2], direction)) /
                             (sum * size);
    if (time >= 0.0L) found.push_back({time, k});
  }
  std::sort(found.begin(), found.end(),
            [](const Candidate& a, const Candidate& b) { return a.time < b.time; });
  return found;
}

/// [m] Of the ground; looks at every triangle.
std::optional<long double> groundAt(const std::vector<SampleTriangle>& triangles, long double x,
                                    long double y) {
  for (const SampleTriangle& t : triangles) {
    const auto side = [&](std::size_t a, std::size_t b) {
      return (t.column[a] - x) * (t.row[b] - y) - (t.column[b] - x) * (t.row[a] - y);
    };
    const long double u = side(1, 2), v = side(2, 0), w = side(0, 1);
    if (u < 0.0L || v < 0.0L || w < 0.0L) continue;
    return (u * t.height[0] + v * t.height[1] + w * t.height[2]) / (u + v + w);
  }
  return std::nullopt;
}

Point along(const Point& from, const Point& direction, long double time) {
  return {from[0] + time * direction[0], from[1] + time * direction[1], from[2] + time * direction[2]};
}

/// The first of the candidates after which the ray is on the other side of the ground.
std::size_t firstCrossing(const std::vector<SampleTriangle>& triangles, const std::vector<Candidate>& met,
                          const Point& from, const Point& direction) {
  const auto isAbove = [&](long double time) -> std::optional<bool> {
    const Point place = along(from, direction, time);
    const std::optional<long double> ground = groundAt(triangles, place[0], place[1]);
    if (!ground) return std::nullopt;
    return place[2] > *ground;
  };
  const bool above = *isAbove(0.0L);
  for (std::size_t k = 0; k < met.size(); ++k) {
    const long double next = k + 1 < met.size() ? met[k + 1].time : met[k].time + 1e-3L;
    if (next - met[k].time < 1e-12L) continue;
    if (isAbove(0.5L * (met[k].time + next)) != above) return k;
  }
  return met.size();
}

/// A ray that comes to the ground's other side, whatever it aims at, has to hit something, and what it hits
/// is one of the candidates up to the first where it changes sides. Counts those.
void expectNoLeak(const SceneQuery& query, const std::vector<SampleTriangle>& triangles, const Point& from,
                  const Point& direction, int& crossed) {
  const std::vector<Candidate> met = candidates(triangles, from, direction);
  const std::size_t crossing = firstCrossing(triangles, met, from, direction);
  if (crossing == met.size()) return;  // it only touched the tip of a pit, from below
  ++crossed;
  const RayHit hit = ask(query, ray(from, direction, std::numeric_limits<double>::infinity()));
  ASSERT_EQ(hit.end, RayEnd::ground);
  const auto isHit = [&](const Candidate& one) {
    return std::fabs(one.time - static_cast<long double>(hit.way)) <= 1e-12L * (1.0L + one.time);
  };
  ASSERT_TRUE(std::any_of(met.begin(), met.begin() + static_cast<std::ptrdiff_t>(crossing) + 1, isHit))
      << hit.way << " instead of " << static_cast<double>(met[crossing].time);
  ASSERT_EQ(hit.known, hit.way);
  const bool found = std::any_of(met.begin(), met.end(), [&](const Candidate& one) {
    if (!isHit(one)) return false;
    const SampleTriangle& t = triangles[one.triangle];
    const Point ab{static_cast<long double>(t.column[1] - t.column[0]),
                   static_cast<long double>(t.row[1] - t.row[0]),
                   static_cast<long double>(t.height[1] - t.height[0])};
    const Point ac{static_cast<long double>(t.column[2] - t.column[0]),
                   static_cast<long double>(t.row[2] - t.row[0]),
                   static_cast<long double>(t.height[2] - t.height[0])};
    const Point normal{hit.normal[0], hit.normal[1], hit.normal[2]};
    if (hit.fromBelow != (times(normal, direction) > 0.0L)) return false;
    return std::fabs(times(normal, ab)) < 1e-12L && std::fabs(times(normal, ac)) < 1e-12L &&
           std::fabs(length(normal) - 1.0L) < 1e-14L && normal[2] > 0.0L;
  });
  ASSERT_TRUE(found);
}

TEST(SceneRay, HitsWhatItCrossesAtVerticesSidesAndSeamsToo) {
  int crossed = 0;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    const SceneQuery query(mixed(seed), kIntervals);
    const std::vector<SampleTriangle> triangles = trianglesOf(*query.scene());
    Dice dice(seed);
    for (int trial = 0; trial < 300; ++trial) {
      const SampleTriangle& aim =
          triangles[static_cast<std::size_t>(dice.whole(0, static_cast<int>(triangles.size()) - 1))];
      // A vertex, the middle of a side, or a quarter of it; most sides lie between two triangles or meshes.
      const auto a = static_cast<std::size_t>(dice.whole(0, 2)),
                 b = static_cast<std::size_t>(dice.whole(0, 2));
      const long double share = dice.whole(0, 4) / 4.0L;
      const auto between = [&](auto from, auto to) {
        return static_cast<long double>(from) + share * static_cast<long double>(to - from);
      };
      const Point target{between(aim.column[a], aim.column[b]), between(aim.row[a], aim.row[b]),
                         between(aim.height[a], aim.height[b])};
      const long double side = trial % 2 == 0 ? 1.0L : -1.0L;
      Point from{static_cast<long double>(dice.whole(-60, 60)), static_cast<long double>(dice.whole(-60, 60)),
                 side * dice.whole(12, 60)};
      if (trial % 5 == 0) from[0] = target[0];  // along the lines of the lattice,
      if (trial % 7 == 0) from[1] = target[1];
      if (trial % 11 == 0) from[0] = target[0] + (from[1] - target[1]);  // and along its diagonals
      if (std::fabs(from[0]) > 62.0L) continue;
      const Point direction = minus(target, from);
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", trial " << trial);
      ASSERT_NO_FATAL_FAILURE(expectNoLeak(query, triangles, from, direction, crossed));
    }
  }
  EXPECT_GT(crossed, 450);
}

TEST(SceneRay, NothingLeaksThroughVerticesWhereverRoundingPutsThem) {
  constexpr double kSpacing = 0.1;
  Patchwork patchwork(kIntervals, kSpacing, rough);
  Dice dice(6);
  patchwork.addDivided(PatchworkNode{-64, -64, 4}, dice);
  const SceneQuery query(patchwork.scene(), kIntervals);
  const std::vector<SampleTriangle> triangles = trianglesOf(*query.scene());
  for (int trial = 0; trial < 30000; ++trial) {
    const SampleTriangle& aim =
        triangles[static_cast<std::size_t>(dice.whole(0, static_cast<int>(triangles.size()) - 1))];
    Ray ray;
    ray.from = *Position::fromMetres(dice.between(-6.3, 6.3), dice.between(-6.3, 6.3), kIntervals * kSpacing);
    ray.height = dice.between(200.0, 3000.0);
    const Position target{aim.column[0] >> 3, aim.row[0] >> 3, 0.125 * static_cast<double>(aim.column[0] & 7),
                          0.125 * static_cast<double>(aim.row[0] & 7)};
    const Offset away = offset(ray.from, target, kIntervals * kSpacing);
    ray.direction = {away.east, away.north, static_cast<double>(aim.height[0]) - ray.height};
    if (std::max(std::fabs(static_cast<double>(aim.column[0])), std::fabs(static_cast<double>(aim.row[0]))) >=
        48.0) {
      continue;  // what it does not hit there it would not hit before the rim of all there is
    }
    const RayHit hit = ask(query, ray);
    ASSERT_EQ(hit.end, RayEnd::ground) << trial;
    // It may pass a summit that it just touches; but what is under the ground comes out from below.
    ASSERT_TRUE(!hit.fromBelow || std::fabs(hit.way - 1.0) < 1e-9) << trial << ", " << hit.way;
  }
}

TEST(SceneRay, MeetsTheFirstOfAllTrianglesOrNone) {
  int hits = 0, misses = 0, grazes = 0;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    const SceneQuery query(mixed(seed), kIntervals);
    const std::vector<SampleTriangle> triangles = trianglesOf(*query.scene());
    Dice dice(seed + 100);
    for (int trial = 0; trial < 400; ++trial) {
      const Point from{dice.between(-90, 90), dice.between(-90, 90), dice.between(-20, 20)};
      const bool graze = trial % 2 == 0;
      const Point direction{dice.between(-1, 1), dice.between(-1, 1),
                            (graze ? 0.02L : 1.0L) * dice.between(-1, 1)};
      const double length = dice.between(0, 200);
      const RayHit hit = ask(query, ray(from, direction, length));
      const std::vector<Candidate> met = candidates(triangles, from, direction);
      const bool expected = !met.empty() && met.front().time <= static_cast<long double>(length);
      ASSERT_EQ(hit.end, expected ? RayEnd::ground : RayEnd::nothing) << seed << ", " << trial;
      (expected ? hits : misses) += 1;
      if (!expected) continue;
      grazes += graze ? 1 : 0;
      // [m] At the time of the hit the ray is in the triangle, as far as its height says.
      const Point place = along(from, direction, hit.way);
      ASSERT_NEAR(static_cast<double>(place[2]),
                  static_cast<double>(*groundAt(triangles, place[0], place[1])), rayError(300.0));
      ASSERT_NEAR(hit.way, static_cast<double>(met.front().time), 1e-6);
    }
  }
  EXPECT_GT(hits, 130);
  EXPECT_GT(misses, 200);
  EXPECT_GT(grazes, 50);
}

/// Mixed levels whose vertices move between the rough ground and what is three times as high.
std::shared_ptr<const Scene> moving(std::uint64_t seed) {
  Patchwork patchwork(kIntervals, 1.0, rough);
  patchwork.letMove([](std::int64_t column, std::int64_t row) { return 3.0F * rough(row, column); },
                    [](std::int64_t column, std::int64_t row) {
                      return rough(row, row + column) < 5.0F ? 1 : SurfaceVertex::kFixed;
                    },
                    Morph(0.05, std::vector<double>{1.0, 2.0, 7.0}));
  Dice dice(seed);
  for (const std::int64_t x : {-64, 0}) {
    for (const std::int64_t y : {-64, 0}) patchwork.addDivided(PatchworkNode{x, y, 3}, dice);
  }
  return patchwork.scene();
}

TEST(SceneRay, MeetsTheFirstOfAllTrianglesThatAnEyeSees) {
  int hits = 0, misses = 0, other = 0, beyond = 0;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    const SceneQuery lying(moving(seed), kIntervals);
    Dice dice(seed + 200);
    for (int look = 0; look < 8; ++look) {
      const test::EyePoint eye{dice.between(-120, 120), dice.between(-120, 120), dice.between(0, 60)};
      const SceneQuery seen =
          lying.seenFrom({*Position::fromMetres(eye.east, eye.north, kIntervals), eye.height});
      const std::vector<SampleTriangle> triangles = trianglesOf(*test::sceneSeenFrom(*lying.scene(), eye));
      for (int trial = 0; trial < 60; ++trial) {
        const Point from{dice.between(-90, 90), dice.between(-90, 90), dice.between(-20, 40)};
        const Point direction{dice.between(-1, 1), dice.between(-1, 1),
                              (trial % 2 == 0 ? 0.02L : 1.0L) * dice.between(-1, 1)};
        const Ray asked = ray(from, direction, dice.between(0, 200));
        const RayHit hit = ask(seen, asked);
        const std::vector<Candidate> met = candidates(triangles, from, direction);
        const bool expected = !met.empty() && met.front().time <= static_cast<long double>(asked.length);
        ASSERT_EQ(hit.end, expected ? RayEnd::ground : RayEnd::nothing)
            << seed << ", " << look << ", " << trial;
        (expected ? hits : misses) += 1;
        const RayHit unmoved = ask(lying, asked);
        other += unmoved.end != hit.end || std::fabs(unmoved.way - hit.way) > 0.01 ? 1 : 0;
        if (!expected) continue;
        ASSERT_NEAR(hit.way, static_cast<double>(met.front().time), 1e-6);
        // The bound is that of the height there.
        const Result<Position> place =
            asked.from.movedBy(hit.way * asked.direction[0], hit.way * asked.direction[1], kIntervals);
        DrawnPoint point;
        seen.points({&*place, 1}, {&point, 1});
        ASSERT_TRUE(point.there);
        ASSERT_NEAR(hit.error, point.error, 1e-6);
        beyond += std::fabs(asked.height + hit.way * asked.direction[2]) > 8.5 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(hits, 150);
  EXPECT_GT(misses, 300);
  EXPECT_GT(other, 150) << "what the same ray meets of the vertices as they lie";
  EXPECT_GT(beyond, 40) << "hits beyond all heights of the vertices as they lie";
}

TEST(SceneRay, ComesDownWhereTheHeightIs) {
  const SceneQuery query(mixed(4), kIntervals);
  Dice dice(4);
  for (int trial = 0; trial < 500; ++trial) {
    const double x = trial % 3 == 0 ? dice.whole(-64, 63) : dice.between(-64, 64);
    const double y = trial % 4 == 0 ? dice.whole(-64, 63) : dice.between(-64, 64);
    const Position place = *Position::fromMetres(x, y, kIntervals);
    DrawnPoint point;
    query.points({&place, 1}, {&point, 1});
    const RayHit down = ask(query, {place, 100.0}), up = ask(query, {place, -100.0, {0.0, 0.0, 0.25}});
    ASSERT_EQ(down.end, RayEnd::ground);
    ASSERT_NEAR(100.0 - down.way, point.height, 1e-12);
    ASSERT_FALSE(down.fromBelow);
    ASSERT_EQ(down.known, down.way);
    ASSERT_EQ(up.end, RayEnd::ground);
    ASSERT_NEAR(0.25 * up.way - 100.0, point.height, 1e-12);
    ASSERT_TRUE(up.fromBelow);
    ASSERT_EQ(ask(query, {place, 100.0, {0.0, 0.0, 1.0}}).end, RayEnd::nothing);
  }
}

TEST(SceneRay, InThePlaneOfFlatGroundItHitsWhereItComesToIt) {
  Patchwork patchwork(kIntervals, 1.0, [](std::int64_t, std::int64_t) { return 3.0F; });
  patchwork.add({0, 0, 1});
  const SceneQuery query(patchwork.scene(), kIntervals);
  const RayHit inside = ask(query, ray({5.25L, 4.5L, 3.0L}, {1.0L, 0.3L, 0.0L}, 10.0));
  EXPECT_EQ(inside.end, RayEnd::ground);
  EXPECT_EQ(inside.way, 0.0);
  const RayHit outside = ask(query, ray({-4.0L, 4.5L, 3.0L}, {2.0L, 0.25L, 0.0L}, 10.0));
  EXPECT_EQ(outside.end, RayEnd::ground);
  EXPECT_DOUBLE_EQ(outside.way, 2.0);
  EXPECT_EQ(outside.known, 0.0);
  EXPECT_EQ(ask(query, ray({-4.0L, 4.5L, 3.0L}, {2.0L, 0.25L, 0.0L}, 1.5)).end, RayEnd::nothing);
  EXPECT_EQ(ask(query, ray({5.0L, 4.5L, 3.01L}, {1.0L, 0.3L, 0.0L}, 10.0)).end, RayEnd::nothing);
}

TEST(SceneRay, SaysHowFarThereIsGroundBelowIt) {
  Patchwork patchwork(kIntervals, 1.0, rough);
  Dice pieces(2);
  for (int k = 0; k < 16; ++k) {  // ground with holes
    if (k % 5 != 3) patchwork.addDivided(PatchworkNode{32 * (k % 4), 32 * (k / 4), 2}, pieces);
  }
  const SceneQuery query(patchwork.scene(), kIntervals);
  Dice dice(2);
  int left = 0, stayed = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Point from{dice.between(0, 128), dice.between(0, 128), 20.0L};
    const Point direction{dice.between(-1, 1), dice.between(-1, 1), 0.001L};
    const double length = dice.between(0, 100);
    const RayHit hit = ask(query, ray(from, direction, length));
    ASSERT_EQ(hit.end, RayEnd::nothing);
    ASSERT_LE(hit.known, length);
    (hit.known == length ? stayed : left) += 1;
    const auto isThere = [&](double time) {
      const Point place = along(from, direction, time);
      const Position at =
          *Position::fromMetres(static_cast<double>(place[0]), static_cast<double>(place[1]), kIntervals);
      DrawnPoint point;
      query.points({&at, 1}, {&point, 1});
      return point.there;
    };
    for (int k = 0; k < 200; ++k) {
      const double time = hit.known * k / 200.0;
      ASSERT_TRUE(hit.known == 0.0 || isThere(time)) << trial << ", " << time;
    }
    if (hit.known < length) {
      ASSERT_FALSE(isThere(hit.known + 1e-6)) << trial;
    }
  }
  EXPECT_GT(left, 100);
  EXPECT_GT(stayed, 100);
}

TEST(SceneRay, BeyondAHoleAHitIsNotSure) {
  Patchwork patchwork(kIntervals, 1.0,
                      [](std::int64_t column, std::int64_t) { return column < 16 ? 0.0F : 50.0F; });
  patchwork.add({0, 0, 0});
  patchwork.add({16, 0, 0});
  const SceneQuery query(patchwork.scene(), kIntervals);
  const RayHit hit = ask(query, ray({4.0L, 4.5L, 10.0L}, {4.0L, 0.0L, 10.5L}, 100.0));
  ASSERT_EQ(hit.end, RayEnd::ground);
  EXPECT_NEAR(hit.way, 40.0 / 10.5, 1e-12);
  EXPECT_TRUE(hit.fromBelow);
  EXPECT_NEAR(hit.known, 1.0, 1e-6);
  EXPECT_EQ(ask(query, ray({40.0L, 4.5L, 10.0L}, {1.0L, 0.0L, -1.0L}, 100.0)).known, 0.0);
  const RayHit down = ask(query, ray({12.0L, 4.5L, 10.0L}, {0.0L, 0.0L, -1.0L}, 100.0));
  EXPECT_EQ(down.end, RayEnd::nothing);
  EXPECT_EQ(down.known, 0.0);
}

TEST(SceneRay, RefusesWhatIsNoRay) {
  const SceneQuery query(mixed(1), kIntervals);
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  std::vector<Ray> rays(11);
  rays[0].height = nan;
  rays[1].height = infinity;
  rays[2].height = 1.1e9;
  rays[3].from.u = nan;
  rays[4].from.i = kMaxPatch + 1;
  rays[5].direction = {0.0, 0.0, 0.0};
  rays[6].direction[0] = nan;
  rays[7].direction[1] = infinity;
  rays[8].length = nan;
  rays[9].length = -1e-9;
  rays[10].height = 100.0;  // and one that is one
  std::vector<RayHit> hits(rays.size());
  query.firstHits(rays, hits);
  for (std::size_t k = 0; k < 10; ++k) EXPECT_EQ(hits[k].end, RayEnd::refused) << k;
  EXPECT_EQ(hits[10].end, RayEnd::ground);
}

TEST(SceneRay, ExtremeRaysEndWell) {
  const SceneQuery query(mixed(1), kIntervals), empty(std::make_shared<const Scene>(), kIntervals);
  const double tiny = std::numeric_limits<double>::denorm_min(), huge = std::numeric_limits<double>::max();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double length : {0.0, 1.0, huge, infinity}) {
    for (const double a : {0.0, tiny, 1e-160, 1.0, huge}) {
      for (const double b : {0.0, -tiny, 1e-160, -1.0, huge}) {
        for (const double c : {0.0, -tiny, -1e-160, -1.0, -huge}) {
          if (a == 0.0 && b == 0.0 && c == 0.0) continue;
          const Ray ray{{0, 0, 0.3, 0.4}, 100.0, {a, b, c}, length};
          const RayHit hit = ask(query, ray);
          ASSERT_NE(hit.end, RayEnd::refused);
          ASSERT_FALSE(std::isnan(hit.way) || std::isnan(hit.known));
          ASSERT_EQ(ask(empty, ray).end, RayEnd::nothing);
        }
      }
    }
  }
  const std::int64_t far = std::int64_t{1} << 27;  // 2^30 m away, and aimed at the world's zero
  const RayHit hit = ask(query, {{far, -far, 0.25, 0.5}, 1e8, {-8.0 * far - 2.0, 8.0 * far - 4.0, -1e8}});
  EXPECT_EQ(hit.end, RayEnd::ground);
  EXPECT_NEAR(hit.way, 1.0, 1e-6);
}

}  // namespace
}  // namespace teren
