#include "stream/MeshHeight.h"

#include <array>

namespace teren {

namespace {

double cross(double ax, double ay, double bx, double by) noexcept {
  return ax * by - bx * ay;
}

}  // namespace

float heightOf(const Mesh& mesh, const SurfaceVertex& vertex, const SeenVertices* seen) noexcept {
  if (seen == nullptr) return vertex.height;
  return seen->height(mesh.originColumn + (std::int64_t{vertex.column} << mesh.level),
                      mesh.originRow + (std::int64_t{vertex.row} << mesh.level), vertex);
}

std::optional<double> meshHeight(const Mesh& mesh, std::int64_t column, std::int64_t row, double east,
                                 double north, const SeenVertices* seen) noexcept {
  const double step = 1.0 / static_cast<double>(std::int64_t{1} << mesh.level);
  const double x = (static_cast<double>(column - mesh.originColumn) + east) * step;
  const double y = (static_cast<double>(row - mesh.originRow) + north) * step;
  const TriangleIndices& indices = *mesh.indices;
  for (std::size_t at = 0; at + 2 < indices.size(); at += 3) {
    const std::array<const SurfaceVertex*, 3> corners{
        &mesh.vertices[indices[at]], &mesh.vertices[indices[at + 1]], &mesh.vertices[indices[at + 2]]};
    const auto isInside = [&](std::size_t from, std::size_t to) {
      const SurfaceVertex &a = *corners[from], &b = *corners[to];
      return cross(a.column - x, a.row - y, b.column - x, b.row - y) >= 0.0;
    };
    if (!isInside(0, 1) || !isInside(1, 2) || !isInside(2, 0)) continue;
    const SurfaceVertex& a = *corners[0];
    const auto height = [&](std::size_t k) { return static_cast<double>(heightOf(mesh, *corners[k], seen)); };
    const double az = height(0);
    const double bx = corners[1]->column - a.column, by = corners[1]->row - a.row, bz = height(1) - az;
    const double cx = corners[2]->column - a.column, cy = corners[2]->row - a.row, cz = height(2) - az;
    const double area = cross(bx, by, cx, cy);  // > 0: anticlockwise
    const double slopeX = (bz * cy - cz * by) / area, slopeY = (cz * bx - bz * cx) / area;
    return az + ((x - a.column) * slopeX + (y - a.row) * slopeY);
  }
  return std::nullopt;
}

}  // namespace teren
