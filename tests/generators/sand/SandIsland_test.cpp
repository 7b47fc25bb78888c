#include "generators/sand/SandIsland.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Edit.h"
#include "teren/Hash.h"

#include "generators/numbers/RandomNumber.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

/// All regions have so much ground to the west and to the south of where stamps and heights are counted from,
/// and as much to the east and to the north: sand may run far.
constexpr double kApron = 128.0;
constexpr int kApronSquares = 64, kApronPatches = 2;
constexpr DeformRegion kRegion{
    .columns = 4 + 2 * kApronPatches, .rows = 3 + 2 * kApronPatches, .intervals = 32, .spacing = 2.0};
/// What loose faces at rest are promised to be less steep than, as a tangent.
const double kSteepestSand = std::tan((kDryRepose + kReposeTolerance) / 57.295779513);
constexpr std::uint64_t kEnd = std::numeric_limits<std::uint64_t>::max();
constexpr std::string_view kTools[] = {"round", "square", "rake", "wedge", "ball"};

Stamp stamp(double east, double north, double size, double depth,
            const std::vector<Values::Entry>& set = {}) {
  static constexpr Parameter table[] = {Parameter::choice("tool", "round", kTools, ""),
                                        Parameter::boolean("push", false, ""),
                                        Parameter::real("direction", 0.0, 0.0, 360.0, "", ""),
                                        Parameter::real("repose", kDryRepose, 20.0, 45.0, "", ""),
                                        Parameter::real("moisture", 0.0, 0.0, 1.0, "", "")};
  return {.east = east + kApron,
          .north = north + kApron,
          .size = size,
          .depth = depth,
          .values = Values::check(table, set, "sand").value()};
}

template <class Height>
HeightMap groundOf(const DeformRegion& region, Height height) {
  HeightMap map(region.sampleColumns(), region.sampleRows());
  for (int y = 0; y < map.rows(); ++y) {
    for (int x = 0; x < map.columns(); ++x)
      map(x, y) = static_cast<float>(height(x - kApronSquares, y - kApronSquares));
  }
  return map;
}

HeightMap flat(const DeformRegion& region = kRegion) {
  return groundOf(region, [](int, int) { return 0.0; });
}

/// 50 degrees down to the east: steeper than sand lies.
HeightMap steep(const DeformRegion& region = kRegion) {
  return groundOf(region,
                  [&](int x, int) { return 200.0 - 1.2 * (2.0 * x + static_cast<double>(region.i) * 64.0); });
}

HeightMap noisy(double most) {
  RandomSequence random(77);
  return groundOf(kRegion, [&](int, int) { return most * uniformAroundZero(random.next()); });
}

/// As waves that repeat every 32 squares, so that the same ground lies half a patch farther.
double waves(int x, int y) {
  const auto tent = [](int n) { return std::abs((n & 31) - 16) / 16.0; };
  return 12.0 * tent(x + 3) + 7.0 * tent(y + 2 * x) + 0.5 * ((x * 7 + y * 13) & 3);
}

float at(const HeightMap& map, int x, int y) {
  return map(x + kApronSquares, y + kApronSquares);
}

class Island {
 public:
  explicit Island(const HeightMap& ground, const DeformRegion& region = kRegion)
      : region_(region), live_(SandIsland::begin(region, ground.view()).value()) {}

  SandIsland& operator*() { return static_cast<SandIsland&>(*live_); }
  SandIsland* operator->() { return static_cast<SandIsland*>(live_.get()); }
  const SandSurface& surface() { return (*this)->surface(); }
  SixfoldVolume account() { return surface().volume() + surface().owed() - surface().entered(); }

  void press(const Stamp& stamp) {
    const Result<void> applied = live_->apply(stamp);
    ASSERT_TRUE(applied.ok()) << applied.error().message;
  }
  void rest() { ASSERT_TRUE(live_->step(Slice::unlimited(), kEnd)); }

  void grow(const HeightMap& ground, const DeformRegion& region) {
    const Result<void> grown = live_->grow(region, ground.view());
    ASSERT_TRUE(grown.ok()) << grown.error().message;
    region_ = region;
  }

  void merge(Island& other, const HeightMap& ground, const DeformRegion& region) {
    LiveSurface* const others[] = {other.live_.get()};
    const Result<void> merged = live_->merge(region, ground.view(), others);
    ASSERT_TRUE(merged.ok()) << merged.error().message;
    region_ = region;
  }
  const DeformRegion& region() const { return region_; }

  HeightMap loose() {
    HeightMap depths(region_.sampleColumns(), region_.sampleRows());
    EXPECT_TRUE(live_->loose(depths.view()));
    return depths;
  }

  HeightMap heights() {
    HeightMap map(region_.sampleColumns(), region_.sampleRows());
    live_->snapshot()->samples({0, 0, map.columns(), map.rows()}, map.view());
    return map;
  }

 private:
  DeformRegion region_;
  std::unique_ptr<LiveSurface> live_;
};

/// Every promise of the surface, and that all that is fixed lies on the grid's samples, bare.
void expectSound(Island& island, const HeightMap& ground) {
  const SandSurface& surface = island.surface();
  const Result<void> sound = surface.validate();
  EXPECT_TRUE(sound.ok()) << sound.error().message;
  for (VertexId v = 4; v < surface.mesh().vertexSlots(); ++v) {
    if (!surface.mesh().isVertex(v) || !surface.isFixed(v)) continue;
    const LatticePoint p = surface.mesh().point(v);
    ASSERT_EQ(p.x % SandIsland::kStepsASpacing, 0);
    ASSERT_EQ(p.y % SandIsland::kStepsASpacing, 0);
    const OpenCells& cells = surface.cells();
    ASSERT_EQ(surface.height(v), ticksFromMetres(ground(cells.columnOf(p.x), cells.rowOf(p.y))));
    ASSERT_EQ(surface.loose(v), 0);
  }
}

/// All samples as far from the place as the reach, or farther, are the ground's.
void expectUntouchedBeyond(Island& island, const HeightMap& ground, const Stamp& stamp) {
  const double reach = SandIsland::read(stamp, kRegion.spacing).value().reach;
  const HeightMap after = island.heights();
  int changed = 0;
  for (int y = 0; y < ground.rows(); ++y) {
    for (int x = 0; x < ground.columns(); ++x) {
      const double distance = std::hypot(2.0 * x - stamp.east, 2.0 * y - stamp.north);
      if (after(x, y) != ground(x, y)) ++changed;
      if (distance < reach) continue;
      ASSERT_EQ(std::signbit(after(x, y)), std::signbit(ground(x, y)));
      ASSERT_EQ(after(x, y), ground(x, y)) << x << ", " << y;
    }
  }
  EXPECT_GT(changed, 0);
}

TEST(SandIsland, MovesNothingBeyondItsReachOnAnyGround) {
  HeightMap tiny = noisy(1e-30);
  tiny(3, 3) = -0.0F;
  for (const HeightMap& ground : {flat(), steep(), noisy(1.0), noisy(50.0), tiny}) {
    for (const std::string_view tool : kTools) {
      for (const double depth : {4.0, -4.0}) {
        Island island(ground);
        const Stamp dug = stamp(127.0, 96.5, 9.0, depth,
                                {{"tool", std::string(tool)}, {"push", true}, {"direction", 200.0}});
        island.press(dug);
        island.rest();
        expectUntouchedBeyond(island, ground, dug);
        expectSound(island, ground);
        if (depth < 0.0) break;
      }
    }
  }
}

TEST(SandIsland, GivesGroundThatItOnlyTookInBackBitForBit) {
  // Ridges beside the tool, and so little noise that the clean-up takes vertices of it away.
  const HeightMap ground = groundOf(
      kRegion, [](int x, int y) { return 1e-7 * ((x * 37 + y * 11) % 17) + (y % 9 == 4 ? 3.25 : 0.125); });
  Island island(ground);
  const Stamp small = stamp(101.0, 107.0, 2.0, 0.1);
  island.press(small);
  const std::size_t entered = island.surface().mesh().vertexCount();
  island.rest();
  EXPECT_LT(island.surface().mesh().vertexCount(), entered);
  const HeightMap after = island.heights();
  int same = 0;
  for (int y = 0; y < ground.rows(); ++y) {
    for (int x = 0; x < ground.columns(); ++x) {
      const double distance = std::hypot(2.0 * x - small.east, 2.0 * y - small.north);
      if (distance < 1.6 * small.size + 1.0) continue;  // what the tool and its berm touch
      ASSERT_EQ(after(x, y), ground(x, y)) << x << ", " << y;
      same += distance < SandIsland::read(small, 2.0).value().opens;
    }
  }
  EXPECT_GT(same, 30);  // of what was taken in
}

TEST(SandIsland, KeepsAllVolumeExactlyButWhatIsPoured) {
  for (const HeightMap& ground : {flat(), steep(), noisy(3.0)}) {
    Island island(ground);
    const SixfoldVolume before = island.account();
    RandomSequence random(4);
    for (int count = 0; count < 24; ++count) {
      const double depth = count % 5 == 4 ? -2.0 : 1.0 + uniformAroundZero(random.next()) * 0.5;
      island.press(stamp(128.0 + 30.0 * uniformAroundZero(random.next()),
                         96.0 + 20.0 * uniformAroundZero(random.next()), 5.0, depth,
                         {{"tool", std::string(kTools[static_cast<std::size_t>(count) % 5])},
                          {"push", count % 2 == 0},
                          {"direction", 15.0 * count}}));
      EXPECT_TRUE(island.account() == before);
      ASSERT_TRUE(island->step(Slice::unlimited(), island->steps() + 3) || true);
      EXPECT_TRUE(island.account() == before);
    }
    island.rest();
    EXPECT_TRUE(island.account() == before);
    EXPECT_LT(std::fabs(asDouble(island.surface().owed())) / asDouble(island.surface().volumeMoved()), 1e-12);
    expectSound(island, ground);
  }
}

TEST(SandIsland, TellsHowMuchItHasPoured) {
  Island island(flat());
  island.press(stamp(128.0, 96.0, 8.0, -4.0));
  const double paraboloid = 0.5 * 3.14159265358979 * 8.0 * 8.0 * 4.0;
  EXPECT_NEAR(island->poured(), paraboloid, 0.05 * paraboloid);
  const double poured = island->poured();
  island.press(stamp(128.0, 96.0, 8.0, 4.0));
  EXPECT_EQ(island->poured(), poured);
}

/// Sum of all samples' changes [m^3], and of those upwards.
std::pair<double, double> changes(const HeightMap& ground, const HeightMap& after) {
  double sum = 0.0, raised = 0.0;
  for (std::size_t i = 0; i < ground.samples().size(); ++i) {
    const double change = 4.0 * (static_cast<double>(after.samples()[i]) - ground.samples()[i]);
    sum += change;
    raised += std::max(change, 0.0);
  }
  return {sum, raised};
}

TEST(SandIsland, LosesOnlyTheSamplingErrorWhenItIsWrittenBack) {
  const DeformRegion region{
      .columns = 5 + 2 * kApronPatches, .rows = 5 + 2 * kApronPatches, .intervals = 32, .spacing = 2.0};
  for (const auto& [size, bound] : {std::pair(4.0, 0.2), std::pair(12.0, 0.05), std::pair(24.0, 0.02)}) {
    const HeightMap ground = flat(region);
    Island island(ground, region);
    island.press(stamp(161.3, 158.2, size, 0.25 * size));
    island.rest();
    const auto [sum, raised] = changes(ground, island.heights());
    EXPECT_GT(raised, 0.3 * 3.14 * size * size * 0.25 * size);
    EXPECT_LT(std::fabs(sum), bound * raised) << sum / raised;
    EXPECT_NEAR(island->samplingError(), sum, 1e-6 * raised) << "on the TIN no volume is lost";
    RecordProperty("sampling_error_" + std::to_string(static_cast<int>(size)), std::to_string(sum / raised));
  }
}

TEST(SandIsland, TellsItsSamplingErrorOnTheTrianglesThatAreDrawn) {
  const HeightMap ground = groundOf(kRegion, waves);
  Island island(ground);
  EXPECT_EQ(island->samplingError(), 0.0);
  island.press(stamp(128.0, 96.0, 9.0, 3.0));
  island.rest();
  const auto [sum, raised] = changes(ground, island.heights());
  EXPECT_GT(std::fabs(sum), 1e-3 * raised);
  EXPECT_NEAR(island->samplingError(), sum, 1e-6 * raised);
}

TEST(SandIsland, SpreadsSandOverPatchBordersAsWithinPatches) {
  const DeformRegion region{
      .columns = 6 + 2 * kApronPatches, .rows = 6 + 2 * kApronPatches, .intervals = 32, .spacing = 2.0};
  constexpr int kShift = 16;  // half a patch
  const HeightMap ground = groundOf(region, waves);
  const HeightMap shifted = groundOf(region, [](int x, int y) { return waves(x - kShift, y - kShift); });
  Island one(ground, region), other(shifted, region);
  for (const auto& [east, north, depth] :
       {std::tuple(160.0, 160.5, 6.0), std::tuple(171.25, 158.0, 4.0), std::tuple(165.0, 170.0, -5.0)}) {
    one.press(stamp(east, north, 10.0, depth));
    other.press(stamp(east + 2.0 * kShift, north + 2.0 * kShift, 10.0, depth));
    one.rest();
    other.rest();
  }
  EXPECT_EQ(one->steps(), other->steps());
  const HeightMap here = one.heights(), there = other.heights();
  int changed = 0;
  for (int y = 0; y < ground.rows() - kShift; ++y) {
    for (int x = 0; x < ground.columns() - kShift; ++x) {
      ASSERT_EQ(here(x, y), there(x + kShift, y + kShift)) << x << ", " << y;
      changed += here(x, y) != ground(x, y);
    }
  }
  EXPECT_GT(changed, 300);
}

/// A region of which kRegion is a part, six patches more to the west, one to the south, others beyond.
constexpr DeformRegion kLarge{.i = -6, .j = -1, .columns = 16, .rows = 10, .intervals = 32, .spacing = 2.0};

/// The waves of the large region, or the part of them that lies in kRegion.
HeightMap wavesIn(const DeformRegion& region) {
  const int x0 = static_cast<int>(region.i) * 32, y0 = static_cast<int>(region.j) * 32;
  return groundOf(region, [&](int x, int y) { return waves(x + x0, y + y0); });
}

using Corner = std::array<std::int64_t, 4>;  // x, y, height, loose

/// All triangles that are open, in places from the corner of kLarge.
std::vector<std::array<Corner, 3>> openTriangles(Island& island) {
  const SandSurface& surface = island.surface();
  const SampleRectangle place = kLarge.placeOf(island.region());
  const LatticePoint corner = surface.cells().point(-place.column, -place.row);
  std::vector<std::array<Corner, 3>> triangles;
  for (TriangleId t = 0; t < surface.mesh().triangleSlots(); ++t) {
    if (!surface.mesh().isTriangle(t) || !surface.isOpen(t)) continue;
    std::array<Corner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId v = surface.mesh().corners(t)[i];
      const LatticePoint p = surface.mesh().point(v);
      corners[i] = {p.x - corner.x, p.y - corner.y, surface.height(v), surface.loose(v)};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.push_back(corners);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/// Sixfold, of what is loose in open squares [ticks steps^2].
SixfoldVolume looseVolume(Island& island) {
  SixfoldVolume sum = 0;
  for (const auto& [a, b, c] : openTriangles(island)) {
    const WideInteger area = static_cast<WideInteger>(b[0] - a[0]) * (c[1] - a[1]) -
                             static_cast<WideInteger>(b[1] - a[1]) * (c[0] - a[0]);
    sum += area * (a[3] + b[3] + c[3]);
  }
  return sum;
}

/// Stamps of all tools near a place, and after each some steps: none, few, or all there are.
void play(Island& island, double east, double north, std::uint64_t seed) {
  RandomSequence random(seed);
  for (int count = 0; count < 10; ++count) {
    const auto near = [&](double middle) {
      return middle + static_cast<double>(random.nextBits(14)) / 512.0 - 16.0;
    };
    const double x = near(east), y = near(north), depth = count % 3 == 2 ? -3.0 : 2.0;
    island.press(stamp(x, y, 5.0, depth,
                       {{"tool", std::string(kTools[random.next() % 5])},
                        {"push", random.nextBits(1) == 0},
                        {"direction", 8.0 * static_cast<double>(random.nextBits(5))}}));
    const std::uint64_t pauses[] = {0, 3, kEnd - island->steps()};
    island->step(Slice::unlimited(), island->steps() + pauses[random.next() % 3]);
  }
  island.rest();
}

TEST(SandIsland, GoesOnAfterGrowingAsIfItHadBegunSo) {
  constexpr double kEast = 384.0, kNorth = 64.0;  // of kRegion's corner in kLarge
  const HeightMap ground = wavesIn(kLarge);
  Island grown(wavesIn(kRegion)), large(ground, kLarge);
  play(grown, 120.0, 90.0, 5);
  play(large, 120.0 + kEast, 90.0 + kNorth, 5);
  const SixfoldVolume account = grown.account();
  const std::uint64_t steps = grown->steps();
  grown.grow(ground, kLarge);
  EXPECT_EQ(grown->steps(), steps);
  EXPECT_TRUE(grown.account() == account);
  EXPECT_TRUE(test::sameBits(grown.heights().view(), large.heights().view()));
  // On the old rim, over the old island, and where nothing was.
  for (const auto& [east, north] :
       {std::pair(258.0, 150.0), std::pair(496.0, 150.0), std::pair(790.0, 300.0)}) {
    play(grown, east, north, 6);
    play(large, east, north, 6);
    EXPECT_EQ(grown->steps(), large->steps());
    ASSERT_TRUE(test::sameBits(grown.heights().view(), large.heights().view()));
    EXPECT_EQ(grown.surface().mesh().vertexCount(), large.surface().mesh().vertexCount());
    EXPECT_TRUE(grown.surface().owed() == large.surface().owed());
    EXPECT_EQ(grown->poured(), large->poured());
  }
  expectSound(grown, ground);
}

TEST(SandIsland, TakesGroundInWhileSandSlidesWhereverItsLatticeLies) {
  const auto after = [](int more) {
    const DeformRegion region{.columns = 24 + more, .rows = 24 + more, .intervals = 8, .spacing = 2.0};
    RandomSequence random(64);
    HeightMap ground = flat(region);
    for (int y = 0; y < 193; ++y) {
      for (int x = 0; x < 193; ++x) ground(x, y) = static_cast<float>(0.5 * uniformAroundZero(random.next()));
    }
    Island island(ground, region);
    for (double north = 36.0; north <= 92.0; north += 10.0) {
      for (double east = 36.0; east <= 92.0; east += 10.0) island.press(stamp(east, north, 4.0, 1.0));
    }
    island.rest();
    return island.heights();
  };
  const HeightMap one = after(0), other = after(5);
  EXPECT_TRUE(test::sameBits(one.view(), other.view().part(0, 0, 193, 193)));
}

TEST(SandIsland, KeepsItsLooseSandLooseWhenItGrows) {
  const HeightMap ground = flat(kLarge);
  const auto heap = [](bool grows) {
    Island island(flat());
    island.press(stamp(128.0, 96.0, 8.0, -8.0, {{"repose", 45.0}}));
    island.rest();
    const HeightMap before = island.heights();
    if (grows) island.grow(flat(kLarge), kLarge);
    return std::pair(std::move(island), at(before, 64, 48));
  };
  auto [stays, height] = heap(false);
  auto [grown, same] = heap(true);
  EXPECT_EQ(height, same);
  EXPECT_EQ(at(grown.heights(), 64 + 192, 48 + 32), height);
  EXPECT_GT(steepestLooseSlope(grown.surface()), 0.8);
  EXPECT_EQ(steepestLooseSlope(grown.surface()), steepestLooseSlope(stays.surface()));
  // Drier sand beside it lets it slide; a hill of rock would stay.
  stays.press(stamp(136.0, 96.0, 4.0, 1.0, {{"repose", 20.0}}));
  grown.press(stamp(136.0 + 384.0, 96.0 + 64.0, 4.0, 1.0, {{"repose", 20.0}}));
  stays.rest();
  grown.rest();
  EXPECT_LT(at(grown.heights(), 64 + 192, 48 + 32), height - 0.5F);
  EXPECT_EQ(at(grown.heights(), 64 + 192, 48 + 32), at(stays.heights(), 64, 48));
}

/// Up to 2 m, in whole ticks, and nothing in every fifth column.
double someDepth(int x, int y) {
  return x % 5 == 0 ? 0.0 : ((x * 5 + y * 3) & 15) / 8.0;
}

HeightMap depthsIn(const DeformRegion& region) {
  const int x0 = static_cast<int>(region.i) * 32, y0 = static_cast<int>(region.j) * 32;
  return groundOf(region, [&](int x, int y) { return someDepth(x + x0 + 1024, y + y0 + 1024); });
}

TEST(SandIsland, TakesLooseGroundInAsLooseButAtTheFence) {
  const HeightMap ground = wavesIn(kRegion), depths = depthsIn(kRegion);
  Island island(ground);
  island->layLoose(depths.view());
  const std::array stamps = {stamp(80.0, 90.0, 5.0, 2.0), stamp(120.0, 94.0, 5.0, -3.0)};
  // The second one takes in what was the fence of the first.
  for (const Stamp& stamp : stamps) island.press(stamp);
  const SandSurface& surface = island.surface();
  int looseAsLaid = 0, fixed = 0;
  for (VertexId v = 4; v < surface.mesh().vertexSlots(); ++v) {
    if (!surface.mesh().isVertex(v)) continue;
    const LatticePoint p = surface.mesh().point(v);
    const int x = surface.cells().columnOf(p.x), y = surface.cells().rowOf(p.y);
    const bool isPressed = std::any_of(stamps.begin(), stamps.end(), [&](const Stamp& stamp) {
      return std::hypot(2.0 * x - stamp.east, 2.0 * y - stamp.north) < 3.0 * stamp.size;
    });
    fixed += surface.isFixed(v) ? 1 : 0;
    if (isPressed) continue;
    ASSERT_EQ(p, surface.cells().point(x, y));
    ASSERT_EQ(surface.loose(v), surface.isFixed(v) ? 0 : ticksFromMetres(depths(x, y))) << x << ", " << y;
    looseAsLaid += surface.loose(v) > 0 ? 1 : 0;
  }
  EXPECT_GT(looseAsLaid, 200);
  EXPECT_GT(fixed, 50);
  island.rest();
  expectSound(island, ground);
}

TEST(SandIsland, TellsWhatIsLoose) {
  const HeightMap ground = wavesIn(kRegion), depths = depthsIn(kRegion);
  Island island(ground);
  EXPECT_TRUE(test::sameBits(island.loose().view(), HeightMap(ground.columns(), ground.rows()).view()));
  const Stamp dug = stamp(60.0, 90.0, 6.0, 3.0);
  island.press(dug);
  island.rest();
  const HeightMap heights = island.heights(), loose = island.loose();
  EXPECT_GT(at(loose, 30 + 5, 45), 0.25F) << "what the tool has pushed aside";
  const double reach = SandIsland::read(dug, kRegion.spacing).value().reach;
  double volume = 0.0;  // [m^3]
  for (int y = 0; y < ground.rows(); ++y) {
    for (int x = 0; x < ground.columns(); ++x) {
      volume += 4.0 * loose(x, y);
      if (loose(x, y) == 0.0F) continue;
      ASSERT_LT(std::hypot(2.0 * x - dug.east, 2.0 * y - dug.north), reach);
    }
  }
  const double step = island.surface().step();
  const double onTriangles = asDouble(looseVolume(island)) / 6.0 * step * step * kMetresPerTick;
  EXPECT_NEAR(volume, onTriangles, 0.05 * onTriangles);
  // Laid on the ground as it was left, it is as loose as before.
  Island after(heights);
  after->layLoose(loose.view());
  EXPECT_TRUE(test::sameBits(after.loose().view(), loose.view()));
  EXPECT_TRUE(test::sameBits(after.heights().view(), heights.view()));
}

TEST(SandIsland, GoesOnAfterGrowingOverLooseGroundAsIfItHadBegunSo) {
  const HeightMap ground = wavesIn(kLarge), depths = depthsIn(kLarge);
  Island grown(wavesIn(kRegion)), large(ground, kLarge);
  grown->layLoose(depthsIn(kRegion).view());
  large->layLoose(depths.view());
  play(grown, 120.0, 90.0, 5);
  play(large, 120.0 + 384.0, 90.0 + 64.0, 5);
  grown.grow(ground, kLarge);
  grown->layLoose(depths.view());
  EXPECT_TRUE(test::sameBits(grown.loose().view(), large.loose().view()));
  for (const auto& [east, north] : {std::pair(258.0, 150.0), std::pair(790.0, 300.0)}) {
    play(grown, east, north, 6);
    play(large, east, north, 6);
    EXPECT_EQ(grown->steps(), large->steps());
    ASSERT_TRUE(test::sameBits(grown.heights().view(), large.heights().view()));
    ASSERT_TRUE(test::sameBits(grown.loose().view(), large.loose().view()));
  }
  expectSound(grown, ground);
}

TEST(SandIsland, GrowsAgainAndAgainToAllSides) {
  Island island(flat());
  DeformRegion region = kRegion;
  for (int count = 0; count < 12; ++count) {
    if (count % 4 == 0) --region.i;
    if (count % 4 == 1) --region.j;
    ++(count % 4 < 2 ? region.columns : region.rows);
    if (count % 4 == 1) ++region.rows;
    const HeightMap ground = flat(region);
    island.grow(ground, region);
    const double middle = 0.5 * (region.sampleColumns() - 1) * region.spacing;
    island.press(stamp(middle, 64.0 + 8.0 * count, 6.0, 3.0));
    island.rest();
    expectSound(island, ground);
  }
}

constexpr DeformRegion kBeside{.i = -6, .j = -1, .columns = 6, .rows = 10, .intervals = 32, .spacing = 2.0};

TEST(SandIsland, TakesAnotherOneInTriangleByTriangle) {
  const HeightMap ground = wavesIn(kLarge);
  Island island(wavesIn(kRegion)), other(wavesIn(kBeside), kBeside);
  play(island, 120.0, 90.0, 5);
  play(other, 64.0, 190.0, 8);
  auto triangles = openTriangles(island);
  const auto others = openTriangles(other);
  triangles.insert(triangles.end(), others.begin(), others.end());
  std::sort(triangles.begin(), triangles.end());
  const SixfoldVolume account = island.account(), loose = looseVolume(island) + looseVolume(other);
  const SixfoldVolume owed = island.surface().owed() + other.surface().owed();
  const std::size_t constraints =
      island.surface().mesh().constraintCount() + other.surface().mesh().constraintCount();
  const double poured = island->poured() + other->poured();
  const std::uint64_t steps = island->steps();
  const HeightMap here = island.heights(), there = other.heights();
  EXPECT_TRUE(loose > 0);

  island.merge(other, ground, kLarge);
  EXPECT_EQ(openTriangles(island), triangles);
  EXPECT_TRUE(looseVolume(island) == loose);
  EXPECT_TRUE(island.surface().owed() == owed);
  EXPECT_TRUE(island.account() == account);
  EXPECT_EQ(island.surface().mesh().constraintCount(), constraints);
  EXPECT_EQ(island->poured(), poured);
  EXPECT_EQ(island->steps(), steps);
  EXPECT_TRUE(island->atRest());
  expectSound(island, ground);
  const HeightMap all = island.heights();
  EXPECT_TRUE(test::sameBits(all.view().part(192, 32, here.columns(), here.rows()), here.view()));
  EXPECT_TRUE(test::sameBits(all.view().part(0, 0, there.columns(), there.rows()), there.view()));

  // On the border between the two, and over what the other one had.
  for (const double east : {256.0, 70.0}) play(island, east, 190.0, 9);
  EXPECT_TRUE(island.account() == account);
  EXPECT_FALSE(test::sameBits(island.heights().view(), all.view()));
  expectSound(island, ground);
}

TEST(SandIsland, GoesOnAfterMergingWhereverItsLatticeLies) {
  const auto after = [](DeformRegion region) {
    Island island(wavesIn(region), region), other(wavesIn(kBeside), kBeside);
    play(island, 120.0, 90.0, 5);
    play(other, 64.0, 190.0, 8);
    island.merge(other, wavesIn(kLarge), kLarge);
    play(island, 256.0, 190.0, 9);
    return island.heights();
  };
  DeformRegion larger = kRegion;
  ++larger.columns;
  larger.rows += 2;
  EXPECT_TRUE(test::sameBits(after(kRegion).view(), after(larger).view()));
}

TEST(SandIsland, CleansUpAfterMergingWhatWaitedInTheOtherOne) {
  // A tool's outlines stay until the next stamp, which may be another island's.
  Island island(flat()), other(flat(kBeside), kBeside);
  other.press(stamp(64.0, 190.0, 10.0, 5.0, {{"tool", std::string("square")}}));
  other.rest();
  const std::size_t constraints = other.surface().mesh().constraintCount();
  Island alone(flat());
  for (Island* one : {&island, &alone}) {
    one->press(stamp(100.0, 96.0, 4.0, 1.0));
    one->rest();
  }
  island.merge(other, flat(kLarge), kLarge);
  island.press(stamp(100.0 + 384.0, 96.0 + 64.0, 6.0, 1.0));
  island.rest();
  alone.press(stamp(100.0, 96.0, 6.0, 1.0));
  alone.rest();
  EXPECT_LT(island.surface().mesh().constraintCount(),
            alone.surface().mesh().constraintCount() + constraints - 4);
}

TEST(SandIsland, RefusesToGrowBeyondItsLatticeOrOntoGroundThatItCannotHold) {
  Island island(flat());
  island.press(stamp(128.0, 96.0, 8.0, 4.0));
  island.rest();
  const HeightMap before = island.heights();
  DeformRegion region = kRegion;
  region.i = -4096;
  region.columns += 4096;
  const Result<void> beyond = island->grow(region, flat().view());
  ASSERT_FALSE(beyond.ok());
  EXPECT_EQ(beyond.error().message,
            "sand cannot grow to a region of 131328 x 224 squares: its lattice of 262144 along a side ends "
            "before");
  region.i = 0;
  region.columns = 8193;
  EXPECT_FALSE(island->grow(region, flat().view()).ok());
  HeightMap high = flat(kLarge);
  high(7, 5) = 16385.0F;
  const Result<void> tooHigh = island->grow(kLarge, high.view());
  ASSERT_FALSE(tooHigh.ok());
  EXPECT_EQ(tooHigh.error().message, "sand cannot hold ground at 16385 m, only from -16384 m to 16384 m");
  EXPECT_TRUE(test::sameBits(island.heights().view(), before.view()));
}

TEST(SandIsland, LeavesLooseMaterialNoSteeperThanItLies) {
  Island island(flat());
  island.press(stamp(128.0, 96.0, 8.0, -8.0));
  island.rest();
  EXPECT_GT(steepestLooseSlope(island.surface()), 0.5);
  EXPECT_LT(steepestLooseSlope(island.surface()), kSteepestSand);
  const HeightMap after = island.heights();
  EXPECT_LT(at(after, 64, 48), 7.0F);
  EXPECT_GT(at(after, 64, 48), 2.0F);
}

TEST(SandIsland, KeepsFewVerticesWhereGroundIsFlat) {
  Island island(flat());
  island.press(stamp(128.0, 96.0, 10.0, 5.0));
  const std::size_t before = island.surface().mesh().vertexCount();
  const SandPress press = SandIsland::read(stamp(0.0, 0.0, 10.0, 5.0), 2.0).value();
  EXPECT_GT(static_cast<double>(before), 0.7 * press.opens * press.opens);  // 3.14 / 4 at least
  island.rest();
  EXPECT_LT(island.surface().mesh().vertexCount(), 3 * before / 4);
  EXPECT_LE(island->tolerance(), 0.001);
}

TEST(SandIsland, CleansUpAllThatALargeGentleToolHasTakenIn) {
  const DeformRegion region{.columns = 12, .rows = 12, .intervals = 32, .spacing = 2.0};
  Island island(flat(region), region);
  island.press(stamp(256.0, 256.0, 60.0, 0.25));
  const std::size_t before = island.surface().mesh().vertexCount();
  island.rest();
  // The berm is round, and keeps half of them.
  EXPECT_LT(island.surface().mesh().vertexCount(), 11 * before / 20);
}

TEST(SandIsland, HasNeverMoreBeforeItThanItsStepsCanDo) {
  EXPECT_LE(2 * SandIsland::kMostLooks, kMostEditSteps * SandIsland::kStepFaces);
  const DeformRegion region{.columns = 16, .rows = 16, .intervals = 32, .spacing = 2.0};
  Island island(flat(region), region);
  for (int count = 0; count < 24; ++count) {
    island.press(stamp(384.0, 384.0, 48.0, -24.0));
    ASSERT_LE(island->looksLeft(), SandIsland::kMostLooks);
  }
  EXPECT_EQ(island->looksLeft(), SandIsland::kMostLooks);
}

/// How high it lies above the ground, at most, where `isThere` says so of a place [m].
template <class IsThere>
float highestWhere(const HeightMap& ground, const HeightMap& after, const IsThere& isThere) {
  float highest = 0.0F;
  for (int y = 0; y < ground.rows(); ++y) {
    for (int x = 0; x < ground.columns(); ++x) {
      if (isThere(2.0 * x, 2.0 * y)) highest = std::max(highest, after(x, y) - ground(x, y));
    }
  }
  return highest;
}

/// Between two distances from a stamp.
float highestBetween(const HeightMap& ground, const HeightMap& after, const Stamp& from, double near,
                     double far) {
  return highestWhere(ground, after, [&](double east, double north) {
    const double distance = std::hypot(east - from.east, north - from.north);
    return near <= distance && distance < far;
  });
}

TEST(SandIsland, LetsSandRunDownSteepGroundAsFarAsItMay) {
  const HeightMap ground = steep();
  Island island(ground);
  const SixfoldVolume before = island.account();
  const Stamp heap = stamp(100.0, 96.0, 8.0, -8.0);
  const SandPress press = SandIsland::read(heap, 2.0).value();
  EXPECT_EQ(press.reach, 3.0 * press.opens);
  island.press(heap);
  EXPECT_GT(highestBetween(ground, island.heights(), heap, 0.0, 8.0), 7.0F);
  EXPECT_EQ(highestBetween(ground, island.heights(), heap, press.opens, 1e9), 0.0F);
  island.rest();
  expectUntouchedBeyond(island, ground, heap);
  expectSound(island, ground);
  EXPECT_TRUE(island.account() == before);
  const HeightMap after = island.heights();
  EXPECT_LT(highestBetween(ground, after, heap, 0.0, press.opens + 8.0), 0.1F) << "nothing is in its way";
  EXPECT_GT(highestBetween(ground, after, heap, press.reach - 20.0, press.reach), 1.0F)
      << "all of it is here";
  EXPECT_GT(island->looksLeft(), 0U);
}

/// 45 degrees down to a plain, `width` [m] east of a place.
HeightMap hillside(double width) {
  return groundOf(kRegion, [width](int x, int) { return std::max(0.0, 100.0 + width - 2.0 * x); });
}

TEST(SandIsland, LetsSandLieAtTheFootOfAHillAsSandLies) {
  const HeightMap ground = hillside(60.0);
  Island island(ground);
  const Stamp heap = stamp(100.0, 96.0, 8.0, -8.0);
  for (int count = 0; count < 6; ++count) island.press(heap);
  island.rest();
  const HeightMap after = island.heights();
  const double opens = SandIsland::read(heap, 2.0).value().opens;
  EXPECT_LT(opens, 60.0) << "it had to run on";
  EXPECT_LT(highestBetween(ground, after, heap, 0.0, opens - 10.0), 0.1F);
  EXPECT_GT(highestBetween(ground, after, heap, 45.0, 75.0), 2.0F);
  double steepest = 0.0;
  for (int y = 1; y < after.rows(); ++y) {
    for (int x = 1; x < after.columns(); ++x) {
      const float here = after(x, y);
      steepest = std::max<double>(
          {steepest, std::fabs(here - after(x - 1, y)) / 2.0, std::fabs(here - after(x, y - 1)) / 2.0});
    }
  }
  EXPECT_LT(steepest, 1.25) << "there is no wall";
  EXPECT_LT(steepestLooseSlope(island.surface()), kSteepestSand);
}

/// As the engine lets it, on ground that it has.
void spread(Island& island) {
  ASSERT_FALSE(island->spreadsTo().isEmpty());
  ASSERT_TRUE(island.region().changeable().contains(island->spreadsTo()));
  island->spread();
  ASSERT_FALSE(island->atRest());
  island.rest();
}

TEST(SandIsland, SpreadsFromTheEndOfItsReachToTheFootOfAHill) {
  constexpr double kWidth = 130.0;
  const HeightMap ground = hillside(kWidth);
  Island island(ground);
  const SixfoldVolume before = island.account();
  const Stamp heap = stamp(30.0, 96.0, 4.0, -4.0);
  const double reach = SandIsland::read(heap, 2.0).value().reach;
  ASSERT_LT(heap.east + reach, kApron + 100.0 + kWidth - 40.0) << "the foot is beyond it";
  EXPECT_TRUE(island->spreadsTo().isEmpty());
  island.press(heap);
  island.rest();
  EXPECT_GT(highestBetween(ground, island.heights(), heap, 0.0, reach), 0.5F);
  for (int count = 0; !island->spreadsTo().isEmpty(); ++count) {
    ASSERT_LT(count, 8);
    spread(island);
  }
  EXPECT_LT(highestBetween(ground, island.heights(), heap, 0.0, reach), 0.1F) << "nothing leans there now";
  EXPECT_GT(highestBetween(ground, island.heights(), heap, reach, 1e9), 0.2F);
  EXPECT_TRUE(island.account() == before);
  EXPECT_LT(steepestLooseSlope(island.surface()), kSteepestSand);
  expectSound(island, ground);
}

TEST(SandIsland, SpreadsAfterGrowingAsIfItHadBegunSo) {
  const HeightMap ground = steep(kLarge);
  Island grown(steep()), large(ground, kLarge);
  const double east = 2.0 * kLarge.placeOf(kRegion).column, north = 2.0 * kLarge.placeOf(kRegion).row;
  const double reach = SandIsland::read(stamp(0.0, 0.0, 4.0, -4.0), 2.0).value().reach;
  const double place = 2.0 * (kRegion.sampleColumns() - 1) - 2.0 * kApron - reach + 100.0;
  grown.press(stamp(place, 96.0, 4.0, -4.0));
  large.press(stamp(place + east, 96.0 + north, 4.0, -4.0));
  grown.rest();
  large.rest();
  ASSERT_FALSE(kRegion.changeable().contains(grown->spreadsTo()));
  const HeightMap before = grown.heights();
  grown->spread();
  EXPECT_TRUE(grown->atRest()) << "there is no ground";
  EXPECT_TRUE(test::sameBits(grown.heights().view(), before.view()));
  grown.grow(ground, kLarge);
  for (int count = 0; count < 2; ++count) {
    spread(grown);
    spread(large);
    EXPECT_EQ(grown->steps(), large->steps());
    ASSERT_TRUE(test::sameBits(grown.heights().view(), large.heights().view()));
  }
  EXPECT_EQ(openTriangles(grown), openTriangles(large));
  expectSound(grown, ground);
}

/// Anywhere down to so far [m] to the east of a heap, in a strip 40 m wide.
float highestDownTo(const HeightMap& ground, Island& island, const Stamp& heap, double far) {
  return highestWhere(ground, island.heights(), [&](double east, double north) {
    return std::fabs(north - heap.north) < 20.0 && east < heap.east + far;
  });
}

TEST(SandIsland, LetsSandThatLeansOnTheFenceRunOnOnceAStampReachesFarther) {
  for (const bool isTakenIn : {false, true}) {
    Island island(steep(kBeside), kBeside), first(steep());
    const Stamp heap = stamp(40.0, 190.0, 4.0, -4.0);
    const double reach = SandIsland::read(heap, 2.0).value().reach;
    island.press(heap);
    island.rest();
    ASSERT_GT(highestDownTo(steep(kBeside), island, heap, reach), 0.5F);
    // Whatever is done elsewhere.
    for (int count = 0; count < 4; ++count) {
      island.press(stamp(40.0, 420.0, 2.0, 0.5));
      island.rest();
    }
    if (isTakenIn) first.merge(island, steep(kLarge), kLarge);
    Island& now = isTakenIn ? first : island;
    // Far enough beside what leans there to touch nothing of it.
    const Stamp beside = stamp(40.0 + reach - 5.0, 190.0 + 55.0, 8.0, 0.5);
    ASSERT_LT(SandIsland::read(beside, 2.0).value().opens, 25.0);
    now.press(beside);
    now.rest();
    EXPECT_LT(highestDownTo(steep(now.region()), now, heap, reach), 0.1F) << isTakenIn;
  }
}

TEST(SandIsland, LetsSandRunOnWhereAToolCutsWhatItLeansOn) {
  const HeightMap ground = steep();
  Island island(ground);
  const Stamp heap = stamp(40.0, 96.0, 4.0, -4.0);
  const double reach = SandIsland::read(heap, 2.0).value().reach;
  island.press(heap);
  island.rest();
  ASSERT_GT(highestDownTo(ground, island, heap, reach), 0.5F);
  island.press(stamp(40.0 + reach, 96.0, 8.0, 1.0));
  island.rest();
  EXPECT_LT(highestDownTo(ground, island, heap, reach), 0.1F);
  expectSound(island, ground);
}

TEST(SandIsland, LetsSandRunAsFarAsAnyStampBeforeReaches) {
  // So damp that it stays where it is, and the fence with it.
  const auto wide = [](double east, double north) {
    return stamp(east, north, 14.0, -0.125, {{"repose", 45.0}, {"moisture", 1.0}});
  };
  Island island(steep()), other(steep(kBeside), kBeside);
  island.press(wide(60.0, 96.0));
  island.rest();
  other.press(wide(40.0, 190.0));
  other.rest();
  const HeightMap ground = steep(kLarge);
  island.merge(other, ground, kLarge);
  // What it had itself, and has kept where it has grown; and what the other one had.
  for (const Stamp& heap : {stamp(60.0 + 384.0, 96.0 + 64.0, 4.0, -4.0), stamp(40.0, 190.0, 4.0, -4.0)}) {
    const double reach = SandIsland::read(wide(0.0, 0.0), 2.0).value().reach;
    ASSERT_GT(reach, SandIsland::read(heap, 2.0).value().reach + 20.0);
    island.press(heap);
    island.rest();
    EXPECT_LT(highestDownTo(ground, island, heap, reach - 16.0), 0.2F);
    EXPECT_GT(highestDownTo(ground, island, heap, reach), 0.5F);
  }
}

TEST(SandIsland, ComesToRestAmongNeedles) {
  const HeightMap ground = noisy(1000.0);
  Island island(ground);
  island.press(stamp(128.0, 96.0, 6.0, 2.0));
  island.press(stamp(130.0, 92.0, 6.0, -2.0));
  island.rest();
  const double across = SandIsland::read(stamp(0.0, 0.0, 6.0, 2.0), 2.0).value().reach / 2.0;
  EXPECT_LT(static_cast<double>(island->steps()), 2 * 44.5 * across * across * across / 1024.0 + 20.0);
  expectSound(island, ground);
}

TEST(SandIsland, BearsThousandsOfStampsOnOneSpot) {
  constexpr int kStamps = 10'000;
  const HeightMap ground = noisy(1.0);
  Island island(ground);
  const SixfoldVolume before = island.account();
  for (int count = 0; count < kStamps; ++count) {
    const double depth = count % 3 == 2 ? -1.0 : 1.0;
    island.press(stamp(128.5, 95.25, 2.0, depth, {{"tool", std::string(kTools[(count / 7) % 5])}}));
    if (count % 50 != 0) continue;
    ASSERT_TRUE(island->step(Slice::unlimited(), island->steps() + 1));
  }
  EXPECT_TRUE(island.account() == before);
  expectSound(island, ground);
  EXPECT_LT(island.surface().mesh().vertexCount(), 50'000U);
  const HeightMap after = island.heights();
  for (const float height : after.samples()) ASSERT_TRUE(std::isfinite(height));
}

TEST(SandIsland, PutsAStampAfterTheStepThatHasBegun) {
  const auto after = [](bool within) {
    Island island(noisy(1.0));
    island.press(stamp(120.0, 96.0, 10.0, 5.0));
    if (within) {
      for (int slice = 0; slice < 5; ++slice) EXPECT_FALSE(island->step(test::shortestSlice(), kEnd));
      EXPECT_EQ(island->steps(), 0U);
    } else {
      EXPECT_TRUE(island->step(Slice::unlimited(), 1));
    }
    island.press(stamp(128.0, 96.0, 8.0, 4.0));
    EXPECT_EQ(island->steps(), 1U);
    island.rest();
    return island.heights();
  };
  EXPECT_TRUE(test::sameBits(after(true).view(), after(false).view()));
}

TEST(SandIsland, LetsTheAngleOfReposeHoldForWhatMovesFromThenOn) {
  const auto top = [](double repose, double moisture) {
    Island island(flat());
    island.press(stamp(128.0, 96.0, 8.0, -8.0, {{"repose", repose}, {"moisture", moisture}}));
    island.rest();
    return at(island.heights(), 64, 48);
  };
  EXPECT_LT(top(20.0, 0.0), top(30.0, 0.0));
  EXPECT_LT(top(30.0, 0.0), top(30.0, 1.0));
  // A heap at rest stays when drier sand comes far from it.
  Island island(flat());
  island.press(stamp(90.0, 96.0, 6.0, -6.0, {{"repose", 45.0}}));
  island.rest();
  const float before = at(island.heights(), 45, 48);
  island.press(stamp(190.0, 96.0, 4.0, -4.0, {{"repose", 20.0}}));
  island.rest();
  EXPECT_EQ(at(island.heights(), 45, 48), before);
}

TEST(SandIsland, RefusesWithASentenceWhatItCannotDo) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto sentence = [](double size, double depth, const char* tool = "round") {
    const Result<SandPress> press =
        SandIsland::read(stamp(0.0, 0.0, size, depth, {{"tool", std::string(tool)}}), 2.0);
    return press ? std::string() : press.error().message;
  };
  EXPECT_EQ(sentence(0.0, 1.0), "size is 0 m, expected a radius above 0 and up to 128 m");
  EXPECT_EQ(sentence(129.0, 1.0), "size is 129 m, expected a radius above 0 and up to 128 m");
  EXPECT_NE(sentence(nan, 1.0), "");
  EXPECT_EQ(sentence(4.0, 5.0),
            "depth is 5 m, expected at most the size, down or, to heap up, negative, and not 0");
  EXPECT_NE(sentence(4.0, 0.0), "");
  EXPECT_NE(sentence(4.0, nan), "");
  EXPECT_NE(sentence(4.0, 5e-324), "");
  for (const std::string_view tool : kTools) {
    const std::string least = sentence(0.05, 0.01, std::string(tool).c_str());
    ASSERT_NE(least.find("expected at least "), std::string::npos) << least;
    const double size = std::stod(least.substr(least.find("at least ") + 9));
    if (tool == "ball") continue;  // whose outline depends on the depth, too
    EXPECT_EQ(sentence(size * 1.001, 0.01, std::string(tool).c_str()), "");
  }
  const DeformRegion wide{.columns = 8193, .rows = 1, .intervals = 32, .spacing = 2.0};
  const auto tooWide = SandIsland::begin(wide, flat().view());
  ASSERT_FALSE(tooWide.ok());
  EXPECT_EQ(
      tooWide.error().message,
      "sand cannot hold a region of 262176 x 32 squares: at most 262144 along a side and 1073741824 in all");
  HeightMap high = flat();
  high(7, 5) = 16385.0F;
  const auto tooHigh = SandIsland::begin(kRegion, high.view());
  ASSERT_FALSE(tooHigh.ok());
  EXPECT_EQ(tooHigh.error().message, "sand cannot hold ground at 16385 m, only from -16384 m to 16384 m");
}

}  // namespace
}  // namespace teren
