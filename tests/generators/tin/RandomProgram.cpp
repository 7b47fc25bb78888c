#include "tests/generators/tin/RandomProgram.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace teren::test {

const char* nameOf(PointKind kind) {
  switch (kind) {
    case PointKind::uniform:
      return "uniform";
    case PointKind::clustered:
      return "clustered";
    case PointKind::gridded:
      return "gridded";
    case PointKind::collinear:
      return "collinear";
    case PointKind::spiral:
      return "spiral";
  }
  return "unknown";
}

RandomProgram::RandomProgram(std::uint64_t seed, PointKind kind, std::size_t vertices, std::int32_t side)
    : random_(seed),
      kind_(kind),
      vertices_(vertices),
      side_(side),
      mesh_(LatticeFrame{.width = side, .height = side}) {}

LatticePoint RandomProgram::randomPoint() {
  const auto upTo = [this](std::int64_t n) {
    return static_cast<std::int32_t>(random_.next() % static_cast<std::uint64_t>(n + 1));
  };
  const auto inBox = [this](double x) {
    return static_cast<std::int32_t>(std::clamp(x, 0.0, static_cast<double>(side_)));
  };
  if (random_.next() % 32 == 0) {  // on the border
    const std::int32_t along = upTo(side_), across = random_.next() % 2 == 0 ? 0 : side_;
    return random_.next() % 2 == 0 ? LatticePoint{along, across} : LatticePoint{across, along};
  }
  switch (kind_) {
    case PointKind::uniform:
      return {upTo(side_), upTo(side_)};
    case PointKind::clustered: {
      const std::uint64_t cluster = random_.next() % 5;
      const std::int32_t reach = std::max(side_ >> (2 + 4 * static_cast<int>(cluster)), 8);
      const double x = static_cast<double>(mixBits(cluster) % 1000) / 1000.0 * side_;
      const double y = static_cast<double>(mixBits(cluster + 9) % 1000) / 1000.0 * side_;
      return {inBox(x + upTo(reach)), inBox(y + upTo(reach))};
    }
    case PointKind::gridded: {
      const std::int32_t cells =
          std::max(4, static_cast<std::int32_t>(std::sqrt(static_cast<double>(vertices_))));
      return {side_ / cells * upTo(cells), side_ / cells * upTo(cells)};
    }
    case PointKind::collinear: {
      const std::int32_t t = upTo(side_ / 4);
      const std::int32_t line = upTo(3);
      if (line == 0) return {t, side_ / 2};
      if (line == 1) return {side_ / 3, t};
      if (line == 2) return {t, t};
      return {2 * t, side_ - 3 * t};
    }
    case PointKind::spiral: {
      const double turn = 0.0005 * upTo(80000);
      const double radius = side_ / 2.1 * turn / 40.0;
      return {inBox(side_ / 2.0 + radius * std::cos(turn)), inBox(side_ / 2.0 + radius * std::sin(turn))};
    }
  }
  return {};
}

VertexId RandomProgram::randomVertex() {
  for (;;) {
    const auto v = static_cast<VertexId>(random_.next() % mesh_.vertexSlots());
    if (mesh_.isVertex(v)) return v;
  }
}

/// Near, far, stale or none: it must not matter.
TriangleId RandomProgram::randomHint() {
  return random_.next() % 4 == 0 ? kNoTriangle
                                 : static_cast<TriangleId>(random_.next() % (mesh_.triangleSlots() + 2));
}

void RandomProgram::insertOne() {
  const LatticePoint p = randomPoint();
  const std::size_t before = mesh_.vertexCount();
  const Insertion insertion = random_.next() % 2 == 0
                                  ? mesh_.insert(p, static_cast<double>(random_.nextBits(10)), randomHint())
                                  : mesh_.insertOnSurface(p, randomHint());
  touched_.push_back(insertion.vertex);
  if (mesh_.point(insertion.vertex) != p) complaint_ = "a vertex was inserted at another point";
  if (mesh_.vertexCount() != before + (insertion.isNew ? 1 : 0)) complaint_ = "isNew does not tell the truth";
}

void RandomProgram::insertMany() {
  std::vector<LatticePoint> points(1 + random_.next() % 20);
  std::vector<double> heights(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = randomPoint();
  touched_ = mesh_.insert(points, heights);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (mesh_.point(touched_[i]) != points[i]) complaint_ = "a vertex was inserted at another point";
  }
}

void RandomProgram::removeOne() {
  const VertexId v = randomVertex();
  const bool mayGo = mesh_.constraintsAt(v) == 0 && !mesh_.frame().isCorner(mesh_.point(v));
  mesh_.forEachNeighbour(v, [&](VertexId w) { touched_.push_back(w); });
  if (mesh_.remove(v) != mayGo) complaint_ = "a vertex went that had to stay, or the other way round";
  if (mesh_.isVertex(v) == mayGo) complaint_ = "a vertex is still there, or no longer";
}

void RandomProgram::constrainOne() {
  const VertexId a = randomVertex();
  VertexId b = randomVertex();
  if (random_.next() % 4 != 0) {  // a short way, so that most do not cross
    for (int n = 0; n < 3; ++n)
      mesh_.forEachNeighbour(b = n == 0 ? a : b, [&](VertexId w) {
        if (random_.next() % 3 == 0) b = w;
      });
  }
  touched_ = {a, b};
  const std::size_t before = mesh_.vertexCount();
  const int added = mesh_.constrain(a, b, nextId_++);
  if (mesh_.vertexCount() != before + static_cast<std::size_t>(added))
    complaint_ = "crossings were miscounted";
  if (a != b && (mesh_.constraintsAt(a) == 0 || mesh_.constraintsAt(b) == 0)) {
    complaint_ = "no constrained edge ends where the constraint does";
  }
}

void RandomProgram::unconstrainOne() {
  const VertexId a = randomVertex();
  std::vector<VertexId> others;
  mesh_.forEachNeighbour(a, [&](VertexId w) {
    if (mesh_.constraint(a, w)) others.push_back(w);
  });
  touched_ = {a};
  for (const VertexId w : others) {
    if (!mesh_.unconstrain(a, w) || mesh_.constraint(a, w)) complaint_ = "a constraint could not be undone";
    touched_.push_back(w);
  }
  if (mesh_.unconstrain(a, a)) complaint_ = "a constraint was undone that was not there";
}

void RandomProgram::locateOne() {
  const VertexId v = randomVertex();
  if (mesh_.vertexAt(mesh_.point(v), randomHint()) != v) complaint_ = "a vertex was not found where it is";
  const LatticePoint p = randomPoint();
  const Location place = mesh_.locate(p, randomHint());
  const std::array<VertexId, 3>& corners = mesh_.corners(place.triangle);
  int zeros = 0;
  for (int i = 0; i < 3; ++i) {
    const std::int64_t area =
        orientation(mesh_.point(corners[following(i)]), mesh_.point(corners[preceding(i)]), p);
    if (area < 0) complaint_ = "a point was located in a triangle that does not hold it";
    if (area == 0) ++zeros;
    if (place.kind == Location::Kind::edge && (area == 0) != (i == place.corner))
      complaint_ = "another edge was named";
    if (place.kind == Location::Kind::vertex && (area != 0) != (i == place.corner)) {
      complaint_ = "another corner was named";
    }
  }
  if (zeros != static_cast<int>(place.kind)) complaint_ = "face, edge and vertex were mixed up";
}

void RandomProgram::step() {
  touched_.clear();
  complaint_.clear();
  const std::uint64_t dice = random_.next() % 100;
  if (mesh_.vertexCount() > vertices_ + vertices_ / 5) {  // crossings add more than is wanted, and hold it
    dice < 50 ? unconstrainOne() : removeOne();
    return;
  }
  // Grows to the wanted size, shrinks to a third of it, and so on.
  const bool grows = mesh_.vertexCount() < vertices_ / 3 + random_.next() % (vertices_ + 1);
  if (dice < 3 && grows) {
    insertMany();
  } else if (dice < 60) {
    grows ? insertOne() : removeOne();
  } else if (dice < 70) {
    removeOne();
  } else if (dice < 80) {
    constrainOne();
  } else if (dice < 93) {
    unconstrainOne();
  } else {
    locateOne();
  }
}

}  // namespace teren::test
