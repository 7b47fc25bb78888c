#include "generators/fault/FaultFormation.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <vector>

#include "teren/Hash.h"

#include "generators/fault/FaultLine.h"

namespace teren {
namespace {

/// Columns that are summed at once: a row of the tile is two cache lines, the whole of it 33 KB at a side of
/// 257. With 16 the work per fault and tile shows, with 64 the tile leaves the first-level cache.
constexpr int kTile = 32;
constexpr int kLinesPerUnit = 32;       // a unit of drawing lines: about 1 us
constexpr int kCrossingsPerUnit = 256;  // a unit of marking crossings: about 5 us at most

/// Crossing rows are stepped in fixed point with this many bits after the point. That is exact: in a map of
/// 2^a intervals a crossing lies at U / (|dx| * 2^(20 - a)) rows, U an integer, so its fraction is a multiple
/// of 1 / M with M < 2^(40 - a). The start is rounded up by at most 1 and each of up to 2^a increments by at
/// most 1 (in 2^-42 rows), together less than 2^42 / M: the position is never below the true one, and never
/// reaches the next whole row early.
constexpr int kFractionBits = 42;

/// A fault as seen while columns are visited from west to east.
struct Crossing {
  std::uint64_t position = 0;   ///< first row above the line at the next active column, fixed point
  std::uint64_t increment = 0;  ///< of position per column, modulo 2^64
  std::uint32_t flip = 0;       ///< what the sum changes by at that row
  int first = 0, last = 0;      ///< active columns, [first, last): the line lies between bottom and top row
};

/// How many of the columns 0 ... columns - 1 have start + column * gain < limit; gain >= 0.
int countBelow(std::int64_t start, std::int64_t gain, std::int64_t limit, int columns) noexcept {
  if (start >= limit) return 0;
  if (gain == 0) return columns;
  return static_cast<int>(std::min<std::int64_t>(columns, (limit - start + gain - 1) / gain));
}

/// One map of 2^a + 1 samples a side. Columns are made in tiles of kTile. For every fault, a tile receives
/// one mark per column, at the row where the column crosses to the other side; one running sum from south to
/// north then turns the marks of all faults into heights. (Summing along columns, not along rows, lets plain
/// compiler vectors do it.) Marking is bound by the throughput of loads and stores, summing by conversions.
/// Sums and marks are unsigned, because a mark may pass 2^31 where the sum does not.
class MapTask final : public SlicedTask {
 public:
  MapTask(int faults, double metresPerStep, std::uint64_t seed, HeightView out)
      : random_(seed),
        faults_(faults),
        metresPerStep_(metresPerStep),
        unitsLog2_(kFaultUnitBits - std::countr_zero(static_cast<unsigned>(out.columns() - 1))),
        out_(out),
        crossings_(static_cast<std::size_t>(faults)),
        bottom_(static_cast<std::size_t>(out.columns()) + 1),
        tile_(static_cast<std::size_t>(out.rows()) * kTile) {}

  bool step(const Slice& slice) override {
    do {
      if (unit()) return true;
    } while (!slice.over());
    return false;
  }

 private:
  /// Does the next unit of work; true: it was the last one.
  bool unit() {
    if (drawn_ < faults_) {
      drawLines();
    } else if (marked_ < faults_) {
      markCrossings();
    } else {
      sumTile();
      marked_ = 0;
      column_ += kTile;
    }
    return column_ >= out_.columns();
  }

  void drawLines() {
    const int end = std::min(faults_, drawn_ + kLinesPerUnit);
    for (; drawn_ < end; ++drawn_) addLine(drawFaultLine(random_, faults_ - drawn_), crossings_[drawn_]);
    if (drawn_ < faults_) return;
    for (int column = 1; column < out_.columns(); ++column) bottom_[column] += bottom_[column - 1];
  }

  void addLine(const FaultLine& line, Crossing& crossing) {
    const std::int64_t dx = line.bx - line.ax;
    const std::int64_t dy = line.by - line.ay;
    if (dx == 0) return addVerticalLine(line, dy);

    // Below the line is right of it when it runs east, left of it when it runs west; the line itself counts
    // as right. So the first row above the line is floor(U / (width * units per interval)) + 1, with U = 0
    // where the line meets the bottom row and -1 there when the line itself belongs to the side above.
    const std::int64_t width = dx > 0 ? dx : -dx;
    const std::int64_t rise = dx > 0 ? dy : -dy;
    const std::int64_t atWestRim = line.ay * width - rise * line.ax - (dx < 0 ? 1 : 0);
    const std::int64_t top = width << kFaultUnitBits;
    const std::uint32_t below = static_cast<std::uint32_t>(dx > 0 ? -line.left : line.left);
    const int columns = out_.columns();
    if (rise >= 0) {
      crossing.first = countBelow(atWestRim, rise << unitsLog2_, 0, columns);
      crossing.last = countBelow(atWestRim, rise << unitsLog2_, top, columns);
      bottom_[0] -= below;
      bottom_[crossing.first] += 2 * below;
    } else {
      crossing.first = countBelow(-atWestRim, -rise << unitsLog2_, 1 - top, columns);
      crossing.last = countBelow(-atWestRim, -rise << unitsLog2_, 1, columns);
      bottom_[0] += below;
      bottom_[crossing.last] -= 2 * below;
    }
    crossing.flip = -2 * below;
    if (crossing.first < crossing.last) {
      startStepping(crossing, atWestRim + crossing.first * (rise << unitsLog2_), width, rise);
    }
  }

  /// Sets position and increment; `start` is U at the first active column, 0 <= start < width * kFaultUnits.
  void startStepping(Crossing& crossing, std::int64_t start, std::int64_t width, std::int64_t rise) {
    const std::int64_t whole = start / width;
    const std::int64_t part = ((start - whole * width) << kFractionBits) / width;
    const std::int64_t units = (whole << kFractionBits) + part;
    crossing.position =
        static_cast<std::uint64_t>(units >> unitsLog2_) + 1 + (std::uint64_t{1} << kFractionBits);
    const std::int64_t slope = ((rise < 0 ? -rise : rise) << kFractionBits) / width;
    crossing.increment = static_cast<std::uint64_t>(rise < 0 ? -slope : slope + 1);
  }

  /// Columns west of a line that runs north lie left of it, east of a line that runs south likewise.
  void addVerticalLine(const FaultLine& line, std::int64_t dy) {
    const bool north = dy > 0;
    const std::uint32_t west = static_cast<std::uint32_t>(north ? line.left : -line.left);
    bottom_[0] += west;
    const int beyond =
        countBelow(0, std::int64_t{1} << unitsLog2_, line.ax + (north ? 0 : 1), out_.columns());
    bottom_[beyond] -= 2 * west;
  }

  void markCrossings() {
    const int end = std::min(faults_, marked_ + kCrossingsPerUnit);
    for (; marked_ < end; ++marked_) {
      Crossing& crossing = crossings_[marked_];
      const int first = std::max(crossing.first - column_, 0);
      const int last = std::min(crossing.last - column_, kTile);
      if (first >= last) continue;
      std::uint64_t position = crossing.position;
      std::uint32_t* const marks = tile_.data();
      for (int column = first; column < last; ++column) {
        marks[(position >> kFractionBits) * kTile + column] += crossing.flip;
        position += crossing.increment;
      }
      crossing.position = position;
    }
  }

  void sumTile() {
    const int width = std::min(kTile, out_.columns() - column_);
    if (width == kTile) {
      sumColumns<kTile>();
    } else {
      for (int column = 0; column < width; ++column) sumColumns<1>(column);
    }
  }

  /// Sums `count` columns of the tile from `first` on.
  template <int count>
  void sumColumns(int first = 0) {
    std::uint32_t sums[count];
    std::copy_n(bottom_.data() + column_ + first, count, sums);
    std::uint32_t* marks = tile_.data() + first;
    for (int row = 0; row < out_.rows(); ++row, marks += kTile) {
      float* const heights = out_.row(row) + column_ + first;
      for (int column = 0; column < count; ++column) {
        sums[column] += marks[column];
        marks[column] = 0;
        heights[column] = static_cast<float>(metresPerStep_ * static_cast<std::int32_t>(sums[column]));
      }
    }
  }

  RandomSequence random_;
  int faults_;
  double metresPerStep_;
  int unitsLog2_;  // of the units between two samples
  HeightView out_;
  std::vector<Crossing> crossings_;
  std::vector<std::uint32_t> bottom_;  // sums of the bottom row; while lines are drawn, their changes
  std::vector<std::uint32_t> tile_;    // all 0 between tiles
  int drawn_ = 0;                      // lines drawn so far
  int marked_ = 0;                     // crossings marked in this tile so far
  int column_ = 0;                     // the tile's first
};

/// A map that is its centre alone.
class CentreTask final : public SlicedTask {
 public:
  CentreTask(int faults, double metresPerStep, std::uint64_t seed, HeightView out)
      : random_(seed), next_(faults), metresPerStep_(metresPerStep), out_(out) {}

  bool step(const Slice& slice) override {
    do {
      const int end = std::max(0, next_ - kLinesPerUnit);
      for (; next_ > end; --next_) {
        sum_ += drawFaultLine(random_, next_).move(kFaultUnits / 2, kFaultUnits / 2);
      }
      if (next_ == 0) {
        out_(0, 0) = static_cast<float>(metresPerStep_ * sum_);
        return true;
      }
    } while (!slice.over());
    return false;
  }

 private:
  RandomSequence random_;
  int next_;  // step of the next fault
  double metresPerStep_;
  HeightView out_;
  std::int32_t sum_ = 0;
};

double standardDeviationOfSum(int faults) noexcept {
  const std::int64_t n = faults;
  return std::sqrt(static_cast<double>(n * (n + 1) * (2 * n + 1) / 6));
}

}  // namespace

FaultFormation::FaultFormation(int faults, double deviation)
    : faults_(faults), deviation_(deviation), metresPerStep_(deviation / standardDeviationOfSum(faults)) {
  assert(1 <= faults && faults <= kMaxFaults);
  assert(std::isfinite(deviation) && deviation >= 0.0);
}

HeightRange FaultFormation::range() const noexcept {
  const std::int64_t n = faults_;
  const double largest = static_cast<float>(metresPerStep_ * static_cast<double>(n * (n + 1) / 2));
  return {.mean = 0.0, .deviation = deviation_, .min = -largest, .max = largest};
}

/// The terms of the sum are independent, so the squared residual is deviation^2 times E (sigma - I sigma)^2,
/// averaged over the samples: sigma = +-1 is the side of a random line, I the interpolation over the level's
/// triangles. Take the lines as uniform in direction and place, which they are but for the rims. Then
/// (Crofton) a line separates two points with a probability proportional to their distance, averaged over
/// the square kSeparation per side; and for a point P of a triangle with corners 1, 2, 3, weights w1, w2, w3,
///   a line cuts 1 off from P, 2 and 3 with probability kSeparation / 2 (|12| + |13| - |P2| - |P3|): error 2
///   w1, it cuts 1 and P off from 2 and 3 with probability kSeparation / 2 (|P2| + |P3| - |23|): error 2 (1 -
///   w1),
/// and likewise for 2 and 3. The average over the samples of a quad of side 1 is (2 + sqrt 2) / 4 at level 1,
/// where P is only ever the middle of an edge, 0.931 at level 2 and 0.934 +- 0.001 beyond.
double FaultFormation::residual(int level, int samples) const noexcept {
  assert(level >= 0 && samples >= 1);
  constexpr double kMeanDistance = 0.5214054331647207;  // of two random points in a square of side 1
  constexpr double kSeparation = 4.0 * kMeanDistance / 3.141592653589793;  // 2 / pi times the mean chord
  constexpr double kMeanDistanceToCentre = 0.3825978582321191;
  if (level == 0) return 0.0;
  const int intervals = level < 31 ? (samples - 1) >> level : 0;
  if (intervals < 2) return deviation_ * std::sqrt(4.0 * kSeparation * kMeanDistanceToCentre);
  const double quad = level == 1 ? (2.0 + std::sqrt(2.0)) / 4.0 : 0.934;
  return deviation_ * std::sqrt(kSeparation * quad / intervals);
}

std::unique_ptr<SlicedTask> FaultFormation::begin(const MapRequest& request, HeightView out) const {
  assert(out.columns() == request.samples && out.rows() == request.samples);
  if (request.samples == 1) {
    return std::make_unique<CentreTask>(faults_, metresPerStep_, request.seed, out);
  }
  assert(std::has_single_bit(static_cast<unsigned>(request.samples - 1)));
  assert(request.samples - 1 <= kFaultUnits);
  return std::make_unique<MapTask>(faults_, metresPerStep_, request.seed, out);
}

}  // namespace teren
