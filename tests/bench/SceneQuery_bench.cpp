// Heights on the drawn ground, many places at a time, beside one place at a time, beside the plainest way,
// and beside a look at every triangle. Repetitions are interleaved at random; the ratios of the medians come
// last.
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "teren/Hash.h"
#include "teren/SceneQuery.h"
#include "teren/World.h"

#include "stream/Sweep.h"
#include "tests/bench/MedianReporter.h"
#include "tests/engine/stream/PatchGround.h"
#include "tests/engine/stream/PatchworkScene.h"

namespace teren {
namespace {

constexpr int kIntervals = 32;
constexpr double kSpacing = 2.0;
constexpr std::size_t kPlaces = std::size_t{1} << 16;
/// [m] Half the side of the ground asked.
constexpr double kReach = 4000.0;

float hills(std::int64_t column, std::int64_t row) {
  const double x = static_cast<double>(column), y = static_cast<double>(row);
  return static_cast<float>(60.0 * std::sin(0.011 * x) * std::cos(0.013 * y) +
                            5.0 * std::sin(0.1 * x + 0.13 * y));
}

/// 8 km of ground, finer towards the middle: levels 0 to 3, about 1,000 nodes.
void divide(Patchwork& patchwork, const PatchworkNode& node) {
  const std::int64_t side = patchwork.side(node), half = side / 2;
  const double away = std::max(std::fabs(static_cast<double>(node.west + half)),
                               std::fabs(static_cast<double>(node.south + half)));
  if (node.level == 0 || away > 1.6 * static_cast<double>(side)) return patchwork.add(node);
  for (const std::int64_t y : {std::int64_t{0}, half}) {
    for (const std::int64_t x : {std::int64_t{0}, half}) {
      divide(patchwork, PatchworkNode{node.west + x, node.south + y, node.level - 1});
    }
  }
}

/// Every vertex may move, a few metres, and beyond 200 m all do.
Patchwork movable() {
  Patchwork patchwork(kIntervals, kSpacing, hills);
  patchwork.letMove([](std::int64_t column, std::int64_t row) { return hills(column, row) + 3.0F; },
                    [](std::int64_t, std::int64_t) { return 0; },
                    Morph(0.01, std::vector<double>{0.0, 100.0}));
  return patchwork;
}

/// In the middle, as high as an aircraft.
constexpr DetailEye kEye{{}, 300.0};

std::shared_ptr<const Scene> mixedScene() {
  Patchwork patchwork = movable();
  for (const std::int64_t x : {-2048, 0}) {
    for (const std::int64_t y : {-2048, 0}) divide(patchwork, PatchworkNode{x, y, 6});
  }
  return patchwork.scene();
}

/// 8 km of one level.
std::shared_ptr<const Scene> evenScene(int level) {
  Patchwork patchwork = movable();
  const std::int64_t side = std::int64_t{kIntervals} << level, nodes = 4096 / side;
  patchwork.addEven({-2048, -2048, level}, static_cast<int>(nodes), static_cast<int>(nodes));
  return patchwork.scene();
}

std::vector<Position> scattered() {
  Dice dice(1);
  std::vector<Position> places;
  while (places.size() < kPlaces) {
    places.push_back(*Position::fromMetres(dice.between(-kReach, kReach), dice.between(-kReach, kReach),
                                           kIntervals * kSpacing));
  }
  return places;
}

/// 256 x 256 places half a metre apart, row by row.
std::vector<Position> raster() {
  std::vector<Position> places;
  for (std::size_t k = 0; k < kPlaces; ++k) {
    places.push_back(*Position::fromMetres(0.5 * static_cast<double>(k % 256),
                                           0.5 * static_cast<double>(k / 256), kIntervals * kSpacing));
  }
  return places;
}

/// As the vertices lie, or as an eye sees them.
enum class Vertices { lying, seen };
SceneQuery queryOf(const std::shared_ptr<const Scene>& scene, Vertices vertices) {
  const SceneQuery query(scene, kIntervals);
  return vertices == Vertices::seen ? query.seenFrom(kEye) : query;
}

void batched(benchmark::State& state, const std::shared_ptr<const Scene>& scene,
             const std::vector<Position>& places, Vertices vertices) {
  const SceneQuery query = queryOf(scene, vertices);
  std::vector<DrawnPoint> answers(places.size());
  for (auto _ : state) {
    query.points(places, answers);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(places.size()));
}

void single(benchmark::State& state, const std::shared_ptr<const Scene>& scene,
            const std::vector<Position>& places) {
  const SceneQuery query(scene, kIntervals);
  std::vector<DrawnPoint> answers(places.size());
  for (auto _ : state) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      query.points({&places[k], 1}, {&answers[k], 1});
      benchmark::ClobberMemory();
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(places.size()));
}

/// What a program would write that has nothing but the scene: every mesh whose rectangle holds the place,
/// every triangle of those. Of the first 64 places.
void everyMesh(benchmark::State& state, const std::shared_ptr<const Scene>& scene,
               const std::vector<Position>& places) {
  for (auto _ : state) {
    for (std::size_t k = 0; k < 64; ++k) {
      const double x = places[k].x(kIntervals * kSpacing) / kSpacing,
                   y = places[k].y(kIntervals * kSpacing) / kSpacing;
      double height = 0.0;
      for (const auto& mesh : scene->meshes()) {
        const double step = static_cast<double>(std::int64_t{1} << mesh->level);
        const double column = (x - static_cast<double>(mesh->originColumn)) / step;
        const double row = (y - static_cast<double>(mesh->originRow)) / step;
        if (column < 0.0 || row < 0.0 || column > mesh->columns || row > mesh->rows) continue;
        for (std::size_t at = 0; at < mesh->indices->size(); at += 3) {
          const SurfaceVertex& a = mesh->vertices[(*mesh->indices)[at]];
          const SurfaceVertex& b = mesh->vertices[(*mesh->indices)[at + 1]];
          const SurfaceVertex& c = mesh->vertices[(*mesh->indices)[at + 2]];
          const auto side = [&](const SurfaceVertex& p, const SurfaceVertex& q) {
            return (p.column - column) * (q.row - row) - (q.column - column) * (p.row - row);
          };
          const double u = side(b, c), v = side(c, a), w = side(a, b);
          if (u < 0.0 || v < 0.0 || w < 0.0) continue;
          height = (u * static_cast<double>(a.height) + v * static_cast<double>(b.height) +
                    w * static_cast<double>(c.height)) /
                   (u + v + w);
        }
      }
      benchmark::DoNotOptimize(height);
    }
  }
  state.SetItemsProcessed(state.iterations() * 64);
}

enum class Aim { down, mouse, graze };

/// 4,096 rays from places over the ground: straight down; as from an eye 100 m high, within 45 degrees below
/// the horizon; and nearly level, 20 m above the ground where they begin.
std::vector<Ray> raysOver(const std::vector<Position>& places, Aim aim) {
  Dice dice(2);
  std::vector<Ray> rays;
  for (std::size_t k = 0; k < 4096; ++k) {
    Ray& ray = rays.emplace_back();
    ray.from = places[k];
    ray.height = aim == Aim::graze ? 80.0 : 160.0;
    const double down = aim == Aim::graze ? 0.01 : 1.0;
    if (aim != Aim::down) {
      ray.direction = {dice.between(-1, 1), dice.between(-1, 1), -down * dice.between(0, 1)};
    }
  }
  return rays;
}

void firstHits(benchmark::State& state, const std::shared_ptr<const Scene>& scene,
               const std::vector<Ray>& rays, Vertices vertices) {
  const SceneQuery query = queryOf(scene, vertices);
  std::vector<RayHit> hits(rays.size());
  for (auto _ : state) {
    query.firstHits(rays, hits);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

/// Moeller and Trumbore's test of every triangle, four rays.
void everyTriangle(benchmark::State& state, const std::shared_ptr<const Scene>& scene,
                   const std::vector<Ray>& rays) {
  const auto cross = [](const Vector3& a, const Vector3& b) {
    return Vector3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  for (auto _ : state) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double x = rays[k].from.x(kIntervals * kSpacing), y = rays[k].from.y(kIntervals * kSpacing);
      const Vector3 way{rays[k].direction[0], rays[k].direction[1], rays[k].direction[2]};
      double first = 1e300;
      for (const auto& mesh : scene->meshes()) {
        const double step = kSpacing * static_cast<double>(std::int64_t{1} << mesh->level);
        const Vector3 from{x - static_cast<double>(mesh->originColumn) * kSpacing,
                           y - static_cast<double>(mesh->originRow) * kSpacing, rays[k].height};
        const auto corner = [&](std::uint32_t number) {
          const SurfaceVertex& vertex = mesh->vertices[number];
          return Vector3{vertex.column * step, vertex.row * step, static_cast<double>(vertex.height)};
        };
        for (std::size_t at = 0; at < mesh->indices->size(); at += 3) {
          const Vector3 a = corner((*mesh->indices)[at]), ab = corner((*mesh->indices)[at + 1]) - a,
                        ac = corner((*mesh->indices)[at + 2]) - a, p = cross(way, ac), t = from - a;
          const double whole = dot(ab, p), u = dot(t, p) / whole;
          const Vector3 q = cross(t, ab);
          const double v = dot(way, q) / whole, time = dot(ac, q) / whole;
          if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && time >= 0.0 && time < first) first = time;
        }
      }
      benchmark::DoNotOptimize(first);
    }
  }
  state.SetItemsProcessed(state.iterations() * 4);
}

/// Making the query of a snapshot, from nothing and from that of the snapshot before.
void make(benchmark::State& state, const std::shared_ptr<const Scene>& scene, bool again) {
  const SceneQuery before(scene, kIntervals);
  for (auto _ : state) {
    const SceneQuery query(scene, kIntervals, {}, again ? &before : nullptr);
    benchmark::DoNotOptimize(query.bytes());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene->meshes().size()));
}

/// Heights of the landscape's function, in the standard world, at 4,096 of the places, which leap about in
/// 300 patches.
void function(benchmark::State& state, const std::vector<Position>& places, bool atOnce) {
  const auto world = World::create(WorldDescription::standard(), *PluginRegistry::standard());
  if (!world) return state.SkipWithError(world.error().message.c_str());
  std::vector<Position> near(places.begin(), places.begin() + 4096);
  for (Position& place : near) {
    place.i /= 8;
    place.j /= 8;
  }
  std::vector<double> heights(near.size());
  (*world)->heights(near, heights);  // makes the maps
  for (auto _ : state) {
    if (atOnce) {
      (*world)->heights(near, heights);
    } else {
      for (std::size_t k = 0; k < near.size(); ++k) heights[k] = (*world)->height(near[k]);
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(near.size()));
}

int runAll(int argc, char** argv) {
  if (!initializeRepeated(argc, argv)) return 2;
  const auto mixed = mixedScene(), even = evenScene(2);
  const std::vector<Position> everywhere = scattered(), rows = raster();
  for (const auto& [name, scene] : {std::pair{"mixed", mixed}, {"even", even}}) {
    const auto add = [&, scene = scene](const std::string& what, auto&& work) {
      benchmark::RegisterBenchmark((what + "/" + name).c_str(), std::forward<decltype(work)>(work))
          ->Unit(benchmark::kMicrosecond);
    };
    std::size_t bytes = 0;
    for (const auto& mesh : scene->meshes()) bytes += mesh->bytes();
    std::printf("%s: %zu meshes, %zu triangles, %zu bytes; the query has %zu\n", name, scene->meshes().size(),
                scene->triangles(), bytes, SceneQuery(scene, kIntervals).bytes());
    for (const auto& [how, vertices] : {std::pair{"", Vertices::lying}, {"-seen", Vertices::seen}}) {
      const auto addBatch = [&](const char* what, const std::vector<Position>& places) {
        add(std::string(what) + how, [&places, scene = scene, vertices = vertices](benchmark::State& state) {
          batched(state, scene, places, vertices);
        });
      };
      addBatch("scattered", everywhere);
      addBatch("raster", rows);
    }
    add("single", [&, scene = scene](benchmark::State& state) { single(state, scene, everywhere); });
    add("every-mesh", [&, scene = scene](benchmark::State& state) { everyMesh(state, scene, everywhere); });
    for (const auto& [what, aim] :
         {std::pair{"down", Aim::down}, {"mouse", Aim::mouse}, {"graze", Aim::graze}}) {
      const std::vector<Ray> rays = raysOver(everywhere, aim);
      add(what, [=](benchmark::State& state) { firstHits(state, scene, rays, Vertices::lying); });
      add(std::string(what) + "-seen",
          [=](benchmark::State& state) { firstHits(state, scene, rays, Vertices::seen); });
    }
    add("every-triangle", [scene = scene, rays = raysOver(everywhere, Aim::mouse)](benchmark::State& state) {
      everyTriangle(state, scene, rays);
    });
    add("make", [&, scene = scene](benchmark::State& state) { make(state, scene, false); });
    add("make-again", [&, scene = scene](benchmark::State& state) { make(state, scene, true); });
  }
  for (const bool atOnce : {true, false}) {
    benchmark::RegisterBenchmark(
        atOnce ? "function/at-once" : "function/single",
        [&, atOnce](benchmark::State& state) { function(state, everywhere, atOnce); })
        ->Unit(benchmark::kMicrosecond);
  }
  MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  const double places = static_cast<double>(kPlaces);
  for (const char* name : {"/mixed", "/even"}) {
    std::printf("a place, ns%s: scattered %.1f, raster %.1f, single %.1f, every mesh %.0f\n", name,
                1e3 * reporter.median(std::string("scattered") + name) / places,
                1e3 * reporter.median(std::string("raster") + name) / places,
                1e3 * reporter.median(std::string("single") + name) / places,
                1e3 * reporter.median(std::string("every-mesh") + name) / 64.0);
    std::printf("a place as an eye sees it, ns%s: scattered %.1f, raster %.1f\n", name,
                1e3 * reporter.median(std::string("scattered-seen") + name) / places,
                1e3 * reporter.median(std::string("raster-seen") + name) / places);
    std::printf("a ray as an eye sees the ground, us%s: down %.2f, mouse %.2f, graze %.2f\n", name,
                reporter.median(std::string("down-seen") + name) / 4096.0,
                reporter.median(std::string("mouse-seen") + name) / 4096.0,
                reporter.median(std::string("graze-seen") + name) / 4096.0);
    std::printf("a ray, us%s: down %.2f, mouse %.2f, graze %.2f, every triangle %.0f\n", name,
                reporter.median(std::string("down") + name) / 4096.0,
                reporter.median(std::string("mouse") + name) / 4096.0,
                reporter.median(std::string("graze") + name) / 4096.0,
                reporter.median(std::string("every-triangle") + name) / 4.0);
    reporter.printRatio("single", "scattered", 0.0, name);
  }
  reporter.printRatio("function/single", "function/at-once", 0.0);
  std::printf("a place of the function, us: %.2f\n", reporter.median("function/at-once") / 4096.0);
  return 0;
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  return teren::runAll(argc, argv);
}
