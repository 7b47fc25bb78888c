#include "generators/tin/JumpGrid.h"

namespace teren {

void JumpGrid::rebuildFor(std::size_t vertices) {
  const auto count = [this](int shift) {
    return (static_cast<std::size_t>(width_ >> shift) + 1) * (static_cast<std::size_t>(height_ >> shift) + 1);
  };
  shift_ = 28;
  while (shift_ > 0 && count(shift_ - 1) <= vertices) --shift_;
  columns_ = static_cast<std::size_t>(width_ >> shift_) + 1;
  cells_ = {};
  cells_.resize(count(shift_), kNoVertex);
}

}  // namespace teren
