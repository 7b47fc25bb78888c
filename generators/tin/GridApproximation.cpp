#include "generators/tin/GridApproximation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "generators/tin/SpatialOrder.h"

namespace teren {
namespace {

constexpr int kMaxSide = (1 << 15) + 1;

/// How many bits a sample's index is shifted to become a coordinate; -1 where the grid does not fit the
/// frame.
int shiftOf(const LatticeFrame& frame, int columns, int rows) {
  if (columns < 2 || rows < 2 || columns > kMaxSide || rows > kMaxSide) return -1;
  const std::int32_t stride = frame.width / (columns - 1);
  if (stride <= 0 || !std::has_single_bit(static_cast<std::uint32_t>(stride))) return -1;
  const bool fits =
      stride * (columns - 1) == frame.width && static_cast<std::int64_t>(stride) * (rows - 1) == frame.height;
  return fits ? std::countr_zero(static_cast<std::uint32_t>(stride)) : -1;
}

/// An integer with the bits of a number; those of numbers >= 0 order as the numbers do.
template <class Real>
using Bits = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;

/// Four numbers at once, in whatever registers there are: the results do not depend on them.
template <class Real>
struct Four {
  typedef Real Numbers __attribute__((vector_size(4 * sizeof(Real))));
  typedef Bits<Real> Places __attribute__((vector_size(4 * sizeof(Real))));
};

/// The grid's samples with room behind each row, so that four may be read wherever one is.
class PaddedGrid {
 public:
  explicit PaddedGrid(ConstHeightView grid) : stride_(grid.columns() + 3) {
    samples_.resize(static_cast<std::size_t>(stride_) * grid.rows());
    for (int y = 0; y < grid.rows(); ++y) std::copy_n(grid.row(y), grid.columns(), &samples_[index(0, y)]);
  }
  const float* at(std::int32_t x, std::int32_t y) const noexcept { return &samples_[index(x, y)]; }

 private:
  std::size_t index(std::int32_t x, std::int32_t y) const noexcept {
    return static_cast<std::size_t>(y) * stride_ + static_cast<std::size_t>(x);
  }

  std::size_t stride_;
  std::vector<float> samples_;
};

/// A sample of a triangle and its vertical distance from it.
template <class Real>
struct Candidate {
  Real error = 0;
  std::int32_t column = 0;
  std::int32_t row = 0;
};

/// The largest |sample - height| so far, in each of four lanes, and where it was.
template <class Real>
class WorstOfLanes {
 public:
  using Numbers = typename Four<Real>::Numbers;
  using Places = typename Four<Real>::Places;

  /// One row: `count` samples against start, start + slope, ...
  void addRow(const float* samples, std::int32_t count, Real start, Real slope, std::int32_t x,
              std::int32_t y) noexcept {
    const Numbers first = start + lanes_ * slope;
    if (count >= kLong && !isBeaten(samples, count & ~3, first, slope)) {
      const std::int32_t done = count & ~3;
      return addPart(samples, done, count, first, slope, x, y);
    }
    addPart(samples, 0, count, first, slope, x, y);
  }

  /// Of equal ones the first, rows from south.
  Candidate<Real> worst() const noexcept {
    int best = 0;
    for (int lane = 1; lane < 4; ++lane) {
      const bool tie = worst_[lane] == worst_[best] && where_[lane] < where_[best];
      if (worst_[lane] > worst_[best] || tie) best = lane;
    }
    const auto where = static_cast<std::int32_t>(where_[best]);
    return {worst_[best], where & 0xffff, where >> 16};
  }

 private:
  static constexpr std::int32_t kLong = 16;

  /// |samples - heights|; both in place, for passing four doubles by value depends on the processor.
  static void distance(const float* samples, Numbers& heights) noexcept {
    typename Four<float>::Numbers four;
    std::memcpy(&four, samples, sizeof four);
    const Numbers difference = __builtin_convertvector(four, Numbers) - heights;
    heights = (Numbers)((Places)difference & std::numeric_limits<Bits<Real>>::max());  // without its sign
  }
  /// True where a row, whose length is a multiple of four, holds something worse than any lane has; a quick
  /// look.
  bool isBeaten(const float* samples, std::int32_t count, const Numbers& first, Real slope) const noexcept {
    Numbers largest = worst_;
    for (std::int32_t i = 0; i < count; i += 4) {
      Numbers error = first + static_cast<Real>(i) * slope;
      distance(samples + i, error);
      largest = error > largest ? error : largest;
    }
    const Places more = largest > worst_;
    return (more[0] | more[1] | more[2] | more[3]) != 0;
  }
  void addPart(const float* samples, std::int32_t from, std::int32_t count, const Numbers& first, Real slope,
               std::int32_t x, std::int32_t y) noexcept {
    for (std::int32_t i = from; i < count; i += 4) {
      Numbers error = first + static_cast<Real>(i) * slope;
      distance(samples + i, error);
      const Places place = places_ + ((static_cast<Bits<Real>>(y) << 16) + x + i);
      const Places worse = (error > worst_) & (places_ < static_cast<Bits<Real>>(count - i));
      worst_ = worse ? error : worst_;
      where_ = worse ? place : where_;
    }
  }

  Numbers lanes_{0, 1, 2, 3};
  Places places_{0, 1, 2, 3};
  Numbers worst_{};
  Places where_{};
};

/// A grid point and its height.
struct Corner {
  std::int32_t x;
  std::int32_t y;
  double z;
};

/// The sample of a triangle that is farthest from it, borders included. Rows are walked from the left side to
/// the right one, whose columns are computed in double: 2^-20 is less than the distance from a whole number
/// of any quotient that is none, and more than rounding. So is the height at the left side, for in a sliver
/// the slopes are steep; along a row the height stays between those of the corners.
template <class Real>
Candidate<Real> worstIn(std::array<Corner, 3> corner, const PaddedGrid& grid) noexcept {
  const auto [a, b, c] = corner;
  const double scale =
      1.0 / (static_cast<double>(b.x - a.x) * (c.y - a.y) - static_cast<double>(b.y - a.y) * (c.x - a.x));
  const double east = ((b.z - a.z) * (c.y - a.y) - (c.z - a.z) * (b.y - a.y)) * scale;
  const double north = ((c.z - a.z) * (b.x - a.x) - (b.z - a.z) * (c.x - a.x)) * scale;

  if (corner[1].y < corner[0].y) std::swap(corner[0], corner[1]);
  if (corner[2].y < corner[1].y) std::swap(corner[1], corner[2]);
  if (corner[1].y < corner[0].y) std::swap(corner[0], corner[1]);
  const auto [low, middle, high] = corner;
  const auto slant = [](const Corner& p, const Corner& q) {
    return p.y == q.y ? 0.0 : static_cast<double>(q.x - p.x) / (q.y - p.y);
  };
  const double whole = slant(low, high), lower = slant(low, middle), upper = slant(middle, high);
  WorstOfLanes<Real> worst;
  for (std::int32_t y = low.y; y <= high.y; ++y) {
    const double one = low.x + (y - low.y) * whole;
    const double other = y < middle.y ? low.x + (y - low.y) * lower : middle.x + (y - middle.y) * upper;
    const auto first = static_cast<std::int32_t>(std::min(one, other) + (1.0 - 0x1p-20));
    const auto last = static_cast<std::int32_t>(std::max(one, other) + 0x1p-20);
    const double start = a.z + ((first - a.x) * east + (y - a.y) * north);
    worst.addRow(grid.at(first, y), last - first + 1, static_cast<Real>(start), static_cast<Real>(east),
                 first, y);
  }
  return worst.worst();
}

/// Greedy insertion into one mesh. Real: float where its rounding is small beside the error, else double.
///
/// Triangles wait in classes of about equal errors, two to a doubling, and within the worst class they are
/// taken tile by tile along a curve instead of worst first: latency bounds the work, and so it finds its
/// surroundings in the cache. That costs up to a hundredth more triangles and saves more than half of the
/// time.
template <class Real>
class GreedyInsertion {
 public:
  GreedyInsertion(ConstHeightView grid, Triangulation& mesh, int shift, Real limit)
      : grid_(grid), mesh_(mesh), shift_(shift), limit_(limit) {
    while ((std::max(grid.columns(), grid.rows()) - 1) >> tileShift_ >= kTiles) ++tileShift_;
    for (int y = 0; y < kTiles; ++y) {
      for (int x = 0; x < kTiles; ++x) {
        tileOrder_[y * kTiles + x] =
            static_cast<std::uint16_t>(hilbertPlace({x, y}, kTileBits) >> (32 - 2 * kTileBits));
      }
    }
  }

  void run() {
    for (TriangleId t = 0; t < mesh_.triangleSlots(); ++t) scan(t);
    while (!waiting_.empty()) {
      if (waiting_.back().empty()) {
        waiting_.pop_back();
        continue;
      }
      const std::size_t worstClass = waiting_.size() - 1;
      takeInTileOrder(worstClass);
      for (const TriangleId t : taken_) {
        if (classOf(worst_[t].error) == worstClass) insertWorstOf(t);  // else it has changed since
      }
    }
  }

 private:
  static constexpr int kTileBits = 6;
  static constexpr int kTiles = 1 << kTileBits;
  static constexpr int kClassShift = sizeof(Real) == 4 ? 22 : 51;  // leaves one bit of the fraction

  /// Only for errors above the limit; 0 for all others.
  std::size_t classOf(Real error) const noexcept {
    if (error <= limit_) return 0;
    return static_cast<std::size_t>((std::bit_cast<Bits<Real>>(error) >> kClassShift) -
                                    (std::bit_cast<Bits<Real>>(limit_) >> kClassShift)) +
           1;
  }

  std::size_t tileOf(TriangleId t) const noexcept {
    return tileOrder_[(worst_[t].row >> tileShift_) * kTiles + (worst_[t].column >> tileShift_)];
  }

  /// Moves a class to taken_ (counting sort).
  void takeInTileOrder(std::size_t which) {
    std::vector<TriangleId>& from = waiting_[which];
    std::array<std::uint32_t, kTiles * kTiles + 1> start{};
    for (const TriangleId t : from) ++start[tileOf(t) + 1];
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    taken_.resize(from.size());
    for (const TriangleId t : from) taken_[start[tileOf(t)]++] = t;
    from.clear();
  }

  void insertWorstOf(TriangleId t) {
    const Candidate<Real> worst = worst_[t];
    const LatticePoint p{worst.column << shift_, worst.row << shift_};
    const Insertion insertion = mesh_.insert(p, *grid_.at(worst.column, worst.row), t);
    assert(insertion.isNew);
    mesh_.forEachCorner(insertion.vertex, [this](Link at) { scan(at.triangle()); });
  }

  void scan(TriangleId t) {
    if (worst_.size() <= t) worst_.resize(mesh_.triangleSlots());
    std::array<Corner, 3> corner{};
    for (int i = 0; i < 3; ++i) {
      const LatticePoint p = mesh_.point(mesh_.corners(t)[i]);
      corner[i] = {p.x >> shift_, p.y >> shift_, 0.0};
      corner[i].z = *grid_.at(corner[i].x, corner[i].y);
    }
    worst_[t] = worstIn<Real>(corner, grid_);
    const std::size_t which = classOf(worst_[t].error);
    if (which == 0) return;
    if (waiting_.size() <= which) waiting_.resize(which + 1);
    waiting_[which].push_back(t);
  }

  PaddedGrid grid_;
  Triangulation& mesh_;
  int shift_;
  Real limit_;
  int tileShift_ = 0;
  std::array<std::uint16_t, kTiles * kTiles> tileOrder_{};
  std::vector<Candidate<Real>> worst_;            // by triangle
  std::vector<std::vector<TriangleId>> waiting_;  // by class; outdated entries stay and are passed over
  std::vector<TriangleId> taken_;
};

/// Along all four sides, once around.
void insertBorder(ConstHeightView grid, Triangulation& mesh, int shift) {
  const std::int32_t east = grid.columns() - 1, north = grid.rows() - 1;
  TriangleId near = kNoTriangle;
  const auto insert = [&](std::int32_t x, std::int32_t y) {
    near = mesh.triangleAt(mesh.insert({x << shift, y << shift}, grid(x, y), near).vertex);
  };
  for (std::int32_t x = 1; x < east; ++x) insert(x, 0);
  for (std::int32_t y = 1; y < north; ++y) insert(east, y);
  for (std::int32_t x = east - 1; x > 0; --x) insert(x, north);
  for (std::int32_t y = north - 1; y > 0; --y) insert(0, y);
}

}  // namespace

Result<Triangulation> approximateGrid(ConstHeightView grid, const LatticeFrame& frame, double maxError,
                                      GridBorder border) {
  const int columns = grid.columns(), rows = grid.rows();
  const int shift = shiftOf(frame, columns, rows);
  if (shift < 0) {
    return Error{"a grid of " + std::to_string(columns) + " x " + std::to_string(rows) +
                 " samples does not fit a mesh of " + std::to_string(frame.width) + " x " +
                 std::to_string(frame.height) + " steps"};
  }
  if (!(maxError >= 0.0 && std::isfinite(maxError))) {
    return Error{"the error of a mesh must be a finite number >= 0, not " + std::to_string(maxError)};
  }
  float largest = 0.0f;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      if (!std::isfinite(grid(x, y))) {
        return Error{"the height of sample (" + std::to_string(x) + ", " + std::to_string(y) +
                     ") is not finite"};
      }
      largest = std::max(largest, std::fabs(grid(x, y)));
    }
  }
  Triangulation mesh(frame);
  for (VertexId v = 0; v < 4; ++v) {
    mesh.setHeight(v, grid(mesh.point(v).x >> shift, mesh.point(v).y >> shift));
  }
  if (border == GridBorder::all) insertBorder(grid, mesh, shift);
  // What rounding adds to a distance: a few ulp of the largest height.
  const double ofFloat = 0x1p-21 * largest, ofDouble = 0x1p-49 * largest;
  if (maxError > 64.0 * ofFloat) {
    GreedyInsertion<float>(grid, mesh, shift, static_cast<float>(maxError - ofFloat)).run();
  } else {
    GreedyInsertion<double>(grid, mesh, shift, std::max(maxError - ofDouble, ofDouble)).run();
  }
  return mesh;
}

namespace {

/// visit(column, row, height) for every sample of a grid that fits the mesh, row by row.
template <class Visitor>
void forEachSample(const Triangulation& mesh, int columns, int rows, Visitor&& visit) {
  const int shift = shiftOf(mesh.frame(), columns, rows);
  assert(shift >= 0);
  TriangleId near = kNoTriangle;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const LatticePoint p{x << shift, y << shift};
      const Location place = mesh.locate(p, near);
      near = place.triangle;
      visit(x, y, mesh.heightAt(p, place));
    }
  }
}

}  // namespace

void sampleGrid(const Triangulation& mesh, HeightView out) {
  forEachSample(mesh, out.columns(), out.rows(),
                [&](int x, int y, double height) { out(x, y) = static_cast<float>(height); });
}

double worstErrorAtSamples(const Triangulation& mesh, ConstHeightView grid) {
  double worst = 0.0;
  forEachSample(mesh, grid.columns(), grid.rows(), [&](int x, int y, double height) {
    worst = std::max(worst, std::fabs(grid(x, y) - height));
  });
  return worst;
}

}  // namespace teren
