// Plugin kind 3: a deformer owns a live surface over a piece of ground, presses tools into it and lets it
// settle.
#pragma once

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "teren/HeightMap.h"
#include "teren/Parameter.h"
#include "teren/Result.h"
#include "teren/Slice.h"

namespace teren {

/// A rectangle of a region's samples; empty where columns or rows are 0.
struct SampleRectangle {
  int column = 0, row = 0, columns = 0, rows = 0;

  bool isEmpty() const noexcept { return columns == 0 || rows == 0; }
  bool contains(int x, int y) const noexcept {
    return column <= x && x - column < columns && row <= y && y - row < rows;
  }
  bool contains(const SampleRectangle& part) const noexcept {
    return part.column >= column && part.row >= row && part.columns >= 0 && part.rows >= 0 &&
           part.columns <= column + columns - part.column && part.rows <= row + rows - part.row;
  }
  /// The least that contains both; an empty one has no place.
  SampleRectangle joinedWith(const SampleRectangle& other) const noexcept {
    if (isEmpty()) return other;
    if (other.isEmpty()) return *this;
    const int west = std::min(column, other.column), south = std::min(row, other.row);
    return {west, south, std::max(column + columns, other.column + other.columns) - west,
            std::max(row + rows, other.row + other.rows) - south};
  }
};

/// A surface changes no corner of the cells that lie so many deep along its region's rim: heights there stay
/// the ground's, and on the rim the normals, too.
inline constexpr int kCollarCells = 2;

/// Whole patches of ground at level 0: (columns n + 1) x (rows n + 1) samples, `spacing` [m] apart, rows from
/// south to north.
struct DeformRegion {
  std::int64_t i = 0, j = 0;  ///< patch of the south-west corner
  int columns = 1, rows = 1;  ///< patches, at least 1
  int intervals = 32;         ///< n, along a patch's side; at least 2
  double spacing = 2.0;       ///< [m]

  int sampleColumns() const noexcept { return columns * intervals + 1; }
  int sampleRows() const noexcept { return rows * intervals + 1; }
  /// The samples inside the collar: all that may change.
  SampleRectangle changeable() const noexcept {
    constexpr int first = kCollarCells + 1;
    return {first, first, std::max(0, sampleColumns() - 2 * first), std::max(0, sampleRows() - 2 * first)};
  }
  /// Those of them that lie nearer to a place [m] than `distance`, along each axis. Any numbers will do.
  SampleRectangle within(double east, double north, double distance) const noexcept {
    const SampleRectangle all = changeable();
    const auto along = [&](double middle, int from, int count) {
      const double least = std::floor((middle - distance) / spacing) + 1.0;
      const double past = -std::floor(-(middle + distance) / spacing);
      // std::max and std::min take their first argument where the other is NaN.
      const int first = static_cast<int>(std::min<double>(from + count, std::max<double>(from, least)));
      const int end = static_cast<int>(std::min<double>(from + count, std::max<double>(first, past)));
      return std::pair(first, end - first);
    };
    const auto [column, width] = along(east, all.column, all.columns);
    const auto [row, height] = along(north, all.row, all.rows);
    return {column, row, width, height};
  }
  /// Where in this region the samples of another lie that is a part of it (assert).
  SampleRectangle placeOf(const DeformRegion& part) const noexcept {
    const std::int64_t column = (part.i - i) * intervals, row = (part.j - j) * intervals;
    assert(part.intervals == intervals && part.spacing == spacing && column >= 0 && row >= 0);
    assert(column + part.sampleColumns() <= sampleColumns() && row + part.sampleRows() <= sampleRows());
    return {static_cast<int>(column), static_cast<int>(row), part.sampleColumns(), part.sampleRows()};
  }
};

/// One press of a tool: a few bytes that give the same ground wherever they are applied.
struct Stamp {
  double east = 0.0, north = 0.0;  ///< [m] of the tool's middle, from the region's south-west corner
  double height = 0.0;     ///< [m] at which the tool was held; tools that press from the ground ignore it
  double size = 1.0;       ///< [m] radius, or half the width; what it measures is the deformer's to say
  double depth = 0.0;      ///< [m] downwards where positive, upwards where negative
  std::uint64_t seed = 0;  ///< of what is random in it
  Values values;           ///< checked against the deformer's table
};

/// How a live surface lay at one moment. Immutable: any number of threads may ask, also when the surface has
/// gone on or is gone.
class DeformedGround {
 public:
  virtual ~DeformedGround() = default;

  /// [m] of the surface's triangles at a place of the region, in metres from its south-west corner; a grid's
  /// squares are split from south-west to north-east, as in nodes. At a sample it rounds to the float that
  /// `samples` writes there. Asked outside the region, it is a broken contract (assert).
  virtual double height(double east, double north) const = 0;
  /// Writes the heights of the rectangle's samples; it lies in the region and `out` has its size (assert).
  virtual void samples(const SampleRectangle& rectangle, HeightView out) const = 0;
  /// All samples that differ from the ground the surface began with lie in here, and here in `changeable`.
  virtual SampleRectangle changed() const = 0;
};

/// Ground that is being worked on. It advances in logical steps, which are numbered: what becomes of it
/// depends on the region, the ground, the stamps and after how many steps each of them came, never on how the
/// steps were sliced or asked for. One thread at a time, which may be another one from call to call. Nothing
/// throws but for want of memory.
class LiveSurface {
 public:
  virtual ~LiveSurface() = default;

  /// Presses a tool in. A logical step that has begun is completed before, so that a stamp always comes after
  /// a whole number of them. Refuses with one sentence what it cannot do, and then nothing has changed. Costs
  /// what lies within the stamp's reach.
  virtual Result<void> apply(const Stamp& stamp) = 0;

  /// Works until `upTo` logical steps have been done since it began or it is at rest (true), or until the
  /// slice is over (false), and at least one unit. Does no step where there is nothing to do.
  virtual bool step(const Slice& slice, std::uint64_t upTo) = 0;

  /// Logical steps completed since it began.
  virtual std::uint64_t steps() const noexcept = 0;
  /// Nothing moves any more until the next stamp. It begins at rest, and every stamp comes to rest after a
  /// number of steps.
  virtual bool atRest() const noexcept = 0;

  /// How it lies now; in the middle of a logical step that is provisional, else as much a function of the
  /// past as all the rest. Never null. Costs what has changed since the last one.
  virtual std::shared_ptr<const DeformedGround> snapshot() = 0;

  /// Every byte held, what it shares with its last snapshot included.
  virtual std::size_t bytes() const noexcept = 0;

  /// [m^3] At rest (assert): how much more volume lies under the samples of its last snapshot, on the grid's
  /// triangles, than under the surface itself; what is lost or won where it ends. None where samples are all
  /// there is. O(samples and what else it has).
  virtual double samplingError() const { return 0.0; }

  /// At rest only (assert), right after it began, grew or merged, and only where surfaces before have left
  /// something loose: so much of the ground at each sample of its region is loose [m], finite and not
  /// negative, while the rest is solid. Where something of its own lies already, that counts. A surface that
  /// knows no loose material needs nothing of this.
  virtual void layLoose(ConstHeightView depths) { (void)depths; }
  /// At rest only (assert): writes how much of the ground is loose at each sample of its region, what was
  /// laid and never touched included, and says so; false where it knows no loose material. Then what it
  /// changed is solid, and all else as it was.
  virtual bool loose(HeightView depths) const {
    (void)depths;
    return false;
  }

  /// At rest only (assert): from now on it covers `region`, of which its own is a part. `ground` has that
  /// region's samples; those where it lay are the ones that it began with. Stamps are then placed from the
  /// new corner, and that is all: samples and steps stay, and what comes is as if it had begun over the
  /// larger region, to the bit where sums of metres are exact. O(samples). Refuses with one sentence a region
  /// that it cannot hold, and then nothing has changed. A surface that does not grow needs nothing of this:
  /// where it is in the way it ends, and another begins on its samples.
  virtual Result<void> grow(const DeformRegion& region, ConstHeightView ground) {
    (void)region, (void)ground;
    return Error{"this surface does not grow"};
  }

  /// The same, and it takes what others have: surfaces of the same deformer, at rest, whose regions are parts
  /// of `region` that lie apart from its own and from each other (assert). `ground` is where each of them lay
  /// the one that it began with. Samples stay, those of the others too, which are good for nothing from then
  /// on. Where this refuses, with one sentence, nothing has changed, and the others end; so a surface that
  /// does not merge needs nothing of it, either.
  virtual Result<void> merge(const DeformRegion& region, ConstHeightView ground,
                             std::span<LiveSurface* const> others) {
    (void)region, (void)ground, (void)others;
    return Error{"this surface does not merge"};
  }

  /// At rest only (assert): where material that leans on the end of its stamps' reach would go on to, samples
  /// that also lie beyond its region; empty where all comes to rest by itself. O(what leans there).
  virtual SampleRectangle spreadsTo() const { return {}; }
  /// At rest only (assert): what its region's changeable() samples have of that may change from now on,
  /// though no stamp reaches it; where there is some it is not at rest any more. What becomes of it depends
  /// on nothing else.
  virtual void spread() {}
};

/// A kind of deformation. Const and thread-safe. A deformer has no settings of its own: all that can be set
/// is said stamp by stamp, so that a list of stamps says everything. A concrete class is
/// default-constructible and also has
///   static std::span<const Parameter> parameters() noexcept;   // the table of its stamps' values
class Deformer {
 public:
  virtual ~Deformer() = default;

  /// How far from its middle [m] the stamp, and what settles because of it alone, may change ground that lies
  /// `spacing` [m] apart: samples at this distance and farther stay as they are. A region that it is applied
  /// to has so much ground around the middle, and the collar beyond. (Many stamps together may move ground
  /// farther, up to the collar, and so may one where a surface is let: LiveSurface::spread.) Refuses with one
  /// sentence a stamp that no region could take.
  virtual Result<double> reach(const Stamp& stamp, double spacing) const = 0;

  /// Begins a live surface over `ground`: as many finite samples as the region has (assert), which it copies.
  /// O(samples). Refuses with one sentence a region that it cannot hold; never null.
  virtual Result<std::unique_ptr<LiveSurface>> begin(const DeformRegion& region,
                                                     ConstHeightView ground) const = 0;
};

/// "2.5 m": as short as it can be and read back the same, for sentences about stamps.
inline std::string metresText(double value) {
  char digits[32];
  return std::string(digits, std::to_chars(digits, digits + sizeof(digits), value).ptr) + " m";
}

/// Whether a stamp with this reach [m] leaves the region's collar alone: for the `apply` of every deformer.
/// Numbers that are not finite do not.
inline Result<void> checkPlace(const DeformRegion& region, const Stamp& stamp, double reach) {
  const double collar = kCollarCells * region.spacing;
  const double east = region.columns * region.intervals * region.spacing;
  const double north = region.rows * region.intervals * region.spacing;
  const auto fits = [&](double middle, double side) {
    return reach >= 0.0 && middle - reach >= collar && middle + reach <= side - collar;
  };
  if (fits(stamp.east, east) && fits(stamp.north, north)) return {};
  return Error{"the stamp " + metresText(stamp.east) + " east and " + metresText(stamp.north) +
               " north of its region's corner reaches " + metresText(reach) + ", expected to keep " +
               metresText(collar) + " inside the region's " + metresText(east) + " by " + metresText(north)};
}

}  // namespace teren
