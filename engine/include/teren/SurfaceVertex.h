// A vertex of the ground, as a renderer gets it.
#pragma once

#include <cstdint>

namespace teren {

/// One vertex of the surface, 20 bytes. `column` and `row` count the mesh's steps from its origin to the east
/// and north; the height [m] is absolute. The unit normal's x and y are stored as round(32767 n); its z is
/// sqrt(1 - x^2 - y^2), always positive.
///
/// `coarserHeight` [m] and the coarser normal are those of the next coarser level's surface there: what the
/// vertex draws near to with distance (Morph.h). A vertex between nodes of several levels is one of the
/// finest, so all meshes that share a vertex have the same of everything but column and row.
struct SurfaceVertex {
  std::int16_t column = 0, row = 0;
  float height = 0.0F;
  std::int16_t normalX = 0, normalY = 0;
  float coarserHeight = 0.0F;
  /// As normalX and normalY, but that the last four bits of x are the level of the vertex.
  std::int16_t coarserNormalX = kFixed, coarserNormalY = 0;

  static constexpr int kFixed = 15;  ///< in place of a level: there is no coarser surface
  int level() const noexcept { return coarserNormalX & 15; }
  /// Without the level, right to 8 steps.
  int coarserX() const noexcept { return (coarserNormalX & ~15) + 8; }
  void setCoarser(int level, float itsHeight, std::int16_t x, std::int16_t y) noexcept {
    coarserHeight = itsHeight;
    coarserNormalX = static_cast<std::int16_t>((x & ~15) | (level < kFixed ? level : kFixed));
    coarserNormalY = y;
  }

  friend bool operator==(const SurfaceVertex&, const SurfaceVertex&) = default;
};
static_assert(sizeof(SurfaceVertex) == 20);

}  // namespace teren
