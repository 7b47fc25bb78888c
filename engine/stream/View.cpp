#include "stream/View.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <tuple>

namespace teren {

bool insideWorld(const NodeKey& key) noexcept {
  const std::int64_t most = (kMaxPatch >> key.level) - 1;
  return key.i >= -most && key.i < most && key.j >= -most && key.j < most;
}

namespace {

/// [s] From now on.
constexpr Span kAnyTime{0.0, std::numeric_limits<double>::infinity()};

/// The cells that a coordinate comes over during a span, `margin` wide to both sides; cells are 1 wide.
struct Cells {
  Cells(double at, double rate, const Span& span, double margin) {
    const double a = at + rate * span.begin, b = at + rate * span.end;
    first = static_cast<std::int64_t>(std::floor(std::min(a, b) - margin));
    last = static_cast<std::int64_t>(std::floor(std::max(a, b) + margin));
  }
  std::int64_t first = 0, last = 0;
};

/// All level-0 nodes that a square with sides of 2 `margin` [pitches] comes over within `seconds` on a
/// straight way at so many pitches a second: its own first, then in the order in which they are reached.
void findPassages(const Position& from, double eastRate, double northRate, double seconds, double margin,
                  std::vector<GroundNodes::Passage>& passages) {
  using Passage = GroundNodes::Passage;
  const NodeKey own = nodeAt(from, 0);
  passages.clear();
  const Cells columns(from.u, eastRate, {0.0, seconds}, margin);
  for (std::int64_t column = columns.first; column <= columns.last; ++column) {
    const auto west = static_cast<double>(column);
    const Span inColumn = spanWithin(from.u, eastRate, west - margin, west + 1.0 + margin, kAnyTime);
    const Cells rows(from.v, northRate, {std::min(inColumn.begin, seconds), std::min(inColumn.end, seconds)},
                     margin);
    for (std::int64_t row = rows.first; row <= rows.last; ++row) {
      const auto south = static_cast<double>(row);
      const Span inRow = spanWithin(from.v, northRate, south - margin, south + 1.0 + margin, kAnyTime);
      const Span span{std::max(inColumn.begin, inRow.begin), std::min(inColumn.end, inRow.end)};
      const NodeKey key{0, own.i + column, own.j + row};
      if (span.begin <= std::min(span.end, seconds) && insideWorld(key)) passages.push_back({key, span});
    }
  }
  std::sort(passages.begin(), passages.end(), [&own](const Passage& a, const Passage& b) {
    return std::tuple(a.span.begin, a.key != own, a.key.j, a.key.i) <
           std::tuple(b.span.begin, b.key != own, b.key.j, b.key.i);
  });
}

}  // namespace

std::vector<NodeKey> viewNodes(const Position& position, const ViewSettings& view, const World& world) {
  const NodeKey centre = nodeAt(position, view.level);
  const double side = world.pitch() * static_cast<double>(std::int64_t{1} << view.level);
  const Position corner{centre.i << view.level, centre.j << view.level, 0.0, 0.0};
  const Offset inside = offset(corner, position, world.pitch());
  std::vector<std::tuple<double, NodeKey>> ranked;
  for (int dj = -view.radius; dj <= view.radius; ++dj) {
    for (int di = -view.radius; di <= view.radius; ++di) {
      const NodeKey key = centre.neighbour(di, dj);
      if (!insideWorld(key)) continue;
      const double east = (di + 0.5) * side - inside.east, north = (dj + 0.5) * side - inside.north;
      ranked.emplace_back(east * east + north * north, key);
    }
  }
  std::sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
    const auto& [distanceA, keyA] = a;
    const auto& [distanceB, keyB] = b;
    return std::tie(distanceA, keyA.j, keyA.i) < std::tie(distanceB, keyB.j, keyB.i);
  });
  std::vector<NodeKey> nodes;
  nodes.reserve(ranked.size());
  for (const auto& [distance, key] : ranked) nodes.push_back(key);
  return nodes;
}

bool mayStay(const NodeKey& key, const NodeKey& centre, const ViewSettings& view, int margin) noexcept {
  const int most = view.radius + margin;
  return key.level == view.level && std::abs(key.i - centre.i) <= most && std::abs(key.j - centre.j) <= most;
}

void groundNodes(const Motion& motion, const World& world, GroundNodes& nodes) {
  const double pitch = world.pitch(), margin = std::max(kGroundMargin, motion.reach) / pitch;
  const double speed = std::sqrt(motion.east * motion.east + motion.north * motion.north);
  const double secondsAhead = speed > 0.0 ? std::min(kGroundSeconds, kGroundPitches * pitch / speed) : 0.0;
  const bool tooFast = !(secondsAhead >= kGroundNotice) && speed != 0.0;
  const bool moves = speed > 0.0 && !tooFast;
  const double seconds = moves ? secondsAhead : 0.0;
  nodes.wanted.clear();
  nodes.passing.clear();
  findPassages(motion.position, moves ? motion.east / pitch : 0.0, moves ? motion.north / pitch : 0.0,
               seconds, margin, nodes.passages);
  for (const auto& [key, span] : nodes.passages) {
    const bool passing = tooFast || span.end + 0.5 * pitch / speed < kGroundNotice;
    (passing ? nodes.passing : nodes.wanted).push_back(key);
  }
}

}  // namespace teren
