// The plain rival of sand on a triangulation: a regular grid of the same finest detail, with the same slides.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "generators/sand/FaceSlide.h"
#include "generators/sand/MarkSet.h"

namespace teren {

/// A square of a metre with side x side samples, each square of them cut into two triangles. Height and loose
/// thickness are whole ticks, as in SandSurface; a face slides by FaceSlide.h, in a queue. All ground is
/// loose.
class SandGrid {
 public:
  /// 2 <= side <= 46,000; level at height 0, `loose` [m] deep.
  SandGrid(int side, double loose);

  int side() const noexcept { return side_; }
  /// Presses a flat disc down to `bottom` [m] at (x, y) [m] and heaps up the removed volume on a ring around
  /// it.
  void stamp(double x, double y, double radius, double bottom, double bermWidth);
  /// Lets at most so many faces slide; true: all is at rest.
  bool slide(const Repose& repose, std::uint64_t steps);
  /// Every byte held.
  std::size_t bytes() const noexcept;

 private:
  struct Sample {
    std::int64_t height = 0;  // [ticks]
    std::int64_t loose = 0;   // [ticks]
  };
  struct Place {
    int column = 0, row = 0;
  };

  std::size_t at(Place p) const noexcept {
    return static_cast<std::size_t>(p.row) * static_cast<std::size_t>(side_) +
           static_cast<std::size_t>(p.column);
  }
  std::int64_t weight(Place p) const noexcept;
  void raise(Place p, std::int64_t ticks);
  void addAround(Place p);
  void addSquare(int column, int row);
  void look(std::uint32_t face, const Repose& repose);
  /// visit(place, distance [m]) for every sample at most `reach` [m] from (x, y) [m].
  template <class Visitor>
  void forEachWithin(double x, double y, double reach, Visitor&& visit);

  int side_;
  double spacing_;  // [m]
  std::vector<Sample> samples_;
  VolumeLedger ledger_;
  MarkSet waiting_;
  std::vector<std::uint32_t> now_, next_;
  std::size_t position_ = 0;
};

}  // namespace teren
