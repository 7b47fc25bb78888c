// Random programs on a triangulation: insert, remove, constrain, unconstrain, locate, over points of several
// kinds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "teren/Hash.h"

#include "generators/tin/Triangulation.h"

namespace teren::test {

enum class PointKind { uniform, clustered, gridded, collinear, spiral };
inline constexpr PointKind kAllPointKinds[] = {PointKind::uniform, PointKind::clustered, PointKind::gridded,
                                               PointKind::collinear, PointKind::spiral};
const char* nameOf(PointKind kind);

/// A triangulation that random operations change; a pure function of its seed.
class RandomProgram {
 public:
  /// `vertices`: about as many as there will be. `side` [steps] of the box.
  RandomProgram(std::uint64_t seed, PointKind kind, std::size_t vertices, std::int32_t side = 1 << 24);

  /// Does one operation. The vertices it happened at, for a local check, are in touched().
  void step();

  const Triangulation& mesh() const noexcept { return mesh_; }
  Triangulation& mesh() noexcept { return mesh_; }
  const std::vector<VertexId>& touched() const noexcept { return touched_; }
  /// What the last operation broke besides the mesh's own promises; empty: nothing.
  const std::string& complaint() const noexcept { return complaint_; }
  LatticePoint randomPoint();

 private:
  VertexId randomVertex();
  TriangleId randomHint();
  void insertOne();
  void insertMany();
  void removeOne();
  void constrainOne();
  void unconstrainOne();
  void locateOne();

  RandomSequence random_;
  PointKind kind_;
  std::size_t vertices_;
  std::int32_t side_;
  Triangulation mesh_;
  std::vector<VertexId> touched_;
  std::string complaint_;
  std::uint32_t nextId_ = 0;
};

}  // namespace teren::test
