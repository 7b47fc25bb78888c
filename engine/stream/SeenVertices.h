// Heights of vertices in a snapshot: as they lie, or as an eye sees them moved (Morph.h).
#pragma once

#include <cmath>
#include <cstdint>

#include "teren/Morph.h"
#include "teren/Object.h"
#include "teren/SurfaceVertex.h"

namespace teren {

/// As they lie.
struct LyingVertices {
  static constexpr bool kMoves = false;
  static float height(std::int64_t /*column*/, std::int64_t /*row*/, const SurfaceVertex& vertex) noexcept {
    return vertex.height;
  }
};

/// Where the vertex shader draws them, in the same arithmetic: floats from the sample next to the eye. The
/// height of a vertex follows from its place in the world alone, whichever mesh it is read from.
class SeenVertices {
 public:
  static constexpr bool kMoves = true;

  /// Level-0 samples that places are counted from.
  struct Corner {
    std::int64_t column = 0, row = 0;
  };

  /// Whether anything moves with this eye: it is a place where an eye can be.
  static bool moves(const DetailEye& eye, const Morph& morph) noexcept {
    return morph.tolerance() > 0.0F && eye.position.valid() && std::fabs(eye.height) <= kMostHeight;
  }
  /// Of an eye with which anything moves. `morph` outlives this object.
  SeenVertices(const DetailEye& eye, const Morph& morph, const Corner& corner, int intervals,
               double spacing) noexcept
      : morph_(morph), spacing_(static_cast<float>(spacing)), height_(static_cast<float>(eye.height)) {
    const double east = eye.position.u * intervals, north = eye.position.v * intervals;
    column_ = eye.position.i * intervals + static_cast<std::int64_t>(east) - corner.column;
    row_ = eye.position.j * intervals + static_cast<std::int64_t>(north) - corner.row;
    east_ = static_cast<float>((east - std::floor(east)) * spacing);
    north_ = static_cast<float>((north - std::floor(north)) * spacing);
  }

  /// [m] Of the vertex at this sample, counted from the corner.
  float height(std::int64_t column, std::int64_t row, const SurfaceVertex& vertex) const noexcept {
    const float x = static_cast<float>(column - column_) * spacing_ - east_;
    const float y = static_cast<float>(row - row_) * spacing_ - north_;
    const float z = vertex.height - height_;
    return morph_.height(vertex, std::sqrt(x * x + y * y + z * z));
  }

 private:
  const Morph& morph_;
  float spacing_, height_;             // [m]
  std::int64_t column_ = 0, row_ = 0;  // the sample to the eye's south-west, from the corner,
  float east_ = 0.0F, north_ = 0.0F;   // and how far [m] beyond it the eye is
};

}  // namespace teren
