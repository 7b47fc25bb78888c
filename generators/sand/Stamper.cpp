#include "generators/sand/Stamper.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "teren/ProcessorTime.h"

namespace teren {
namespace {

constexpr int kMostHalvings = 4;
constexpr double kThinnestWall = 4.0;    // [steps]
constexpr double kShortestFitted = 8.0;  // [steps]
constexpr double kBeside = 0.4;          // of what is heaped up ahead
constexpr double kMostStamps = 65536.0;

/// Deeper than the tool by as much [ticks], 2^-20 m, counts as deeper.
constexpr std::int64_t kDeeperBy = std::int64_t{1} << 18;

/// A tool's point turned into its direction [m].
ToolPoint turned(const ToolPoint& p, const StampPlace& place) noexcept {
  if (place.directionX == 0.0 && place.directionY == 0.0) return p;
  return {std::fma(place.directionX, p.x, -(place.directionY * p.y)),
          std::fma(place.directionY, p.x, place.directionX * p.y)};
}

/// And back: a place on the ground as the tool sees it.
ToolPoint asSeenBy(const SandSurface& surface, LatticePoint p, const StampPlace& place) noexcept {
  const LatticeFrame& frame = surface.mesh().frame();
  const ToolPoint from{frame.placeX(p) - place.x, frame.placeY(p) - place.y};
  if (place.directionX == 0.0 && place.directionY == 0.0) return from;
  return {std::fma(place.directionX, from.x, place.directionY * from.y),
          std::fma(place.directionX, from.y, -(place.directionY * from.x))};
}

double lengthOf(const ToolPoint& p) noexcept {
  return std::sqrt(p.x * p.x + p.y * p.y);
}

bool hasId(const Triangulation& mesh, VertexId a, VertexId b, std::uint32_t id) noexcept {
  if (mesh.constraintsAt(a) == 0 || mesh.constraintsAt(b) == 0) return false;
  const auto found = mesh.constraint(a, b);
  return found && *found == id;
}

}  // namespace

Result<void> Stamper::check(const SandSurface& surface, const ToolShape& tool,
                            const StampPlace& place) const {
  const double numbers[] = {place.x, place.y, place.height, place.directionX, place.directionY};
  if (!std::all_of(std::begin(numbers), std::end(numbers), [](double n) { return std::isfinite(n); })) {
    return Error{"a tool's place, height and direction must be finite numbers"};
  }
  const double length = lengthOf({place.directionX, place.directionY});
  if (length != 0.0 && std::fabs(length - 1.0) > 1e-9) {
    return Error{"a tool's direction must be a vector of length 1 or 0, not " + std::to_string(length)};
  }
  const LatticeFrame& frame = surface.mesh().frame();
  for (const ToolPart& part : tool.parts()) {
    for (std::size_t i = 0; i < part.outer.size(); ++i) {
      const ToolPoint p = turned(part.outer[i], place);
      const auto on = frame.snap(place.x + p.x, place.y + p.y);
      if (!on || frame.isOnBorder(*on)) {
        return Error{"the tool at (" + std::to_string(place.x) + ", " + std::to_string(place.y) +
                     ") reaches beyond the sand"};
      }
      const ToolPoint &out = part.outer[i], &in = part.inner.front()[i];
      if (lengthOf({out.x - in.x, out.y - in.y}) < kThinnestWall * frame.step) {
        return Error{"the tool is too small for this sand: its walls must be at least " +
                     std::to_string(kThinnestWall * frame.step) + " m thick"};
      }
    }
  }
  return {};
}

LatticePoint Stamper::onLattice(const SandSurface& surface, const ToolPoint& p,
                                const StampPlace& place) const {
  const ToolPoint there = turned(p, place);
  const auto snapped = surface.mesh().frame().snap(place.x + there.x, place.y + there.y);
  assert(snapped);
  return *snapped;
}

Result<StampReport> Stamper::stamp(SandSurface& surface, const ToolShape& tool, const StampPlace& place) {
  if (const Result<void> fine = check(surface, tool, place); !fine) return fine.error();
  StampReport report;
  charged_ = threadProcessorTime();
  allRims_.clear();
  allInside_.clear();
  if (!surface.mesh().isVertex(near_)) near_ = 0;
  const SixfoldVolume before = surface.owed();
  for (const ToolPart& part : tool.parts()) press(surface, part, place, report);
  const double step = surface.step();
  report.displaced = asDouble(surface.owed() - before) * kMetresPerTick * step * step / 6.0;
  heapUp(surface, tool, place);
  charge(report.times.berm);
  return report;
}

/// The processor time since the last charge belongs to this part.
void Stamper::charge(double& part) noexcept {
  const std::chrono::nanoseconds now = threadProcessorTime();
  part += std::chrono::duration<double>(now - charged_).count();
  charged_ = now;
}

void Stamper::press(SandSurface& surface, const ToolPart& part, const StampPlace& place,
                    StampReport& report) {
  const Ids ids{nextId_, nextId_ + 1};
  nextId_ += 2;
  outline_.clear();
  for (std::size_t i = 0; i < part.outer.size(); ++i) {
    const LatticePoint a = onLattice(surface, part.outer[i], place);
    outline_.push_back(a);
    fit(surface, a, onLattice(surface, part.outer[(i + 1) % part.outer.size()], place), kMostHalvings);
  }
  enforce(surface, ids.outer, report.times);
  const LatticePoint inside = onLattice(surface, part.inner.front().front(), place);
  flood(surface, inside, ids);
  dissolveInside(surface, ids);
  charge(report.times.constraints);
  forced_.clear();
  for (const ToolOutline& inner : part.inner) {
    outline_.clear();
    for (const ToolPoint& p : inner) outline_.push_back(onLattice(surface, p, place));
    enforce(surface, ids.inner, report.times);
    for (const VertexId v : chain_) forced_.add(v);
  }
  flood(surface, inside, ids);
  report.contour += static_cast<int>(rim_.ids().size() + forced_.ids().size());
  dig(surface, part, place, report);
  charge(report.times.removal);
}

/// Appends the points that divide the way from a to b until the ground between two of them is straight.
void Stamper::fit(SandSurface& surface, LatticePoint a, LatticePoint b, int halvings) {
  const std::int32_t x = b.x - a.x, y = b.y - a.y;
  const double length = lengthOf({static_cast<double>(x), static_cast<double>(y)});
  if (halvings == 0 || length < kShortestFitted) return;
  const TriangleId hint = surface.mesh().triangleAt(near_);
  const std::int64_t from = surface.heightAt(a, hint), to = surface.heightAt(b, hint);
  bool fits = true;
  for (int part = 1; part < 4; ++part) {
    const LatticePoint p{a.x + part * x / 4, a.y + part * y / 4};
    const std::int64_t straight = from + part * ((to - from) / 4);
    const std::int64_t off = surface.heightAt(p, hint) - straight;
    fits = fits && std::fabs(metresFromTicks(off)) <= settings_.fit;
  }
  if (fits) return;
  const LatticePoint middle{a.x + x / 2, a.y + y / 2};
  fit(surface, a, middle, halvings - 1);
  outline_.push_back(middle);
  fit(surface, middle, b, halvings - 1);
}

/// Makes outline_ vertices (in chain_) and a closed chain of constrained edges.
void Stamper::enforce(SandSurface& surface, std::uint32_t id, StampTimes& times) {
  chain_.clear();
  for (const LatticePoint p : outline_) {
    near_ = surface.insert(p, surface.mesh().triangleAt(near_));
    chain_.push_back(near_);
  }
  charge(times.insertion);
  if (chain_.size() < 3) return;
  for (std::size_t i = 0; i < chain_.size(); ++i) {
    surface.constrain(chain_[i], chain_[(i + 1) % chain_.size()], id);
  }
  charge(times.constraints);
}

/// Finds the triangles within the outer outline and their vertices, which of these lie on it, and which on an
/// inner one.
void Stamper::flood(const SandSurface& surface, LatticePoint inside, const Ids& ids) {
  const Triangulation& mesh = surface.mesh();
  insideTriangles_.clear();
  insideVertices_.clear();
  rim_.clear();
  insideTriangles_.add(mesh.locate(inside, mesh.triangleAt(near_)).triangle);
  for (std::size_t n = 0; n < insideTriangles_.ids().size(); ++n) {
    const TriangleId t = insideTriangles_.ids()[n];
    const std::array<VertexId, 3>& corners = mesh.corners(t);
    for (int i = 0; i < 3; ++i) {
      insideVertices_.add(corners[i]);
      const VertexId a = corners[following(i)], b = corners[preceding(i)];
      if (hasId(mesh, a, b, ids.outer)) {
        rim_.add(a);
        rim_.add(b);
        continue;
      }
      if (hasId(mesh, a, b, ids.inner)) {
        forced_.add(a);
        forced_.add(b);
      }
      const TriangleId beyond = mesh.neighbour(t, i);
      if (beyond != kNoTriangle) insideTriangles_.add(beyond);
    }
  }
}

void Stamper::dissolveInside(SandSurface& surface, const Ids& ids) {
  const Triangulation& mesh = surface.mesh();
  edges_.clear();
  for (const TriangleId t : insideTriangles_.ids()) {
    const std::array<VertexId, 3>& corners = mesh.corners(t);
    for (int i = 0; i < 3; ++i) {
      const VertexId a = corners[following(i)], b = corners[preceding(i)];
      if (a > b || mesh.constraintsAt(a) == 0 || mesh.constraintsAt(b) == 0) continue;
      const auto id = mesh.constraint(a, b);
      if (id && *id != ids.outer) edges_.emplace_back(a, b);
    }
  }
  for (const auto& [a, b] : edges_) surface.unconstrain(a, b);
}

/// Lowers what the tool reaches and removes what has become redundant.
void Stamper::dig(SandSurface& surface, const ToolPart& part, const StampPlace& place, StampReport& report) {
  const auto underside = [&](VertexId v) {
    return ticksFromMetres(place.height - part.depth.at(asSeenBy(surface, surface.mesh().point(v), place)));
  };
  const auto isDeeper = [&](VertexId v) {
    return !rim_.contains(v) && surface.height(v) < underside(v) - kDeeperBy;
  };
  const std::int64_t loosening = ticksFromMetres(settings_.loosening);
  bool cuts = false;
  const auto cut = [&](VertexId v) {
    const std::int64_t deep = underside(v);
    if (deep >= surface.height(v)) return;
    surface.raise(v, deep - surface.height(v));
    surface.loosen(v, loosening);
    cuts = true;
  };
  for (const VertexId v : forced_.ids()) cut(v);
  for (const VertexId v : insideVertices_.ids()) {
    if (rim_.contains(v) || forced_.contains(v)) {
      allInside_.add(v);
      continue;
    }
    bool kept = isDeeper(v);
    if (!kept) {
      surface.mesh().forEachNeighbour(v, [&](VertexId n) { kept = kept || isDeeper(n); });
      cut(v);
    }
    if (!kept && surface.remove(v)) {
      ++report.removed;
    } else {
      allInside_.add(v);
    }
  }
  for (const VertexId v : rim_.ids()) {
    allRims_.add(v);
    if (cuts) surface.loosen(v, loosening);
  }
  near_ = rim_.ids().front();
}

/// Lists what may be heaped up upon, in around_, and in share_ how much of the height of a berm each gets.
void Stamper::collectBerm(const SandSurface& surface, const ToolShape& tool, const StampPlace& place) {
  const bool straightDown = place.directionX == 0.0 && place.directionY == 0.0;
  const double width = settings_.bermWidth * tool.reach();
  around_.clear();
  share_.clear();
  for (const VertexId v : allRims_.ids()) around_.add(v);
  for (std::size_t n = 0; n < around_.ids().size(); ++n) {
    const VertexId v = around_.ids()[n];
    const ToolPoint at = asSeenBy(surface, surface.mesh().point(v), place);
    const double distance = lengthOf(at);
    const double beyond = std::max(distance - tool.reach(), 0.0);
    const double ahead = straightDown || distance == 0.0 ? 1.0 : kBeside + at.x / distance;
    const double near = width > 0.0 ? 1.0 - beyond / width : beyond > 0.0 ? 0.0 : 1.0;
    share_.push_back(std::max(near, 0.0) * std::clamp(ahead, 0.0, 1.0));
    if (near <= 0.0) continue;
    surface.mesh().forEachNeighbour(v, [&](VertexId w) {
      if (!allInside_.contains(w)) around_.add(w);
    });
  }
}

/// Pays what is due with a berm.
void Stamper::heapUp(SandSurface& surface, const ToolShape& tool, const StampPlace& place) {
  collectBerm(surface, tool, place);
  double weights = 0.0;
  VertexId heaviest = kNoVertex;
  std::int64_t most = 0;
  for (std::size_t n = 0; n < share_.size(); ++n) {
    if (share_[n] == 0.0) continue;
    const std::int64_t weight = surface.weight(around_.ids()[n]);
    weights += share_[n] * static_cast<double>(weight);
    if (weight > most) {
      most = weight;
      heaviest = around_.ids()[n];
    }
  }
  if (heaviest == kNoVertex) {
    surface.settle(allRims_.ids());
    return;
  }
  const double rise = asDouble(surface.due()) / weights * kMetresPerTick;
  for (std::size_t n = 0; n < share_.size(); ++n) {
    surface.raise(around_.ids()[n], ticksFromMetres(rise * share_[n]));
  }
  surface.settle({&heaviest, 1});
}

std::size_t Stamper::bytes() const noexcept {
  return sizeof(*this) + outline_.capacity() * sizeof(LatticePoint) + chain_.capacity() * sizeof(VertexId) +
         edges_.capacity() * sizeof(edges_[0]) + insideTriangles_.bytes() + insideVertices_.bytes() +
         rim_.bytes() + forced_.bytes() + allRims_.bytes() + allInside_.bytes() + around_.bytes() +
         share_.capacity() * sizeof(double);
}

double stampSpacing(double speed, const ToolShape& tool) noexcept {
  const double way = speed / 60.0;
  const double least = tool.reach() / 8.0, most = tool.reach() / 2.0;
  return way > least ? std::min(way, most) : least;
}

std::vector<StampPlace> stampsAlong(const StampPlace& from, const StampPlace& to, double spacing) {
  const double x = to.x - from.x, y = to.y - from.y;
  const double length = lengthOf({x, y});
  std::vector<StampPlace> places;
  if (!(length > 0.0) || !(spacing > 0.0) || !std::isfinite(length)) return places;
  const double count = std::min(-std::floor(-length / spacing), kMostStamps);
  for (double n = 1.0; n <= count; n += 1.0) {
    const double part = n / count;
    places.push_back({from.x + part * x, from.y + part * y, from.height + part * (to.height - from.height),
                      x / length, y / length});
  }
  return places;
}

}  // namespace teren
