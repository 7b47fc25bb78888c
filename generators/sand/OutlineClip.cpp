#include "generators/sand/OutlineClip.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace teren {
namespace {

/// A part of a segment, from 0 to 1.
struct Part {
  double first = 0.0;
  double last = 1.0;
};

/// Cuts off where from + t (to - from) is less than 0 or more than `most` (Liang and Barsky 1984); false
/// where nothing is left.
bool cut(Part& part, double from, double to, double most) noexcept {
  const double along = to - from;
  if (along == 0.0) return 0.0 <= from && from <= most;
  const double one = -from / along, other = (most - from) / along;
  part.first = std::max(part.first, std::min(one, other));
  part.last = std::min(part.last, std::max(one, other));
  return part.first <= part.last;
}

/// [steps] A coordinate next to a border is on it; one that is far outside stays a number.
double snapped(double coordinate, double most, double margin) noexcept {
  coordinate = std::clamp(coordinate, -0x1p60, 0x1p60);
  if (0.0 <= coordinate && coordinate < margin) return 0.0;
  return most - margin < coordinate && coordinate <= most ? most : coordinate;
}

std::int32_t rounded(double coordinate, std::int32_t most) noexcept {
  return static_cast<std::int32_t>(std::clamp(std::floor(coordinate + 0.5), 0.0, static_cast<double>(most)));
}

/// An outline in steps of the box.
class Outline {
 public:
  Outline(const LatticeFrame& frame, std::span<const ToolPoint> outline, double margin) : frame_(frame) {
    for (const ToolPoint& p : outline) {
      points_.push_back({snapped((p.x - frame.x) / frame.step, frame.width, margin / frame.step),
                         snapped((p.y - frame.y) / frame.step, frame.height, margin / frame.step)});
    }
  }

  std::size_t size() const noexcept { return points_.size(); }
  bool isInside(std::size_t i) const noexcept {
    const ToolPoint& p = points_[i];
    return 0.0 <= p.x && p.x <= frame_.width && 0.0 <= p.y && p.y <= frame_.height;
  }
  /// The part of the side after point i that lies in the box.
  std::optional<Part> sideInside(std::size_t i) const noexcept {
    const ToolPoint &a = points_[i], &b = points_[(i + 1) % size()];
    Part part;
    if (!cut(part, a.x, b.x, frame_.width) || !cut(part, a.y, b.y, frame_.height)) return std::nullopt;
    return part;
  }
  LatticePoint at(std::size_t i, double part) const noexcept {
    const ToolPoint &a = points_[i], &b = points_[(i + 1) % size()];
    return {rounded(a.x + part * (b.x - a.x), frame_.width),
            rounded(a.y + part * (b.y - a.y), frame_.height)};
  }

 private:
  LatticeFrame frame_;
  std::vector<ToolPoint> points_;
};

void append(LatticeChain& chain, LatticePoint p) {
  if (chain.points.empty() || !(chain.points.back() == p)) chain.points.push_back(p);
}

}  // namespace

std::vector<LatticeChain> clippedOutline(const LatticeFrame& frame, std::span<const ToolPoint> outline,
                                         double margin) {
  const Outline all(frame, outline, margin);
  std::size_t start = 0;
  while (start < all.size() && all.isInside(start)) ++start;
  std::vector<LatticeChain> chains;
  if (start == all.size() && start > 0) {
    chains.push_back({{}, true});
    for (std::size_t i = 0; i < all.size(); ++i) append(chains.back(), all.at(i, 0.0));
    return chains;
  }
  for (std::size_t n = 0; n < all.size(); ++n) {
    const std::size_t i = (start + n) % all.size();
    const std::optional<Part> part = all.sideInside(i);
    if (!part) continue;
    const LatticePoint from = all.at(i, part->first);
    if (chains.empty() || !(chains.back().points.back() == from)) chains.push_back({});
    append(chains.back(), from);
    append(chains.back(), all.at(i, part->last));
  }
  return chains;
}

}  // namespace teren
