// What stands where on the drawn ground: heights, normals and the first hits of rays, on exactly the
// triangles of a snapshot, many at a time. For whatever has to fit what is seen: clearance, shadows, picking,
// vehicles.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "teren/Position.h"
#include "teren/Scene.h"

namespace teren {

/// The drawn ground at a place.
struct DrawnPoint {
  bool there = false;     ///< whether ground is drawn here; where not, the rest says nothing
  std::int8_t level = 0;  ///< of the mesh
  double height = 0.0;    ///< [m]
  std::array<double, 3> normal{0.0, 0.0, 1.0};  ///< unit; east, north, up; of the triangle
};

/// Every height lies within this share of the largest of the triangle's heights (at least 1 m) of exact
/// arithmetic, every component of a normal within it of the exact one.
inline constexpr double kDrawnPointError = 0x1p-46;

/// Heights and rays on a snapshot. Immutable: any thread may ask, at the same time. It keeps the snapshot.
class SceneQuery {
 public:
  /// `intervals` is World::intervals() of the world that the scene shows. Costs about a microsecond for each
  /// mesh that is not in `before`, and a tenth of that for the others: hand over the query of the snapshot
  /// before where there is one (it may go afterwards).
  SceneQuery(std::shared_ptr<const Scene> scene, int intervals, const SceneQuery* before = nullptr);
  ~SceneQuery();
  SceneQuery(SceneQuery&&) noexcept;
  SceneQuery& operator=(SceneQuery&&) noexcept;

  const std::shared_ptr<const Scene>& scene() const noexcept;
  /// Held beside the snapshot itself.
  std::size_t bytes() const noexcept;

  /// Answers every place; both spans have the same length (assert). A place that is not valid() has no
  /// ground. A mesh's southern and western lines belong to it, its northern and eastern ones to what follows
  /// there, so on the northern and eastern rim of all that is drawn nothing is. On regular meshes heights are
  /// those of triangleHeight over the same samples, bit for bit. Allocates nothing. About 30 ns a place
  /// wherever they lie (bench-scene-query), bound by memory where a scene is larger than the caches:
  /// neighbours in `places` that are neighbours on the ground share what was fetched.
  void points(std::span<const Position> places, std::span<DrawnPoint> answers) const;

 private:
  class State;
  std::unique_ptr<const State> state_;
};

}  // namespace teren
