#include "generators/spectral/InverseTransform.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>

#include "generators/numbers/Turn.h"

namespace teren {
namespace {

using Cell = InverseTransform::Cell;
constexpr int kLanes = 16;

/// Four floats that compilers keep in a register; all arithmetic is lane by lane, so bits do not depend on
/// how wide the registers are.
typedef float Vector __attribute__((vector_size(16), may_alias));
constexpr int kVector = sizeof(Vector) / sizeof(float);

#define TEREN_ALWAYS_INLINE [[gnu::always_inline]] inline

TEREN_ALWAYS_INLINE Vector& vectorAt(float* lanes) {
  return *reinterpret_cast<Vector*>(lanes);
}

/// to = from * turn; the two may be the same cell.
TEREN_ALWAYS_INLINE void turned(Cell& from, Harmonic turn, Cell& to) {
  for (int lane = 0; lane < kLanes; lane += kVector) {
    const Vector re = vectorAt(from.re + lane), im = vectorAt(from.im + lane);
    vectorAt(to.re + lane) = re * turn.re - im * turn.im;
    vectorAt(to.im + lane) = re * turn.im + im * turn.re;
  }
}

/// a, b = a + b, (a - b) * turn
TEREN_ALWAYS_INLINE void butterfly(Cell& a, Cell& b, Harmonic turn) {
  for (int lane = 0; lane < kLanes; lane += kVector) {
    const Vector aRe = vectorAt(a.re + lane), aIm = vectorAt(a.im + lane);
    const Vector bRe = vectorAt(b.re + lane), bIm = vectorAt(b.im + lane);
    vectorAt(a.re + lane) = aRe + bRe;
    vectorAt(a.im + lane) = aIm + bIm;
    const Vector re = aRe - bRe, im = aIm - bIm;
    vectorAt(b.re + lane) = re * turn.re - im * turn.im;
    vectorAt(b.im + lane) = re * turn.im + im * turn.re;
  }
}

/// a, b = a + b, a - b
TEREN_ALWAYS_INLINE void butterfly(Cell& a, Cell& b) {
  for (int lane = 0; lane < kLanes; lane += kVector) {
    const Vector aRe = vectorAt(a.re + lane), aIm = vectorAt(a.im + lane);
    const Vector bRe = vectorAt(b.re + lane), bIm = vectorAt(b.im + lane);
    vectorAt(a.re + lane) = aRe + bRe;
    vectorAt(a.im + lane) = aIm + bIm;
    vectorAt(b.re + lane) = aRe - bRe;
    vectorAt(b.im + lane) = aIm - bIm;
  }
}

/// even, odd = a + conj b, (a - conj b) * turn; even and odd may be a and b or other cells.
TEREN_ALWAYS_INLINE void conjugateButterfly(Cell& a, Cell& b, int lane, Harmonic turn, Vector& evenRe,
                                            Vector& evenIm, Vector& oddRe, Vector& oddIm) {
  const Vector aRe = vectorAt(a.re + lane), aIm = vectorAt(a.im + lane);
  const Vector bRe = vectorAt(b.re + lane), bIm = vectorAt(b.im + lane);
  evenRe = aRe + bRe;
  evenIm = aIm - bIm;
  const Vector re = aRe - bRe, im = aIm + bIm;
  oddRe = re * turn.re - im * turn.im;
  oddIm = re * turn.im + im * turn.re;
}

/// One stage of complex transforms of `size` cells, all those of cells[0 ... count). Harmonics beyond
/// +-largest are zero where that says anything. `stride` leads from turn to turn.
void complexStage(Cell* cells, int count, int size, int largest, const Harmonic* turns, int stride) {
  const int half = size / 2;
  for (Cell* even = cells; even < cells + count; even += size) {
    Cell* const odd = even + half;
    if (4 * largest < size) {
      odd[0] = even[0];
      for (int k = 1; k <= largest; ++k) {
        const Harmonic turn = turns[k * stride];
        turned(even[k], turn, odd[k]);
        even[half - k] = odd[half - k];
        turned(odd[half - k], {turn.re, -turn.im}, odd[half - k]);
      }
    } else {
      butterfly(even[0], odd[0]);
      for (int k = 1; k < half; ++k) butterfly(even[k], odd[k], turns[k * stride]);
    }
  }
}

/// The even half of a complex stage alone.
void complexFold(Cell* cells, int size) {
  float* const even = cells->re;
  const float* const odd = cells[size / 2].re;
  for (int n = 0; n < size / 2 * 2 * kLanes; ++n) even[n] += odd[n];
}

/// The harmonics 0 ... size / 2 of a real transform lie in size / 2 cells; those at 0 and size / 2 are real
/// and share the first, as its two parts.
void realEnds(Cell& first, Cell& middle) {
  for (int lane = 0; lane < kLanes; ++lane) {
    const float a = first.re[lane], b = first.im[lane];
    const float re = middle.re[lane], im = middle.im[lane];
    first.re[lane] = a + b;
    first.im[lane] = re + re;
    middle.re[lane] = a - b;
    middle.im[lane] = -(im + im);
  }
}

/// Harmonics k and half - k of a real transform become k of its even and odd transform, and with them those
/// at quarter - k and quarter + k, which share their cells; k < quarter - k.
TEREN_ALWAYS_INLINE void realQuad(Cell* cells, int quarter, int k, Harmonic turn, Harmonic opposite) {
  Cell &a = cells[k], &b = cells[2 * quarter - k], &c = cells[quarter - k], &d = cells[quarter + k];
  for (int lane = 0; lane < kLanes; lane += kVector) {
    Vector evenRe, evenIm, oddRe, oddIm, evenRe2, evenIm2, oddRe2, oddIm2;
    conjugateButterfly(a, b, lane, turn, evenRe, evenIm, oddRe, oddIm);
    conjugateButterfly(c, d, lane, opposite, evenRe2, evenIm2, oddRe2, oddIm2);
    vectorAt(a.re + lane) = evenRe;
    vectorAt(a.im + lane) = evenIm;
    vectorAt(d.re + lane) = oddRe;
    vectorAt(d.im + lane) = oddIm;
    vectorAt(c.re + lane) = evenRe2;
    vectorAt(c.im + lane) = evenIm2;
    vectorAt(b.re + lane) = oddRe2;
    vectorAt(b.im + lane) = oddIm2;
  }
}

/// One stage of real transforms of `size` samples, size >= 4, all those of cells[0 ... count).
void realStage(Cell* cells, int count, int size, int largest, const Harmonic* turns, int stride) {
  const int quarter = size / 4;
  for (Cell* even = cells; even < cells + count; even += 2 * quarter) {
    Cell* const odd = even + quarter;
    if (largest < quarter) {
      odd[0] = even[0];
      for (int k = 1; k <= largest; ++k) turned(even[k], turns[k * stride], odd[k]);
      continue;
    }
    realEnds(even[0], odd[0]);
    int k = 1;
    for (; k < quarter - k; ++k) {
      realQuad(even, quarter, k, turns[k * stride], turns[(quarter - k) * stride]);
    }
    if (2 * k != quarter) continue;
    const Harmonic turn = turns[k * stride];
    for (int lane = 0; lane < kLanes; lane += kVector) {
      Vector evenRe, evenIm, oddRe, oddIm;
      conjugateButterfly(even[k], odd[k], lane, turn, evenRe, evenIm, oddRe, oddIm);
      vectorAt(even[k].re + lane) = evenRe;
      vectorAt(even[k].im + lane) = evenIm;
      vectorAt(odd[k].re + lane) = oddRe;
      vectorAt(odd[k].im + lane) = oddIm;
    }
  }
}

/// The even half of a real stage alone, in the same operations.
void realFold(Cell* cells, int size) {
  const int quarter = size / 4;
  realEnds(cells[0], cells[quarter]);
  for (int k = 1; k < quarter; ++k) {
    const Cell& opposite = cells[2 * quarter - k];
    for (int lane = 0; lane < kLanes; ++lane) {
      cells[k].re[lane] += opposite.re[lane];
      cells[k].im[lane] -= opposite.im[lane];
    }
  }
}

/// The last stage of a real transform. Inlined, so that a constant width needs no loop.
TEREN_ALWAYS_INLINE void storeLanes(const Cell& cell, int width, float scale, float* south, float* north) {
  float sums[kLanes], differences[kLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    sums[lane] = scale * (cell.re[lane] + cell.im[lane]);
    differences[lane] = scale * (cell.re[lane] - cell.im[lane]);
  }
  std::copy_n(sums, width, south);
  std::copy_n(differences, width, north);
}

/// to[column].lane(row) = rows[row][column]; four at a time.
void transposed(const float* const rows[kLanes], float* to, std::ptrdiff_t stride) {
  for (int column = 0; column < kLanes; column += 4) {
    for (int row = 0; row < kLanes; row += 4) {
      const auto source = [&](int n) { return *reinterpret_cast<const Vector*>(rows[row + n] + column); };
      const Vector a = source(0), b = source(1), c = source(2), d = source(3);
      const Vector ab = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                   ab2 = __builtin_shufflevector(a, b, 2, 6, 3, 7);
      const Vector cd = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                   cd2 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
      float* const target = to + column * stride + row;
      vectorAt(target) = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
      vectorAt(target + stride) = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
      vectorAt(target + 2 * stride) = __builtin_shufflevector(ab2, cd2, 0, 1, 4, 5);
      vectorAt(target + 3 * stride) = __builtin_shufflevector(ab2, cd2, 2, 3, 6, 7);
    }
  }
}

/// The least power of two that tells all harmonics -largest ... largest apart.
int leastSide(int largest) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(2 * largest + 1)));
}

}  // namespace

InverseTransform::InverseTransform(const HarmonicSource& source, int side, float scale, HeightView out)
    : source_(source),
      side_(side),
      scale_(0.5f * scale),
      out_(out),
      largest_(source.largest()),
      start_(std::max(side, leastSide(largest_))),
      rows_((largest_ + kLanes) / kLanes * kLanes),
      width_(std::max(start_, kLanes / 2)),
      turns_(static_cast<std::size_t>(start_ / 2)),
      order_(static_cast<std::size_t>(side)),
      row_(static_cast<std::size_t>(2 * largest_ + 1)),
      waves_(static_cast<std::size_t>(kLanes * width_)),
      cells_(std::make_unique_for_overwrite<Cell[]>(static_cast<std::size_t>(width_))),
      between_(std::make_unique_for_overwrite<Cell[]>(static_cast<std::size_t>(rows_) *
                                                      ((side + kLanes - 1) / kLanes))) {
  assert(std::has_single_bit(static_cast<unsigned>(side)) && 2 <= side && side <= 4096 && largest_ >= 0);
  assert(out.columns() == out.rows() && (out.columns() == side || out.columns() == side + 1));
  for (int n = 0; n < start_ / 2; ++n) {
    const SineCosine turn = sineCosineOfTurn(static_cast<double>(n) / start_);
    turns_[n] = {static_cast<float>(turn.cosine), static_cast<float>(turn.sine)};
  }
  for (int n = 1; n < side; ++n) order_[n] = order_[n / 2] / 2 + (n % 2) * (side / 2);
}

InverseTransform::~InverseTransform() = default;

bool InverseTransform::step(const Slice& slice) {
  do {
    if (unit()) return true;
  } while (!slice.over());
  return false;
}

bool InverseTransform::unit() {
  switch (phase_) {
    case Phase::rows:
      addRow();
      return false;
    case Phase::gathering:
      gather();
      return false;
    case Phase::columnStages:
      columnStage();
      return false;
    case Phase::transposition:
      transpose();
      return false;
    case Phase::load:
      load();
      return false;
    case Phase::rowStages:
      rowStage();
      return false;
    case Phase::store:
      return store();
  }
  return true;
}

/// Puts the harmonics of one l where its lane will be, those with k < 0 at the end. After the last of the
/// block, lanes take the place of rows.
void InverseTransform::addRow() {
  Harmonic* const wave = waves_.data() + next_ * width_;
  const int l = block_ * kLanes + next_;
  if (l <= largest_) {
    source_.row(l, row_.data());
    std::copy_n(row_.data() + largest_, largest_ + 1, wave);
    std::copy_n(row_.data(), largest_, wave + start_ - largest_);
  } else {
    std::fill_n(wave, width_, Harmonic{});
  }
  if (++next_ < kLanes) return;
  next_ = 0;
  phase_ = Phase::gathering;
}

void InverseTransform::gather() {
  constexpr int kGroup = kLanes / 2;  // as many harmonics as fill sixteen floats
  constexpr int kGroupsPerUnit = 32;
  for (const int end = std::min(width_, next_ + kGroupsPerUnit * kGroup); next_ < end; next_ += kGroup) {
    if (next_ > largest_ && next_ + kGroup <= start_ - largest_) {
      std::fill_n(cells_.get() + next_, kGroup, Cell{});
      continue;
    }
    const float* rows[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) rows[lane] = &waves_[lane * width_ + next_].re;
    transposed(rows, cells_[next_].re, kLanes);
  }
  if (next_ < width_) return;
  next_ = 0;
  size_ = start_;
  phase_ = Phase::columnStages;
}

void InverseTransform::columnStage() {
  if (size_ > side_) {
    complexFold(cells_.get(), size_);
  } else {
    complexStage(cells_.get(), side_, size_, largest_, turns_.data(), start_ / size_);
  }
  size_ /= 2;
  if (size_ == 1) phase_ = Phase::transposition;
}

/// Turns lanes of l into lanes of x, sixteen by sixteen.
void InverseTransform::transpose() {
  constexpr int kBlocksPerUnit = 4;
  const int blocks = (side_ + kLanes - 1) / kLanes;
  for (const int end = std::min(blocks, next_ + kBlocksPerUnit); next_ < end; ++next_) {
    const float* rows[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
      rows[lane] = cells_[order_[std::min(next_ * kLanes + lane, side_ - 1)]].re;
    }
    Cell* const to = between_.get() + static_cast<std::ptrdiff_t>(next_) * rows_ + block_ * kLanes;
    transposed(rows, to->re, 2 * kLanes);
    for (const float*& row : rows) row += kLanes;
    transposed(rows, to->im, 2 * kLanes);
  }
  if (next_ < blocks) return;
  next_ = 0;
  ++block_;
  phase_ = Phase::rows;
  if (block_ * kLanes <= largest_) return;
  block_ = 0;
  phase_ = Phase::load;
}

void InverseTransform::load() {
  const Cell* const from = between_.get() + static_cast<std::ptrdiff_t>(block_) * rows_;
  std::copy_n(from, largest_ + 1, cells_.get());
  std::fill(cells_.get() + largest_ + 1, cells_.get() + start_ / 2, Cell{});
  // Of the harmonics without waves from south to north only the real part counts, and, as real transforms
  // count all others twice, it counts twice too; the last multiplication halves all.
  for (float& re : cells_[0].re) re += re;
  std::fill_n(cells_[0].im, kLanes, 0.0f);
  size_ = start_;
  phase_ = size_ > 2 ? Phase::rowStages : Phase::store;
}

void InverseTransform::rowStage() {
  if (size_ > side_) {
    realFold(cells_.get(), size_);
  } else {
    realStage(cells_.get(), side_ / 2, size_, largest_, turns_.data(), start_ / size_);
  }
  size_ /= 2;
  if (size_ == 2) phase_ = Phase::store;
}

/// The last stage, straight into the map. Returns true when the map is complete.
bool InverseTransform::store() {
  const int first = block_ * kLanes;
  const int width = std::min(kLanes, side_ - first);
  const bool closed = out_.columns() > side_;
  for (int n = 0; n < side_ / 2; ++n) {
    float* const south = out_.row(order_[2 * n]) + first;
    float* const north = out_.row(order_[2 * n + 1]) + first;
    if (width == kLanes) {
      storeLanes(cells_[n], kLanes, scale_, south, north);
    } else {
      storeLanes(cells_[n], width, scale_, south, north);
    }
    if (closed && first == 0) {
      south[side_] = south[0];
      north[side_] = north[0];
    }
  }
  ++block_;
  phase_ = Phase::load;
  if (block_ * kLanes < side_) return false;
  if (closed) std::copy_n(out_.row(0), out_.columns(), out_.row(side_));
  return true;
}

}  // namespace teren
