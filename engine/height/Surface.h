// The drawn surface over a grid of heights: two triangles a square, split by the diagonal from south-west to
// north-east, with vertex normals from central differences.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace teren {

/// Heights at the corners of a grid square [m].
struct SquareHeights {
  double southWest = 0.0, southEast = 0.0, northWest = 0.0, northEast = 0.0;
};

/// What the triangle at (x, y) in [0, 1]^2 of a square says: its height there and its slopes per side.
struct TrianglePoint {
  double height = 0.0;
  double slopeX = 0.0, slopeY = 0.0;  ///< [m per side of the square]
};

/// Exact at the corners; on the diagonal both triangles agree.
inline TrianglePoint sampleTriangle(const SquareHeights& corner, double x, double y) noexcept {
  TrianglePoint point;
  if (x >= y) {  // south-west, south-east, north-east
    point.slopeX = corner.southEast - corner.southWest;
    point.slopeY = corner.northEast - corner.southEast;
  } else {  // south-west, north-east, north-west
    point.slopeX = corner.northEast - corner.northWest;
    point.slopeY = corner.northWest - corner.southWest;
  }
  point.height = corner.southWest + (x * point.slopeX + y * point.slopeY);
  return point;
}

/// A unit normal as stored in a vertex: x and y as round(32767 n); z follows and is positive.
struct PackedNormal {
  std::int16_t x = 0, y = 0;
  friend bool operator==(const PackedNormal&, const PackedNormal&) = default;
};

/// The largest angle [radian] between a normal of slope <= 10 and its packed form: half a step in x and in y,
/// divided by the cosine of the slope.
inline constexpr double kPackedNormalError = 2.2e-4;

/// The normal of a vertex by how far [m] the ground falls to the east and to the north over 2 `spacing` [m].
inline PackedNormal normalOfFalls(double nx, double ny, double spacing) noexcept {
  const double nz = 2.0 * spacing;
  const double scale = 32767.0 / std::sqrt(nx * nx + ny * ny + nz * nz);
  return {static_cast<std::int16_t>(std::floor(nx * scale + 0.5)),
          static_cast<std::int16_t>(std::floor(ny * scale + 0.5))};
}

/// The normal of a vertex from its four neighbours [m], `spacing` [m] away each.
inline PackedNormal vertexNormal(float west, float east, float south, float north, double spacing) noexcept {
  return normalOfFalls(static_cast<double>(west) - static_cast<double>(east),
                       static_cast<double>(south) - static_cast<double>(north), spacing);
}

/// The unit normal of a triangle with the given slopes [m per side] and side [m]; its zeros are never -0.
std::array<double, 3> faceNormal(const TrianglePoint& point, double side) noexcept;

}  // namespace teren
