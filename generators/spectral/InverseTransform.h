// From harmonics to heights: the two-dimensional inverse real Fourier transform with a power of two samples a
// side, in slices, the same bits on every processor and at every level.
#pragma once

#include <memory>
#include <vector>

#include "teren/HeightMap.h"
#include "teren/Slice.h"

namespace teren {

/// What a wave adds: re cos(angle) - im sin(angle), the real part of (re + i im) e^(i angle).
struct Harmonic {
  float re = 0.0f, im = 0.0f;
};

/// The harmonics of a map. Const; the functions may be called from any thread.
class HarmonicSource {
 public:
  virtual ~HarmonicSource() = default;

  /// The largest wave number along either axis, K >= 0.
  virtual int largest() const noexcept = 0;

  /// Writes the harmonics with l waves from south to north, 0 <= l <= K: row[K + k] for k = -K ... K waves
  /// from west to east. They must be finite. (l < 0 is not asked for: a real wave is its own opposite.)
  virtual void row(int l, Harmonic* row) const noexcept = 0;
};

/// Largest error of a height: kTransformError * scale * (the sum of the sizes of all harmonics). A harmonic
/// passes at most 24 stages and gathers less than 3.5 * 2^-24 of its size in each (sum, product, rounded
/// turn). What is measured is far less: a test asks for a twentieth.
inline constexpr double kTransformError = 5e-6;

/// Fills `out` with
///   height(x, y) = scale * sum over l = 0 ... K, k = -K ... K of the real part of
///                  harmonic(k, l) * e^(2 pi i (k x + l y) / side),
/// x, y = 0 ... out.columns() - 1. `side` is a power of two, 2 ... 4096; `out` is a square of `side` samples,
/// or of side + 1, where the last column and row repeat the first.
///
/// Rows and columns are split by parity of the *sample*, radix 2: the even samples of a transform are the
/// transform of half the side with the harmonics k and k + side / 2 added, so the map with half the side
/// equals every second sample of this one bit for bit, whatever K. Stages in which most harmonics are zero
/// touch only the others. Sixteen columns are worked on side by side, in blocks that stay in the cache;
/// between the two passes the harmonics are transposed in blocks, so no power-of-two stride is ever walked.
/// All in float, bound by loads and stores of the first-level cache; in registers of 16, 32 or 64 bytes, by
/// what the processor has, with the same bits.
///
/// Allocates when made, never in `step`: about 128 bytes * (2 side + (K + 16) * side / 16). A unit of work
/// takes 1 to 10 us up to a side of 1024.
class InverseTransform final : public SlicedTask {
 public:
  static constexpr int kLanes = 16;

  /// Sixteen complex numbers, one a lane: two cache lines.
  struct alignas(64) Cell {
    float re[kLanes];
    float im[kLanes];
  };

  /// `source` and `out` must outlive the task.
  InverseTransform(const HarmonicSource& source, int side, float scale, HeightView out);
  ~InverseTransform() override;

  bool step(const Slice& slice) override;

 private:
  enum class Phase { rows, gathering, columnStages, transposition, load, rowStages, store };

  bool unit();
  void addRow();
  void gather();
  void columnStage();
  void transpose();
  void load();
  void rowStage();
  bool store();

  const HarmonicSource& source_;
  int side_;
  float scale_;  // half of what was asked for
  HeightView out_;
  int largest_;  // K
  int start_;    // size of the first stage: side_, or the least that holds all harmonics if that is more
  int rows_;     // harmonics along y, K + 1, rounded up to whole cells
  int width_;    // start_, but at least a group of cells that are gathered at once
  std::vector<Harmonic> turns_;      // e^(2 pi i n / start_), n < start_ / 2
  std::vector<int> order_;           // where a sample lies after all stages: its bits, reversed
  std::vector<Harmonic> row_;        // what the source wrote
  std::vector<Harmonic> waves_;      // sixteen l, width_ of k each
  std::unique_ptr<Cell[]> cells_;    // one block, in work
  std::unique_ptr<Cell[]> between_;  // [block of sixteen x][l], one lane a column

  Phase phase_ = Phase::rows;
  int block_ = 0;  // of sixteen l in the first pass, of sixteen x in the second
  int next_ = 0;   // row or block of columns within the phase
  int size_ = 0;   // of the stage
};

}  // namespace teren
