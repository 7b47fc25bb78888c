#include "generators/sand/SandSurface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

namespace teren {
namespace {

std::int64_t clamped(std::int64_t ticks) noexcept {
  return std::clamp(ticks, -kHighestTick, kHighestTick);
}

/// The number of ticks nearest to number / divisor, halves upwards; divisor > 0.
std::int64_t ticksNearest(WideInteger number, WideInteger divisor) noexcept {
  return asTicks(dividedDown(2 * number + divisor, 2 * divisor));
}

}  // namespace

SandSurface::SandSurface(const LatticeFrame& frame, double height, double loose)
    : mesh_(frame, metresFromTicks(ticksFromMetres(height))) {
  const std::int64_t thickness = std::max<std::int64_t>(ticksFromMetres(loose), 0);
  for (VertexId v = 0; v < 4; ++v) adopt(v, ticksFromMetres(height), thickness);
}

SandSurface::SandSurface(const LatticeFrame& frame, std::span<const LatticePoint> points,
                         std::span<const double> heights, double loose, std::size_t spare)
    : mesh_(frame, heights.empty() ? 0.0 : metresFromTicks(ticksFromMetres(heights.front()))) {
  assert(points.size() == heights.size() && points.size() <= kMostVertices);
  const std::vector<VertexId> vertices = mesh_.insert(points, heights);
  mesh_.reserve(mesh_.vertexSlots() + spare);
  loose_.reserve(mesh_.vertexSlots() + spare);
  const std::int64_t thickness = std::max<std::int64_t>(ticksFromMetres(loose), 0);
  loose_.resize(mesh_.vertexSlots(), kNoLoose);  // points that are one vertex leave slots free
  for (VertexId v = 0; v < mesh_.vertexSlots(); ++v) {
    if (mesh_.isVertex(v)) loose_[v] = thickness;
  }
  for (std::size_t i = points.size(); i-- > 0;) {  // of equal points the first counts
    mesh_.setHeight(vertices[i], metresFromTicks(ticksFromMetres(heights[i])));
  }
}

Result<void> SandSurface::hasRoom(std::size_t vertices) {
  if (vertices < kMostVertices) return {};
  return Error{"the sand has " + std::to_string(vertices) + " vertices, and must have fewer than " +
               std::to_string(kMostVertices) + " to get more"};
}

void SandSurface::fence(const OpenCells& cells) {
  cells_ = cells;
  mesh_.expectWithin(cells_.corner(), cells_.width(), cells_.height());
}

void SandSurface::grow(int west, int south, int columns, int rows) {
  fence(cells_.grown(west, south, columns, rows));
  mesh_.moveTo(-step() * cells_.corner().x, -step() * cells_.corner().y);
}

/// Calls visit(triangle) for all triangles at v and returns their weight.
template <class Visitor>
std::int64_t SandSurface::weigh(VertexId v, Visitor&& visit) const {
  const LatticePoint p = mesh_.point(v);
  std::int64_t sum = 0;
  mesh_.forEachCorner(v, [&](Link at) {
    const std::array<VertexId, 3>& corners = mesh_.corners(at.triangle());
    sum += orientation(p, mesh_.point(corners[following(at.side())]),
                       mesh_.point(corners[preceding(at.side())]));
    visit(at.triangle());
  });
  return sum;
}

std::int64_t SandSurface::weight(VertexId v) const noexcept {
  return weigh(v, [](TriangleId) {});
}

std::int64_t SandSurface::weight(VertexId v, std::vector<TriangleId>& star) const {
  star.clear();
  return weigh(v, [&](TriangleId t) { star.push_back(t); });
}

Face SandSurface::unweighedFace(TriangleId t) const noexcept {
  const std::array<VertexId, 3>& corners = mesh_.corners(t);
  Face face;
  for (std::size_t i = 0; i < 3; ++i) {
    face[i] = {mesh_.point(corners[i]), height(corners[i]), loose_[corners[i]], 0};
  }
  return face;
}

bool SandSurface::isOpen(TriangleId t) const noexcept {
  const std::array<VertexId, 3>& corners = mesh_.corners(t);
  const LatticePoint a = mesh_.point(corners[0]), b = mesh_.point(corners[1]), c = mesh_.point(corners[2]);
  const auto middle = [](std::int32_t one, std::int32_t two, std::int32_t three) {
    return static_cast<std::int32_t>((std::int64_t{one} + two + three) / 3);
  };
  return cells_.isOpen(cells_.columnOf(middle(a.x, b.x, c.x)), cells_.rowOf(middle(a.y, b.y, c.y)));
}

std::int64_t SandSurface::heightAt(LatticePoint p, TriangleId hint) const noexcept {
  return ticksFromMetres(mesh_.heightAt(p, hint));
}

SixfoldVolume SandSurface::volume() const noexcept {
  SixfoldVolume sum = 0;
  for (TriangleId t = 0; t < mesh_.triangleSlots(); ++t) {
    if (!mesh_.isTriangle(t)) continue;
    const Face face = unweighedFace(t);
    sum += static_cast<WideInteger>(orientation(face[0].place, face[1].place, face[2].place)) *
           (face[0].height + face[1].height + face[2].height);
  }
  return sum;
}

void SandSurface::setHeight(VertexId v, std::int64_t ticks) noexcept {
  assert(-kHighestTick <= ticks && ticks <= kHighestTick);
  mesh_.setHeight(v, metresFromTicks(ticks));
}

/// Gives a vertex that has come its height and its loose thickness.
void SandSurface::adopt(VertexId v, std::int64_t ticks, std::int64_t loose) {
  while (v >= loose_.size()) loose_.push_back(kNoLoose);
  loose_[v] = loose;
  setHeight(v, ticks);
}

void SandSurface::begin() {
  changes_.clear();
  touched_.clear();
  fenced_.clear();
  mesh_.recordChanges(&changes_, &fenced_);
}

/// What the recorded changes did to the volume; lists what they touched.
SixfoldVolume SandSurface::finish(const Gone& gone) {
  mesh_.recordChanges(nullptr);
  for (const TriangleId t : fenced_) changedTriangles_.add(t);
  seen_.clear();
  for (const TriangleChange& change : changes_) {
    changedTriangles_.add(change.triangle);
    for (const VertexId v : change.corners) {
      if (v != gone.vertex) seen_.add(v);
    }
  }
  touched_.assign(seen_.ids().begin(), seen_.ids().end());
  adoptCrossings();
  const auto place = [&](VertexId v) { return v == gone.vertex ? gone.place : mesh_.point(v); };
  const auto high = [&](VertexId v) { return v == gone.vertex ? gone.height : height(v); };
  SixfoldVolume change = 0;
  for (const TriangleChange& one : changes_) {
    const auto [a, b, c] = one.corners;
    const SixfoldVolume volume =
        static_cast<WideInteger>(orientation(place(a), place(b), place(c))) * (high(a) + high(b) + high(c));
    change += one.created ? volume : -volume;
  }
  return change;
}

/// Vertices that the triangulation made where constraints cross lie on the surface, but not on a whole tick,
/// and bear as much as their neighbours on average.
void SandSurface::adoptCrossings() {
  for (const VertexId v : touched_) {
    if (v < loose_.size() && loose_[v] != kNoLoose) continue;
    WideInteger sum = 0;
    int count = 0;
    mesh_.forEachNeighbour(v, [&](VertexId n) {
      if (n >= loose_.size() || loose_[n] == kNoLoose) return;
      sum += loose_[n];
      ++count;
    });
    adopt(v, ticksFromMetres(mesh_.height(v)), count > 0 ? static_cast<std::int64_t>(sum / count) : 0);
    changedVertices_.add(v);
  }
}

std::int64_t SandSurface::looseAt(LatticePoint p, TriangleId t) const noexcept {
  const std::array<VertexId, 3>& corners = mesh_.corners(t);
  const LatticePoint a = mesh_.point(corners[0]), b = mesh_.point(corners[1]), c = mesh_.point(corners[2]);
  const WideInteger sum = static_cast<WideInteger>(orientation(p, b, c)) * loose_[corners[0]] +
                          static_cast<WideInteger>(orientation(a, p, c)) * loose_[corners[1]] +
                          static_cast<WideInteger>(orientation(a, b, p)) * loose_[corners[2]];
  return static_cast<std::int64_t>(sum / orientation(a, b, c));
}

/// Adds a vertex on the surface, in triangle t, where none is.
VertexId SandSurface::add(LatticePoint p, TriangleId t) {
  const std::int64_t ticks = heightAt(p, t);
  const std::int64_t loose = looseAt(p, t);
  const VertexId v = mesh_.insert(p, metresFromTicks(ticks), t).vertex;
  adopt(v, ticks, loose);
  changedVertices_.add(v);
  return v;
}

VertexId SandSurface::insert(LatticePoint p, TriangleId hint) {
  const Location place = mesh_.locate(p, hint);
  if (place.kind == Location::Kind::vertex) return mesh_.corners(place.triangle)[place.corner];
  begin();
  const VertexId v = add(p, place.triangle);
  ledger_.enterDue(finish({}));
  return v;
}

VertexId SandSurface::enter(LatticePoint p, std::int64_t ticks, TriangleId hint, std::int64_t loose) {
  const Location place = mesh_.locate(p, hint);
  if (place.kind == Location::Kind::vertex) return mesh_.corners(place.triangle)[place.corner];
  begin();
  const VertexId v = mesh_.insert(p, metresFromTicks(ticks), place.triangle).vertex;
  adopt(v, ticks, loose);
  changedVertices_.add(v);
  entered_ += finish({});
  return v;
}

void SandSurface::enterEdge(VertexId a, VertexId b, std::uint32_t id) {
  begin();
  mesh_.constrain(a, b, id);
  entered_ += finish({});
}

void SandSurface::takeAccount(const SandSurface& other) {
  ledger_.enterDue(-other.due());
  ledger_.enter(other.due() - other.owed());
  entered_ += other.owed();
  moved_ += other.moved_;
}

LatticePoint SandSurface::middle(VertexId a, VertexId b) const noexcept {
  const LatticePoint from = mesh_.point(a), to = mesh_.point(b);
  return {(from.x + to.x) >> 1, (from.y + to.y) >> 1};
}

VertexId SandSurface::divide(VertexId a, VertexId b) {
  const LatticePoint p = middle(a, b);
  if (cells_.isFixed(p)) return kNoVertex;
  if (mesh_.vertexAt(p, mesh_.triangleAt(a)) != kNoVertex) return kNoVertex;
  const auto id = mesh_.constraint(a, b);
  begin();
  if (id) mesh_.unconstrain(a, b);  // it may pass half a step beside
  const VertexId between = add(p, mesh_.locate(p, mesh_.triangleAt(a)).triangle);
  if (id) {
    mesh_.constrain(a, between, *id);
    mesh_.constrain(between, b, *id);
  }
  ledger_.enterDue(finish({}));
  return between;
}

bool SandSurface::remove(VertexId v) {
  if (isFixed(v)) return false;
  const Gone gone{v, mesh_.point(v), height(v)};
  begin();
  const bool removed = mesh_.remove(v);
  if (removed) {
    loose_[v] = kNoLoose;
    changedVertices_.add(v);
  }
  ledger_.enterDue(finish(gone));
  return removed;
}

void SandSurface::constrain(VertexId a, VertexId b, std::uint32_t id) {
  begin();
  mesh_.constrain(a, b, id);
  ledger_.enterDue(finish({}));
}

bool SandSurface::unconstrain(VertexId a, VertexId b) {
  begin();
  const bool found = mesh_.unconstrain(a, b);
  ledger_.enterDue(finish({}));
  return found;
}

void SandSurface::noteMoved(VertexId v) {
  changedVertices_.add(v);
  mesh_.forEachCorner(v, [&](Link at) { changedTriangles_.add(at.triangle()); });
}

/// Returns what that adds to the volume.
SixfoldVolume SandSurface::lift(VertexId v, std::int64_t ticks) {
  if (isFixed(v)) return 0;
  const std::int64_t before = height(v);
  const std::int64_t rise = clamped(before + asTicks(ticks)) - before;
  if (rise == 0) return 0;
  const SixfoldVolume volume = static_cast<WideInteger>(weight(v)) * rise;
  setHeight(v, before + rise);
  loose_[v] = std::max<std::int64_t>(loose_[v] + rise, 0);
  if (rise > 0) moved_ += volume;
  noteMoved(v);
  return volume;
}

void SandSurface::raise(VertexId v, std::int64_t ticks) {
  ledger_.enterDue(lift(v, ticks));
}

void SandSurface::pour(VertexId v, std::int64_t ticks) {
  entered_ += lift(v, ticks);
}

void SandSurface::loosen(VertexId v, std::int64_t depth) {
  if (depth <= loose_[v] || isFixed(v)) return;
  loose_[v] = depth;
  noteMoved(v);
}

void SandSurface::apply(TriangleId t, const Face& face, const FaceMove& move, const Stars& stars) {
  const std::array<VertexId, 3> corners = mesh_.corners(t);
  ledger_.enter(volumeOf(face, move));
  for (std::size_t i = 0; i < 3; ++i) {
    if (move[i] == 0) continue;
    assert(loose_[corners[i]] + move[i] >= 0);
    setHeight(corners[i], face[i].height + move[i]);
    loose_[corners[i]] += move[i];
    if (move[i] > 0) moved_ += static_cast<WideInteger>(face[i].weight) * move[i];
    changedVertices_.add(corners[i]);
    for (const TriangleId at : stars[i]) changedTriangles_.add(at);
  }
}

void SandSurface::settle(std::span<const VertexId> vertices) {
  if (due() == 0 && owed() == 0) return;
  WideInteger weights = 0;
  std::int64_t most = 0;
  VertexId heaviest = kNoVertex;
  for (const VertexId v : vertices) {
    if (isFixed(v)) continue;
    const std::int64_t one = weight(v);
    weights += one;
    if (one > most) {
      most = one;
      heaviest = v;
    }
  }
  if (heaviest == kNoVertex) return;
  const std::int64_t all = ticksNearest(due(), weights);
  if (all != 0) {
    for (const VertexId v : vertices) raise(v, all);
  }
  raise(heaviest, ledger_.payment(most));
  ledger_.settled();
}

void SandSurface::clearChanges() noexcept {
  changedVertices_.clear();
  changedTriangles_.clear();
}

std::size_t SandSurface::bytes() const noexcept {
  return sizeof(*this) - sizeof(mesh_) + mesh_.bytes() + loose_.bytes() + cells_.bytes() +
         changedVertices_.bytes() + changedTriangles_.bytes() + seen_.bytes() +
         changes_.capacity() * sizeof(TriangleChange) + fenced_.capacity() * sizeof(TriangleId) +
         touched_.capacity() * sizeof(VertexId);
}

Result<void> SandSurface::validate() const {
  if (const Result<void> sound = mesh_.validate(); !sound) return sound;
  for (VertexId v = 0; v < mesh_.vertexSlots(); ++v) {
    if (!mesh_.isVertex(v)) continue;
    const std::string name = "vertex " + std::to_string(v);
    if (loose_[v] < 0) return Error{name + " bears less than nothing"};
    if (metresFromTicks(height(v)) != mesh_.height(v)) return Error{name + " lies between two ticks"};
    if (std::fabs(mesh_.height(v)) > metresFromTicks(kHighestTick)) return Error{name + " lies out of range"};
  }
  return {};
}

}  // namespace teren
