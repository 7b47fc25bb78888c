#include "teren/PixelError.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "world/NodeErrors.h"

namespace teren {

namespace {

/// Metres from the eye.
struct Box {
  double west = 0.0, east = 0.0, south = 0.0, north = 0.0, low = 0.0, high = 0.0;

  double distance() const noexcept {
    const auto outside = [](double from, double to) { return std::max({from, -to, 0.0}); };
    const double x = outside(west, east), y = outside(south, north), z = outside(low, high);
    return std::sqrt(x * x + y * y + z * z);
  }
  double farthest() const noexcept {
    const auto side = [](double from, double to) { return std::max(std::fabs(from), std::fabs(to)); };
    const double x = side(west, east), y = side(south, north), z = side(low, high);
    return std::sqrt(x * x + y * y + z * z);
  }
};

/// Where a mesh's columns and rows lie as seen from the eye; exact to the rounding of small numbers, wherever
/// both are.
struct MeshFrame {
  MeshFrame(const World& world, const Mesh& theMesh, const Eye& theEye)
      : mesh(theMesh), height(theEye.height), spacing(world.spacing(theMesh.level)) {
    const auto n = static_cast<std::int64_t>(world.intervals());
    const auto metres = [&](std::int64_t origin, std::int64_t patch, double share) {
      return (static_cast<double>(origin - patch * n) - share * static_cast<double>(n)) * world.spacing(0);
    };
    east = metres(mesh.originColumn, theEye.position.i, theEye.position.u);
    north = metres(mesh.originRow, theEye.position.j, theEye.position.v);
  }

  Box whole() const noexcept {
    return {east,
            east + mesh.columns * spacing,
            north,
            north + mesh.rows * spacing,
            static_cast<double>(mesh.minHeight) - height,
            static_cast<double>(mesh.maxHeight) - height};
  }

  Box triangle(std::size_t first) const noexcept {
    const auto vertex = [&](std::size_t k) -> const SurfaceVertex& {
      return mesh.vertices[(*mesh.indices)[first + k]];
    };
    const SurfaceVertex &a = vertex(0), &b = vertex(1), &c = vertex(2);
    const auto [west, eastern] = std::minmax({a.column, b.column, c.column});
    const auto [south, northern] = std::minmax({a.row, b.row, c.row});
    const auto [low, high] = std::minmax({a.height, b.height, c.height});
    return {
        east + west * spacing,      east + eastern * spacing,          north + south * spacing,
        north + northern * spacing, static_cast<double>(low) - height, static_cast<double>(high) - height};
  }

  const Mesh& mesh;
  double height, spacing;  // [m]
  double east = 0.0, north = 0.0;
};

double nearestOf(const MeshFrame& frame) {
  const Mesh& mesh = frame.mesh;
  const double far = frame.whole().distance();
  if (far >= std::max(mesh.columns, mesh.rows) * frame.spacing) return std::max(far, kNearestGround);
  double near = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first < mesh.indices->size(); first += 3) {
    near = std::min(near, frame.triangle(first).distance());
  }
  return std::max(near, kNearestGround);
}

/// [m / m] The largest error over distance between two distances, of vertices of a level that move. In
/// between t is the square of a linear function of the distance, so the error over it is convex until they
/// have arrived, and falls from then on: it is largest at an end or at the arrival.
double largestOfMoving(const Morph& morph, int level, double own, double next, double near, double far) {
  const auto at = [&](double distance) {
    const auto t = static_cast<double>(morph.share(level, static_cast<float>(distance)));
    return (own + t * (next - own)) / distance;
  };
  const Morph::Range& range = morph.ranges()[static_cast<std::size_t>(level)];
  const double arrival = (static_cast<double>(range.error) + 1.0 / static_cast<double>(range.perMetre)) /
                         static_cast<double>(morph.tolerance());
  return std::max({at(near), at(far), at(std::clamp(arrival, near, far))});
}

}  // namespace

double drawnError(const World& world, const Mesh& mesh) {
  return world.nodeErrors().estimate(mesh.nodeLevel, static_cast<double>(mesh.bend));
}

double lensPixels(double rows, double fieldOfView) noexcept {
  return rows / (2.0 * std::tan(0.5 * fieldOfView));
}

double pixelError(const World& world, const Mesh& mesh, const Eye& eye, const Morph& morph) {
  const double own = drawnError(world, mesh);
  const int level = mesh.nodeLevel;
  const bool moves = morph.tolerance() > 0.0F && level < world.topLevel() && level < SurfaceVertex::kFixed;
  if (!moves && own == 0.0) return 0.0;
  const MeshFrame frame(world, mesh, eye);
  const double near = nearestOf(frame);
  if (!moves) return own / near * eye.lensPixels;
  const double next = std::max(own, world.nodeErrors().estimate(level + 1));
  const double far = std::max(near, frame.whole().farthest());
  return largestOfMoving(morph, level, own, next, near, far) * eye.lensPixels;
}

PixelError pixelError(const World& world, const Scene& scene, const Eye& eye) {
  std::vector<double> pixels;
  pixels.reserve(scene.meshes().size());
  for (const auto& mesh : scene.meshes()) pixels.push_back(pixelError(world, *mesh, eye, scene.morph()));
  if (pixels.empty()) return {};
  const auto rank = pixels.begin() + static_cast<std::ptrdiff_t>((pixels.size() * 99 + 99) / 100 - 1);
  std::nth_element(pixels.begin(), rank, pixels.end());
  return {*rank, *std::max_element(rank, pixels.end())};
}

}  // namespace teren
