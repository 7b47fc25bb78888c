#include "generators/spectral/InverseTransform.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>

#include "generators/numbers/Turn.h"

namespace teren {
namespace {

using Cell = InverseTransform::Cell;
constexpr int kLanes = InverseTransform::kLanes;

#define TEREN_ALWAYS_INLINE [[gnu::always_inline]] inline

/// What differs between processors: the width of their registers, and nothing else.
struct Stages {
  void (*complexStage)(Cell* cells, int count, int size, int largest, const Harmonic* turns, int stride);
  void (*complexFold)(Cell* cells, int size);
  void (*realStage)(Cell* cells, int count, int size, int largest, const Harmonic* turns, int stride);
  void (*realFold)(Cell* cells, int size);
};

// The function that knows the processor must not be compiled for a better one, nor anything of the standard
// library: so the stages, which call nothing, are compiled in namespaces of their own within one file.
#define TEREN_VECTOR_BYTES 16
namespace narrow {
#include "generators/spectral/Stages.h"
}
#undef TEREN_VECTOR_BYTES
#if defined(__x86_64__)
#pragma GCC push_options
#pragma GCC target("avx2")
#define TEREN_VECTOR_BYTES 32
namespace wide {
#include "generators/spectral/Stages.h"
}
#undef TEREN_VECTOR_BYTES
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f")
#define TEREN_VECTOR_BYTES 64
namespace widest {
#include "generators/spectral/Stages.h"
}
#undef TEREN_VECTOR_BYTES
#pragma GCC pop_options
#endif

const Stages& stagesOfThisProcessor() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return widest::kStages;
  if (__builtin_cpu_supports("avx2")) return wide::kStages;
#endif
  return narrow::kStages;
}

using narrow::Vector;
using narrow::vectorAt;

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
  static const Stages& stages = stagesOfThisProcessor();
  if (size_ > side_) {
    stages.complexFold(cells_.get(), size_);
  } else {
    stages.complexStage(cells_.get(), side_, size_, largest_, turns_.data(), start_ / size_);
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
  static const Stages& stages = stagesOfThisProcessor();
  if (size_ > side_) {
    stages.realFold(cells_.get(), size_);
  } else {
    stages.realStage(cells_.get(), side_ / 2, size_, largest_, turns_.data(), start_ / size_);
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
