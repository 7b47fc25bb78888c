#include "teren/SceneQuery.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "height/Surface.h"
#include "stream/SceneIndex.h"
#include "stream/SceneRay.h"
#include "stream/SeenVertices.h"

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

template <class Vertices>
TrianglePoint inSquare(const Found& found, const Vertices& vertices) {
  const SurfaceVertex* const south = found.southWest;
  const SurfaceVertex* const north = south + found.mesh->columns + 1;
  const auto height = [&](const SurfaceVertex& vertex) {
    return static_cast<double>(
        vertices.height(found.mesh->columnOf(vertex), found.mesh->rowOf(vertex), vertex));
  };
  const SquareHeights heights{height(south[0]), height(south[1]), height(north[0]), height(north[1])};
  return sampleTriangle(heights, found.x, found.y);
}

template <class Vertices>
TrianglePoint inTriangle(const Found& found, const Vertices& vertices) {
  const auto corner = [&](std::size_t k) -> const SurfaceVertex& {
    return found.mesh->vertices[found.corners[k]];
  };
  const auto height = [&](std::size_t k) {
    const SurfaceVertex& vertex = corner(k);
    return static_cast<double>(
        vertices.height(found.mesh->columnOf(vertex), found.mesh->rowOf(vertex), vertex));
  };
  const SurfaceVertex& a = corner(0);
  const double az = height(0);
  const double bx = corner(1).column - a.column, by = corner(1).row - a.row, bz = height(1) - az;
  const double cx = corner(2).column - a.column, cy = corner(2).row - a.row, cz = height(2) - az;
  const double area = cross(bx, by, cx, cy);  // > 0: anticlockwise
  TrianglePoint point;
  point.slopeX = (bz * cy - cz * by) / area;
  point.slopeY = (cz * bx - bz * cx) / area;
  point.height = az + ((found.x - a.column) * point.slopeX + (found.y - a.row) * point.slopeY);
  return point;
}

template <class Vertices>
TrianglePoint inFound(const Found& found, const Vertices& vertices) {
  return found.mesh->regular ? inSquare(found, vertices) : inTriangle(found, vertices);
}

}  // namespace

class SceneQuery::State {
 public:
  State(std::shared_ptr<const Scene> theScene, int theIntervals, std::span<const float> errors,
        const State* before)
      : scene(std::move(theScene)),
        intervals(theIntervals),
        known(std::make_shared<const SceneIndex>(*scene, theIntervals, errors,
                                                 before != nullptr ? before->known.get() : nullptr)),
        index(*known) {}
  /// What `of` knows, without its scene.
  explicit State(const State& of, std::shared_ptr<const Scene> nothing)
      : scene(std::move(nothing)), intervals(of.intervals), known(of.known), index(noIndex()) {}

  Found find(const Position& place) const;
  SeenVertices seenFrom(const DetailEye& eye, const Morph& morph) const noexcept {
    return {eye, morph, {index.cornerColumn(), index.cornerRow()}, intervals, scene->spacing()};
  }
  template <class Vertices>
  void answer(std::span<const Position> places, std::span<DrawnPoint> answers,
              const Vertices& vertices) const;
  template <class Vertices>
  void answerAll(std::span<const Position> places, std::span<DrawnPoint> answers,
                 const Vertices& vertices) const;

  std::shared_ptr<const Scene> scene;
  int intervals;
  std::shared_ptr<const SceneIndex> known;  // of meshes that may be gone: ids tell
  const SceneIndex& index;                  // of those of the scene

 private:
  static const SceneIndex& noIndex() {
    static const SceneIndex nothing(Scene{}, 1, {}, nullptr);
    return nothing;
  }
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

template <class Vertices>
void SceneQuery::State::answer(std::span<const Position> places, std::span<DrawnPoint> answers,
                               const Vertices& vertices) const {
  std::array<Found, kBatch> found;
  for (std::size_t k = 0; k < places.size(); ++k) found[k] = find(places[k]);
  for (std::size_t k = 0; k < places.size(); ++k) {
    DrawnPoint& answer = answers[k];
    answer.there = found[k].mesh != nullptr;
    if (!answer.there) continue;
    answer.level = found[k].mesh->level;
    const TrianglePoint point = inFound(found[k], vertices);
    answer.height = point.height;
    answer.normal =
        faceNormal(point, scene->spacing() * static_cast<double>(std::int64_t{1} << answer.level));
    answer.error = static_cast<double>(found[k].mesh->error);
    if constexpr (Vertices::kMoves) {
      answer.error += std::fabs(point.height - inFound(found[k], LyingVertices{}).height);
    }
  }
}

template <class Vertices>
void SceneQuery::State::answerAll(std::span<const Position> places, std::span<DrawnPoint> answers,
                                  const Vertices& vertices) const {
  for (std::size_t first = 0; first < places.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, places.size() - first);
    answer(places.subspan(first, count), answers.subspan(first, count), vertices);
  }
}

SceneQuery::SceneQuery(std::shared_ptr<const Scene> scene, int intervals, std::span<const float> errors,
                       const SceneQuery* before)
    : state_(std::make_shared<const State>(std::move(scene), intervals, errors,
                                           before != nullptr ? before->state_.get() : nullptr)) {}

SceneQuery SceneQuery::seenFrom(const DetailEye& eye, const Morph& morph) const {
  SceneQuery seen(state_);
  if (SeenVertices::moves(eye, morph)) {
    seen.eye_ = eye;
    seen.morph_ = morph;
  }
  return seen;
}

SceneQuery SceneQuery::withoutScene() const {
  return SceneQuery(std::make_shared<const State>(*state_, std::make_shared<const Scene>()));
}

std::size_t SceneQuery::newMeshes() const noexcept {
  return state_->index.measured();
}

const std::shared_ptr<const Scene>& SceneQuery::scene() const noexcept {
  return state_->scene;
}

std::size_t SceneQuery::bytes() const noexcept {
  return sizeof(State) + state_->known->bytes();
}

void SceneQuery::points(std::span<const Position> places, std::span<DrawnPoint> answers) const {
  assert(places.size() == answers.size());
  const State& state = *state_;
  if (!eye_) return state.answerAll(places, answers, LyingVertices{});
  state.answerAll(places, answers, state.seenFrom(*eye_, morph_));
}

void SceneQuery::firstHits(std::span<const Ray> rays, std::span<RayHit> hits) const {
  assert(rays.size() == hits.size());
  std::optional<SeenVertices> seen;
  if (eye_) seen.emplace(state_->seenFrom(*eye_, morph_));
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const Ray& ray = rays[k];
    hits[k] = {};
    if (!SceneRay::isRay(ray)) continue;
    const bool covered = state_->find(ray.from).mesh != nullptr;
    hits[k] = SceneRay(state_->index, state_->scene->spacing(), state_->intervals, ray, covered,
                       seen ? &*seen : nullptr)
                  .firstHit();
  }
}

}  // namespace teren
