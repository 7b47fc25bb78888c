// The surface of the next coarser level over a node: where its vertices draw to with distance.
#pragma once

#include "teren/HeightMap.h"

#include "height/Surface.h"

namespace teren {

/// Samples of level L + 1 over a node of level L, with one more on every side, so that all normals are
/// central differences: those of that level's meshes, bit for bit.
class CoarserSurface {
 public:
  /// How many samples a side has; n is even.
  static constexpr int side(int intervals) noexcept { return intervals / 2 + 3; }

  struct Point {
    float height = 0.0F;  ///< [m]
    PackedNormal normal;
  };

  /// `samples` must outlive it; `spacing` [m] of the node's own.
  CoarserSurface(const HeightMap& samples, double spacing) noexcept
      : samples_(samples), spacing_(2.0 * spacing) {}

  /// At a sample of the node. Between coarser samples on the triangle there, which is as exact as a float is:
  /// the middle of an edge, or of the diagonal from south-west to north-east. Normals there are the mean of
  /// the two ends', as a triangle's shading has it. About 25 ns.
  Point at(int column, int row) const noexcept {
    const int west = (column >> 1) + 1, south = (row >> 1) + 1;
    if (((column | row) & 1) == 0) return {samples_(west, south), normal(west, south)};
    const int east = west + (column & 1), north = south + (row & 1);
    const PackedNormal a = normal(west, south), b = normal(east, north);
    return {0.5F * (samples_(west, south) + samples_(east, north)), {middle(a.x, b.x), middle(a.y, b.y)}};
  }

 private:
  static std::int16_t middle(std::int16_t a, std::int16_t b) noexcept {
    return static_cast<std::int16_t>((a + b) >> 1);
  }
  PackedNormal normal(int x, int y) const noexcept {
    return vertexNormal(samples_(x - 1, y), samples_(x + 1, y), samples_(x, y - 1), samples_(x, y + 1),
                        spacing_);
  }

  const HeightMap& samples_;
  double spacing_;
};

}  // namespace teren
