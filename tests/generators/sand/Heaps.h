// Surfaces for the tests of sand.
#pragma once

#include <cstdint>
#include <vector>

#include "teren/Hash.h"

#include "generators/numbers/RandomNumber.h"
#include "generators/sand/SandSurface.h"

namespace teren {

inline LatticeFrame boxOf(int bits, double step) {
  LatticeFrame frame;
  frame.step = step;
  frame.width = frame.height = std::int32_t{1} << bits;
  return frame;
}

/// `count` random points in a box of a metre, as high as `height(x, y)` [m] says at x, y in [0, 1].
template <class Height>
SandSurface scatteredSand(int count, std::uint64_t seed, double loose, Height height) {
  const LatticeFrame frame = boxOf(20, 0x1p-20);
  RandomSequence random(seed);
  std::vector<LatticePoint> points{{0, 0}, {frame.width, 0}, {frame.width, frame.height}, {0, frame.height}};
  while (points.size() < static_cast<std::size_t>(count)) {
    const auto x = static_cast<std::int32_t>(random.nextBits(20));
    points.push_back({x, static_cast<std::int32_t>(random.nextBits(20))});
  }
  std::vector<double> heights;
  for (const LatticePoint p : points) heights.push_back(height(p.x * 0x1p-20, p.y * 0x1p-20));
  return SandSurface(frame, points, heights, loose);
}

/// Raises a corner of the box by a slide that balances nothing: all of it becomes an old debt.
inline void runUpADebt(SandSurface& surface, std::int64_t ticks) {
  const TriangleId t = surface.mesh().triangleAt(0);
  Face face = surface.unweighedFace(t);
  FaceMove move{};
  SandSurface::Stars stars;
  for (std::size_t i = 0; i < 3; ++i) {
    face[i].weight = surface.weight(surface.mesh().corners(t)[i], stars[i]);
    if (surface.mesh().corners(t)[i] == 0) move[i] = ticks;
  }
  surface.apply(t, face, move, stars);
}

/// A cone twice as steep as dry sand lies, half a metre wide.
inline double cone(double x, double y) {
  const double distance = std::sqrt((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5));
  return distance < 0.25 ? (0.25 - distance) * 1.2 : 0.0;
}

}  // namespace teren
