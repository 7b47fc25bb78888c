#include "apps/sandbox/SandGround.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "teren/Hash.h"

namespace teren {
namespace {

constexpr int kSideBits = 24;                             // a side is between 2^23 and 2^24 steps
constexpr std::uint64_t kPlasticX = 0xc13fa9a902a6328fU;  // 1 / p as a fraction of 2^64, p^3 = p + 1
constexpr std::uint64_t kPlasticY = 0x91e10da5c79e7b1cU;  // 1 / p^2
constexpr double kMoved = 0.5;                            // of the mean distance between two vertices

/// In [0, 1).
double uniform(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// The smallest power of two that is a step for this side.
double stepFor(double side) {
  double step = 0x1p-40;
  while (side / step > static_cast<double>(std::int32_t{1} << kSideBits)) step *= 2.0;
  return step;
}

/// One octave of smooth bumps, in [0, 1]: hashes at whole places, cubic between them.
double bumps(double x, double y, std::uint64_t seed) {
  const double left = std::floor(x), below = std::floor(y);
  const auto eased = [](double part) { return part * part * (3.0 - 2.0 * part); };
  const double u = eased(x - left), v = eased(y - below);
  const auto corner = [&](double i, double j) {
    const auto column = static_cast<std::uint64_t>(left + i), row = static_cast<std::uint64_t>(below + j);
    return uniform(hashWith(hashWith(seed, column), row));
  };
  const double south = corner(0, 0) + u * (corner(1, 0) - corner(0, 0));
  const double north = corner(0, 1) + u * (corner(1, 1) - corner(0, 1));
  return south + v * (north - south);
}

/// In [0, 1]; x and y in sides.
double rolling(double x, double y, std::uint64_t seed) {
  double sum = 0.0, weight = 0.5, scale = 3.0;
  for (std::uint64_t octave = 0; octave < 4; ++octave, weight *= 0.5, scale *= 2.0) {
    sum += weight * bumps(scale * x, scale * y, hashWith(seed, octave));
  }
  return sum / 0.9375;  // the sum of the weights
}

/// Evenly on the border, so that no long triangles lie along it, then inside.
std::vector<LatticePoint> places(const SandGround& ground, const LatticeFrame& frame) {
  std::vector<LatticePoint> points = {
      {0, 0}, {frame.width, 0}, {frame.width, frame.height}, {0, frame.height}};
  const auto count = static_cast<std::size_t>(ground.vertices);
  const auto perSide = static_cast<int>(std::floor(std::sqrt(static_cast<double>(ground.vertices))));
  for (int n = 1; n + 1 < perSide && points.size() + 4 <= count; ++n) {
    const auto along = static_cast<std::int32_t>(std::int64_t{frame.width} * n / (perSide - 1));
    points.insert(points.end(), {{along, 0}, {frame.width, along}, {along, frame.height}, {0, along}});
  }
  const double side = static_cast<double>(frame.width);
  const double moved = kMoved / std::sqrt(static_cast<double>(ground.vertices));
  const auto inside = [side](double part) {
    return static_cast<std::int32_t>(std::floor(std::clamp(part, 0x1p-20, 1.0 - 0x1p-20) * side));
  };
  for (std::uint64_t n = 1; points.size() < count; ++n) {
    const std::uint64_t random = hashWith(ground.seed, n);
    const double east = uniform(n * kPlasticX) + moved * (uniform(random) - 0.5);
    const double north = uniform(n * kPlasticY) + moved * (uniform(mixBits(random)) - 0.5);
    points.push_back({inside(east), inside(north)});
  }
  return points;
}

SandSettings settingsFor(const SandGround& ground) {
  SandSettings settings;  // made for a side of one metre
  settings.longestEdge *= ground.side;
  settings.flatness *= ground.side;
  settings.stamp.fit *= ground.side;
  settings.stamp.loosening *= ground.side;
  return settings;
}

}  // namespace

std::span<const Parameter> SandGround::parameters() noexcept {
  static constexpr Parameter table[] = {
      Parameter::real("size", 1.0, 0.01, 1000.0, "m", "side of the box"),
      Parameter::integer("vertices", 10'000, 4, 4'000'000, "", "how many; more show finer traces"),
      Parameter::real("depth", 1.0, 0.0, 1000.0, "m", "of loose sand on solid ground"),
      Parameter::real("roughness", 0.0, 0.0, 1000.0, "m", "how high the ground rolls at the start"),
      Parameter::integer("seed", 42, 0, 1'000'000'000, "", "another seed, another ground"),
  };
  return table;
}

SandGround SandGround::from(const Values& values) {
  SandGround ground;
  ground.side = values.real("size");
  ground.vertices = static_cast<int>(values.integer("vertices"));
  ground.depth = values.real("depth");
  ground.roughness = values.real("roughness");
  ground.seed = static_cast<std::uint64_t>(values.integer("seed"));
  return ground;
}

Sandbox makeSand(const SandGround& ground) {
  LatticeFrame frame;
  frame.step = stepFor(ground.side);
  frame.width = frame.height = static_cast<std::int32_t>(std::floor(ground.side / frame.step));
  const std::vector<LatticePoint> points = places(ground, frame);
  std::vector<double> heights;
  heights.reserve(points.size());
  for (const LatticePoint p : points) {
    const double side = frame.width;
    heights.push_back(ground.roughness > 0.0 ? ground.roughness * rolling(p.x / side, p.y / side, ground.seed)
                                             : 0.0);
  }
  const std::size_t spare = points.size() / 64 + 1024;  // what a drag adds before arrays grow
  Sandbox sandbox(SandSurface(frame, points, heights, ground.depth, spare), settingsFor(ground));
  if (ground.roughness > 0.0) sandbox.loosenAll();
  return sandbox;
}

}  // namespace teren
