// One number for a whole landscape: prints a hash over baked regions, heights and queries of two worlds, near
// and far from the world's zero. tests/same-bits runs it in many ways; the number must never differ (law 1).
//   landscape-hash [--slice-us N] [--visit-seed N]    N = 0: unlimited slices, visits row by row
//   landscape-hash --libm                             a hash over glibc's own sin, exp, log and pow instead,
//   to
//                                                     show whether glibc was told to compute otherwise
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
#include <memory>
#include <numeric>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "teren/Bake.h"
#include "teren/Hash.h"
#include "teren/PluginRegistry.h"
#include "teren/Position.h"
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

template <class T>
T valueOrExit(teren::Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "landscape-hash: %s\n", result.error().message.c_str());
    std::exit(1);
  }
  return std::move(result).value();
}

teren::WorldDescription filteredFaults() {
  teren::LayerDescription layer;
  layer.generator = "fault";
  layer.filters = {{"band", {{"k", 0.9}, {"passes", std::int64_t{5}}}}};
  teren::WorldDescription description;
  description.seed = 7;
  description.layers = {layer};
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

std::uint64_t landscapeHash(std::uint64_t sliceMicroseconds, std::uint64_t visitSeed) {
  teren::BakeOptions options;
  options.slice = std::chrono::microseconds(sliceMicroseconds);
  options.visitSeed = visitSeed;
  const auto registry = teren::PluginRegistry::standard();
  Fnv1a hash;
  for (const auto& description : {teren::WorldDescription::standard(), filteredFaults()}) {
    const std::shared_ptr<const World> world = valueOrExit(World::create(description, *registry));
    addRegions(hash, *world, options);
    addPoints(hash, *world, visitSeed);
  }
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
  std::uint64_t sliceMicroseconds = 0;
  std::uint64_t visitSeed = 0;
  for (int index = 1; index < argc; ++index) {
    const std::string_view option = argv[index];
    if (option == "--libm") {
      std::printf("%016llx\n", static_cast<unsigned long long>(libmHash()));
      return 0;
    }
    const bool known = option == "--slice-us" || option == "--visit-seed";
    if (!known || index + 1 == argc) {
      std::fprintf(stderr, "usage: landscape-hash [--slice-us N] [--visit-seed N] | --libm\n");
      return 2;
    }
    (option == "--slice-us" ? sliceMicroseconds : visitSeed) = numberOrExit(argv[++index]);
  }
  std::printf("%016llx\n", static_cast<unsigned long long>(landscapeHash(sliceMicroseconds, visitSeed)));
}
