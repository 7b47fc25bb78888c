#include "apps/fly/ToolBelt.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "teren/Hash.h"

#include "apps/fly/Steps.h"

namespace teren {
namespace {

using Tool = ToolBelt::Tool;

constexpr double kCraterRim = 0.225, kCraterIrregularity = 0.1;  // the deformer's own
constexpr double kMostBlur = 16.0;                               // [samples] that smoothing takes

struct Row {
  Tool tool;
  std::string_view name, kind;
  double spacing;  // [sizes] between stamps of a stroke
};
constexpr std::array kTools{
    Row{Tool::dig, "dig", "crater", 0.5},       Row{Tool::heap, "heap", "crater", 0.5},
    Row{Tool::smooth, "smooth", "crater", 0.5}, Row{Tool::crater, "crater", "crater", 2.5},
    Row{Tool::rake, "rake", "sand", 0.5},       Row{Tool::shovel, "shovel", "sand", 1.0},
    Row{Tool::pour, "pour", "sand", 1.0}};

const Row& rowOf(Tool tool) {
  return kTools[static_cast<std::size_t>(tool)];
}

Edit editAt(const Position& place, double pitch, const char* kind, double size, double depth) {
  Edit edit;
  edit.kind = kind;
  edit.x = place.x(pitch);
  edit.y = place.y(pitch);
  edit.size = size;
  edit.depth = depth;
  return edit;
}

}  // namespace

Edit craterEdit(const Position& place, double pitch, double size, double depth, double rim,
                double irregularity) {
  Edit edit = editAt(place, pitch, "crater", size, depth);
  edit.seed = hashWith(std::bit_cast<std::uint64_t>(edit.x), std::bit_cast<std::uint64_t>(edit.y));
  edit.parameters = {{"rim", rim}, {"irregularity", irregularity}};
  return edit;
}

Edit sandEdit(const Position& place, double pitch, std::string tool, double size, double depth, double east,
              double north) {
  Edit edit = editAt(place, pitch, "sand", size, depth);
  edit.parameters = {{"tool", std::move(tool)}};
  if (east == 0.0 && north == 0.0) return edit;
  const double degrees = std::atan2(north, east) * 180.0 / std::numbers::pi;
  edit.parameters.emplace_back("push", true);
  edit.parameters.emplace_back("direction", degrees < 0.0 ? std::min(degrees + 360.0, 360.0) : degrees);
  return edit;
}

std::string_view ToolBelt::kindOf(Tool tool) noexcept {
  return rowOf(tool).kind;
}

std::string_view ToolBelt::nameOf(Tool tool) noexcept {
  return rowOf(tool).name;
}

std::vector<Tool> ToolBelt::takeNext(const IsThere& isThere) {
  lift();
  std::vector<Tool> passed;
  for (std::size_t next = inHand_ ? static_cast<std::size_t>(*inHand_) + 1 : 0; next < kTools.size();
       ++next) {
    if (isThere(kTools[next].kind)) {
      inHand_ = kTools[next].tool;
      return passed;
    }
    passed.push_back(kTools[next].tool);
  }
  inHand_.reset();
  return passed;
}

bool ToolBelt::isInSand() const noexcept {
  return inHand_ && rowOf(*inHand_).kind == "sand";
}

double ToolBelt::size() const noexcept {
  return isInSand() ? std::min(size_, kMostSand * ground_.spacing) : size_;
}

double ToolBelt::depth() const noexcept {
  const double depth = std::min(depth_, size());
  return isInSand() ? std::min(depth, kDeepestSand * ground_.spacing) : depth;
}

void ToolBelt::resize(int direction) noexcept {
  size_ = Steps::toolSizes().next(size(), direction);
}

void ToolBelt::deepen(int direction) noexcept {
  depth_ = Steps::toolDepths().next(depth(), direction);
}

double ToolBelt::spacing() const noexcept {
  return inHand_ ? rowOf(*inHand_).spacing * size() : size();
}

void ToolBelt::begin(const Position& aim, std::vector<Edit>& edits) {
  last_ = aim;
  if (*inHand_ != Tool::rake) edits.push_back(stamp(aim, 0.0, 0.0));
}

std::vector<Edit> ToolBelt::press(const Position& aim) {
  std::vector<Edit> edits;
  if (!inHand_) return edits;
  if (!last_) {
    begin(aim, edits);
    return edits;
  }
  const double stride = spacing();
  const Offset way = offset(*last_, aim, ground_.pitch);
  const double length = std::hypot(way.east, way.north);
  if (!(length >= stride)) return edits;
  if (length > kMostStampsAtOnce * stride) {
    begin(aim, edits);
    return edits;
  }
  const double east = way.east / length, north = way.north / length;
  for (double gone = stride; gone <= length; gone += stride) {
    const Result<Position> next = last_->movedBy(stride * east, stride * north, ground_.pitch);
    if (!next) break;
    last_ = *next;
    edits.push_back(stamp(*next, east, north));
  }
  return edits;
}

Edit ToolBelt::stamp(const Position& place, double east, double north) const {
  const double pitch = ground_.pitch;
  switch (*inHand_) {
    case Tool::heap:
      return craterEdit(place, pitch, size(), -depth(), 0.0, 0.0);
    case Tool::crater:
      return craterEdit(place, pitch, size(), depth(), kCraterRim, kCraterIrregularity);
    case Tool::smooth: {
      Edit edit = craterEdit(place, pitch, size(), std::min(depth(), kMostBlur * ground_.spacing), 0.0, 0.0);
      edit.parameters = {{"tool", std::string("smooth")}};
      return edit;
    }
    case Tool::rake:
      return sandEdit(place, pitch, "rake", size(), depth(), east, north);
    case Tool::shovel:
      return sandEdit(place, pitch, "round", size(), depth(), 0.0, 0.0);
    case Tool::pour:
      return sandEdit(place, pitch, "round", size(), -depth(), 0.0, 0.0);
    default:
      return craterEdit(place, pitch, size(), depth(), 0.0, 0.0);
  }
}

}  // namespace teren
