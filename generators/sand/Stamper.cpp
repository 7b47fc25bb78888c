#include "generators/sand/Stamper.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "teren/ProcessorTime.h"

#include "generators/sand/OutlineClip.h"

namespace teren {
namespace {

constexpr int kMostHalvings = 4;
constexpr double kThinnestWall = 8.0;    // [steps]
constexpr double kShortestFitted = 8.0;  // [steps]
constexpr double kBeside = 0.4;          // of what is heaped up ahead
constexpr double kMostStamps = 65536.0;
/// A pushed tool's berm would rise by more than so many times its depth: hardly anything lies ahead.
constexpr double kHighestBerm = 16.0;

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

/// Whether what lies at a point is an edge of this id, or a vertex of one.
bool touches(const Triangulation& mesh, const Location& place, std::uint32_t id) noexcept {
  const std::array<VertexId, 3>& corners = mesh.corners(place.triangle);
  const VertexId a = corners[following(place.corner)], b = corners[preceding(place.corner)];
  if (place.kind != Location::Kind::vertex) {
    return place.kind == Location::Kind::edge && hasId(mesh, a, b, id);
  }
  bool found = false;
  const VertexId v = corners[place.corner];
  mesh.forEachNeighbour(v, [&](VertexId n) { found = found || hasId(mesh, v, n, id); });
  return found;
}

/// The parts of an outline that lie in the box, where the tool is pressed in.
std::vector<LatticeChain> placed(const SandSurface& surface, const ToolPart& part, const ToolOutline& outline,
                                 const StampPlace& place) {
  ToolOutline there;
  for (const ToolPoint& p : outline) {
    const ToolPoint from = turned(p, place);
    there.push_back({place.x + from.x, place.y + from.y});
  }
  return clippedOutline(surface.mesh().frame(), there, 0.5 * part.wall);
}

/// Whether a point lies within an outline.
bool contains(const ToolOutline& outline, const ToolPoint& p) noexcept {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const ToolPoint &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    const double turn = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    if ((turn > 0.0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
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
  if (Result<void> room = SandSurface::hasRoom(surface.mesh().vertexCount()); !room) return room;
  bool reaches = false, covers = false;
  for (const ToolPart& part : tool.parts()) {
    if (!(part.wall >= kThinnestWall * surface.step())) {
      return Error{"the tool is too small for this sand: its walls must be at least " +
                   std::to_string(kThinnestWall * surface.step()) + " m thick"};
    }
    const bool bottom = !placed(surface, part, part.inner.front(), place).empty();
    reaches = reaches || bottom;
    covers = covers || (bottom && placed(surface, part, part.outer, place).empty());
  }
  if (reaches && !covers) return {};
  return Error{"the tool at (" + std::to_string(place.x) + ", " + std::to_string(place.y) +
               ") lies beyond the sand or covers all of it"};
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

void Stamper::take(const Stamper& other, std::span<const VertexId> taken) {
  nextId_ += other.nextId_ - 1;
  const auto add = [taken](ChangeList& list, VertexId v) {
    if (v < taken.size() && taken[v] != kNoVertex) list.add(taken[v]);
  };
  for (const VertexId v : other.allRims_.ids()) add(allRims_, v);
  for (const VertexId v : other.allInside_.ids()) add(allInside_, v);
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
  bottom_.clear();
  for (const LatticeChain& chain : placed(surface, part, part.inner.front(), place)) {
    bottom_.insert(bottom_.end(), chain.points.begin(), chain.points.end());
  }
  if (bottom_.empty()) return;
  enforceOuter(surface, part, place, ids.outer, report.times);
  flood(surface, ids);
  dissolveInside(surface, ids);
  charge(report.times.constraints);
  enforceInner(surface, part, place, ids.inner, report.times);
  flood(surface, ids);
  report.contour += static_cast<int>(rim_.ids().size() + forced_.ids().size());
  dig(surface, part, place, report);
  charge(report.times.removal);
}

void Stamper::enforceOuter(SandSurface& surface, const ToolPart& part, const StampPlace& place,
                           std::uint32_t id, StampTimes& times) {
  for (const LatticeChain& chain : placed(surface, part, part.outer, place)) {
    const std::vector<LatticePoint>& points = chain.points;
    outline_.clear();
    for (std::size_t i = 0; i < points.size(); ++i) {
      outline_.push_back(points[i]);
      if (chain.closed || i + 1 < points.size()) {
        fit(surface, points[i], points[(i + 1) % points.size()], kMostHalvings);
      }
    }
    enforce(surface, chain.closed, id, times);
  }
}

void Stamper::enforceInner(SandSurface& surface, const ToolPart& part, const StampPlace& place,
                           std::uint32_t id, StampTimes& times) {
  forced_.clear();
  for (const ToolOutline& inner : part.inner) {
    for (const LatticeChain& chain : placed(surface, part, inner, place)) {
      outline_.assign(chain.points.begin(), chain.points.end());
      enforce(surface, chain.closed, id, times);
      for (const VertexId v : chain_) forced_.add(v);
    }
  }
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

/// Makes outline_ vertices (in chain_) and a chain of constrained edges.
void Stamper::enforce(SandSurface& surface, bool closed, std::uint32_t id, StampTimes& times) {
  chain_.clear();
  for (const LatticePoint p : outline_) {
    near_ = surface.insert(p, surface.mesh().triangleAt(near_));
    chain_.push_back(near_);
  }
  charge(times.insertion);
  for (std::size_t i = 1; i < chain_.size(); ++i) surface.constrain(chain_[i - 1], chain_[i], id);
  if (closed && chain_.size() > 2) surface.constrain(chain_.back(), chain_.front(), id);
  charge(times.constraints);
}

/// Finds the triangles around bottom_ within the outer outline and their vertices, which of these lie on it,
/// and which on an inner one.
void Stamper::flood(const SandSurface& surface, const Ids& ids) {
  const Triangulation& mesh = surface.mesh();
  insideTriangles_.clear();
  insideVertices_.clear();
  rim_.clear();
  for (const LatticePoint p : bottom_) {
    const Location place = mesh.locate(p, mesh.triangleAt(near_));
    if (!touches(mesh, place, ids.outer)) insideTriangles_.add(place.triangle);
  }
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
  const auto staysInWall = [&](VertexId v) {  // a corner of the box between the outlines
    return v < 4 && !contains(part.inner.front(), asSeenBy(surface, surface.mesh().point(v), place));
  };
  for (const VertexId v : insideVertices_.ids()) {
    if (rim_.contains(v) || forced_.contains(v) || staysInWall(v)) {
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
}

/// Lists what may be heaped up upon, in around_, and in share_ how much of the height of a berm each gets.
/// Returns the height [m] of a berm of what is due; infinite where nothing has a share.
double Stamper::collectBerm(const SandSurface& surface, const ToolShape& tool, const StampPlace& place,
                            bool directed) {
  const double width = settings_.bermWidth * tool.reach();
  around_.clear();
  share_.clear();
  heaviest_ = kNoVertex;
  double weights = 0.0;
  std::int64_t most = 0;
  for (const VertexId v : allRims_.ids()) around_.add(v);
  for (std::size_t n = 0; n < around_.ids().size(); ++n) {
    const VertexId v = around_.ids()[n];
    const ToolPoint at = asSeenBy(surface, surface.mesh().point(v), place);
    const double distance = lengthOf(at);
    const double beyond = std::max(distance - tool.reach(), 0.0);
    const double ahead = !directed || distance == 0.0 ? 1.0 : kBeside + at.x / distance;
    const double near = width > 0.0 ? 1.0 - beyond / width : beyond > 0.0 ? 0.0 : 1.0;
    share_.push_back(surface.isFixed(v) ? 0.0 : std::max(near, 0.0) * std::clamp(ahead, 0.0, 1.0));
    if (share_.back() > 0.0) {
      const std::int64_t weight = surface.weight(v);
      weights += share_.back() * static_cast<double>(weight);
      if (weight > most) heaviest_ = v;
      most = std::max(most, weight);
    }
    if (near <= 0.0) continue;
    surface.mesh().forEachNeighbour(v, [&](VertexId w) {
      if (!allInside_.contains(w)) around_.add(w);
    });
  }
  return weights > 0.0 ? asDouble(surface.due()) / weights * kMetresPerTick : HUGE_VAL;
}

/// Pays what is due with a berm.
void Stamper::heapUp(SandSurface& surface, const ToolShape& tool, const StampPlace& place) {
  const bool directed = place.directionX != 0.0 || place.directionY != 0.0;
  double rise = collectBerm(surface, tool, place, directed);
  if (directed && rise > kHighestBerm * tool.depth()) rise = collectBerm(surface, tool, place, false);
  if (heaviest_ == kNoVertex) {
    surface.settle(allRims_.ids());
    return;
  }
  for (std::size_t n = 0; n < share_.size(); ++n) {
    surface.raise(around_.ids()[n], ticksFromMetres(rise * share_[n]));
  }
  surface.settle({&heaviest_, 1});
}

std::size_t Stamper::bytes() const noexcept {
  return sizeof(*this) + (outline_.capacity() + bottom_.capacity()) * sizeof(LatticePoint) +
         chain_.capacity() * sizeof(VertexId) + edges_.capacity() * sizeof(edges_[0]) +
         insideTriangles_.bytes() + insideVertices_.bytes() + rim_.bytes() + forced_.bytes() +
         allRims_.bytes() + allInside_.bytes() + around_.bytes() + share_.capacity() * sizeof(double);
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
