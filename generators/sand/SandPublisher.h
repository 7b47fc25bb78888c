// Publishes sand: a snapshot after each iteration, at the cost of what has changed.
#pragma once

#include <cstddef>
#include <memory>

#include "generators/sand/ChangeList.h"
#include "generators/sand/SandSnapshot.h"
#include "generators/sand/Sandbox.h"

namespace teren {

/// Follows a sandbox by its lists of changes; the last part of an iteration. One publisher for a sandbox, in
/// the sandbox's thread: two would take the lists away from each other. What it hands out is for any thread.
class SandPublisher {
 public:
  /// The sandbox as it is; its lists of changes are empty afterwards, and where they were so before, the last
  /// snapshot is the answer, in O(1). Copies the pages that the lists name and those of vertices around,
  /// whose normals change: O(pages touched + slots / 16384). The first time publishAll().
  std::shared_ptr<const SandSnapshot> publish(Sandbox& sandbox);
  /// The same whatever the lists say: after another sandbox has taken this one's place. Looks everywhere for
  /// what differs and copies that. O(n); where little differs, a tenth of the first time.
  std::shared_ptr<const SandSnapshot> publishAll(Sandbox& sandbox);

  /// Every byte held, the last snapshot included.
  std::size_t bytes() const noexcept;

 private:
  void take(const Triangulation& mesh, TriangleId t);
  void bound(std::size_t trianglePage);
  void setBounds(std::size_t trianglePage, const SandBounds& bounds);
  std::shared_ptr<const SandSnapshot> finish(Sandbox& sandbox);

  PageEditor<SandVertexPage> vertices_;
  PageEditor<SandTrianglePage> triangles_;
  PageEditor<SandBoundsPage> bounds_;
  std::shared_ptr<const SandSnapshot> last_;
  ChangeList refreshed_;  // vertices that may look different
};

}  // namespace teren
