// Taking away vertices that nobody would miss, and constraints that hold nothing any more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "generators/sand/FrontQueue.h"
#include "generators/sand/MarkSet.h"
#include "generators/sand/SandSurface.h"
#include "generators/sand/Slides.h"

namespace teren {

/// What a clean-up did since it was made.
struct CleanUpCount {
  std::uint64_t looked = 0;     // vertices looked at
  std::uint64_t removed = 0;    // of them, those that went
  std::uint64_t dissolved = 0;  // constrained edges that became ordinary ones
  double largestError = 0.0;  // [m] no place lies farther from where it was because of all this; <= tolerance
};

/// Vertices wait in a queue, first come first served. One goes where it is flat against its neighbours: all
/// of them within a band around one plane through it (its faces' mean gradient), measured straight up; angles
/// to the horizontal, as published, would keep every vertex of an inclined plane.
///
/// Why the error is bounded: the old and the new faces lie within the band, so removal moves no place by more
/// than the band's width; giving the volume back raises the neighbours by at most 1.5 times that (the star's
/// faces each have two of them as corners). The sum is added to the errors that the corners carry from
/// earlier removals, and a vertex stays where that would exceed the tolerance. A vertex that moves by itself
/// starts anew.
///
/// A vertex stays where loose material lies as steep as it may slide: slides divide long edges there, and
/// would divide them again for ever.
///
/// A constrained edge of an older stamp is dissolved where its two faces satisfy Delaunay's rule anyway, or
/// where the other diagonal of their quadrangle lies within the tolerance, and no other edge flips with it.
/// Which of the material is solid may shift at a removal, by as much as solid ground is uneven there; the
/// surface's volume is kept exactly.
///
/// Cost: O(k) a vertex, O(k log k) a removal. Memory: 2 bytes and 1 bit a vertex.
class CleanUp {
 public:
  /// tolerance [m] >= 0.
  explicit CleanUp(double tolerance) noexcept : tolerance_(tolerance) {}

  double tolerance() const noexcept { return tolerance_; }
  /// A vertex to be looked at.
  void add(VertexId v) {
    if (waiting_.insert(v)) queue_.push_back(v);
  }
  /// A vertex that has moved by itself, or come: it carries no error.
  void addMoved(VertexId v);
  /// What waits in another one, and the errors that its vertices carry; these are `taken` by now.
  void take(const CleanUp& other, std::span<const VertexId> taken);
  std::size_t waiting() const noexcept { return queue_.size(); }
  /// Looks at the vertices that wait, at most so many. Constraints with an id of at least `kept` stay. Faces
  /// that changed are added to the slides.
  void run(SandSurface& surface, Slides& slides, std::uint32_t kept, std::size_t most);

  const CleanUpCount& count() const noexcept { return count_; }
  std::size_t bytes() const noexcept;

 private:
  friend class SandState;  // archives

  void dissolveAt(SandSurface& surface, Slides& slides, VertexId v, std::uint32_t kept);
  void dissolve(SandSurface& surface, Slides& slides, VertexId a, VertexId b);
  void removeIfFlat(SandSurface& surface, Slides& slides, VertexId v);
  double bandAround(const SandSurface& surface, VertexId v);
  bool bearsLoose(const SandSurface& surface, VertexId v) const;
  double carried(VertexId v) const noexcept;
  void carry(VertexId v, double error);

  double tolerance_;
  CleanUpCount count_;
  MarkSet waiting_;
  FrontQueue<VertexId> queue_;
  CompactArray<std::uint16_t> carried_;  // in parts of the tolerance
  std::vector<VertexId> ring_;
  double slope_ = 0.0;  // of the plane through the vertex that bandAround was asked for
};

}  // namespace teren
