#include "generators/sand/LevelSand.h"

#include <cstdint>
#include <vector>

#include "teren/Hash.h"

namespace teren {

SandSurface levelSand(int vertices, double loose, std::size_t spare) {
  constexpr int kSideBits = 24;
  LatticeFrame frame;
  frame.step = 1.0 / (std::int32_t{1} << kSideBits);
  frame.width = frame.height = std::int32_t{1} << kSideBits;
  RandomSequence random(static_cast<std::uint64_t>(vertices));
  std::vector<LatticePoint> points(static_cast<std::size_t>(vertices) - 4);
  for (LatticePoint& p : points) {
    p = {static_cast<std::int32_t>(random.nextBits(kSideBits)),
         static_cast<std::int32_t>(random.nextBits(kSideBits))};
  }
  const std::vector<double> heights(points.size(), 0.0);
  return SandSurface(frame, points, heights, loose, spare);
}

}  // namespace teren
