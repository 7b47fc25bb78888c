#include "stream/SceneRay.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "teren/Object.h"

namespace teren {

namespace {

/// A component of the direction that is less of the largest than this moves nothing by as much as an atom.
constexpr double kNoMove = 1e-200;

double cross(double ax, double ay, double bx, double by) noexcept {
  return ax * by - ay * bx;
}

}  // namespace

bool SceneRay::isRay(const Ray& ray) noexcept {
  bool moves = false;
  for (const double component : ray.direction) {
    if (!std::isfinite(component)) return false;
    moves = moves || component != 0.0;
  }
  return moves && ray.from.valid() && std::fabs(ray.height) <= kMostHeight && ray.length >= 0.0;
}

SceneRay::SceneRay(const SceneIndex& index, double spacing, int intervals, const Ray& ray,
                   bool beginsOverGround, const SeenVertices* seen)
    : index_(index),
      seen_(seen),
      spacing_(spacing),
      height_(ray.height),
      beginsOverGround_(beginsOverGround) {
  const double east = ray.from.u * intervals, north = ray.from.v * intervals;
  column_ = ray.from.i * intervals + static_cast<std::int64_t>(std::floor(east)) - index.cornerColumn();
  row_ = ray.from.j * intervals + static_cast<std::int64_t>(std::floor(north)) - index.cornerRow();
  beyondX_ = east - std::floor(east);
  beyondY_ = north - std::floor(north);
  const auto size = [&](std::size_t axis) { return std::fabs(ray.direction[axis]); };
  const std::size_t most = size(2) >= size(0) && size(2) >= size(1) ? 2 : (size(1) >= size(0) ? 1 : 0);
  axes_ = {(most + 1) % 3, (most + 2) % 3, most};
  length_ = ray.length;
  scale_ = size(most);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    direction_[axis] = ray.direction[axis] / scale_;
    if (std::fabs(direction_[axis]) < kNoMove) direction_[axis] = 0.0;
  }
  shearX_ = direction_[axes_[0]] / direction_[most];
  shearY_ = direction_[axes_[1]] / direction_[most];
  line_ = {0.0, 0.0, direction_[0] / spacing, direction_[1] / spacing};
  const std::int64_t side = std::int64_t{1} << index.rootShift();
  reach_ = rayError(std::max({std::fabs(x(0)), std::fabs(x(side)), std::fabs(y(0)), std::fabs(y(side))}));
  span_ = {0.0, ray.length * scale_};
  const double run = std::max(std::fabs(line_.dx), std::fabs(line_.dy));
  slack_ = run > 0.0 ? 4.0 * reach_ / run : std::numeric_limits<double>::infinity();
}

RayHit SceneRay::firstHit() {
  const Square root{0, 0, index_.rootShift()};
  const auto overRoot = [&](double reach, const Span& when, const auto& visit) {
    const WalkedGrid whole{x(0), y(0), static_cast<double>(std::int64_t{1} << root.shift), 1, 1};
    walkGrid(line_, whole, reach, when, [&](int, int, const Span& span) {
      return visit(index_.root(), index_.rootExtent(), root, span);
    });
  };
  overRoot(reach_, span_, [&](const auto&... over) { return overEntry(over...); });
  RayHit hit;
  hit.end = hit_ ? RayEnd::ground : RayEnd::nothing;
  hit.way = hit_ ? time_ / scale_ : 0.0;
  const double end = hit_ ? time_ : span_.end, sure = hit_ ? hit.way : length_;
  if (line_.dx == 0.0 && line_.dy == 0.0) {
    hit.known = beginsOverGround_ ? sure : 0.0;
  } else if (beginsOverGround_) {
    overRoot(0.0, {0.0, end}, [&](const auto&... over) { return coverEntry(over...); });
    hit.known = covered_ >= end - slack_ ? sure : covered_ / scale_;
  }
  if (!hit_) return hit;
  hit.level = mesh_->level;
  hit.error = static_cast<double>(mesh_->error);
  if (seen_ != nullptr) hit.error += movedAtHit();
  const Vector &a = triangle_[0].place, &b = triangle_[1].place, &c = triangle_[2].place;
  const Vector ab{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, ac{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const Vector normal{cross(ab[1], ab[2], ac[1], ac[2]), cross(ab[2], ab[0], ac[2], ac[0]),
                      cross(ab[0], ab[1], ac[0], ac[1])};
  const double size = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  for (std::size_t axis = 0; axis < 3; ++axis) hit.normal[axis] = normal[axis] / size;
  hit.fromBelow =
      hit.normal[0] * direction_[0] + hit.normal[1] * direction_[1] + hit.normal[2] * direction_[2] > 0.0;
  return hit;
}

// ---- From squares of the tree to triangles

bool SceneRay::overEntry(SceneIndex::Entry entry, const SceneIndex::Extent& extent, const Square& square,
                         const Span& span) {
  if (hit_ && span.begin > time_ + slack_) return false;
  if (entry.kind == SceneIndex::Kind::nothing || !meets(extent.heights, span)) return true;
  if (entry.kind == SceneIndex::Kind::leaf) {
    overLeaf(entry, span);
    return true;
  }
  overChildren(entry, square, reach_, span, [&](const auto&... over) { return overEntry(over...); });
  return true;
}

template <class Visit>
void SceneRay::overChildren(SceneIndex::Entry entry, const Square& square, double reach, const Span& span,
                            const Visit& visit) const {
  const int below = square.shift - SceneIndex::kFanShift;
  const WalkedGrid grid{x(square.west), y(square.south), static_cast<double>(std::int64_t{1} << below),
                        SceneIndex::kFan, SceneIndex::kFan};
  const SceneIndex::Branch& branch = index_.branch(entry);
  const auto extents = index_.extents(entry);
  walkGrid(line_, grid, reach, span, [&](int column, int row, const Span& part) {
    const auto child = static_cast<std::size_t>(row * SceneIndex::kFan + column);
    const Square its{square.west + (std::int64_t{column} << below),
                     square.south + (std::int64_t{row} << below), below};
    return visit(branch.entries[child], extents[child], its, part);
  });
}

void SceneRay::overLeaf(SceneIndex::Entry leaf, const Span& span) {
  for (const std::uint32_t number : index_.meshesOf(leaf)) {
    const IndexedMesh& mesh = index_.meshes()[number];
    if (meets(mesh.heights, span)) overMesh(mesh, span);
  }
}

WalkedGrid SceneRay::blocksOf(const IndexedMesh& mesh) const noexcept {
  return {x(mesh.west), y(mesh.south), static_cast<double>(std::int64_t{1} << mesh.blockShift << mesh.level),
          mesh.blockColumns(), mesh.blockRows()};
}

void SceneRay::overMesh(const IndexedMesh& mesh, const Span& span) {
  walkGrid(line_, blocksOf(mesh), reach_, span, [&](int column, int row, const Span& part) {
    if (hit_ && part.begin > time_ + slack_) return false;
    if (!meets(index_.blockHeights(mesh, column, row), part)) return true;
    mesh.regular ? overSquares(mesh, column, row, part) : meetBag(mesh, column, row);
    return true;
  });
}

void SceneRay::overSquares(const IndexedMesh& mesh, int blockColumn, int blockRow, const Span& span) {
  const int firstColumn = blockColumn << mesh.blockShift, firstRow = blockRow << mesh.blockShift;
  const std::int64_t west = mesh.west + (std::int64_t{firstColumn} << mesh.level);
  const std::int64_t south = mesh.south + (std::int64_t{firstRow} << mesh.level);
  const WalkedGrid squares{x(west), y(south), static_cast<double>(std::int64_t{1} << mesh.level),
                           std::min(1 << mesh.blockShift, mesh.columns - firstColumn),
                           std::min(1 << mesh.blockShift, mesh.rows - firstRow)};
  walkGrid(line_, squares, reach_, span, [&](int column, int row, const Span& part) {
    const SurfaceVertex* const bottom =
        mesh.vertices + std::int64_t{firstRow + row} * (mesh.columns + 1) + firstColumn + column;
    const SurfaceVertex* const top = bottom + mesh.columns + 1;
    const auto [low, high] = std::minmax({heightOf(mesh, bottom[0]), heightOf(mesh, bottom[1]),
                                          heightOf(mesh, top[0]), heightOf(mesh, top[1])});
    if (!meets({low, high}, part)) return true;
    const Corner southWest = corner(mesh, bottom[0]), northEast = corner(mesh, top[1]);
    meet(southWest, corner(mesh, bottom[1]), northEast, mesh);
    meet(southWest, northEast, corner(mesh, top[0]), mesh);
    return !hit_ || part.begin <= time_ + slack_;
  });
}

void SceneRay::meetBag(const IndexedMesh& mesh, int blockColumn, int blockRow) {
  for (const std::uint32_t triangle : index_.bucket(mesh, blockColumn, blockRow)) {
    const std::uint32_t* const corners = mesh.indices + triangle;
    meet(corner(mesh, mesh.vertices[corners[0]]), corner(mesh, mesh.vertices[corners[1]]),
         corner(mesh, mesh.vertices[corners[2]]), mesh);
  }
}

/// A function of the vertex's place in the world alone, whichever mesh it is read from: that is what makes
/// sides shared.
SceneRay::Corner SceneRay::corner(const IndexedMesh& mesh, const SurfaceVertex& vertex) const noexcept {
  return {{x(mesh.columnOf(vertex)) * spacing_, y(mesh.rowOf(vertex)) * spacing_,
           static_cast<double>(heightOf(mesh, vertex)) - height_},
          &vertex};
}

float SceneRay::heightOf(const IndexedMesh& mesh, const SurfaceVertex& vertex) const noexcept {
  return seen_ != nullptr ? seen_->height(mesh.columnOf(vertex), mesh.rowOf(vertex), vertex) : vertex.height;
}

bool SceneRay::meets(const HeightSpan& heights, const Span& span) const noexcept {
  const double begin = direction_[2] * span.begin;
  const double end = direction_[2] == 0.0 ? begin : direction_[2] * span.end;
  const double reach = rayError(std::max({std::fabs(begin), std::fabs(end), std::fabs(height_)}));
  return std::max(begin, end) + reach >= static_cast<double>(heights.low) - height_ &&
         std::min(begin, end) - reach <= static_cast<double>(heights.high) - height_;
}

// ---- Triangles

void SceneRay::meet(const Corner& first, const Corner& second, const Corner& third, const IndexedMesh& mesh) {
  const Vector &a = first.place, &b = second.place, &c = third.place;
  const auto [kx, ky, kz] = axes_;
  const double ax = a[kx] - shearX_ * a[kz], ay = a[ky] - shearY_ * a[kz];
  const double bx = b[kx] - shearX_ * b[kz], by = b[ky] - shearY_ * b[kz];
  const double cx = c[kx] - shearX_ * c[kz], cy = c[ky] - shearY_ * c[kz];
  const double u = cross(bx, by, cx, cy), v = cross(cx, cy, ax, ay), w = cross(ax, ay, bx, by);
  if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return;
  const double sum = u + v + w;
  double time = (u * a[kz] + v * b[kz] + w * c[kz]) / sum * direction_[kz];
  if (sum == 0.0) {  // the ray runs in the triangle's own plane
    const Span over = timesOver({first, second, third}, span_);
    if (over.empty()) return;
    time = over.begin;
  }
  if (!(time >= 0.0 && time <= span_.end) || (hit_ && time >= time_)) return;
  hit_ = true;
  time_ = time;
  mesh_ = &mesh;
  triangle_ = {first, second, third};
}

/// When the ray is over or under a triangle.
Span SceneRay::timesOver(const Triangle& triangle, Span within) const noexcept {
  for (std::size_t k = 0; k < 3 && !within.empty(); ++k) {
    const Vector &from = triangle[k].place, &to = triangle[(k + 1) % 3].place;
    const double sideX = to[0] - from[0], sideY = to[1] - from[1];
    within =
        spanWithin(cross(sideX, sideY, -from[0], -from[1]), cross(sideX, sideY, direction_[0], direction_[1]),
                   0.0, std::numeric_limits<double>::infinity(), within);
  }
  return within;
}

/// [m] By how much the triangle that was hit has moved where it was hit.
double SceneRay::movedAtHit() const noexcept {
  const double east = direction_[0] * time_, north = direction_[1] * time_;
  double sum = 0.0, moved = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector &from = triangle_[(k + 1) % 3].place, &to = triangle_[(k + 2) % 3].place;
    const double weight = cross(from[0] - east, from[1] - north, to[0] - east, to[1] - north);
    const double lying = static_cast<double>(triangle_[k].vertex->height) - height_;
    sum += weight;
    moved += weight * (triangle_[k].place[2] - lying);
  }
  return std::fabs(moved / sum);
}

// ---- How far there is ground below or above the ray

bool SceneRay::coverEntry(SceneIndex::Entry entry, const SceneIndex::Extent& extent, const Square& square,
                          const Span& span) {
  if (span.begin > covered_ + slack_) return false;
  if (extent.covered) {
    covered_ = std::max(covered_, span.end);
  } else if (entry.kind == SceneIndex::Kind::leaf) {
    for (bool further = true; further;) {
      further = false;
      for (const std::uint32_t number : index_.meshesOf(entry)) {
        further = coverMesh(index_.meshes()[number], span) || further;
      }
    }
  } else if (entry.kind == SceneIndex::Kind::branch) {
    overChildren(entry, square, 0.0, span, [&](const auto&... over) { return coverEntry(over...); });
  }
  return true;
}

/// Whether a mesh takes the covered way further.
bool SceneRay::coverMesh(const IndexedMesh& mesh, const Span& span) {
  const double before = covered_;
  const auto extend = [&](const Span& part) {
    if (!part.empty() && part.begin <= covered_ + slack_) covered_ = std::max(covered_, part.end);
  };
  if (mesh.regular) {
    const Span across = spanWithin(0.0, line_.dx, x(mesh.west), x(mesh.east()), span);
    extend(spanWithin(0.0, line_.dy, y(mesh.south), y(mesh.north()), across));
    return covered_ > before;
  }
  walkGrid(line_, blocksOf(mesh), reach_, span, [&](int column, int row, const Span&) {
    for (const std::uint32_t triangle : index_.bucket(mesh, column, row)) {
      Triangle corners;
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = corner(mesh, mesh.vertices[mesh.indices[triangle + k]]);
      extend(timesOver(corners, span));
    }
    return true;
  });
  return covered_ > before;
}

}  // namespace teren
