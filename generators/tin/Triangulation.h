// A surface of triangles over scattered points that can be changed anywhere at any time: a constrained
// Delaunay triangulation whose every decision is exact.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "teren/Result.h"

#include "generators/tin/ConstraintTable.h"
#include "generators/tin/JumpGrid.h"
#include "generators/tin/LatticeFrame.h"
#include "generators/tin/TriangleMesh.h"

namespace teren {

/// What lies at a point.
struct Location {
  enum class Kind { face, edge, vertex };
  Kind kind = Kind::face;
  TriangleId triangle = kNoTriangle;
  int corner = 0;  // vertex: which one; edge: the corner opposite it; face: 0
};

/// A triangle that an operation took away or made.
struct TriangleChange {
  std::array<VertexId, 3> corners;  // counter-clockwise
  bool created = false;
  TriangleId triangle = kNoTriangle;
};

/// What an insertion came to.
struct Insertion {
  VertexId vertex = kNoVertex;
  bool isNew = false;  // false: there was a vertex already, and it keeps its height
};

/// The triangulation of a box (LatticeFrame) whose four corners are vertices that stay; so every point of the
/// box lies in a triangle, and a point outside is refused. Edges are Delaunay: the circle around each
/// triangle holds no vertex that can be seen from inside it across no constrained edge. Where four vertices
/// lie on one circle either diagonal may stand; which one depends on the history, and is the same on every
/// machine.
///
/// Points are lattice points; orientation is decided in 64 bits, in-circle in 128 (LatticePoint.h), so
/// collinear and cocircular points are nothing special. Heights [m] are any finite numbers in an array of
/// their own, and decide nothing.
///
/// Memory: 16 bytes a vertex, 8 its height, 48 its two triangles, 1 to 4 the jump grid's, 16 to 64 a
/// constrained edge; arrays grow by an eighth. Below, k is the number of neighbours of the vertex at hand, 6
/// on average.
///
/// Ids of living vertices and triangles are stable, except that an operation may change any triangle it
/// reports. A removed vertex's is given out again. Const functions may run in several threads at once while
/// no other runs. A copy goes on recording changes into the same list. A broken precondition is an assert.
class Triangulation {
 public:
  /// Four vertices, 0 ... 3 from south-west counter-clockwise, at `height` [m]. Sides of 1 ... kLatticeSide.
  explicit Triangulation(const LatticeFrame& frame, double height = 0.0);

  /// Room for so many vertices in all, exactly.
  void reserve(std::size_t vertices);

  const LatticeFrame& frame() const noexcept { return frame_; }
  /// The box lies with its south-west corner at (x, y) [m] from now on, and all that is in it moves along.
  void moveTo(double x, double y) noexcept { frame_.x = x, frame_.y = y; }
  /// Most vertices will be in this part of the box: helps searches there, and decides nothing. O(n).
  void expectWithin(LatticePoint corner, std::int32_t width, std::int32_t height);
  std::size_t vertexCount() const noexcept { return mesh_.vertexCount(); }
  std::size_t triangleCount() const noexcept { return mesh_.triangleCount(); }
  std::size_t constraintCount() const noexcept { return table_.size(); }
  /// Every byte held, unused capacity included.
  std::size_t bytes() const noexcept;

  /// Ids are below these; not every one is in use.
  VertexId vertexSlots() const noexcept { return static_cast<VertexId>(mesh_.vertexSlots()); }
  TriangleId triangleSlots() const noexcept { return static_cast<TriangleId>(mesh_.triangleSlots()); }
  bool isVertex(VertexId v) const noexcept { return mesh_.isVertex(v); }
  bool isTriangle(TriangleId t) const noexcept { return mesh_.isTriangle(t); }

  LatticePoint point(VertexId v) const noexcept { return mesh_.point(v); }
  double height(VertexId v) const noexcept { return heights_[v]; }
  void setHeight(VertexId v, double height) noexcept { heights_[v] = height; }
  bool isOnBorder(VertexId v) const noexcept { return frame_.isOnBorder(mesh_.point(v)); }
  /// How many constrained edges end at v.
  std::uint32_t constraintsAt(VertexId v) const noexcept { return mesh_.constraints(v); }
  /// Some triangle at v: the hint for what happens near v next.
  TriangleId triangleAt(VertexId v) const noexcept { return mesh_.star(v).triangle(); }
  /// Counter-clockwise.
  const std::array<VertexId, 3>& corners(TriangleId t) const noexcept { return mesh_.triangle(t).vertex; }
  /// Whether the side opposite corner i is a constrained edge.
  bool isConstrained(TriangleId t, int i) const noexcept;
  /// Across the side opposite corner i; kNoTriangle beyond the border.
  TriangleId neighbour(TriangleId t, int i) const noexcept {
    const Link over = mesh_.triangle(t).link[i];
    return over.isOutside() ? kNoTriangle : over.triangle();
  }

  /// visit(corner): every triangle at v counter-clockwise, as the corner where v is. O(k).
  template <class Visitor>
  void forEachCorner(VertexId v, Visitor&& visit) const {
    const Link first = mesh_.firstAround(v, isOnBorder(v));
    Link at = first;
    do {
      visit(at);
      at = mesh_.nextAround(at);
    } while (!at.isOutside() && at != first);
  }
  /// visit(vertex): the neighbours of v counter-clockwise; on the border the first and the last lie there.
  /// O(k).
  template <class Visitor>
  void forEachNeighbour(VertexId v, Visitor&& visit) const {
    Link last;
    forEachCorner(v, [&](Link at) {
      visit(mesh_.triangle(at.triangle()).vertex[following(at.side())]);
      last = at;
    });
    if (mesh_.nextAround(last).isOutside()) {
      visit(mesh_.triangle(last.triangle()).vertex[preceding(last.side())]);
    }
  }
  /// visit(a, b, id) for every constrained edge, a < b. O(edges).
  template <class Visitor>
  void forEachConstraint(Visitor&& visit) const {
    table_.forEach(visit);
  }

  /// What lies at p, which must be in the box; on an edge, the triangle left of the way from its western (or
  /// southern) end; at a vertex triangleAt(). The search starts at the hint, any id, or from the jump grid,
  /// whichever is nearer, and walks: O(1) expected for points that are spread, O(sqrt(n)) at worst in
  /// practice.
  Location locate(LatticePoint p, TriangleId hint = kNoTriangle) const noexcept;
  /// The vertex at p, or kNoVertex.
  VertexId vertexAt(LatticePoint p, TriangleId hint = kNoTriangle) const noexcept;
  /// The surface's height [m] at a lattice point of the box: exactly the vertex's at a vertex; on an edge a
  /// function of its two ends alone. Elsewhere rounded, off by at most 8 ulp of the largest of three heights.
  double heightAt(LatticePoint p, TriangleId hint = kNoTriangle) const noexcept;
  /// The same for a point that has been located.
  double heightAt(LatticePoint p, const Location& place) const noexcept;

  /// The height [m] at any place [m], taken to the nearest 2^-24 of a step; nothing where it is outside the
  /// box or not a number. At lattice points the same bits as above, on edges again from both sides.
  std::optional<double> heightAt(double x, double y, TriangleId hint = kNoTriangle) const noexcept;

  /// Adds a vertex. Where there is one already, nothing changes. The height must be finite.
  Insertion insert(LatticePoint p, double height, TriangleId hint = kNoTriangle);
  /// Adds a vertex on the surface as it is: heightAt(p).
  Insertion insertOnSurface(LatticePoint p, TriangleId hint = kNoTriangle);
  /// Adds a vertex at the lattice point nearest to a place [m]; an error outside the box or where not finite.
  Result<Insertion> insert(double x, double y, double height, TriangleId hint = kNoTriangle);
  /// Adds many vertices in an order of its own, several times faster than one by one; their ids follow a
  /// space-filling curve. As many heights as points; of equal points the one that comes first counts. Where
  /// they are no fewer than the vertices there were, all triangles are renumbered so that near ones are near
  /// in memory. Returns the vertex of each point.
  std::vector<VertexId> insert(std::span<const LatticePoint> points, std::span<const double> heights);

  /// Takes a vertex away and closes the gap. False, and nothing changes, where it is one of the box's corners
  /// or the end of a constrained edge. O(k log k).
  bool remove(VertexId v);

  /// Makes the way from a to b consist of constrained edges, and gives them the id; an edge that is
  /// constrained already gets the new one. Vertices on the way divide it. Where it crosses a constrained
  /// edge, the crossing is rounded to the lattice and becomes a vertex of both, on the surface (at the height
  /// found there before), and the four pieces are inserted instead, which bend to vertices within half a step
  /// and may cross others; pieces of the older constraint leave edges of other ids as they are. Returns how
  /// many vertices crossings added. O(edges crossed), expected.
  int constrain(VertexId a, VertexId b, std::uint32_t id);
  /// Makes a constrained edge an ordinary one, which may then be flipped away. False where the two vertices
  /// do not share a constrained edge.
  bool unconstrain(VertexId a, VertexId b);
  /// The id of the constrained edge between two vertices.
  std::optional<std::uint32_t> constraint(VertexId a, VertexId b) const noexcept;
  bool isEdge(VertexId a, VertexId b) const noexcept { return !findEdge(a, b).isOutside(); }

  /// Names a triangle's corners from this one on, and makes it the first that is found at them: so a mesh's
  /// order can be made independent of how it came about.
  void turn(TriangleId t, VertexId first) noexcept;

  /// From now on every operation appends each triangle it takes away and each it makes, in order, to the
  /// list; nullptr: to none. A triangle may come and go within one operation. So the change of any integral
  /// is the sum over the created minus the sum over the removed, at heights as during the operation. `fenced`
  /// gets triangles of which a side becomes or ceases to be constrained. Both lists are the caller's.
  void recordChanges(std::vector<TriangleChange>* changes, std::vector<TriangleId>* fenced = {}) noexcept {
    changes_ = changes;
    fenced_ = fenced;
  }

  /// Proves every promise: triangles turn left and fill the box, neighbours agree, edges are constrained
  /// Delaunay, vertices, counters and constraints are consistent. The error names the first breach. O(n).
  Result<void> validate() const;
  /// The same for the triangles at v and their edges. O(k).
  Result<void> validateAround(VertexId v) const;

 private:
  friend class SandState;  // archives
  /// One side of a gap in the mesh: it begins at `from`; beyond it lies `outer`.
  struct Rim {
    VertexId from = kNoVertex;
    Link outer;
  };
  /// One corner of the gap that a removed vertex leaves, as seen from there.
  struct RingCorner {
    Rim rim;
    std::int64_t x = 0, y = 0;            // [steps] from the removed vertex
    std::uint32_t before = 0, after = 0;  // its neighbours among the corners that are left
    double time = 0.0;                    // when its ear is due; infinite where it may not be cut
  };

  struct Edge {
    VertexId a = kNoVertex, b = kNoVertex;
  };
  /// A way that is yet to be made of constrained edges.
  struct Piece {
    VertexId a = kNoVertex, b = kNoVertex;
    std::uint32_t id = 0;
    bool bends = false;  // came of a crossing, and is rounded anyway
  };
  /// How far a way leads: to a vertex on it, or to one near it, or else to one side of a barrier.
  struct Way {
    VertexId end = kNoVertex;
    VertexId detour = kNoVertex;
    Link barrier;
  };

  /// When a corner's ear is due; the first of a heap is due first.
  struct Due {
    double time = 0.0;
    std::uint32_t corner = 0;
    bool operator<(const Due& other) const noexcept {
      return time != other.time ? time > other.time : corner > other.corner;
    }
  };

  void note(TriangleId t, bool created) {
    if (changes_ != nullptr) changes_->push_back({mesh_.triangle(t).vertex, created, t});
  }

  // Triangulation.cpp
  TriangleId startFor(LatticePoint p, TriangleId hint) const noexcept;
  Location walk(LatticePoint p, TriangleId start) const noexcept;
  Link leftOf(Link side) const noexcept;
  Link findEdge(VertexId a, VertexId b) const noexcept;
  void rebuildGrid();

  // Insertion.cpp
  VertexId newVertex(LatticePoint p, double height);
  std::vector<VertexId> insertMany(std::span<const LatticePoint> points, std::span<const double> heights,
                                   std::vector<std::uint32_t> order);
  void insertAt(VertexId v, const Location& place);
  void dig(LatticePoint p, TriangleId t, int firstSide, int sides);
  void fillWithFan(VertexId v, bool closed);

  // Removal.cpp
  void collectRing(VertexId v);
  double earTime(const RingCorner& b) const noexcept;
  void reschedule(std::uint32_t corner, bool queued);
  std::uint32_t firstDue(std::uint32_t any, bool queued);
  void cutEars();
  void fillQuadrangle(std::uint32_t first);
  TriangleId fillTriangle(const Rim& a, const Rim& b, const Rim& c);

  // Flipping.cpp
  void flip(Link side);
  void restore();
  void setConstrained(Link side, std::uint32_t id);
  void noteFence(Link side);

  // Constraining.cpp
  static bool isNearWay(LatticePoint a, LatticePoint b, LatticePoint w, std::int64_t turn) noexcept;
  Way trace(VertexId a, VertexId b, bool bends);
  void flipAway(VertexId a, VertexId b);
  void forceEdge(VertexId a, VertexId b, std::uint32_t id);
  bool cross(const Piece& piece, Link barrier);
  void bendTo(VertexId x);

  // Validation.cpp
  Result<void> validateTriangle(TriangleId t) const;

  LatticeFrame frame_;
  TriangleMesh mesh_;
  CompactArray<double> heights_;
  ConstraintTable table_;
  JumpGrid grid_;
  std::vector<TriangleChange>* changes_ = nullptr;
  std::vector<TriangleId>* fenced_ = nullptr;

  // Kept between operations so that they allocate nothing.
  std::vector<Rim> rim_, pending_;
  std::vector<TriangleId> freed_;
  std::vector<RingCorner> ring_;
  std::vector<Due> due_;
  std::vector<Link> suspects_;
  std::vector<Edge> crossed_, made_;
  std::vector<Piece> pieces_;
};

}  // namespace teren
