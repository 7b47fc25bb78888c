// Stamps, slides and clean-up in random order, with random tools at random places.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "generators/numbers/Tangent.h"
#include "generators/sand/Sandbox.h"
#include "tests/generators/sand/Heaps.h"

namespace teren {

/// With more a game is over; the next one is on other ground.
inline constexpr std::size_t kMostVertices = 2'500;

/// A fifth of a cubic metre, sixfold [ticks steps^2], of games' boxes: what a few dozen stamps move.
inline constexpr double kFirstMoved = 0.2 * 6.0 * kTicksPerMetre * 0x1p40;

inline std::vector<ToolShape> toolbox() {
  const std::vector<ToolPoint> hook{{-0.04, -0.04}, {0.04, -0.04}, {0.04, 0.04},  {-0.04, 0.04},
                                    {-0.04, 0.02},  {0.02, 0.02},  {0.02, -0.02}, {-0.04, -0.02}};
  return {*ToolShape::disc(0.05, 0.1),     *ToolShape::disc(0.02, 0.03, 5), *ToolShape::square(0.1, 0.05),
          *ToolShape::rake(0.16, 0.04, 4), *ToolShape::wedge(0.08, 0.1),    *ToolShape::ball(0.1, 0.06),
          *ToolShape::polygon(hook, 0.07), *ToolShape::disc(0.3, 0.05)};
}

/// One game and its own account of the volume.
class RandomGame {
 public:
  explicit RandomGame(std::uint64_t seed) : random_(seed), sandbox_(ground(random_), settings(random_)) {
    all_ = sandbox_.surface().volume() + sandbox_.surface().owed();
    sandbox_.loosenAll();
  }

  Sandbox& sandbox() { return sandbox_; }
  const Sandbox& sandbox() const { return sandbox_; }
  bool isOver() const { return sandbox_.surface().mesh().vertexCount() > kMostVertices; }

  void play(const std::vector<ToolShape>& tools) {
    switch (random_.next() % 8) {
      case 0:
      case 1:
        stamp(tools[random_.next() % tools.size()]);
        break;
      case 2:
      case 3:
      case 4:
        sandbox_.slide(random_.next() % 400);
        break;
      case 5:
      case 6:
        sandbox_.clean();
        break;
      default:
        if (random_.next() % 16 == 0) {
          const double angle = 20.0 + 20.0 * uniform(random_.next()), moisture = uniform(random_.next());
          angle_ = angle + kMoistureGain * moisture;
          sandbox_.setRepose(angle, moisture);
        }
        sandbox_.forgetChanges();
    }
  }

  /// Iterations until all is at rest, at most so many.
  int iterationsToRest(int most) {
    for (int n = 1; n <= most; ++n) {
      if (sandbox_.iterate(~std::uint64_t{0})) return n;
    }
    return most + 1;
  }
  /// By how much the steepest loose face is steeper than may be at rest; negative where it is not [tangent].
  double excess() const {
    return steepestLooseSlope(sandbox_.surface()) - tangentOfDegrees(angle_ + kReposeTolerance);
  }

  /// What is wrong, or nothing.
  std::string fault() const {
    const SandSurface& surface = sandbox_.surface();
    if (!(surface.volume() + surface.owed() == all_)) return "volume is lost";
    if (const Result<void> sound = surface.validate(); !sound) return sound.error().message;
    const double drift = std::fabs(asDouble(surface.owed()));
    if (drift > 1e-12 * std::max(asDouble(surface.volumeMoved()), kFirstMoved))
      return "the account has run up";
    if (strayed_) return "a stamp has moved ground out of its reach";
    if (sandbox_.cleanUp().count().largestError > sandbox_.cleanUp().tolerance())
      return "clean-up has moved ground";
    return {};
  }

 private:
  static SandSurface ground(RandomSequence& random) {
    const std::uint64_t seed = random.next();
    const double steep = uniform(random.next()), loose = random.next() % 3 == 0 ? 0.01 : 5.0;
    const int count = 10 + static_cast<int>(random.nextBits(8));
    return scatteredSand(count, seed, loose, [steep](double x, double y) {
      const double u = 3.0 * x - std::floor(3.0 * x), v = 2.0 * y - std::floor(2.0 * y);
      return 0.4 * steep * u * v;
    });
  }
  static SandSettings settings(RandomSequence& random) {
    SandSettings settings;
    settings.longestEdge = 0.03 + 0.3 * uniform(random.next());
    settings.flatness = random.next() % 4 == 0 ? 0.0 : 1e-5 + 1e-2 * uniform(random.next());
    settings.stamp.loosening = 0.05 * uniform(random.next());
    return settings;
  }

  /// A place that may lie outside, or next to the border, at a height that may be in the air or deep down.
  void stamp(const ToolShape& tool) {
    StampPlace place{1.4 * uniform(random_.next()) - 0.2, 1.4 * uniform(random_.next()) - 0.2,
                     0.3 * uniform(random_.next()) - 0.1};
    if (random_.next() % 4 != 0) {
      const double x = uniformAroundZero(random_.next()), y = uniformAroundZero(random_.next());
      const double length = std::sqrt(x * x + y * y);
      place.directionX = x / length;
      place.directionY = y / length;
    }
    const double extent = (1.0 + StampSettings{}.bermWidth) * tool.reach() + sandbox_.surface().step();
    std::vector<std::int64_t> before = heightsBeyond(place, extent);
    (void)sandbox_.stamp(tool, place);  // a refusal changes nothing, which fault() would notice
    before.resize(sandbox_.surface().mesh().vertexSlots(), kNoHeight);
    strayed_ = strayed_ || before != heightsBeyond(place, extent);
  }
  /// Of all vertices farther from a place than this [m].
  std::vector<std::int64_t> heightsBeyond(const StampPlace& place, double distance) const {
    const Triangulation& mesh = sandbox_.surface().mesh();
    std::vector<std::int64_t> heights(mesh.vertexSlots(), kNoHeight);
    for (VertexId v = 0; v < mesh.vertexSlots(); ++v) {
      if (!mesh.isVertex(v)) continue;
      const double x = mesh.frame().placeX(mesh.point(v)) - place.x;
      const double y = mesh.frame().placeY(mesh.point(v)) - place.y;
      if (x * x + y * y > distance * distance) heights[v] = sandbox_.surface().height(v);
    }
    return heights;
  }

  static constexpr std::int64_t kNoHeight = 2 * kHighestTick;
  RandomSequence random_;
  Sandbox sandbox_;
  SixfoldVolume all_ = 0;
  double angle_ = kDryRepose;  // [degree] of repose
  bool strayed_ = false;
};

}  // namespace teren
