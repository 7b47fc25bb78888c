// The disc of water around the eye in the buffers of a GL context.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "coin/WaterCells.h"

namespace teren {

/// Its vertices have two coordinates, in the unit disc. make(), draw() and release() need the context.
class WaterDisc {
 public:
  void make();
  void release();
  /// Draws the cells of `count` rings from `first` on; the corners' places are the attribute with this
  /// number.
  void draw(const WaterCells& cells, int first, int count, unsigned attribute);
  std::size_t bytes() const noexcept { return bytes_; }

 private:
  unsigned vertices_ = 0;
  std::size_t bytes_ = 0;
  std::vector<std::uint16_t> triangles_;  // of the cells that are being drawn
};

}  // namespace teren
