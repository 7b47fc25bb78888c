// Ground of the endless landscape that becomes sand where tools touch it: the live surface of the plugin
// "sand".
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "teren/DeformGrid.h"
#include "teren/HeightMap.h"

#include "generators/sand/Sandbox.h"
#include "generators/sand/ToolShape.h"

namespace teren {

/// A tool as a stamp describes it, checked.
struct SandPress {
  std::optional<ToolShape> tool;  ///< nothing: a mound is poured on
  double radius = 1.0;            ///< [m] of the mound
  double height = 0.0;            ///< [m] of the mound
  double pushX = 0.0, pushY = 0.0;
  double dryAngle = kDryRepose, moisture = 0.0;
  double opens = 0.0;  ///< [m] how far ground is taken in at once
  double reach = 0.0;  ///< [m] ... and how far it may be, where sand runs on
};

/// A triangulation (TIN) in the middle of the region's grid. Its lattice is the world's, level-0 spacing /
/// 1024 a step; patch corners are whole squares of 1024 steps, so islands differ by whole steps. The lattice
/// is 2^18 squares a side, with the first region in its middle: however the island grows, no point moves. It
/// begins without any sand. Each stamp first takes the squares around it into the TIN, exactly as nodes draw
/// them (Opening.h), as solid ground, or, where islands before it have left it so, as loose ground that lies
/// as it lies until something moves it; vertices that are flat go from there to the clean-up's tolerance.
/// What tools cut becomes loose, and only loose material slides (Sandbox.h).
///
/// The fence around those squares keeps all others, and so the rim and the collar, as they are, bit for bit:
/// sand that comes there leans on it. Where it would slide on, the fence gives way at the end of the logical
/// step, kRunOutCells squares far, within the reach of the stamps so far: three times as far as they take
/// ground in, or 96 spacings farther where that is less, so that what is heaped on a steep slope runs down
/// it. Only there it lies as against a wall, and keeps its volume, until it is let (spread()): then the fence
/// gives way on, kSpreadCells squares around whatever leans on it there with more than a film. So an
/// avalanche runs to the foot of any slope that the engine has room for.
/// Where sand spreads, patches are nothing, nor is it to be seen that an island has grown; one that took
/// others in goes on with their triangles, volumes, debts and waiting vertices (Merging.h).
///
/// Steps: one takes kStepFaces faces to slide and then looks at kStepVertices vertices for the clean-up, or
/// as many as wait. Sand comes to rest by itself, but among needles of rock that takes for ever; so a stamp
/// brings 8 n^1.5 looks at faces, n squares that it takes in and that sand runs out to, two to ten times what
/// it takes on natural ground, and where they are used up sand lies as it lies until the next stamp touches
/// it. All stamps together never have more than kMostLooks before them: sand is at rest within a million
/// steps after the last of them.
///
/// What is read from outside are the grid's samples, at the TIN's heights there; a sample that lies within
/// tolerance() of the ground that the surface began with is that ground's. So ground on which nothing moved
/// is given back bit for bit, and DeformedGround::height is that of the level-0 triangles over the samples.
///
/// Volume: on the TIN nothing is lost; surface().volume() + owed() - entered() never changes, in exact
/// integers, and what is owed is rounding to ticks. Only poured() comes from nowhere. The samples see the TIN
/// at points a spacing apart: their volume differs from the TIN's by what lies between, the sampling error,
/// 4 % of what a round tool of 2 spacings raised, 0.2 % with one of 6 or 12 (SandIsland_test).
///
/// Memory: 16 bytes a sample of the region, and some 130 a vertex in the TIN, of which the first stamp at a
/// place brings 4 (size + depth)^2 / spacing^2 at the order of magnitude.
class SandIsland final : public LiveSurface {
 public:
  static constexpr double kMostSpacings = 64.0;  ///< of a tool's size: more would be a million vertices
  static constexpr std::int32_t kStepsASpacing = 1024;
  static constexpr int kRunOutCells = 2;
  static constexpr int kSpreadCells = 32;             ///< to each side
  static constexpr double kFilm = 1.0 / 16.0;         ///< [spacings] that less loose material is
  static constexpr double kTolerance = 1.0 / 2048.0;  ///< [spacings]
  static constexpr std::uint64_t kStepFaces = 1024;
  static constexpr std::size_t kStepVertices = 256;
  /// Half a million steps of sliding; what is cleaned up meanwhile takes far fewer.
  static constexpr std::uint64_t kMostLooks = 500'000 * kStepFaces;

  /// What a stamp means, or one sentence why it means nothing. size [m]: the radius of round tools, half the
  /// width of others, above 0 to kMostSpacings, and large enough for the tool's walls. depth [m]: how deep
  /// the tool goes below the ground in its middle, above 0 to size; where it is negative a mound so high is
  /// poured on, whatever the tool, of loose material that comes from nowhere. Stamp::height and seed are
  /// ignored.
  static Result<SandPress> read(const Stamp& stamp, double spacing);

  /// Refuses a region that its lattice cannot hold, and ground beyond +-16384 m. O(samples), copied.
  static Result<std::unique_ptr<LiveSurface>> begin(const DeformRegion& region, ConstHeightView ground);

  Result<void> apply(const Stamp& stamp) override;
  bool step(const Slice& slice, std::uint64_t upTo) override;
  std::uint64_t steps() const noexcept override { return steps_; }
  bool atRest() const noexcept override { return !begun_ && sandbox_.isDone(); }
  std::shared_ptr<const DeformedGround> snapshot() override;
  std::size_t bytes() const noexcept override;
  void layLoose(ConstHeightView depths) override;
  bool loose(HeightView depths) const override;
  /// The squares around whatever sand leans on. Nothing where kMostLooks are used up.
  SampleRectangle spreadsTo() const override;
  void spread() override;
  /// Refuses a region beyond its lattice, and what begin() refuses.
  Result<void> grow(const DeformRegion& region, ConstHeightView ground) override;
  /// Takes others in with all that is loose, owed and still to be cleaned up; their steps are forgotten.
  Result<void> merge(const DeformRegion& region, ConstHeightView ground,
                     std::span<LiveSurface* const> others) override;

  /// Within 1e-9 of what lies over the lowest of the region's heights.
  double samplingError() const override;

  const SandSurface& surface() const noexcept { return sandbox_.surface(); }
  /// So many faces are looked at until sand lies as it lies.
  std::uint64_t looksLeft() const noexcept;
  double tolerance() const noexcept { return sandbox_.settings().flatness; }  ///< [m]
  double poured() const noexcept { return poured_; }                          ///< [m^3]

 private:
  SandIsland(const DeformRegion& region, ConstHeightView ground);

  void takeGroundIn(const Stamp& stamp, const SandPress& press);
  void limitLooks();
  void allowLooks(std::uint64_t looks);
  std::uint64_t looksFor(double more) const noexcept;
  void work();
  template <class Visitor>
  void forEachSpread(Visitor&& visit) const;
  void findWayOut(LatticePoint corner);
  bool runOut();
  void sample(TriangleId t);
  template <class Visitor>
  void forEachSample(TriangleId t, Visitor&& visit) const;
  double volumeOverOpenSquares(double from) const;
  double volumeUnderSamples(double from) const;
  void take(SandIsland& other);

  HeightMap ground_;
  HeightMap loose_;  // of it, when the surface began or grew; empty where all was solid
  DeformGrid grid_;
  Sandbox sandbox_;
  double poured_ = 0.0;
  OpenCells reached_;  // squares within the reach of stamps
  std::vector<Opening::Cell> cells_;
  std::size_t leanedSeen_ = 0;  // of the vertices that sand leans on, at the front
  bool runsOut_ = false;        // squares have been opened in this step
  bool begun_ = false;          // a step, which is not done
  std::uint64_t faces_ = 0;
  std::uint64_t slidesUntil_ = 0;  // so many faces are looked at in all ...
  std::uint64_t slidesMost_ = 0;   // ... and never more until the next stamp
  double squares_ = 0.0;           // of the latest stamp, with those that sand ran out to since
  std::size_t vertices_ = 0;       // done of the step
  std::uint64_t steps_ = 0;
};

}  // namespace teren
