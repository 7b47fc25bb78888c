#include "coin/GroundHorizon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "coin/DrawnHeights.h"

namespace teren {
namespace {

/// A rectangle around the eye's plumb line, and heights above the eye [m].
struct Place {
  double west, south, east, north, low, high;

  double nearest() const { return std::hypot(std::max({west, -east, 0.0}), std::max({south, -north, 0.0})); }
  double farthest() const { return std::hypot(std::max(-west, east), std::max(-south, north)); }
};

/// Grows with the angle from the east to the north, 0 ... 4 for the whole turn.
double turnOf(double x, double y) {
  const double share = x / (std::fabs(x) + std::fabs(y));
  return y >= 0.0 ? 1.0 - share : 3.0 + share;
}

/// In sectors, from the first to the last edge of a place that lies to one side of the eye.
std::pair<double, double> sectorsOf(const Place& place) {
  constexpr double kPerTurn = GroundHorizon::kSectors / 4.0;
  const std::array<double, 4> turns{turnOf(place.west, place.south), turnOf(place.west, place.north),
                                    turnOf(place.east, place.south), turnOf(place.east, place.north)};
  auto [low, high] = std::minmax_element(turns.begin(), turns.end());
  double first = *low, last = *high;
  if (last - first > 2.0) {  // across the east
    first = 4.0;
    last = 4.0;
    for (const double turn : turns) {
      if (turn > 2.0) first = std::min(first, turn);
      if (turn <= 2.0) last = std::max(last, turn + 4.0);
    }
  }
  return {first * kPerTurn, last * kPerTurn};
}

/// Whether a triangle of the mesh is under a place [steps] of its plan, all of it below the height [m], moved
/// or not.
bool isUnder(const Mesh& mesh, const MovedVertices& moved, double x, double y, double height) {
  const TriangleIndices& indices = *mesh.indices;
  for (std::size_t at = 0; at + 2 < indices.size(); at += 3) {
    const std::array<const SurfaceVertex*, 3> corners{
        &mesh.vertices[indices[at]], &mesh.vertices[indices[at + 1]], &mesh.vertices[indices[at + 2]]};
    const auto isInside = [&](std::size_t from, std::size_t to) {
      const SurfaceVertex &a = *corners[from], &b = *corners[to];
      return (a.column - x) * (b.row - y) - (b.column - x) * (a.row - y) >= 0.0;
    };
    if (!isInside(0, 1) || !isInside(1, 2) || !isInside(2, 0)) continue;
    return std::all_of(corners.begin(), corners.end(), [&](const SurfaceVertex* corner) {
      return static_cast<double>(std::max(corner->height, moved.height(mesh, *corner))) < height;
    });
  }
  return false;
}

/// Whether there is ground below the eye, and surely below.
bool isAboveGround(const Scene& scene, const MovedVertices& moved, const ScenePlacement& placement,
                   const SbVec3d& eye) {
  return std::any_of(scene.meshes().begin(), scene.meshes().end(), [&](const auto& mesh) {
    const SbVec3d corner = placement.position(Sample{mesh->originColumn, mesh->originRow});
    const double step = std::ldexp(placement.spacing(), mesh->level);
    const double x = (eye[0] - corner[0]) / step, y = (eye[1] - corner[1]) / step;
    const bool isOver = 0.0 <= x && x <= mesh->columns && 0.0 <= y && y <= mesh->rows;
    return isOver && isUnder(*mesh, moved, x, y, eye[2] - corner[2]);
  });
}

std::size_t wrapped(int sector) {
  return static_cast<std::size_t>(sector) % GroundHorizon::kSectors;
}

}  // namespace

std::vector<GroundHorizon::Block> GroundHorizon::blocksOf(const Mesh& mesh) {
  const int across = mesh.columns + 1;
  const auto squares = static_cast<std::size_t>(mesh.columns) * static_cast<std::size_t>(mesh.rows);
  const bool whole =
      mesh.vertices.size() == squares + static_cast<std::size_t>(mesh.columns + mesh.rows + 1) &&
      mesh.indices->size() == 6 * squares;
  std::vector<Block> blocks;
  if (!whole || mesh.columns < kBlock || mesh.rows < kBlock) return blocks;
  std::vector<std::pair<float, float>> heights(mesh.vertices.size());
  for (const SurfaceVertex& vertex : mesh.vertices) {
    heights[static_cast<std::size_t>(vertex.row * across + vertex.column)] = drawnHeights(vertex);
  }
  for (int south = 0; south < mesh.rows; south += kBlock) {
    for (int west = 0; west < mesh.columns; west += kBlock) {
      const int north = std::min(south + kBlock, mesh.rows), east = std::min(west + kBlock, mesh.columns);
      Block block{static_cast<std::int16_t>(west),        static_cast<std::int16_t>(south),
                  static_cast<std::int16_t>(east),        static_cast<std::int16_t>(north),
                  std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
      for (int row = south; row <= north; ++row) {
        for (int column = west; column <= east; ++column) {
          const auto [low, high] = heights[static_cast<std::size_t>(row * across + column)];
          block.low = std::min(block.low, low);
          block.high = std::max(block.high, high);
        }
      }
      blocks.push_back(block);
    }
  }
  return blocks;
}

/// Adds the mesh's parts, and what they hide; returns false where the near plane may cut some of it away.
bool GroundHorizon::add(const Mesh& mesh, std::size_t number, const ScenePlacement& placement,
                        const SbVec3d& eye, double nearest) {
  const SbVec3d corner = placement.position(Sample{mesh.originColumn, mesh.originRow}) - eye;
  const double step = std::ldexp(placement.spacing(), mesh.level);
  const auto addBlock = [&](const Block& block, bool hides) {
    const Place place{corner[0] + step * block.west,
                      corner[1] + step * block.south,
                      corner[0] + step * block.east,
                      corner[1] + step * block.north,
                      corner[2] + static_cast<double>(block.low),
                      corner[2] + static_cast<double>(block.high)};
    const double near = place.nearest(), far = place.farthest();
    if (near < 2.0 * nearest && place.high > -2.0 * nearest) return false;
    if (!(near > 0.0)) {
      seen_[number] = 1;
      return true;
    }
    const auto [first, last] = sectorsOf(place);
    parts_.push_back({near, place.high / (place.high > 0.0 ? near : far), static_cast<int>(std::floor(first)),
                      static_cast<int>(std::floor(last)), number});
    // It fills only these from edge to edge.
    const int from = static_cast<int>(std::ceil(first)), to = static_cast<int>(std::floor(last)) - 1;
    if (hides && from <= to) ridges_.push_back({far, place.low / (place.low > 0.0 ? far : near), from, to});
    return true;
  };
  const auto [found, isNew] = blocks_.try_emplace(&mesh);
  if (isNew) found->second = blocksOf(mesh);
  if (found->second.empty()) {
    return addBlock({0, 0, static_cast<std::int16_t>(mesh.columns), static_cast<std::int16_t>(mesh.rows),
                     mesh.minHeight, mesh.maxHeight},
                    false);
  }
  return std::all_of(found->second.begin(), found->second.end(),
                     [&](const Block& block) { return addBlock(block, true); });
}

void GroundHorizon::raise(const Ridge& ridge) noexcept {
  for (int sector = ridge.first; sector <= ridge.last; ++sector) {
    double& slope = horizon_[wrapped(sector)];
    slope = std::max(slope, ridge.slope);
  }
}

bool GroundHorizon::isBelow(const Part& part) const noexcept {
  for (int sector = part.first; sector <= part.last; ++sector) {
    if (!(horizon_[wrapped(sector)] > part.slope + 1e-9)) return false;
  }
  return true;
}

void GroundHorizon::leaveOutHidden(std::vector<const Mesh*>& meshes, const Scene& scene,
                                   const MovedVertices& moved, const ScenePlacement& placement,
                                   const SbVec3d& eye, double nearest) {
  if (!isAboveGround(scene, moved, placement, eye)) return;
  ridges_.clear();
  parts_.clear();
  seen_.assign(meshes.size(), 0);
  for (std::size_t number = 0; number < meshes.size(); ++number) {
    if (!add(*meshes[number], number, placement, eye, nearest)) return;
  }
  const auto isNearer = [](const auto& a, const auto& b) { return a.distance < b.distance; };
  std::sort(ridges_.begin(), ridges_.end(), isNearer);
  std::sort(parts_.begin(), parts_.end(), isNearer);
  horizon_.fill(-std::numeric_limits<double>::infinity());
  auto ridge = ridges_.begin();
  for (const Part& part : parts_) {
    for (; ridge != ridges_.end() && ridge->distance <= part.distance; ++ridge) raise(*ridge);
    if (seen_[part.mesh] == 0 && !isBelow(part)) seen_[part.mesh] = 1;
  }
  std::size_t number = 0;
  std::erase_if(meshes, [&](const Mesh*) { return seen_[number++] == 0; });
}

}  // namespace teren
