// One ray on its way over the drawn ground, to the first triangle it hits.
#pragma once

#include <array>
#include <cstdint>

#include "teren/SceneQuery.h"

#include "stream/GridWalk.h"
#include "stream/SceneIndex.h"
#include "stream/SeenVertices.h"

namespace teren {

/// Looks for the first hit, from the squares of the tree over blocks of meshes to triangles, each only where
/// the ray is over it and between its heights - give or take far more than rounding can do, so what is left
/// out does not matter. A triangle is hit by the signs of three products around its sides (Woop, Benthin and
/// Wald, "Watertight Ray/Triangle Intersection", JCGT 2013, here in double): two triangles compute the same
/// numbers for the side that they share, so no ray slips through between them or at a corner.
class SceneRay {
 public:
  /// `ray` that isRay(). `beginsOverGround`: whether a triangle is below or above its beginning. `seen`:
  /// where the vertices are; nullptr: as they lie.
  SceneRay(const SceneIndex& index, double spacing, int intervals, const Ray& ray, bool beginsOverGround,
           const SeenVertices* seen);
  RayHit firstHit();

  /// Whether the numbers of a ray are in their ranges.
  static bool isRay(const Ray& ray) noexcept;

 private:
  using Vector = std::array<double, 3>;  // east, north, up of where the ray begins [m]
  struct Corner {
    Vector place;
    const SurfaceVertex* vertex;
  };
  using Triangle = std::array<Corner, 3>;

  /// Of the tree: from its south-west corner, 2^shift samples a side.
  struct Square {
    std::int64_t west, south;
    int shift;
  };

  /// These stop where they return false.
  bool overEntry(SceneIndex::Entry entry, const SceneIndex::Extent& extent, const Square& square,
                 const Span& span);
  bool coverEntry(SceneIndex::Entry entry, const SceneIndex::Extent& extent, const Square& square,
                  const Span& span);
  template <class Visit>
  void overChildren(SceneIndex::Entry entry, const Square& square, double reach, const Span& span,
                    const Visit& visit) const;
  void overLeaf(SceneIndex::Entry leaf, const Span& span);
  void overMesh(const IndexedMesh& mesh, const Span& span);
  void overSquares(const IndexedMesh& mesh, int blockColumn, int blockRow, const Span& span);
  void meetBag(const IndexedMesh& mesh, int blockColumn, int blockRow);
  void meet(const Corner& first, const Corner& second, const Corner& third, const IndexedMesh& mesh);
  Span timesOver(const Triangle& triangle, Span within) const noexcept;
  double movedAtHit() const noexcept;
  bool meets(const HeightSpan& heights, const Span& span) const noexcept;
  bool coverMesh(const IndexedMesh& mesh, const Span& span);
  Corner corner(const IndexedMesh& mesh, const SurfaceVertex& vertex) const noexcept;
  float heightOf(const IndexedMesh& mesh, const SurfaceVertex& vertex) const noexcept;
  /// Of a place of the index, in samples from where the ray begins.
  double x(std::int64_t column) const noexcept { return static_cast<double>(column - column_) - beyondX_; }
  double y(std::int64_t row) const noexcept { return static_cast<double>(row - row_) - beyondY_; }
  WalkedGrid blocksOf(const IndexedMesh& mesh) const noexcept;

  const SceneIndex& index_;
  const SeenVertices* seen_;
  double spacing_;
  std::int64_t column_ = 0, row_ = 0;     // where it begins: the sample to its south-west,
  double beyondX_ = 0.0, beyondY_ = 0.0;  // and how far beyond
  double height_ = 0.0;
  Vector direction_{};                 // the largest component is 1 or -1
  double scale_ = 1.0;                 // of the direction that was asked for
  PlanLine line_;                      // in samples
  std::array<std::size_t, 3> axes_{};  // the one the ray runs along most comes last
  double shearX_ = 0.0, shearY_ = 0.0;
  Span span_;
  double length_ = 0.0;  // as asked for
  double reach_ = 0.0;   // [samples] by which all is taken to be larger
  double slack_ = 0.0;   // in time

  bool hit_ = false;
  double time_ = 0.0;
  const IndexedMesh* mesh_ = nullptr;
  Triangle triangle_{};
  bool beginsOverGround_;
  double covered_ = 0.0;  // there is ground all the way up to this time
};

}  // namespace teren
