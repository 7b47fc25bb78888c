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
  MeshFrame(const World& world, const Mesh& theMesh, const Position& eye, double eyeHeight)
      : mesh(theMesh), height(eyeHeight), spacing(world.spacing(theMesh.level)) {
    const auto n = static_cast<std::int64_t>(world.intervals());
    const auto metres = [&](std::int64_t origin, std::int64_t patch, double share) {
      return (static_cast<double>(origin - patch * n) - share * static_cast<double>(n)) * world.spacing(0);
    };
    east = metres(mesh.originColumn, eye.i, eye.u);
    north = metres(mesh.originRow, eye.j, eye.v);
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

/// How far a mesh is from the eye that looks, and what that says of how far it is from the eye that vertices
/// move with: at most `apart` farther, and at most `farthest`. All in metres.
struct Distances {
  double near = 0.0, far = 0.0;
  double apart = 0.0, farthest = 0.0;
};

/// [m / m] The largest error over distance of vertices of a level that move. t is the square of a linear
/// function of the distance, so the error over it is convex until they have arrived, or can be no farther
/// from the eye they move with, and falls from then on: it is largest at an end or there.
double largestOfMoving(const Morph& morph, int level, double own, double next, const Distances& distances) {
  const auto& [near, far, apart, farthest] = distances;
  const auto at = [&](double distance) {
    const double moved = std::min(distance + distances.apart, distances.farthest);
    const auto t = static_cast<double>(morph.share(level, static_cast<float>(moved)));
    return (own + t * (next - own)) / distance;
  };
  const Morph::Range& range = morph.ranges()[static_cast<std::size_t>(level)];
  const double arrival = (static_cast<double>(range.error) + 1.0 / static_cast<double>(range.perMetre)) /
                         static_cast<double>(morph.tolerance());
  return std::max({at(near), at(far), at(std::clamp(arrival - apart, near, far)),
                   at(std::clamp(farthest - apart, near, far))});
}

PixelError summary(std::vector<double> pixels) {
  if (pixels.empty()) return {};
  const auto rank = pixels.begin() + static_cast<std::ptrdiff_t>((pixels.size() * 99 + 99) / 100 - 1);
  std::nth_element(pixels.begin(), rank, pixels.end());
  return {*rank, *std::max_element(rank, pixels.end())};
}

}  // namespace

double drawnError(const World& world, const Mesh& mesh) {
  return world.nodeErrors().estimate(mesh.nodeLevel, static_cast<double>(mesh.bend)) +
         static_cast<double>(mesh.moved);
}

double lensPixels(double rows, double fieldOfView) noexcept {
  return rows / (2.0 * std::tan(0.5 * fieldOfView));
}

double pixelError(const World& world, const Mesh& mesh, const Eye& eye, const Morph& morph) {
  return pixelError(world, mesh, eye, morph, {eye.position, eye.height});
}

double pixelError(const World& world, const Mesh& mesh, const Eye& eye, const Morph& morph,
                  const DetailEye& movedWith) {
  const double own = drawnError(world, mesh);
  const int level = mesh.nodeLevel;
  const bool moves = morph.tolerance() > 0.0F && level < world.topLevel() && level < SurfaceVertex::kFixed;
  if (!moves && own == 0.0) return 0.0;
  const MeshFrame frame(world, mesh, eye.position, eye.height);
  const double near = nearestOf(frame);
  if (!moves) return own / near * eye.lensPixels;
  const double next = std::max(own, world.nodeErrors().estimate(level + 1));
  Distances distances{near, std::max(near, frame.whole().farthest())};
  const Offset way = offset(eye.position, movedWith.position, world.pitch());
  const double up = movedWith.height - eye.height;
  distances.apart = std::sqrt(way.east * way.east + way.north * way.north + up * up);
  distances.farthest = MeshFrame(world, mesh, movedWith.position, movedWith.height).whole().farthest();
  distances.farthest = std::max(distances.farthest, kNearestGround);
  return largestOfMoving(morph, level, own, next, distances) * eye.lensPixels;
}

PixelError pixelError(const World& world, const Scene& scene, const Eye& eye) {
  return pixelError(world, scene, eye, {eye.position, eye.height});
}

PixelError pixelError(const World& world, const Scene& scene, const Eye& eye, const DetailEye& movedWith) {
  std::vector<double> pixels;
  pixels.reserve(scene.meshes().size());
  for (const auto& mesh : scene.meshes()) {
    pixels.push_back(pixelError(world, *mesh, eye, scene.morph(), movedWith));
  }
  return summary(std::move(pixels));
}

}  // namespace teren
