// The sides of a block of sand: what is seen of it from beside.
#pragma once

#include <memory>
#include <vector>

#include "apps/sandbox/SandEdges.h"
#include "generators/sand/SandSnapshot.h"

namespace teren {

/// Walls from the border of the surface down to a level bottom. Follows snapshots.
class SandSides {
 public:
  /// The walls' triangles, three vertices each, with normals outwards. O(pages of triangles that differ from
  /// the last snapshot's + edges on the border).
  const std::vector<SandVertex>& of(const std::shared_ptr<const SandSnapshot>& sand);
  /// The height of the bottom [m]: a twentieth of the box's longer side below the lowest sand.
  static float bottomOf(const SandSnapshot& sand) noexcept;
  /// Keeps nothing.
  void clear();

 private:
  SandEdges border_{SandEdges::Kind::border};
  std::shared_ptr<const SandSnapshot> last_;
  std::vector<SandVertex> triangles_;
};

}  // namespace teren
