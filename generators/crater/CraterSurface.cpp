#include "generators/crater/CraterSurface.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace teren {
namespace {

Error wrong(const char* field, double value, const std::string& expected) {
  return {std::string(field) + " is " + metresText(value) + ", expected " + expected};
}

}  // namespace

Result<CraterTool> CraterSurface::read(const Stamp& stamp, double spacing) {
  const bool smooths = stamp.values.choice("tool") == "smooth";
  if (!(stamp.size > 0.0 && stamp.size <= kLargest)) {
    return wrong("size", stamp.size, "a radius above 0 and up to " + metresText(kLargest));
  }
  CraterTool tool;
  tool.radius = stamp.size;
  tool.depth = stamp.depth;
  if (smooths) {
    const double most = std::min(stamp.size, Smoothing::kMostSamples * spacing);
    if (!(stamp.depth > 0.0 && stamp.depth <= most)) {
      return wrong("depth", stamp.depth, "how far to blur, above 0 and up to " + metresText(most));
    }
    tool.kind = CraterTool::Kind::smooth;
    tool.steps = Smoothing::stepsFor(stamp.depth / spacing);
    tool.reach = Smoothing::reach(stamp.size, spacing);
    return tool;
  }
  if (!(std::fabs(stamp.depth) <= stamp.size)) {
    return wrong("depth", stamp.depth, "at most the size up or down");
  }
  tool.rim = stamp.values.real("rim");
  tool.irregular = stamp.values.real("irregularity");
  tool.reach = CraterShape::reach(stamp.size, tool.rim, tool.irregular);
  return tool;
}

Result<void> CraterSurface::apply(const Stamp& stamp) {
  const Result<CraterTool> tool = read(stamp, grid_.region().spacing);
  if (!tool) return tool.error();
  if (Result<void> place = checkPlace(grid_.region(), stamp, tool->reach); !place) return place;
  while (begun_) work();
  if (tool->kind == CraterTool::Kind::crater) {
    dig(stamp, *tool);
  } else {
    smoothings_.emplace_back(grid_.region(), stamp.east, stamp.north, tool->radius, tool->steps);
  }
  return {};
}

void CraterSurface::dig(const Stamp& stamp, const CraterTool& tool) {
  const CraterShape shape(tool.radius, tool.depth, tool.rim, tool.irregular, stamp.seed);
  const double spacing = grid_.region().spacing;
  const SampleRectangle near = grid_.region().within(stamp.east, stamp.north, tool.reach);
  for (int y = near.row; y < near.row + near.rows; ++y) {
    for (int x = near.column; x < near.column + near.columns; ++x) {
      const double change = shape.height(x * spacing - stamp.east, y * spacing - stamp.north);
      if (change != 0.0) grid_.set(x, y, grid_(x, y) + change);
    }
  }
}

bool CraterSurface::step(const Slice& slice, std::uint64_t upTo) {
  while (!atRest() && steps_ < upTo) {
    work();
    if (slice.over()) break;
  }
  return atRest() || steps_ >= upTo;
}

void CraterSurface::work() {
  begun_ = true;
  if (!smoothings_[current_].row(grid_)) return;
  if (++current_ < smoothings_.size()) return;
  current_ = 0;
  begun_ = false;
  ++steps_;
  std::erase_if(smoothings_, [](const Smoothing& smoothing) { return smoothing.stepsLeft() == 0; });
}

/// Nothing but the grid knows of the region: the smoothings, which do, are done.
Result<void> CraterSurface::grow(const DeformRegion& region, ConstHeightView ground) {
  assert(atRest());
  grid_.grow(region, ground);
  return {};
}

Result<void> CraterSurface::merge(const DeformRegion& region, ConstHeightView ground,
                                  std::span<LiveSurface* const> others) {
  Result<void> grown = grow(region, ground);
  if (!grown) return grown;
  for (const LiveSurface* other : others) {
    assert(other->atRest());
    grid_.take(static_cast<const CraterSurface&>(*other).grid_);
  }
  return {};
}

std::size_t CraterSurface::bytes() const noexcept {
  std::size_t sum = sizeof(*this) - sizeof(grid_) + grid_.bytes();
  for (const Smoothing& smoothing : smoothings_) sum += smoothing.bytes();
  return sum + (smoothings_.capacity() - smoothings_.size()) * sizeof(Smoothing);
}

}  // namespace teren
