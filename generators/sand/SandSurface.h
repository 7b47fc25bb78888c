// A surface of sand: solid ground and what lies loose on it, on a triangulation, with an exact account of
// volume.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "teren/Result.h"

#include "generators/sand/ChangeList.h"
#include "generators/sand/FaceSlide.h"
#include "generators/sand/OpenCells.h"
#include "generators/sand/Ticks.h"
#include "generators/sand/VolumeLedger.h"
#include "generators/tin/Triangulation.h"

namespace teren {

/// Every vertex has a height, a whole number of ticks, and of that a thickness of loose material >= 0; what
/// is below is solid. Heights are those of the triangulation, whose doubles hold ticks exactly.
///
/// volume() + owed() - entered() never changes: every operation enters what it did to the volume of the
/// piecewise linear surface, flips and crossings included, in exact integers. It does not pay at once;
/// settle() does, from vertices of the caller's choice. Solid and loose are interpolated where a vertex
/// comes; which of the two a given volume is, is not accounted for.
///
/// A surface may have a fence (OpenCells): vertices that are fixed keep their height, bear nothing loose and
/// stay, whatever they are asked for; what they should pay others pay, or it remains due.
///
/// Costs: an operation's own in Triangulation; k neighbours make a weight O(k). Memory: 8 bytes a vertex
/// beside the triangulation, and 1 bit a vertex and a triangle for the lists of what changed. One thread.
class SandSurface {
 public:
  /// More would leave no triangle's id for one more tool: 2^28 less 2^22.
  static constexpr std::size_t kMostVertices = (std::size_t{1} << 28) - (std::size_t{1} << 22);
  /// One sentence where a surface of so many vertices may not get more.
  static Result<void> hasRoom(std::size_t vertices);

  /// A level box; `loose` [m] of it is loose, at least 0; heights are clamped to +-16384 m.
  SandSurface(const LatticeFrame& frame, double height, double loose);
  /// Ground through points with a height [m] each, as many of both, at most kMostVertices. A corner of the
  /// box that is not among them has the first one's height, or 0. Room for `spare` vertices more is set
  /// aside, which keeps growing cheap.
  SandSurface(const LatticeFrame& frame, std::span<const LatticePoint> points,
              std::span<const double> heights, double loose, std::size_t spare = 0);

  const Triangulation& mesh() const noexcept { return mesh_; }
  /// Closes all squares of a grid: for a box to which its ground comes square by square (Opening.h).
  void fence(const OpenCells& cells);
  const OpenCells& cells() const noexcept { return cells_; }
  void open(int column, int row) { cells_.open(column, row); }
  void open(const OpenCells& other, int column, int row) { cells_.take(other, column, row); }
  /// OpenCells::grown. The corner of the squares has the place (0, 0) m, before and from then on.
  void grow(int west, int south, int columns, int rows);
  /// Whether a triangle lies in open squares: none lies on both sides of the fence.
  bool isOpen(TriangleId t) const noexcept;
  bool isFixed(VertexId v) const noexcept { return cells_.isFixed(mesh_.point(v)); }
  double step() const noexcept { return mesh_.frame().step; }  // [m]
  std::int64_t height(VertexId v) const noexcept { return ticksOf(mesh_.height(v)); }
  std::int64_t loose(VertexId v) const noexcept { return loose_[v]; }
  std::int64_t solid(VertexId v) const noexcept { return height(v) - loose_[v]; }
  /// Twice the area of all triangles at v [steps^2].
  std::int64_t weight(VertexId v) const noexcept;
  /// The same; these triangles replace what is in the list.
  std::int64_t weight(VertexId v, std::vector<TriangleId>& star) const;
  /// The corners of a triangle without their weights, which are 0, and as if none were fixed.
  Face unweighedFace(TriangleId t) const noexcept;
  /// Height [ticks] of the triangles at a lattice point of the box, rounded.
  std::int64_t heightAt(LatticePoint p, TriangleId hint) const noexcept;

  /// Loose thickness [ticks] at a point of a triangle, between its corners', rounded down.
  std::int64_t looseAt(LatticePoint p, TriangleId t) const noexcept;

  /// Sixfold, exactly [ticks steps^2]. O(n).
  SixfoldVolume volume() const noexcept;
  const VolumeLedger& ledger() const noexcept { return ledger_; }
  SixfoldVolume owed() const noexcept { return ledger_.owed(); }
  /// Of that, what operations other than slides changed since the last settle() [ticks steps^2, sixfold].
  SixfoldVolume due() const noexcept { return ledger_.due(); }
  /// All the volume that slides, stamps and settling have raised, sixfold [ticks steps^2]: what drift is
  /// measured against.
  SixfoldVolume volumeMoved() const noexcept { return moved_; }
  /// All the volume that was added from outside: ground that entered, sand that was poured.
  SixfoldVolume entered() const noexcept { return entered_; }

  /// Adds a vertex on the surface, or finds the one that is there.
  VertexId insert(LatticePoint p, TriangleId hint = kNoTriangle);
  /// Ground enters: a vertex at a height of its own, solid but for `loose` ticks, or the one that is there;
  /// and an edge of it as Triangulation::constrain. What that does to the volume is entered().
  VertexId enter(LatticePoint p, std::int64_t ticks, TriangleId hint = kNoTriangle, std::int64_t loose = 0);
  void enterEdge(VertexId a, VertexId b, std::uint32_t id);
  /// The ground of another surface has entered, and with it all that this one owes.
  void takeAccount(const SandSurface& other);
  /// Triangulation::turn.
  void turn(TriangleId t, VertexId first) noexcept { mesh_.turn(t, first); }
  /// Half way between two vertices, rounded down to a step.
  LatticePoint middle(VertexId a, VertexId b) const noexcept;
  /// Adds a vertex in the middle() of an edge; a constraint goes through it. kNoVertex, and nothing changes,
  /// where there is one already.
  VertexId divide(VertexId a, VertexId b);
  /// False, and nothing changes, at a corner of the box or the end of a constrained edge.
  bool remove(VertexId v);
  /// As Triangulation::constrain; vertices at crossings are put on the surface.
  void constrain(VertexId a, VertexId b, std::uint32_t id);
  bool unconstrain(VertexId a, VertexId b);

  /// Raises a vertex by some ticks, up to its limit at most. What comes is loose; what goes is loose as far
  /// as that lasts, then solid.
  void raise(VertexId v, std::int64_t ticks);
  /// Raises it by loose material from outside.
  void pour(VertexId v, std::int64_t ticks);
  /// Makes material loose down to this depth [ticks] below the surface.
  void loosen(VertexId v, std::int64_t depth);
  /// The triangles at each corner of a face.
  using Stars = std::array<std::vector<TriangleId>, 3>;
  /// A slide: no corner may fall by more than its loose thickness.
  void apply(TriangleId t, const Face& face, const FaceMove& move, const Stars& stars);

  /// Pays what is due: all these vertices, different ones, rise by as many whole ticks as come nearest, the
  /// heaviest by what is left, and by a tick more where that lessens what is owed beside. So |owed| ends at
  /// half the heaviest's weight or at the old debt, whichever is more, however large that debt; only where a
  /// height comes to its limit more remains. Fixed vertices do not pay. Nothing without others.
  void settle(std::span<const VertexId> vertices);
  /// The triangles that the last insertion, division, removal or (un)constraining took or made, in order; a
  /// flip counts four, and one may come and go.
  std::span<const TriangleChange> lastChanges() const noexcept { return changes_; }
  /// Their corners that remain.
  std::span<const VertexId> lastTouched() const noexcept { return touched_; }

  /// Vertices that rose, fell, came, went or became loose, and triangles that came, went, lie at such
  /// vertices, or of which a side became or ceased to be constrained, since clearChanges().
  const ChangeList& changedVertices() const noexcept { return changedVertices_; }
  const ChangeList& changedTriangles() const noexcept { return changedTriangles_; }
  void clearChanges() noexcept;

  /// Every byte held, unused capacity included.
  std::size_t bytes() const noexcept;
  /// The triangulation's promises, and that heights are ticks in range and no thickness is negative. O(n).
  Result<void> validate() const;

 private:
  friend class SandState;  // archives

  /// A vertex as it was before it was removed.
  struct Gone {
    VertexId vertex = kNoVertex;
    LatticePoint place;
    std::int64_t height = 0;
  };

  template <class Visitor>
  std::int64_t weigh(VertexId v, Visitor&& visit) const;
  static std::int64_t ticksOf(double height) noexcept {
    return static_cast<std::int64_t>(height * kTicksPerMetre);
  }
  void setHeight(VertexId v, std::int64_t ticks) noexcept;
  void adopt(VertexId v, std::int64_t ticks, std::int64_t loose);
  void adoptCrossings();
  void begin();
  VertexId add(LatticePoint p, TriangleId t);
  SixfoldVolume finish(const Gone& gone);
  SixfoldVolume lift(VertexId v, std::int64_t ticks);
  void noteMoved(VertexId v);

  Triangulation mesh_;
  static constexpr std::int64_t kNoLoose = -1;  // no vertex is there
  CompactArray<std::int64_t> loose_;            // [ticks]
  VolumeLedger ledger_;
  SixfoldVolume moved_ = 0;
  SixfoldVolume entered_ = 0;
  OpenCells cells_;
  ChangeList changedVertices_;
  ChangeList changedTriangles_;

  // Kept between operations so that they allocate nothing.
  std::vector<TriangleChange> changes_;
  std::vector<TriangleId> fenced_;
  std::vector<VertexId> touched_;
  ChangeList seen_;
};

}  // namespace teren
