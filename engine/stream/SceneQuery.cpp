#include "teren/SceneQuery.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "height/Surface.h"
#include "stream/SceneIndex.h"
#include "stream/SceneRay.h"

namespace teren {

namespace {

/// Places looked up before the first is answered: enough that the vertices of one come from memory while
/// others are looked up, few enough for the stack.
constexpr std::size_t kBatch = 64;

/// Where an answer comes from: a square of a regular mesh, or a triangle of another.
struct Found {
  const IndexedMesh* mesh = nullptr;         ///< nullptr: nothing there
  const SurfaceVertex* southWest = nullptr;  ///< of the square
  const std::uint32_t* corners = nullptr;    ///< of the triangle
  double x = 0.0, y = 0.0;                   ///< in the square, 0 ... 1; or in the mesh, in steps
};

double cross(double ax, double ay, double bx, double by) noexcept {
  return ax * by - bx * ay;
}

/// The triangle of a bag that a place, in the mesh's steps, lies in, rims included; nullptr where none does.
const std::uint32_t* triangleAt(const SceneIndex& index, const IndexedMesh& mesh, double x, double y) {
  const auto block = [&](double at, int blocks) {
    return std::min(static_cast<int>(at) >> mesh.blockShift, blocks - 1);
  };
  for (const std::uint32_t triangle :
       index.bucket(mesh, block(x, mesh.blockColumns()), block(y, mesh.blockRows()))) {
    const std::uint32_t* const corners = mesh.indices + triangle;
    const auto inside = [&](std::size_t from, std::size_t to) {
      const SurfaceVertex& a = mesh.vertices[corners[from]];
      const SurfaceVertex& b = mesh.vertices[corners[to]];
      return cross(a.column - x, a.row - y, b.column - x, b.row - y) >= 0.0;
    };
    if (inside(0, 1) && inside(1, 2) && inside(2, 0)) return corners;
  }
  return nullptr;
}

void answerSquare(const Found& found, double spacing, DrawnPoint& answer) {
  const SurfaceVertex* const south = found.southWest;
  const SurfaceVertex* const north = south + found.mesh->columns + 1;
  const SquareHeights heights{static_cast<double>(south[0].height), static_cast<double>(south[1].height),
                              static_cast<double>(north[0].height), static_cast<double>(north[1].height)};
  const TrianglePoint point = sampleTriangle(heights, found.x, found.y);
  answer.height = point.height;
  answer.normal = faceNormal(point, spacing * static_cast<double>(std::int64_t{1} << found.mesh->level));
}

void answerTriangle(const Found& found, double spacing, DrawnPoint& answer) {
  const auto corner = [&](std::size_t k) -> const SurfaceVertex& {
    return found.mesh->vertices[found.corners[k]];
  };
  const SurfaceVertex& a = corner(0);
  const auto rise = [&](std::size_t k) {
    return static_cast<double>(corner(k).height) - static_cast<double>(a.height);
  };
  const double bx = corner(1).column - a.column, by = corner(1).row - a.row, bz = rise(1);
  const double cx = corner(2).column - a.column, cy = corner(2).row - a.row, cz = rise(2);
  const double area = cross(bx, by, cx, cy);  // > 0: anticlockwise
  TrianglePoint point;
  point.slopeX = (bz * cy - cz * by) / area;
  point.slopeY = (cz * bx - bz * cx) / area;
  point.height = static_cast<double>(a.height) +
                 ((found.x - a.column) * point.slopeX + (found.y - a.row) * point.slopeY);
  answer.height = point.height;
  answer.normal = faceNormal(point, spacing * static_cast<double>(std::int64_t{1} << found.mesh->level));
}

}  // namespace

class SceneQuery::State {
 public:
  State(std::shared_ptr<const Scene> theScene, int theIntervals, std::span<const float> errors,
        const State* before)
      : scene(std::move(theScene)),
        intervals(theIntervals),
        index(*scene, theIntervals, errors, before != nullptr ? &before->index : nullptr) {}

  Found find(const Position& place) const;
  void answer(std::span<const Position> places, std::span<DrawnPoint> answers) const;

  std::shared_ptr<const Scene> scene;
  int intervals;
  SceneIndex index;
};

Found SceneQuery::State::find(const Position& place) const {
  Found found;
  if (!place.valid()) return found;
  const double n = intervals, x = place.u * n, y = place.v * n;  // exact: n is a power of two
  const double squareX = std::floor(x), squareY = std::floor(y);
  const std::int64_t column = place.i * intervals + static_cast<std::int64_t>(squareX) - index.cornerColumn();
  const std::int64_t row = place.j * intervals + static_cast<std::int64_t>(squareY) - index.cornerRow();
  const SceneIndex::Entry leaf = index.leafAt(column, row);
  if (leaf.kind == SceneIndex::Kind::nothing) return found;
  for (const std::uint32_t number : index.meshesOf(leaf)) {
    const IndexedMesh& mesh = index.meshes()[number];
    const std::int64_t east = column - mesh.west, north = row - mesh.south;
    if (!mesh.holds(east >> mesh.level, north >> mesh.level)) continue;
    const double step = 1.0 / static_cast<double>(std::int64_t{1} << mesh.level);
    if (mesh.regular) {
      const std::int64_t beyond = (std::int64_t{1} << mesh.level) - 1;
      const std::int64_t square =
          (north >> mesh.level) * (std::int64_t{mesh.columns} + 1) + (east >> mesh.level);
      found.mesh = &mesh;
      found.southWest = mesh.vertices + square;
      found.x = (static_cast<double>(east & beyond) + (x - squareX)) * step;
      found.y = (static_cast<double>(north & beyond) + (y - squareY)) * step;
      __builtin_prefetch(found.southWest);
      __builtin_prefetch(found.southWest + mesh.columns + 1);
      return found;
    }
    found.x = (static_cast<double>(east) + (x - squareX)) * step;
    found.y = (static_cast<double>(north) + (y - squareY)) * step;
    found.corners = triangleAt(index, mesh, found.x, found.y);
    if (found.corners != nullptr) {
      found.mesh = &mesh;
      return found;
    }
  }
  return found;
}

void SceneQuery::State::answer(std::span<const Position> places, std::span<DrawnPoint> answers) const {
  std::array<Found, kBatch> found;
  for (std::size_t k = 0; k < places.size(); ++k) found[k] = find(places[k]);
  for (std::size_t k = 0; k < places.size(); ++k) {
    DrawnPoint& answer = answers[k];
    answer.there = found[k].mesh != nullptr;
    if (!answer.there) continue;
    answer.level = found[k].mesh->level;
    answer.error = static_cast<double>(found[k].mesh->error);
    if (found[k].mesh->regular) {
      answerSquare(found[k], scene->spacing(), answer);
    } else {
      answerTriangle(found[k], scene->spacing(), answer);
    }
  }
}

SceneQuery::SceneQuery(std::shared_ptr<const Scene> scene, int intervals, std::span<const float> errors,
                       const SceneQuery* before)
    : state_(std::make_unique<const State>(std::move(scene), intervals, errors,
                                           before != nullptr ? before->state_.get() : nullptr)) {}
SceneQuery::~SceneQuery() = default;
SceneQuery::SceneQuery(SceneQuery&&) noexcept = default;
SceneQuery& SceneQuery::operator=(SceneQuery&&) noexcept = default;

const std::shared_ptr<const Scene>& SceneQuery::scene() const noexcept {
  return state_->scene;
}

std::size_t SceneQuery::bytes() const noexcept {
  return sizeof(State) + state_->index.bytes();
}

void SceneQuery::points(std::span<const Position> places, std::span<DrawnPoint> answers) const {
  assert(places.size() == answers.size());
  for (std::size_t first = 0; first < places.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, places.size() - first);
    state_->answer(places.subspan(first, count), answers.subspan(first, count));
  }
}

void SceneQuery::firstHits(std::span<const Ray> rays, std::span<RayHit> hits) const {
  assert(rays.size() == hits.size());
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const Ray& ray = rays[k];
    hits[k] = {};
    if (!SceneRay::isRay(ray)) continue;
    const bool covered = state_->find(ray.from).mesh != nullptr;
    hits[k] = SceneRay(state_->index, state_->scene->spacing(), state_->intervals, ray, covered).firstHit();
  }
}

}  // namespace teren
