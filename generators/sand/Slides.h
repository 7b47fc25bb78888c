// Sand coming to rest: steep faces slide one after the other until none is left, in numbered steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "generators/sand/ChangeList.h"
#include "generators/sand/MarkSet.h"
#include "generators/sand/Repose.h"
#include "generators/sand/SandSurface.h"

namespace teren {

/// What slides did since they were made.
struct SlideCount {
  std::uint64_t steps = 0;   // faces looked at
  std::uint64_t moves = 0;   // of them, those that slid
  std::uint64_t splits = 0;  // vertices added on long edges
  std::uint64_t sweeps = 0;  // times that all faces waiting at one moment were looked at
};

/// Faces wait in a queue, first come first served; one step takes one face. If it is steeper than it may be
/// (Repose), it slides (FaceSlide.h) and all faces at its moved corners wait again. So what is computed
/// depends on the surface and the order of add() alone, never on how many steps are taken at a time.
///
/// Where a face slides from a corner whose edges are longer than `longestEdge`, each of them is divided in
/// the middle first, at a vertex on the surface; the volume that the flips around it change is given back by
/// that vertex. So a scarp eats into coarse ground as far as sand really slides, through edges of which each
/// is half the next, and a wide flat face is not tilted as a whole. Edges only get shorter, so that ends.
/// Where the middle would lie in the circle over a long edge that stays, the border's or a constrained one,
/// that is divided instead (Ruppert 1995): otherwise halves of halves would line it with slivers, whose
/// slopes need a hundred times as many steps to come to rest.
///
/// It comes to rest: every move lowers the energy of its face (FaceSlide.h), and nothing raises it but
/// vertices added, which are finitely many. Solid ground is never cut. 0.1 to 0.4 us a step, as near as
/// memory is; the number of sweeps grows with the number of faces across what slides. Ids in the queue name
/// slots: one that is gone is passed over.
class Slides {
 public:
  /// longestEdge [m]: at least 8 lattice steps are taken; infinity never divides an edge.
  Slides(const Repose& repose, double longestEdge) noexcept : repose_(repose), longestEdge_(longestEdge) {}

  const Repose& repose() const noexcept { return repose_; }
  void setRepose(const Repose& repose) noexcept { repose_ = repose; }

  /// A triangle that may have become steep.
  void add(TriangleId t) {
    if (waiting_.insert(t)) next_.push_back(t);
  }
  /// All triangles at a vertex; where it is fixed, none: one that can slide has others.
  void addAround(const SandSurface& surface, VertexId v);
  /// All triangles there are.
  void addAll(const SandSurface& surface);

  /// Triangles that are gone wait no longer: whatever comes into their slots does so where it is added.
  /// O(those that wait).
  void forgetGone(const SandSurface& surface);

  /// Fixed vertices at which steep faces were seen that lean on them (FaceSlide.h), in the order of the first
  /// time, until they are forgotten.
  const ChangeList& leanedOn() const noexcept { return leanedOn_; }
  /// Whether a steep face still leans on one of them with more than so much that is loose [ticks].
  bool leansOn(const SandSurface& surface, VertexId fixed, std::int64_t more) const;
  /// Those that are no longer fixed; faces at them wait.
  void forgetLeanedOn(const SandSurface& surface);
  /// Those of other slides, which have become other vertices.
  void takeLeanedOn(const Slides& other, std::span<const VertexId> taken);

  /// Whatever waits lies still, however steep, until it is added again.
  void stop() noexcept;
  bool atRest() const noexcept { return position_ == now_.size() && next_.empty(); }
  /// Takes at most so many steps. True: all is at rest.
  bool advance(SandSurface& surface, std::uint64_t steps);

  const SlideCount& count() const noexcept { return count_; }
  std::size_t bytes() const noexcept;

 private:
  friend class SandState;  // archives

  struct SteepFace {
    Face face;  // without weights
    double slope;
  };
  std::optional<SteepFace> steepFace(const SandSurface& surface, TriangleId t) const;
  void look(SandSurface& surface, TriangleId t);
  bool divideEdges(SandSurface& surface, TriangleId t, const Face& face);
  bool divideEdgesAt(SandSurface& surface, VertexId v);

  Repose repose_;
  double longestEdge_;
  SlideCount count_;
  MarkSet waiting_;
  std::vector<TriangleId> now_;  // this sweep; from position_ on, they are still to be looked at
  std::size_t position_ = 0;
  std::vector<TriangleId> next_;  // the next sweep
  ChangeList leanedOn_;
  std::vector<VertexId> far_;  // ends of edges to be divided
  SandSurface::Stars stars_;   // of the face at hand
};

/// The steepest loose face: its slope as a tangent, 0 where there is none. O(n).
double steepestLooseSlope(const SandSurface& surface);

}  // namespace teren
