// What stands where on the drawn ground: heights, normals and the first hits of rays, on exactly the
// triangles of a snapshot, many at a time; as their vertices lie, or as an eye sees them, moved with distance
// (Morph.h). For whatever has to fit what is seen: clearance, shadows, picking, vehicles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "teren/Morph.h"
#include "teren/Object.h"
#include "teren/Position.h"
#include "teren/Scene.h"

namespace teren {

/// The drawn ground at a place.
struct DrawnPoint {
  bool there = false;     ///< whether ground is drawn here; where not, the rest says nothing
  std::int8_t level = 0;  ///< of the mesh
  double height = 0.0;    ///< [m]
  std::array<double, 3> normal{0.0, 0.0, 1.0};  ///< unit; east, north, up; of the triangle
  /// [m] How far the level-0 triangles may be from `height` here: the error of the mesh, and by how much an
  /// eye sees the triangle moved here. They in turn lie within World::query's `error` of the landscape's
  /// function.
  double error = 0.0;
};

/// Every height lies within this share of the largest of the triangle's heights (at least 1 m) of exact
/// arithmetic on its vertices, every component of a normal within it of the exact one. Where an eye sees them
/// moved, the vertices themselves are where Morph::height puts them: floats, as in the vertex shader.
inline constexpr double kDrawnPointError = 0x1p-46;

/// A way in a straight line, or a part of one.
struct Ray {
  Position from;
  double height = 0.0;  ///< [m] where it begins; at most kMostHeight above or below zero
  std::array<double, 3> direction{0.0, 0.0, -1.0};  ///< east, north, up; finite, of any length but 0
  /// How far it goes, in lengths of `direction`: 0 ... infinity.
  double length = std::numeric_limits<double>::infinity();
};

enum class RayEnd : std::uint8_t {
  refused,  ///< a number of the ray is out of its range, or NaN
  nothing,  ///< it hits nothing that is drawn
  ground,
};

/// The first triangle that a ray hits, where it begins and where it ends included, from above or from below.
struct RayHit {
  RayEnd end = RayEnd::refused;
  bool fromBelow = false;  ///< the ray comes from the triangle's lower side
  std::int8_t level = 0;   ///< of the mesh
  double way = 0.0;        ///< to the hit, in lengths of Ray::direction
  /// Up to here, in the same measure, ground is drawn below or above all of the ray: what it hits, and that
  /// it hits nothing, is sure only so far. Equal to `way` (or to Ray::length) where it is sure altogether.
  double known = 0.0;
  std::array<double, 3> normal{0.0, 0.0, 1.0};  ///< unit; of the triangle, upwards whatever side was hit
  double error = 0.0;                           ///< [m] of the height, as DrawnPoint::error
};

/// [m] How far a hit is from where the ray meets the triangle's plane in exact arithmetic, along the height
/// of the triangle over it, where the triangle or the ray's beginning is so far [m] away.
constexpr double rayError(double distance) {
  return 1e-9 + 0x1p-44 * distance;
}

/// Heights and rays on a snapshot. Immutable: any thread may ask, at the same time. It keeps the snapshot.
/// Copies share all that is costly.
class SceneQuery {
 public:
  /// `intervals` is World::intervals() of the world that the scene shows; `errors` [m], one for each of the
  /// scene's meshes (drawnError in PixelError.h), is what answers say of theirs; empty: 0. Costs about a
  /// microsecond for each mesh that is not in `before`, and a tenth of that for the others: hand over the
  /// query of the snapshot before where there is one (it may go afterwards).
  SceneQuery(std::shared_ptr<const Scene> scene, int intervals, std::span<const float> errors = {},
             const SceneQuery* before = nullptr);

  /// The same snapshot with its vertices moved as this eye sees them: what is on the screen, to the rounding
  /// of the graphics card's floats. `morph` is how: that of the scene, or of another picture's view
  /// (Engine::morph). Nothing moves for an eye that is no valid() position or more than kMostHeight above or
  /// below zero. Costs nothing; heights cost a sixth more (bench-scene-query).
  SceneQuery seenFrom(const DetailEye& eye) const { return seenFrom(eye, scene()->morph()); }
  SceneQuery seenFrom(const DetailEye& eye, const Morph& morph) const;

  const std::shared_ptr<const Scene>& scene() const noexcept;
  /// How many of the scene's meshes were not in `before`: what making this has cost.
  std::size_t newMeshes() const noexcept;
  /// All that this knows of its meshes, for a query to come (as its `before`), without keeping the snapshot:
  /// it answers that nothing is drawn.
  SceneQuery withoutScene() const;
  /// Held beside the snapshot itself.
  std::size_t bytes() const noexcept;

  /// Answers every place; both spans have the same length (assert). A place that is not valid() has no
  /// ground. A mesh's southern and western lines belong to it, its northern and eastern ones to what follows
  /// there, so on the northern and eastern rim of all that is drawn nothing is. On regular meshes that are
  /// not moved, heights are those of triangleHeight over the same samples, bit for bit. Allocates nothing.
  /// About 55 ns a place wherever they lie (bench-scene-query), bound by memory where a scene is larger than
  /// the caches: neighbours in `places` that are neighbours on the ground share what was fetched.
  void points(std::span<const Position> places, std::span<DrawnPoint> answers) const;

  /// Answers every ray; both spans have the same length (assert). What a ray crosses it hits, on the line
  /// between two triangles or two meshes and on a vertex too; only where it just touches a ridge or a summit
  /// without crossing, within rounding, it may pass. A ray in a triangle's own plane hits the triangle where
  /// it comes to it. Allocates nothing. A third of a microsecond straight down, 2 to 4 as from an eye, up to
  /// 16 where it grazes, and a fifth more on what an eye sees: in proportion to the blocks of 8 x 8 squares
  /// it comes near (bench-scene-query).
  void firstHits(std::span<const Ray> rays, std::span<RayHit> hits) const;

 private:
  class State;
  explicit SceneQuery(std::shared_ptr<const State> state) : state_(std::move(state)) {}

  std::shared_ptr<const State> state_;
  std::optional<DetailEye> eye_;
  Morph morph_;
};

}  // namespace teren
