// The constrained edges of sand, for drawing them: followed from snapshot to snapshot.
#pragma once

#include <memory>
#include <vector>

#include "generators/sand/SandSnapshot.h"

namespace teren {

/// Keeps the last snapshot it was asked about, and the edges of each of its pages.
class SandEdges {
 public:
  /// The constrained edges of a snapshot as pairs of vertices, each at least once. O(pages of triangles that
  /// differ from the last one's + edges).
  const std::vector<VertexId>& of(const std::shared_ptr<const SandSnapshot>& sand);
  /// Keeps nothing.
  void clear();

 private:
  std::shared_ptr<const SandSnapshot> last_;
  std::vector<std::vector<VertexId>> ofPage_;
  std::vector<VertexId> all_;
};

}  // namespace teren
