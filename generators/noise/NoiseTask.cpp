#include "generators/noise/NoiseTask.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "generators/noise/NoiseLattice.h"

namespace teren {
namespace {

constexpr int kWorkPerColumn = 32;  // samples times octaves in a unit, for a column of a tile: 1 to 20 us
constexpr double kMostTileCells = 0x1p28;  // a tile is less wide; NoiseRow.h allows 2^31 with the margins

/// The offset from a cell's corner as NoiseKernel.h takes it, and the weight of the other corner.
float offsetOf(std::uint32_t part) noexcept {
  return static_cast<float>(static_cast<std::int32_t>(part >> 8)) * 0x1p-24f;
}
float quintic(float t) noexcept {
  const float inner = t * (t * 6.0f - 15.0f) + 10.0f;
  return t * t * t * inner;
}

/// One octave's lattice and where the rows of the tile lie on it.
struct Octave {
  NoiseLattice lattice;
  bool onLines = false;         // columns and rows are the lattice's own lines
  double warpCells = 0.0;       // the farthest that warp moves a sample
  WideWord rowX = 0, rowY = 0;  // coordinates of the next row: what y adds, phases included in the second
  std::uint64_t line = 0;       // the cell whose hashes the row has
  bool hashed = false;
};

class NoiseTask final : public SlicedTask {
 public:
  NoiseTask(const Noise& noise, const FieldRequest& request, HeightView out, NoiseRowKernel kernel,
            int tileColumns)
      : out_(out),
        kernel_(kernel),
        x_(noisePosition(request.i, request.u)),
        y_(noisePosition(request.j, request.v)),
        step_(noiseStep(request.spacing, request.pitch)),
        workPerUnit_(kWorkPerColumn * tileColumns) {
    const NoiseSettings& settings = noise.settings();
    const int kept = noise.kept(request.level, request.spacing);
    const bool warped = settings.warp > 0.0 && kept > 0;
    octaves_.resize(static_cast<std::size_t>(kept + (warped ? 2 : 0)));
    rows_.resize(octaves_.size());
    for (int n = 0; n < kept; ++n) addOctave(noise, request, n, n, warped);
    for (int n = kept; n < static_cast<int>(octaves_.size()); ++n) {
      addOctave(noise, request, n, kMostNoiseOctaves + n - kept, false);
    }
    chooseTile(tileColumns);
    row_ = {.octaves = rows_.data(),
            .octaveCount = kept,
            .warps = warped ? rows_.data() + kept : nullptr,
            .constant = static_cast<float>(noise.plan().constant(kept)),
            .before = static_cast<float>(noise.plan().before()),
            .tail = static_cast<float>(noise.plan().tail(kept)),
            .columns = 1,
            .heights = heights_};
  }

  bool step(const Slice& slice) override {
    do {
      unit();
      if (west_ == out_.columns()) return true;
    } while (!slice.over());
    return false;
  }

 private:
  static constexpr int kMostColumns = 128;

  /// number: of its random numbers; from kMostNoiseOctaves on those of warp, whose noise is in metres.
  void addOctave(const Noise& noise, const FieldRequest& request, int place, int number, bool warped) {
    const NoiseSettings& settings = noise.settings();
    const bool warp = number >= kMostNoiseOctaves;
    const double frequency = warp ? settings.frequency : noise.plan().frequency(number);
    Octave& octave = octaves_[static_cast<std::size_t>(place)];
    NoiseOctaveRow& row = rows_[static_cast<std::size_t>(place)];
    octave.lattice = NoiseLattice(settings.kind, frequency * request.pitch, request.seed, number);
    octave.onLines = settings.kind == NoiseKind::perlin && !warped;
    const double metres = settings.warp / std::sqrt(noiseConstants(settings.kind).variance);
    row.amplitude = static_cast<float>(warp ? metres : noise.plan().amplitude(number));
    if (!warped) return;
    const double cells = warpedCells(settings, frequency, request.pitch);
    const bool simplex = settings.kind == NoiseKind::simplex;
    row.straight = static_cast<float>(simplex ? cells * (1.0 + kSkew) : cells);
    row.across = static_cast<float>(simplex ? cells * kSkew : 0.0);
    octave.warpCells = metres * cells * (simplex ? 1.0 + 2.0 * kSkew : 1.0) * 1.001 + 2.0;
  }

  /// As wide and high as the keys of hashes allow; the columns' numbers get their room.
  void chooseTile(int tileColumns) {
    double cellsPerSample = 0.0;
    for (const Octave& octave : octaves_) {
      const double cells = static_cast<double>(octave.lattice.straight + octave.lattice.across) * 0x1p-64;
      cellsPerSample = std::max(cellsPerSample, cells * static_cast<double>(step_));
    }
    const double most = kMostTileCells / std::max(cellsPerSample, 1.0);
    const int longest = std::max(1, static_cast<int>(most));
    tileColumns_ = std::min({tileColumns, kMostColumns, out_.columns(), longest});
    tileRows_ = std::min(out_.rows(), longest);
    stride_ = static_cast<std::size_t>((tileColumns_ + kNoisePadding - 1) / kNoisePadding * kNoisePadding);
    words_.resize(4 * octaves_.size() * stride_);
    floats_.resize(2 * octaves_.size() * stride_);
    for (std::size_t n = 0; n < octaves_.size(); ++n) {
      NoiseOctaveRow& row = rows_[n];
      row.west = row.cellX = words(n, 0);
      row.east = row.partX = words(n, 1);
      row.cellY = words(n, 2);
      row.partY = words(n, 3);
      row.offset = floats(n, 0);
      row.weight = floats(n, 1);
    }
  }

  std::uint32_t* words(std::size_t octave, std::size_t which) noexcept {
    return words_.data() + (4 * octave + which) * stride_;
  }
  float* floats(std::size_t octave, std::size_t which) noexcept {
    return floats_.data() + (2 * octave + which) * stride_;
  }

  void unit() {
    if (octave_ < octaves_.size()) return beginOctave(octave_++);
    const int columns = row_.columns = std::min(tileColumns_, out_.columns() - west_);
    const int end = std::min(out_.rows(), south_ + tileRows_);
    // A row costs what its padding does, too: the last tile may be one column wide.
    const int padded = (columns + kNoisePadding - 1) / kNoisePadding * kNoisePadding;
    const int work = padded * (static_cast<int>(octaves_.size()) + 1);
    for (int rows = std::max(1, workPerUnit_ / work); rows > 0 && rowNumber_ < end; --rows) {
      for (std::size_t n = 0; n < octaves_.size(); ++n) beginRow(octaves_[n], rows_[n]);
      kernel_(row_);
      std::copy_n(heights_, columns, out_.row(rowNumber_++) + west_);
    }
    if (rowNumber_ < end) return;
    octave_ = 0;
    south_ = end;
    if (south_ < out_.rows()) return;
    south_ = rowNumber_ = 0;
    west_ += columns;
  }

  WideWord after(WideWord first, int samples) const noexcept {
    return first + static_cast<WideWord>(step_) * static_cast<unsigned>(samples);
  }

  /// An octave's columns in the tile, its first row, and the keys of its hashes there.
  void beginOctave(std::size_t n) {
    Octave& octave = octaves_[n];
    NoiseOctaveRow& row = rows_[n];
    const NoiseLattice& lattice = octave.lattice;
    const WideWord east = after(x_, west_), north = after(y_, south_);
    const WideWord x = east * lattice.straight + lattice.phaseX, y = east * lattice.across;
    octave.rowX = north * lattice.across;
    octave.rowY = north * lattice.straight + lattice.phaseY;
    const auto margin = static_cast<std::uint64_t>(octave.warpCells) + 1;
    row.keysX = axisKeysFrom(cellOf(x) + cellOf(octave.rowX) - margin, lattice.seedX);
    row.keysY = axisKeysFrom(cellOf(y) + cellOf(octave.rowY) - margin, lattice.seedY);
    if (octave.onLines) {
      beginLines(n, x);
    } else {
      beginPlaces(n, x, y);
    }
  }

  void beginLines(std::size_t n, WideWord x) noexcept {
    const NoiseLattice& lattice = octaves_[n].lattice;
    const AxisKeys& keys = rows_[n].keysX;
    const WideWord step = static_cast<WideWord>(step_) * lattice.straight;
    const int columns = std::min(tileColumns_, out_.columns() - west_);
    for (int column = 0; column < columns; ++column, x += step) {
      words(n, 0)[column] = axisHash(cellOf(x), keys);
      words(n, 1)[column] = axisHash(cellOf(x) + 1, keys);
      floats(n, 0)[column] = offsetOf(partOf(x));
      floats(n, 1)[column] = quintic(offsetOf(partOf(x)));
    }
  }

  void beginPlaces(std::size_t n, WideWord x, WideWord y) noexcept {
    const NoiseLattice& lattice = octaves_[n].lattice;
    const WideWord stepX = static_cast<WideWord>(step_) * lattice.straight;
    const WideWord stepY = static_cast<WideWord>(step_) * lattice.across;
    const int columns = std::min(tileColumns_, out_.columns() - west_);
    for (int column = 0; column < columns; ++column, x += stepX, y += stepY) {
      words(n, 0)[column] = static_cast<std::uint32_t>(cellOf(x));
      words(n, 1)[column] = partOf(x);
      words(n, 2)[column] = static_cast<std::uint32_t>(cellOf(y));
      words(n, 3)[column] = partOf(y);
    }
  }

  /// What the next row needs of an octave.
  void beginRow(Octave& octave, NoiseOctaveRow& row) noexcept {
    const WideWord x = octave.rowX, y = octave.rowY;
    octave.rowX += static_cast<WideWord>(step_) * octave.lattice.across;
    octave.rowY += static_cast<WideWord>(step_) * octave.lattice.straight;
    if (!octave.onLines) {
      row.rowCellX = static_cast<std::uint32_t>(cellOf(x));
      row.rowPartX = partOf(x);
      row.rowCellY = static_cast<std::uint32_t>(cellOf(y));
      row.rowPartY = partOf(y);
      return;
    }
    row.rowOffset = offsetOf(partOf(y));
    row.rowWeight = quintic(row.rowOffset);
    if (octave.hashed && octave.line == cellOf(y)) return;
    octave.line = cellOf(y);
    octave.hashed = true;
    row.south = axisHash(octave.line, row.keysY);
    row.north = axisHash(octave.line + 1, row.keysY);
  }

  HeightView out_;
  NoiseRowKernel kernel_;
  WideWord x_, y_;      // of the first sample [2^-32 pitches]
  std::uint64_t step_;  // between samples
  int workPerUnit_;
  std::vector<Octave> octaves_;
  std::vector<NoiseOctaveRow> rows_;
  std::vector<std::uint32_t> words_;  // of the tile's columns, four rows an octave
  std::vector<float> floats_;         // the same, two
  NoiseRow row_;
  int tileColumns_ = 1, tileRows_ = 1;
  std::size_t stride_ = 0;    // columns of the tile, padded
  int west_ = 0, south_ = 0;  // of the tile [samples]
  std::size_t octave_ = 0;    // next to be set up
  int rowNumber_ = 0;         // next
  alignas(64) float heights_[kMostColumns];
};

}  // namespace

std::unique_ptr<SlicedTask> beginNoise(const Noise& noise, const FieldRequest& request, HeightView out,
                                       NoiseRowKernel kernel, int tileColumns) {
  assert(out.columns() == request.columns && out.rows() == request.rows && !out.empty());
  return std::make_unique<NoiseTask>(noise, request, out, kernel, tileColumns);
}

}  // namespace teren
