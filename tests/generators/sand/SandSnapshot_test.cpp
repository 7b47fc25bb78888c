#include "generators/sand/SandSnapshot.h"

#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "generators/sand/LevelSand.h"
#include "generators/sand/SandHistory.h"
#include "generators/sand/SandPublisher.h"
#include "tests/generators/sand/Heaps.h"

namespace teren {
namespace {

using Shared = std::shared_ptr<const SandSnapshot>;

double waves(double x, double y) {
  const double u = 4.0 * x - std::floor(4.0 * x), v = 3.0 * y - std::floor(3.0 * y);
  return 0.1 * u * v;
}

/// Whether a snapshot's normal is the mean of the faces' normals by their angles, computed with libm, each
/// of which may be 7e-5 off.
bool isNormal(const SandSurface& surface, VertexId v, const SandVertex& copy) {
  const Triangulation& mesh = surface.mesh();
  double sum[3] = {0.0, 0.0, 0.0};
  double allowed = 0.0;
  mesh.forEachCorner(v, [&](Link at) {
    double arrows[2][3];
    for (int k = 0; k < 2; ++k) {
      const VertexId n = mesh.corners(at.triangle())[k == 0 ? following(at.side()) : preceding(at.side())];
      arrows[k][0] = (mesh.point(n).x - mesh.point(v).x) * surface.step();
      arrows[k][1] = (mesh.point(n).y - mesh.point(v).y) * surface.step();
      arrows[k][2] = mesh.height(n) - mesh.height(v);
    }
    const auto &b = arrows[0], &c = arrows[1];
    const double cross[3] = {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]};
    const double length = std::hypot(cross[0], cross[1], cross[2]);
    const double angle = std::atan2(length, b[0] * c[0] + b[1] * c[1] + b[2] * c[2]);
    for (int i = 0; i < 3; ++i) sum[i] += angle * cross[i] / length;
    allowed += 7e-5;
  });
  const double length = std::hypot(sum[0], sum[1], sum[2]);
  allowed = allowed / length + 0.51 / 32767.0;
  return std::fabs(sum[0] / length - copy.normal[0] / 32767.0) < allowed &&
         std::fabs(sum[1] / length - copy.normal[1] / 32767.0) < allowed;
}

std::string differenceAt(const SandSurface& surface, const SandSnapshot& copy, VertexId v) {
  const std::string name = "vertex " + std::to_string(v);
  if (!surface.mesh().isVertex(v)) return copy.vertex(v) == SandVertex{} ? "" : name + " is gone";
  const SandVertex& one = copy.vertex(v);
  if (!(one.place == surface.mesh().point(v))) return name + " is elsewhere";
  if (one.height != static_cast<float>(surface.mesh().height(v))) return name + " has another height";
  if (one.loose != static_cast<float>(metresFromTicks(surface.loose(v))))
    return name + " bears something else";
  return isNormal(surface, v, one) ? "" : name + " has another normal";
}

bool liesIn(const SandBounds& bounds, const SandVertex& vertex) {
  return bounds.southWest.x <= vertex.place.x && vertex.place.x <= bounds.northEast.x &&
         bounds.southWest.y <= vertex.place.y && vertex.place.y <= bounds.northEast.y &&
         bounds.low <= vertex.height && vertex.height <= bounds.high;
}

std::string differenceIn(const SandSurface& surface, const SandSnapshot& copy, TriangleId t) {
  const std::string name = "triangle " + std::to_string(t);
  if (!surface.mesh().isTriangle(t)) return copy.isTriangle(t) ? name + " is gone" : "";
  if (!copy.isTriangle(t) || copy.corners(t) != surface.mesh().corners(t)) return name + " differs";
  for (int i = 0; i < 3; ++i) {
    if (copy.isConstrained(t, i) != surface.mesh().isConstrained(t, i)) return name + " has another fence";
    if (!liesIn(copy.bounds(t / SandTrianglePage::kSlots), copy.vertex(copy.corners(t)[i])))
      return name + " is out of bounds";
    if (!liesIn(copy.bounds(), copy.vertex(copy.corners(t)[i]))) return name + " is out of all bounds";
  }
  return "";
}

/// How a snapshot differs from a surface, or nothing.
std::string difference(const SandSurface& surface, const SandSnapshot& copy) {
  const Triangulation& mesh = surface.mesh();
  if (copy.vertexSlots() != mesh.vertexSlots() || copy.triangleSlots() != mesh.triangleSlots() ||
      copy.vertexCount() != mesh.vertexCount() || copy.triangleCount() != mesh.triangleCount())
    return "the counts differ";
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v) {
    if (std::string found = differenceAt(surface, copy, v); !found.empty()) return found;
  }
  for (TriangleId t = 0; t < mesh.triangleSlots(); ++t) {
    if (std::string found = differenceIn(surface, copy, t); !found.empty()) return found;
  }
  return "";
}

/// Copies of everything a snapshot holds.
struct Content {
  std::vector<SandVertexPage> vertices;
  std::vector<SandTrianglePage> triangles;
  friend bool operator==(const Content&, const Content&) = default;
};

Content contentOf(const SandSnapshot& snapshot) {
  Content content;
  for (std::size_t i = 0; i < snapshot.vertexPages().size(); ++i)
    content.vertices.push_back(snapshot.vertexPages()[i]);
  for (std::size_t i = 0; i < snapshot.trianglePages().size(); ++i)
    content.triangles.push_back(snapshot.trianglePages()[i]);
  return content;
}

/// How a snapshot differs from one that a new publisher makes, or nothing; empty pages may follow.
std::string differenceFromNew(Sandbox sandbox, const SandSnapshot& copy) {
  SandPublisher publisher;
  const Shared fresh = publisher.publishAll(sandbox);
  const Content expected = contentOf(*fresh);
  Content content = contentOf(copy);
  const std::size_t pages = expected.triangles.size();
  for (std::size_t i = 0; i < content.triangles.size(); ++i) {
    if (copy.bounds(i) != (i < pages ? fresh->bounds(i) : SandBounds{}))
      return "page " + std::to_string(i) + " has other bounds";
  }
  const SandVertexPage noVertices{};
  const SandTrianglePage noTriangles{};
  while (content.vertices.size() > expected.vertices.size() && content.vertices.back() == noVertices)
    content.vertices.pop_back();
  while (content.triangles.size() > pages && content.triangles.back() == noTriangles)
    content.triangles.pop_back();
  if (content.vertices != expected.vertices) return "the vertices differ";
  if (content.triangles != expected.triangles) return "the triangles differ";
  return copy.bounds() == fresh->bounds() ? "" : "all bounds differ";
}

/// Sand, a publisher and random moves.
class Game {
 public:
  explicit Game(std::uint64_t seed, int vertices = 900)
      : random_(seed), sandbox_(scatteredSand(vertices, seed, 0.02, waves), {}) {
    sandbox_.loosenAll();
  }
  Sandbox& sandbox() { return sandbox_; }
  const SandSurface& surface() const { return sandbox_.surface(); }
  Shared publish() { return publisher_.publish(sandbox_); }
  Shared publishAll() { return publisher_.publishAll(sandbox_); }

  void move() {
    static const std::vector<ToolShape> tools{*ToolShape::disc(0.05, 0.1), *ToolShape::rake(0.16, 0.04, 4),
                                              *ToolShape::square(0.1, 0.05)};
    switch (random_.next() % 4) {
      case 0:
        (void)sandbox_.stamp(tools[random_.next() % tools.size()],
                             {uniform(random_.next()), uniform(random_.next()),
                              0.3 * uniform(random_.next()) - 0.1, 1.0, 0.0});
        break;
      case 1:
        sandbox_.clean();
        break;
      default:
        sandbox_.slide(random_.next() % 300);
    }
  }

 private:
  RandomSequence random_;
  Sandbox sandbox_;
  SandPublisher publisher_;
};

TEST(SandSnapshot, EqualsTheSurfaceAfterAnyMoves) {
  for (std::uint64_t seed = 71; seed < 76; ++seed) {
    Game game(seed);
    ASSERT_EQ(difference(game.surface(), *game.publish()), "") << "seed " << seed;
    for (int n = 0; n < 60; ++n) {
      game.move();
      if (n % 3 != 0) continue;
      ASSERT_EQ(difference(game.surface(), *game.publish()), "") << "move " << n << ", seed " << seed;
    }
  }
}

TEST(SandSnapshot, EqualsAnotherSurfaceThatHasTakenThePlaceOfTheFirst) {
  Game game(77, 3'000), other(78, 400);
  game.publish();
  game.sandbox() = other.sandbox();
  const Shared taken = game.publishAll();
  ASSERT_EQ(difference(game.surface(), *taken), "");
  ASSERT_EQ(differenceFromNew(game.sandbox(), *taken), "");
  EXPECT_TRUE(taken->hit({{0.5, 0.5, 2.0}, {0.0, 0.0, -1.0}}));
  EXPECT_FALSE(taken->hit({{0.5, 0.5, 2.0}, {0.0, 0.0, 1.0}}));
  game.move();
  ASSERT_EQ(difference(game.surface(), *game.publish()), "");
}

TEST(SandSnapshot, EqualsSandOfTheSameHeightsInAWiderBox) {
  const auto sandOf = [](double step) {
    RandomSequence random(88);
    std::vector<LatticePoint> points;
    std::vector<double> heights;
    for (int n = 0; n < 1'000; ++n) {
      const auto x = static_cast<std::int32_t>(random.nextBits(20));
      points.push_back({x, static_cast<std::int32_t>(random.nextBits(20))});
      heights.push_back(0.1 * uniform(random.next()));
    }
    return Sandbox(SandSurface(boxOf(20, step), points, heights, 0.01), {});
  };
  Sandbox sandbox = sandOf(0x1p-20);
  SandPublisher publisher;
  publisher.publish(sandbox);
  sandbox = sandOf(0x1p-18);
  EXPECT_EQ(difference(sandbox.surface(), *publisher.publishAll(sandbox)), "");
}

TEST(SandSnapshot, EqualsSandThatHasBeenPutBack) {
  Game game(86, 3'000);
  const Sandbox before = game.sandbox();
  game.publish();
  game.sandbox().slide(20'000);
  ASSERT_NE(difference(before.surface(), *game.publish()), "");
  game.sandbox() = before;
  ASSERT_EQ(difference(game.surface(), *game.publishAll()), "");
}

TEST(SandSnapshot, EqualsTheSurfaceAfterUndoAndRedo) {
  for (std::uint64_t seed = 91; seed < 95; ++seed) {
    Game game(seed, 2'000);
    SandHistory history(std::size_t{1} << 30);
    const auto follows = [&] { return differenceFromNew(game.sandbox(), *game.publish()); };
    ASSERT_EQ(follows(), "");
    for (int action = 0; action < 10; ++action) {
      history.note(game.sandbox());
      for (int n = 0; n < 3; ++n) game.move();
      ASSERT_EQ(follows(), "") << "action " << action << ", seed " << seed;
    }
    int undone = 0;
    for (; history.undo(game.sandbox()); ++undone) ASSERT_EQ(follows(), "") << undone << ", seed " << seed;
    ASSERT_GT(undone, 5);
    for (; history.redo(game.sandbox()); --undone) ASSERT_EQ(follows(), "") << undone << ", seed " << seed;
  }
}

TEST(SandSnapshot, SharesAllPagesWhereNothingChanged) {
  Game game(79, 20'000);
  const Shared first = game.publish();
  const Shared same = game.publish(), again = game.publishAll();
  int differences = 0;
  const auto count = [&](std::size_t) { ++differences; };
  same->vertexPages().forEachDifference(first->vertexPages(), count);
  same->trianglePages().forEachDifference(first->trianglePages(), count);
  again->vertexPages().forEachDifference(first->vertexPages(), count);
  again->trianglePages().forEachDifference(first->trianglePages(), count);
  EXPECT_EQ(differences, 0);

  ASSERT_TRUE(game.sandbox().stamp(*ToolShape::disc(0.03, 0.01), {0.5, 0.5, 0.02}));
  const Shared dug = game.publish();
  std::vector<bool> changed(dug->vertexPages().size()), changedTriangles(dug->trianglePages().size());
  dug->vertexPages().forEachDifference(first->vertexPages(), [&](std::size_t i) { changed[i] = true; });
  dug->trianglePages().forEachDifference(first->trianglePages(),
                                         [&](std::size_t i) { changedTriangles[i] = true; });
  int shared = 0;
  for (std::size_t i = 0; i < first->vertexPages().size(); ++i) {
    EXPECT_EQ(changed[i], !(dug->vertexPages()[i] == first->vertexPages()[i])) << "vertex page " << i;
    shared += changed[i] ? 0 : 1;
  }
  for (std::size_t i = 0; i < first->trianglePages().size(); ++i) {
    EXPECT_GE(changedTriangles[i], !(dug->trianglePages()[i] == first->trianglePages()[i])) << "page " << i;
    shared += changedTriangles[i] ? 0 : 1;
  }
  EXPECT_GT(shared, static_cast<int>(changed.size() + changedTriangles.size()) * 3 / 4);
}

TEST(SandSnapshot, StaysAsItWasPublished) {
  Game game(80);
  std::vector<Shared> kept;
  std::vector<Content> contents;
  for (int n = 0; n < 40; ++n) {
    kept.push_back(n % 10 == 9 ? game.publishAll() : game.publish());
    contents.push_back(contentOf(*kept.back()));
    game.move();
  }
  game.publish();
  for (std::size_t n = 0; n < kept.size(); ++n) EXPECT_TRUE(contentOf(*kept[n]) == contents[n]) << n;
}

TEST(SandSnapshot, IsTheSameObjectUntilSomethingChanges) {
  Sandbox sandbox(levelSand(900, 0.2, 0), {});
  SandPublisher publisher;
  const Shared first = publisher.publish(sandbox);
  EXPECT_TRUE(publisher.publish(sandbox) == first);
  ASSERT_TRUE(sandbox.stamp(*ToolShape::disc(0.05, 0.1), {0.5, 0.5}));
  EXPECT_FALSE(publisher.publish(sandbox) == first);
  for (int n = 0; n < 20; ++n) sandbox.iterate(100'000);
  const Shared atRest = publisher.publish(sandbox);
  for (int n = 0; n < 50; ++n) {
    sandbox.iterate(20'000);
    ASSERT_TRUE(publisher.publish(sandbox) == atRest) << n;
  }
}

/// Its faces are so thin that products of their sides differ by less than rounding.
TEST(SandSnapshot, HasOneNormalOnAPlaneHoweverThinItsFacesAre) {
  const LatticeFrame frame = boxOf(28, 0x1p-20);
  const std::vector<LatticePoint> points{{0, 0},
                                         {frame.width, 0},
                                         {frame.width, frame.height},
                                         {0, frame.height},
                                         {200'000'000, 199'999'999},
                                         {200'000'001, 200'000'000}};
  std::vector<double> heights;
  for (const LatticePoint p : points) heights.push_back(p.x * 0x1p-21);
  SandSurface surface(frame, points, heights, 0.0);
  const TriangleId hint = surface.mesh().triangleAt(0);
  surface.constrain(0, surface.insert(points[5], hint), 1);
  surface.constrain(0, surface.insert(points[4], hint), 1);
  Sandbox sandbox(std::move(surface), {});
  SandPublisher publisher;
  const Shared sand = publisher.publish(sandbox);
  for (VertexId v = 0; v < sand->vertexSlots(); ++v) {
    if (!sand->vertex(v).isThere()) continue;
    EXPECT_NEAR(sand->vertex(v).normal[0], -32767.0 * std::sqrt(0.2), 2.0) << v;
    EXPECT_NEAR(sand->vertex(v).normal[1], 0.0, 2.0) << v;
  }
}

/// How many pages a tool as large as so many vertices touches, on average.
double pagesTouched(int vertices) {
  Sandbox sandbox(levelSand(vertices, 1.0, 1'000), {});
  SandPublisher publisher;
  Shared last = publisher.publish(sandbox);
  const double spacing = 1.0 / std::sqrt(vertices);
  const ToolShape tool = *ToolShape::disc(6.0 * spacing, 3.0 * spacing);
  int pages = 0;
  constexpr int kStamps = 20;
  for (int n = 0; n < kStamps; ++n) {
    EXPECT_TRUE(sandbox.stamp(tool, {0.4 + 2.0 * spacing * n, 0.45, 0.0, 1.0, 0.0}));
    sandbox.iterate(2'000);
    const Shared next = publisher.publish(sandbox);
    next->vertexPages().forEachDifference(last->vertexPages(), [&](std::size_t) { ++pages; });
    next->trianglePages().forEachDifference(last->trianglePages(), [&](std::size_t) { ++pages; });
    last = next;
  }
  return pages / static_cast<double>(kStamps);
}

TEST(SandSnapshot, CostsWhatHasChangedAndNotTheMesh) {
  const double small = pagesTouched(10'000), large = pagesTouched(160'000);
  EXPECT_LT(large, 1.5 * small);
  EXPECT_LT(large, 80.0);
  RecordProperty("pages", std::to_string(large));
}

TEST(SandSnapshot, TakesAsManyBytesAsItsHeaderSays) {
  Sandbox sandbox(levelSand(50'000, 1.0, 0), {});
  SandPublisher publisher;
  const Shared snapshot = publisher.publish(sandbox);
  const double each = static_cast<double>(snapshot->bytes()) / static_cast<double>(snapshot->vertexCount());
  EXPECT_GT(each, 46.0 - 0.1);
  EXPECT_LT(each, 47.5);
}

TEST(SandSnapshot, IsWholeInAReadersThreadWhileTheSandGoesOn) {
  Game game(81);
  std::mutex door;
  Shared latest = game.publish();
  std::atomic<bool> over = false;
  std::atomic<int> torn = 0, looks = 0;
  std::thread reader([&] {
    while (!over || looks < 10) {
      Shared mine;
      {
        const std::lock_guard lock(door);
        mine = latest;
      }
      // Triangles whose corners are all there, and as many of both as it says.
      std::size_t vertices = 0, triangles = 0;
      for (VertexId v = 0; v < mine->vertexSlots(); ++v) vertices += mine->vertex(v).isThere() ? 1 : 0;
      for (TriangleId t = 0; t < mine->triangleSlots(); ++t) {
        if (!mine->isTriangle(t)) continue;
        ++triangles;
        for (const VertexId v : mine->corners(t)) torn += mine->vertex(v).isThere() ? 0 : 1;
      }
      torn += vertices == mine->vertexCount() && triangles == mine->triangleCount() ? 0 : 1;
      ++looks;
    }
  });
  for (int n = 0; n < 200; ++n) {
    game.move();
    const Shared next = game.publish();
    const std::lock_guard lock(door);
    latest = next;
  }
  over = true;
  reader.join();
  EXPECT_EQ(torn, 0);
}

/// Where a ray first meets any triangle, by Cramer's rule, all triangles looked at.
std::optional<double> nearestByForce(const SandSnapshot& sand, const SandRay& ray) {
  std::optional<double> nearest;
  const auto determinant = [](const std::array<double, 3>& a, const std::array<double, 3>& b,
                              const std::array<double, 3>& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  for (TriangleId t = 0; t < sand.triangleSlots(); ++t) {
    if (!sand.isTriangle(t)) continue;
    std::array<std::array<double, 3>, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const SandVertex& v = sand.vertex(sand.corners(t)[k]);
      p[k] = {sand.frame().placeX(v.place), sand.frame().placeY(v.place), static_cast<double>(v.height)};
    }
    std::array<double, 3> b, c, to, back;
    for (std::size_t i = 0; i < 3; ++i) {
      b[i] = p[1][i] - p[0][i];
      c[i] = p[2][i] - p[0][i];
      to[i] = ray.from[i] - p[0][i];
      back[i] = -ray.direction[i];
    }
    const double all = determinant(b, c, back);
    const double u = determinant(to, c, back) / all, v = determinant(b, to, back) / all;
    const double distance = determinant(b, c, to) / all;
    if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance >= 0.0)) continue;
    if (!nearest || distance < *nearest) nearest = distance;
  }
  return nearest;
}

TEST(SandSnapshot, FindsWhereARayFirstMeetsTheSurface) {
  Game game(82, 2'000);
  for (int n = 0; n < 30; ++n) game.move();
  const Shared sand = game.publish();
  RandomSequence random(83);
  int hits = 0, misses = 0;
  for (int n = 0; n < 500; ++n) {
    SandRay ray;
    for (std::size_t i = 0; i < 3; ++i) {
      ray.from[i] = 3.0 * uniform(random.next()) - 1.0;
      ray.direction[i] = uniform(random.next()) - ray.from[i];
    }
    ray.direction[2] = n % 3 == 0 ? -0.1 : 0.1 * uniform(random.next()) - ray.from[2];
    const std::optional<SandHit> hit = sand->hit(ray);
    const std::optional<double> expected = nearestByForce(*sand, ray);
    ASSERT_EQ(hit.has_value(), expected.has_value()) << n;
    if (!hit) {
      ++misses;
      continue;
    }
    ++hits;
    ASSERT_NEAR(hit->distance, *expected, 1e-9) << n;
    const std::optional<double> ground = game.surface().mesh().heightAt(hit->x, hit->y);
    ASSERT_TRUE(ground) << n;
    EXPECT_NEAR(hit->height, *ground, 1e-6) << n;
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 20);
}

TEST(SandSnapshot, LetsNoRaySlipThroughAVertexOrAnEdge) {
  Game game(84, 600);
  const Shared sand = game.publish();
  const auto inTheMiddle = [](double place) { return 0.2 < place && place < 0.8; };
  for (TriangleId t = 0; t < sand->triangleSlots(); ++t) {
    if (!sand->isTriangle(t)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const SandVertex& a = sand->vertex(sand->corners(t)[k]);
      const SandVertex& b = sand->vertex(sand->corners(t)[(k + 1) % 3]);
      const double x = sand->frame().placeX(a.place), y = sand->frame().placeY(a.place);
      for (const double part : {0.0, 0.37}) {
        const double u = x + part * (sand->frame().placeX(b.place) - x);
        const double v = y + part * (sand->frame().placeY(b.place) - y);
        const double h = static_cast<double>(a.height) + part * static_cast<double>(b.height - a.height);
        EXPECT_TRUE(sand->hit({{u, v, 2.0}, {0.0, 0.0, -1.0}})) << t;
        if (!inTheMiddle(u) || !inTheMiddle(v)) continue;  // where it grazes a ridge it finds ground behind
        EXPECT_TRUE(sand->hit({{0.3, 0.4, 2.0}, {u - 0.3, v - 0.4, h - 2.0}})) << t;
      }
    }
  }
}

TEST(SandSnapshot, AnswersNothingToWhatIsNoRay) {
  Game game(85);
  const Shared sand = game.publish();
  const double nan = std::nan("");
  EXPECT_TRUE(sand->hit({{0.5, 0.5, 1.0}, {0.0, 0.0, -1.0}}));
  EXPECT_FALSE(sand->hit({{0.5, 0.5, 1.0}, {0.0, 0.0, 0.0}}));
  EXPECT_FALSE(sand->hit({{0.5, 0.5, 1.0}, {0.0, 0.0, 1.0}}));
  EXPECT_FALSE(sand->hit({{nan, 0.5, 1.0}, {0.0, 0.0, -1.0}}));
  EXPECT_FALSE(sand->hit({{0.5, 0.5, 1.0}, {0.0, nan, -1.0}}));
  EXPECT_FALSE(sand->hit({{0.5, 0.5, HUGE_VAL}, {0.0, 0.0, -1.0}}));
}

}  // namespace
}  // namespace teren
