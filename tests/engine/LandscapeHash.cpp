// One number for a whole landscape: prints a hash over baked regions, heights, queries, drawn surfaces and
// dug ground of two worlds, near and far from the world's zero. tests/same-bits runs it in many ways; the
// number must never differ (law 1).
//   landscape-hash [--slice-us N] [--visit-seed N] [--workers N] [--cap-mib N]
//       slice 0: unlimited; visit seed 0: row by row; the engine's workers; the engine's cap, under which it
//       must give up some of its view, or this ends with 1 (0, the default: a cap that never matters)
//   landscape-hash --libm
//       a hash over glibc's own sin, exp, log and pow instead, to show whether glibc was told to compute
//       otherwise
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <numeric>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "teren/Bake.h"
#include "teren/EditedGround.h"
#include "teren/Engine.h"
#include "teren/Hash.h"
#include "teren/PluginRegistry.h"
#include "teren/Position.h"
#include "teren/Script.h"
#include "teren/World.h"

namespace {

using teren::Fnv1a;
using teren::Position;
using teren::World;

constexpr std::int64_t kFar = std::int64_t{1} << 40;

template <class Number>
void add(Fnv1a& hash, Number number) {
  for (const std::uint8_t byte : std::bit_cast<std::array<std::uint8_t, sizeof(Number)>>(number)) {
    hash.addByte(byte);
  }
}

void orExit(const teren::Result<void>& result) {
  if (result) return;
  std::fprintf(stderr, "landscape-hash: %s\n", result.error().message.c_str());
  std::exit(1);
}

template <class T>
T valueOrExit(teren::Result<T> result) {
  if (!result) orExit(result.error());
  return std::move(result).value();
}

teren::WorldDescription filteredFaults() {
  teren::LayerDescription layer;
  layer.generator = "fault";
  layer.filters = {{"band", {{"k", 0.9}, {"passes", std::int64_t{5}}}}, {"matrix", {}}};
  teren::WorldDescription description;
  description.seed = 7;
  description.layers = {layer};
  return description;
}

/// A layer of each of the other generators, of noise as a field and as filtered maps, and the filter that
/// needs many passes.
teren::WorldDescription otherGenerators() {
  teren::WorldDescription description;
  description.seed = 8;
  double pitch = 64.0;
  for (const char* generator : {"circles", "midpoint", "slope", "spectral", "steps", "noise", "noise"}) {
    teren::LayerDescription layer;
    layer.generator = generator;
    layer.pitch = pitch;
    description.layers.push_back(layer);
    pitch *= 2.0;
  }
  description.layers[0].parameters = {{"discs", std::int64_t{25}}};
  description.layers[1].filters = {{"thermal", {}}};
  description.layers[5].parameters = {{"warp", 300.0}};
  description.layers[6].parameters = {{"kind", std::string("simplex")}, {"fractal", std::string("ridged")}};
  description.layers[6].filters = {{"band", {}}};
  return description;
}

/// The same few regions at every level, one of them where positions need more than 45 bits.
void addRegions(Fnv1a& hash, const World& world, const teren::BakeOptions& options) {
  for (int level = 0; level <= std::min(4, world.topLevel()); ++level) {
    const teren::BakeRegion regions[] = {{-9, -7, 16, 12, level}, {kFar - 1, -kFar + 3, 6, 5, level}};
    for (const teren::BakeRegion& region : regions) {
      const teren::HeightMap heights = valueOrExit(teren::bake(world, region, options));
      for (const float height : heights.samples()) add(hash, height);
    }
  }
}

/// Craters over each other, smoothed before they lie still, and sand dug, pushed and heaped among them before
/// it lies still, here and far away.
void addEdits(Fnv1a& hash, const std::shared_ptr<const World>& world,
              const std::shared_ptr<const teren::PluginRegistry>& registry, teren::BakeOptions options) {
  teren::EditedGround ground(world, teren::deformersOf(registry));
  const teren::EditWork work{options.slice, [] { return true; }};
  teren::RandomSequence random(20261122);
  for (int count = 0; count < 40; ++count) {
    const auto place = [&](std::int64_t patch) {
      return static_cast<double>(patch) * world->pitch() + static_cast<double>(random.nextBits(12)) * 0.0625;
    };
    teren::Edit edit;
    edit.kind = "crater";
    edit.x = place(count % 4 == 3 ? kFar : 0);
    edit.y = place(count % 4 == 3 ? -kFar : 0);
    edit.size = 5.0 + static_cast<double>(random.nextBits(5));
    edit.depth = 4.0;
    edit.seed = random.next();
    edit.steps = random.next() % 3;
    if (count % 3 == 2) edit.parameters = {{"tool", std::string("smooth")}};
    if (count % 10 >= 6) {
      edit.kind = "sand";
      edit.size = std::min(edit.size, 12.0);
      if (count % 10 == 9) edit.depth = -edit.depth;
      edit.parameters = {{"tool", std::string(count % 2 == 0 ? "round" : "rake")},
                         {"push", count % 20 < 10},
                         {"direction", 9.0 * count}};
    }
    orExit(ground.apply(edit, work));
  }
  orExit(ground.rest(work));
  add(hash, ground.hash());
  options.edits = &ground;
  addRegions(hash, *world, options);
}

std::vector<Position> scatteredPositions(const World& world) {
  teren::RandomSequence random(20260101);
  std::vector<Position> positions;
  for (int count = 0; count < 1000; ++count) {
    const std::int64_t origin = count % 3 == 2 ? kFar : 0;
    const auto fraction = [&] { return std::ldexp(static_cast<double>(random.nextBits(53)), -53); };
    positions.push_back(
        {origin + random.nextBits(4) - 8, random.nextBits(4) - origin - 8, fraction(), fraction()});
  }
  positions.push_back(valueOrExit(Position::fromMetres(-123.456, 7890.125, world.pitch())));
  return positions;
}

/// Visits the positions in the order of the seed, adds what was found in the order of the positions.
void addPoints(Fnv1a& hash, const World& world, std::uint64_t visitSeed) {
  const std::vector<Position> positions = scatteredPositions(world);
  std::vector<std::size_t> order(positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (visitSeed != 0) {
    std::sort(order.begin(), order.end(), [visitSeed](std::size_t a, std::size_t b) {
      return teren::hashWith(visitSeed, a) < teren::hashWith(visitSeed, b);
    });
  }
  std::vector<double> heights(positions.size());
  std::vector<teren::SurfacePoint> points(positions.size());
  for (const std::size_t index : order) {
    heights[index] = world.height(positions[index]);
    points[index] = world.query(positions[index]);
  }
  for (std::size_t index = 0; index < positions.size(); ++index) {
    add(hash, heights[index]);
    add(hash, points[index].height);
    add(hash, points[index].drawn);
    for (const double component : points[index].normal) add(hash, component);
    add(hash, points[index].error);
  }
}

/// Where scripts lead in an hour: objects are where they are to the last bit, too.
void addScripts(Fnv1a& hash) {
  const teren::Course course{.start = {kFar, -7, 0.3, 0.6}, .east = 3.0, .north = -4.0, .speed = 300.0};
  const std::vector<teren::Waypoint> points{
      {{0, 0, 0.1, 0.2}, 5.0}, {{9, 1, 0.0, 0.0}, 50.0}, {{3, 3, 0.3, 0.0}, 1.0}};
  for (const auto& script :
       {valueOrExit(teren::straightScript(course)), valueOrExit(teren::circleScript(course, 700.0)),
        valueOrExit(teren::turnsScript(course)),
        valueOrExit(teren::waypointScript(points, 30.0, 64.0, true))}) {
    for (int tick = 0; tick < 216'000; tick += 97) {
      const teren::Motion motion = valueOrExit(script->at(tick / 60.0));
      add(hash, motion.position.i);
      add(hash, motion.position.j);
      for (const double value :
           {motion.position.u, motion.position.v, motion.height, motion.east, motion.north}) {
        add(hash, value);
      }
    }
  }
}

/// How the same landscape is to be made this time.
struct Trial {
  std::uint64_t sliceMicroseconds = 0, visitSeed = 0, workers = 0, capMib = 0;
};

class Visitor final : public teren::Object {
 public:
  void update(double, const teren::Ground&) override {}
  teren::Motion motion() const override { return motion_; }
  void moveTo(const Position& position) { motion_.position = position; }

 private:
  teren::Motion motion_;
};

/// Hash of the vertices drawn within `reach` level-0 samples of a position, whatever meshes they are in.
std::uint64_t surfaceHash(const teren::Scene& scene, const Position& position, int intervals,
                          std::int64_t reach) {
  using Vertex = std::tuple<std::int64_t, std::int64_t, float, int, int>;
  std::vector<Vertex> vertices;
  for (const auto& mesh : scene.meshes()) {
    for (const teren::SurfaceVertex& vertex : mesh->vertices) {
      const std::int64_t column = mesh->originColumn + (std::int64_t{vertex.column} << mesh->level);
      const std::int64_t row = mesh->originRow + (std::int64_t{vertex.row} << mesh->level);
      const std::int64_t east = column - position.i * intervals, north = row - position.j * intervals;
      if (std::max(std::abs(east), std::abs(north)) > reach) continue;
      vertices.emplace_back(column, row, vertex.height, vertex.normalX, vertex.normalY);
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Fnv1a hash;
  for (const Vertex& vertex : vertices) {
    std::apply([&](auto... parts) { (add(hash, parts), ...); }, vertex);
  }
  return hash.value();
}

/// An engine visits a few places in the order of the seed, twice each, so that under a small cap all is made
/// again; what was drawn there is added in the order of the places.
void addSurfaces(Fnv1a& hash, const std::shared_ptr<const World>& world, const Trial& trial) {
  constexpr int kLevel = 1, kRadius = 12;
  constexpr std::int64_t kPatches = 4;  // a view of radius 2 shows all that is hashed
  teren::EngineOptions options{.view = {kLevel, kRadius}, .workers = static_cast<int>(trial.workers)};
  if (trial.capMib > 0) options.capBytes = static_cast<std::size_t>(trial.capMib) << 20;
  const auto engine = valueOrExit(teren::Engine::create(world, options));
  auto& visitor = static_cast<Visitor&>(engine->add(std::make_unique<Visitor>()));
  const std::vector<Position> places = {
      {0, 0, 0.5, 0.5}, {20, 2, 0.25, 0.0}, {kFar, -kFar, 0.5, 0.5}, {kFar + 9, -kFar, 0.0, 0.0}};
  std::vector<std::size_t> visits(2 * places.size());
  std::iota(visits.begin(), visits.end(), std::size_t{0});
  if (trial.visitSeed != 0) {
    std::sort(visits.begin(), visits.end(), [&](std::size_t a, std::size_t b) {
      return teren::hashWith(trial.visitSeed, a) < teren::hashWith(trial.visitSeed, b);
    });
  }
  std::vector<std::uint64_t> hashes(places.size());
  for (const std::size_t visit : visits) {
    const std::size_t index = visit % places.size();
    visitor.moveTo(places[index]);
    if (trial.sliceMicroseconds > 0) {
      const std::chrono::microseconds budget(trial.sliceMicroseconds);
      do engine->update(0.0, budget);
      while (engine->figures().pending > 0);
    }
    engine->settle();
    const std::int64_t n = world->intervals();
    const std::uint64_t found =
        surfaceHash(*engine->scene(), places[index], world->intervals(), kPatches * n);
    if (hashes[index] != 0 && hashes[index] != found) {
      std::fprintf(stderr, "landscape-hash: place %zu looked otherwise the second time\n", index);
      std::exit(1);
    }
    hashes[index] = found;
  }
  if (trial.capMib > 0 && engine->figures().radius == kRadius) {
    std::fprintf(stderr, "landscape-hash: the cap is too large to matter\n");
    std::exit(1);
  }
  for (const std::uint64_t found : hashes) add(hash, found);
}

std::uint64_t landscapeHash(const Trial& trial) {
  teren::BakeOptions options;
  options.slice = std::chrono::microseconds(trial.sliceMicroseconds);
  options.visitSeed = trial.visitSeed;
  const auto registry = teren::PluginRegistry::standard();
  Fnv1a hash;
  struct Landscape {
    teren::WorldDescription description;
    bool drawn;  // what the engine draws is the same work for any generator: two worlds show it
  };
  for (const auto& [description, drawn] :
       {Landscape{teren::WorldDescription::standard(), true}, Landscape{filteredFaults(), true},
        Landscape{otherGenerators(), false}}) {
    const std::shared_ptr<const World> world = valueOrExit(World::create(description, *registry));
    addRegions(hash, *world, options);
    addPoints(hash, *world, trial.visitSeed);
    if (drawn) addSurfaces(hash, world, trial);
    if (drawn) addEdits(hash, world, registry, options);
  }
  addScripts(hash);
  return hash.value();
}

std::uint64_t libmHash() {
  Fnv1a hash;
  for (int step = 0; step < 200'000; ++step) {
    const volatile double x = 0.01 * step;
    add(hash, std::sin(x) + std::exp(-x) + std::log(x + 1.0) + std::pow(x + 1.0, 0.37));
  }
  return hash.value();
}

std::uint64_t numberOrExit(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) {
    std::fprintf(stderr, "landscape-hash: '%.*s' is not a whole number\n", static_cast<int>(text.size()),
                 text.data());
    std::exit(2);
  }
  return number;
}

}  // namespace

int main(int argc, char** argv) {
  Trial trial;
  const std::pair<std::string_view, std::uint64_t Trial::*> options[] = {
      {"--slice-us", &Trial::sliceMicroseconds},
      {"--visit-seed", &Trial::visitSeed},
      {"--workers", &Trial::workers},
      {"--cap-mib", &Trial::capMib}};
  for (int index = 1; index < argc; ++index) {
    const std::string_view name = argv[index];
    if (name == "--libm") {
      std::printf("%016llx\n", static_cast<unsigned long long>(libmHash()));
      return 0;
    }
    const auto* option = std::find_if(std::begin(options), std::end(options),
                                      [&](const auto& one) { return one.first == name; });
    if (option == std::end(options) || index + 1 == argc) {
      std::fprintf(
          stderr,
          "usage: landscape-hash [--slice-us N] [--visit-seed N] [--workers N] [--cap-mib N] | --libm\n");
      return 2;
    }
    trial.*(option->second) = numberOrExit(argv[++index]);
  }
  std::printf("%016llx\n", static_cast<unsigned long long>(landscapeHash(trial)));
}
