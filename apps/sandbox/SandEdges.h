// The constrained edges of sand, or those on the border of its box, followed from snapshot to snapshot.
#pragma once

#include <memory>
#include <vector>

#include "generators/sand/SandSnapshot.h"

namespace teren {

/// Keeps the last snapshot it was asked about, and the edges of each of its pages.
class SandEdges {
 public:
  enum class Kind { constrained, border };
  explicit SandEdges(Kind kind) noexcept : kind_(kind) {}

  /// The edges of a snapshot as pairs of vertices: constrained ones at least once, those on the border once,
  /// counter-clockwise. O(pages of triangles that differ from the last one's + edges).
  const std::vector<VertexId>& of(const std::shared_ptr<const SandSnapshot>& sand);
  /// Keeps nothing.
  void clear();

 private:
  Kind kind_;
  std::shared_ptr<const SandSnapshot> last_;
  std::vector<std::vector<VertexId>> ofPage_;
  std::vector<VertexId> all_;
};

}  // namespace teren
