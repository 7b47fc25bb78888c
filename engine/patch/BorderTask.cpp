#include "patch/BorderTask.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

namespace teren {

namespace {

constexpr std::size_t kSouth = 0, kNorth = 1, kWest = 2, kEast = 3;

/// Squares of nodes in level-0 patches times n: whole samples.
struct Extent {
  std::int64_t west, south, side;
};

Extent extentOf(const NodeKey& key, int intervals) noexcept {
  const std::int64_t side = std::int64_t{intervals} << key.level;
  return {key.i * side, key.j * side, side};
}

/// What lies across a side of a node: how much of the side, from its western or southern end.
struct Contact {
  std::int64_t from = 0, to = 0;
  int level = 0;
};

/// Of `other` with a side of `node`; from >= to where they do not share a part of it.
Contact contact(const NodeKey& node, const NodeKey& other, std::size_t side, int intervals) noexcept {
  const Extent own = extentOf(node, intervals), its = extentOf(other, intervals);
  const bool across = side == kSouth   ? its.south + its.side == own.south
                      : side == kNorth ? its.south == own.south + own.side
                      : side == kWest  ? its.west + its.side == own.west
                                       : its.west == own.west + own.side;
  if (!across) return {};
  const std::int64_t first = side == kSouth || side == kNorth ? its.west - own.west : its.south - own.south;
  return {std::max<std::int64_t>(first, 0), std::min(first + its.side, own.side), other.level};
}

/// Whether nodes lie across the whole of [from, to] of a side; contacts sorted by where they begin.
bool covered(const std::vector<Contact>& contacts, std::int64_t from, std::int64_t to) noexcept {
  for (const Contact& one : contacts) {
    if (one.from <= from) from = std::max(from, one.to);
  }
  return from >= to;
}

/// The level of the node in the quadrant outside a corner; -1 where there is none.
int levelBeyond(const NodeKey& node, const std::vector<NodeKey>& around, std::size_t corner, int intervals) {
  const Extent own = extentOf(node, intervals);
  const bool east = (corner & 1) != 0, north = (corner & 2) != 0;
  const std::int64_t x = own.west + (east ? own.side : 0), y = own.south + (north ? own.side : 0);
  const auto goesOn = [](std::int64_t low, std::int64_t side, std::int64_t at, bool up) {
    return up ? low <= at && at < low + side : low < at && at <= low + side;
  };
  for (const NodeKey& key : around) {
    const Extent its = extentOf(key, intervals);
    if (goesOn(its.west, its.side, x, east) && goesOn(its.south, its.side, y, north)) return key.level;
  }
  return -1;
}

/// The sides that meet in a corner: first the southern or northern one, then the western or eastern.
std::pair<std::size_t, std::size_t> sidesOf(std::size_t corner) noexcept {
  return {(corner & 2) != 0 ? kNorth : kSouth, (corner & 1) != 0 ? kEast : kWest};
}

/// Points of the line along [from, to] of a side, the last one left out.
std::int64_t pointsAlong(const std::vector<Contact>& contacts, int level, std::int64_t from,
                         std::int64_t to) {
  std::int64_t points = 0;
  for (const Contact& one : contacts) {
    const std::int64_t length = std::min(one.to, to) - std::max(one.from, from);
    if (length > 0) points += std::max<std::int64_t>(length >> std::min(one.level, level), 1);
  }
  return points;
}

}  // namespace

int mostLevelDifference(int intervals) noexcept {
  return 15 - std::bit_width(static_cast<unsigned>(intervals));
}

// ---- What there is to fill

BorderPlan::BorderPlan(const NodeKey& node, const std::vector<NodeKey>& around, int intervals) {
  const std::int64_t step = std::int64_t{1} << node.level, length = intervals * step;
  std::array<std::vector<Contact>, 4> contacts;
  for (std::size_t side = 0; side < 4; ++side) {
    for (const NodeKey& other : around) {
      const Contact one = contact(node, other, side, intervals);
      if (one.from < one.to) contacts[side].push_back(one);
    }
    std::sort(contacts[side].begin(), contacts[side].end(),
              [](const Contact& a, const Contact& b) { return a.from < b.from; });
  }
  const auto isEqual = [&](std::size_t side) {
    return contacts[side].size() == 1 && contacts[side].front().level == node.level;
  };
  std::int64_t points = 0, rim = 0;
  for (std::size_t side = 0; side < 4; ++side) {
    sides_[side] = intervals > 2 && !isEqual(side) && covered(contacts[side], step, length - step);
    if (!sides_[side]) continue;
    points += pointsAlong(contacts[side], node.level, step, length - step) + 1;
    rim += intervals - 1;
  }
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const auto [flat, upright] = sidesOf(corner);
    const int beyond = levelBeyond(node, around, corner, intervals);
    if (beyond < 0 || (beyond == node.level && isEqual(flat) && isEqual(upright))) continue;
    const std::int64_t alongX = (corner & 1) != 0 ? length - step : 0;
    const std::int64_t alongY = (corner & 2) != 0 ? length - step : 0;
    corners_[corner] =
        covered(contacts[flat], alongX, alongX + step) && covered(contacts[upright], alongY, alongY + step);
    if (!corners_[corner]) continue;
    points += pointsAlong(contacts[flat], node.level, alongX, alongX + step) +
              pointsAlong(contacts[upright], node.level, alongY, alongY + step) + 1;
    rim += 1;
  }
  // A triangle for each step along the line, and one for each along the rim.
  bytes_ = sizeof(Mesh) + static_cast<std::size_t>(points + rim) *
                              (sizeof(SurfaceVertex) + 3 * sizeof(TriangleIndices::value_type));
}

bool BorderPlan::empty() const noexcept {
  const auto none = [](const std::array<bool, 4>& parts) {
    return std::none_of(parts.begin(), parts.end(), [](bool part) { return part; });
  };
  return none(sides_) && none(corners_);
}

// ---- Making it

namespace {

std::vector<NodeKey> keysAround(const std::vector<HeldNode>& nodes) {
  std::vector<NodeKey> keys;
  for (std::size_t k = 1; k < nodes.size(); ++k) keys.push_back(nodes[k].key);
  return keys;
}

}  // namespace

BorderTask::BorderTask(std::vector<HeldNode> nodes, double spacing)
    : nodes_(std::move(nodes)),
      intervals_(nodes_.front().heights->columns() - 1),
      plan_(nodes_.front().key, keysAround(nodes_), intervals_),
      indices_(std::make_shared<TriangleIndices>()) {
  const NodeKey own = nodes_.front().key;
  int finest = own.level;
  for (const HeldNode& node : nodes_) finest = std::min(finest, node.key.level);
  assert(own.level - finest <= mostLevelDifference(intervals_));
  spacing_ = spacing * static_cast<double>(std::int64_t{1} << finest);
  const Extent origin = extentOf(own, intervals_);
  for (const HeldNode& node : nodes_) {
    const Extent extent = extentOf(node.key, intervals_);
    squares_.push_back({(extent.west - origin.west) >> finest, (extent.south - origin.south) >> finest,
                        extent.side >> finest, std::int64_t{1} << (node.key.level - finest),
                        node.heights.get(), node.heights.coarser(), node.key.level});
  }
  mesh_->level = finest;
  mesh_->originColumn = origin.west;
  mesh_->originRow = origin.south;
  mesh_->columns = mesh_->rows = static_cast<int>(squares_.front().side);
}

bool BorderTask::step(const Slice& slice) {
  while (part_ < 8) {
    if (part_ >= 4) {
      if (plan_.corner(part_ - 4)) buildCorner(part_ - 4);
      ++part_;
    } else if (plan_.side(part_) && square_ < intervals_ - 1) {
      buildSideSquare(part_, square_++);
    } else {
      ++part_;
      square_ = 1;
    }
    if (slice.over() && part_ < 8) return false;
  }
  indices_->shrink_to_fit();
  mesh_->vertices.shrink_to_fit();
  mesh_->indices = std::move(indices_);
  return true;
}

bool BorderTask::contains(const Square& square, const Place& place) noexcept {
  return square.x <= place.x && place.x <= square.x + square.side && square.y <= place.y &&
         place.y <= square.y + square.side;
}

/// Of a line that equals share, the south or west one's copy is read, as in all pieces.
bool BorderTask::goesBefore(const Square& a, const Square& b) noexcept {
  return a.y != b.y ? a.y < b.y : a.x < b.x;
}

BorderTask::Place BorderTask::onSide(std::size_t side, std::int64_t along,
                                     std::int64_t inwards) const noexcept {
  const std::int64_t far = squares_.front().side - inwards;
  if (side == kSouth) return {along, inwards};
  if (side == kNorth) return {along, far};
  if (side == kWest) return {inwards, along};
  return {far, along};
}

void BorderTask::linePoints(std::size_t side, std::int64_t from, std::int64_t to) {
  line_.clear();
  const std::int64_t own = squares_.front().step;
  for (std::int64_t at = from; at < to;) {
    line_.push_back(at);
    // The finest that lies across the next stretch; all that touch it beyond a corner begin or end there.
    const Place place = onSide(side, at, 0), beyond = onSide(side, at + 1, 0);
    std::int64_t step = own;
    for (std::size_t k = 1; k < squares_.size(); ++k) {
      if (contains(squares_[k], place) && contains(squares_[k], beyond)) {
        step = std::min(step, squares_[k].step);
      }
    }
    at += step;
  }
  line_.push_back(to);
}

void BorderTask::addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool mirrored) {
  if (mirrored) std::swap(a, b);
  indices_->insert(indices_->end(), {a, b, c});
}

void BorderTask::buildSideSquare(std::size_t side, std::int64_t square) {
  const std::int64_t step = squares_.front().step;
  const std::int64_t from = square * step, to = from + step;
  linePoints(side, from, to);
  const std::uint32_t first = vertexAt(onSide(side, from, step)), last = vertexAt(onSide(side, to, step));
  numbers_.clear();
  for (const std::int64_t along : line_) numbers_.push_back(vertexAt(onSide(side, along, 0)));
  const bool mirrored = side == kNorth || side == kWest, high = side == kNorth || side == kEast;
  const std::size_t pieces = numbers_.size() - 1;
  const std::size_t half = pieces == 1 ? (high ? 1 : 0) : pieces / 2;
  for (std::size_t k = 0; k < pieces; ++k) {
    addTriangle(numbers_[k], numbers_[k + 1], k < half ? first : last, mirrored);
  }
  addTriangle(last, first, numbers_[half], mirrored);
}

void BorderTask::buildCorner(std::size_t corner) {
  const Square& own = squares_.front();
  const auto [flat, upright] = sidesOf(corner);
  const bool east = (corner & 1) != 0, north = (corner & 2) != 0;
  const std::int64_t x = east ? own.side - own.step : 0, y = north ? own.side - own.step : 0;
  // From the one end of the two legs over the corner to the other, anticlockwise around the square's inside.
  std::vector<std::uint32_t> flatLeg, uprightLeg;
  linePoints(flat, x, x + own.step);
  for (const std::int64_t along : line_) flatLeg.push_back(vertexAt(onSide(flat, along, 0)));
  linePoints(upright, y, y + own.step);
  for (const std::int64_t along : line_) uprightLeg.push_back(vertexAt(onSide(upright, along, 0)));
  if (!east) std::reverse(flatLeg.begin(), flatLeg.end());  // now towards the corner
  if (!north) std::reverse(uprightLeg.begin(), uprightLeg.end());
  std::vector<std::uint32_t>& first = east == north ? uprightLeg : flatLeg;
  std::vector<std::uint32_t>& second = east == north ? flatLeg : uprightLeg;
  numbers_ = first;
  numbers_.insert(numbers_.end(), second.rbegin() + 1, second.rend());
  const std::uint32_t inner = vertexAt({east ? x : own.step, north ? y : own.step});
  if (numbers_.size() == 3 && east != north) {  // split from south-west to north-east
    addTriangle(inner, numbers_[0], numbers_[2], false);
    addTriangle(numbers_[0], numbers_[1], numbers_[2], false);
    return;
  }
  for (std::size_t k = 0; k + 1 < numbers_.size(); ++k) {
    addTriangle(inner, numbers_[k], numbers_[k + 1], false);
  }
}

// ---- Vertices

std::uint32_t BorderTask::vertexAt(const Place& place) {
  const std::int64_t name = place.y * (squares_.front().side + 1) + place.x;
  const auto number = static_cast<std::uint32_t>(mesh_->vertices.size());
  const auto [found, isNew] = vertices_.emplace(name, number);
  if (!isNew) return found->second;
  meeting_.clear();
  for (const Square& square : squares_) {
    if (contains(square, place)) meeting_.push_back(square);
  }
  const Square& finest = *std::min_element(
      meeting_.begin(), meeting_.end(),
      [](const Square& a, const Square& b) { return a.step != b.step ? a.step < b.step : goesBefore(a, b); });
  SurfaceVertex vertex;
  vertex.column = static_cast<std::int16_t>(place.x);
  vertex.row = static_cast<std::int16_t>(place.y);
  const auto column = static_cast<int>((place.x - finest.x) / finest.step);
  const auto row = static_cast<int>((place.y - finest.y) / finest.step);
  vertex.height = (*finest.heights)(column, row);
  const PackedNormal normal = normalAt(place);
  vertex.normalX = normal.x;
  vertex.normalY = normal.y;
  setCoarser(vertex, finest.coarser, finest.level, spacing_ * static_cast<double>(finest.step), column, row);
  addVertex(vertex);
  return number;
}

PackedNormal BorderTask::normalAt(const Place& place) const {
  std::int64_t distance = 0;
  for (const Square& square : meeting_) distance = std::max(distance, square.step);
  const auto fall = [&](int east, int north) {
    const auto [low, lowDistance] = heightTowards(place, -east, -north, distance);
    const auto [high, highDistance] = heightTowards(place, east, north, distance);
    const auto whole = static_cast<double>(2 * distance);
    return (low - high) * (whole / static_cast<double>(lowDistance + highDistance));
  };
  return normalOfFalls(fall(1, 0), fall(0, 1), spacing_ * static_cast<double>(distance));
}

std::pair<double, std::int64_t> BorderTask::heightTowards(const Place& place, int east, int north,
                                                          std::int64_t distance) const {
  const Square* coarsest = nullptr;
  for (const Square& square : meeting_) {
    if (!contains(square, {place.x + east, place.y + north})) continue;
    if (!coarsest || square.step > coarsest->step ||
        (square.step == coarsest->step && goesBefore(square, *coarsest))) {
      coarsest = &square;
    }
  }
  assert(coarsest);
  const Square& square = *coarsest;
  const std::int64_t room = east > 0    ? square.x + square.side - place.x
                            : east < 0  ? place.x - square.x
                            : north > 0 ? square.y + square.side - place.y
                                        : place.y - square.y;
  const std::int64_t reach = std::min(distance, room);
  // One of the two lies between samples at most: on a line or a rim of the square.
  const std::int64_t x = place.x + east * reach - square.x, y = place.y + north * reach - square.y;
  const auto at = [&](std::int64_t column, std::int64_t row) {
    return static_cast<double>((*square.heights)(static_cast<int>(column), static_cast<int>(row)));
  };
  const std::int64_t column = x / square.step, row = y / square.step;
  const std::int64_t restX = x % square.step, restY = y % square.step;
  const double low = at(column, row);
  if (restX == 0 && restY == 0) return {low, reach};
  const double high = restX != 0 ? at(column + 1, row) : at(column, row + 1);
  const double share = static_cast<double>(restX + restY) / static_cast<double>(square.step);
  return {low + share * (high - low), reach};
}

}  // namespace teren
