#include "generators/sand/Slides.h"

#include <algorithm>
#include <array>
#include <utility>

namespace teren {
namespace {

constexpr double kShortestLimit = 8.0;  // [steps]

double squaredLength(LatticePoint a, LatticePoint b) noexcept {
  const double x = b.x - a.x, y = b.y - a.y;
  return x * x + y * y;
}

/// The edge a b, or a long one beside it that stays and in whose circle the middle of a b would lie.
std::pair<VertexId, VertexId> edgeToDivide(const SandSurface& surface, VertexId a, VertexId b, double limit) {
  const Triangulation& mesh = surface.mesh();
  const LatticePoint p = surface.middle(a, b);
  std::pair<VertexId, VertexId> found{a, b};
  mesh.forEachCorner(a, [&](Link at) {
    const std::array<VertexId, 3>& corners = mesh.corners(at.triangle());
    const int after = following(at.side()), before = preceding(at.side());
    if (corners[after] != b && corners[before] != b) return;
    for (int i = 0; i < 3; ++i) {
      const VertexId c = corners[following(i)], d = corners[preceding(i)];
      if ((c == a && d == b) || (c == b && d == a)) continue;
      const LatticePoint one = mesh.point(c), other = mesh.point(d);
      if (squaredLength(one, other) <= limit * limit) continue;
      const double dot = static_cast<double>(one.x - p.x) * (other.x - p.x) +
                         static_cast<double>(one.y - p.y) * (other.y - p.y);
      if (dot >= 0.0) continue;
      if (mesh.neighbour(at.triangle(), i) == kNoTriangle || mesh.constraint(c, d)) found = {c, d};
    }
  });
  return found;
}

}  // namespace

void Slides::addAround(const SandSurface& surface, VertexId v) {
  if (surface.isFixed(v)) return;
  surface.mesh().forEachCorner(v, [this](Link at) { add(at.triangle()); });
}

void Slides::addAll(const SandSurface& surface) {
  for (TriangleId t = 0; t < surface.mesh().triangleSlots(); ++t) {
    if (surface.mesh().isTriangle(t)) add(t);
  }
}

bool Slides::advance(SandSurface& surface, std::uint64_t steps) {
  for (; steps > 0 && !atRest(); --steps) {
    if (position_ == now_.size()) {
      now_.clear();
      now_.swap(next_);
      position_ = 0;
      ++count_.sweeps;
    }
    const TriangleId t = now_[position_++];
    waiting_.erase(t);
    ++count_.steps;
    if (surface.mesh().isTriangle(t)) look(surface, t);
  }
  return atRest();
}

void Slides::stop() noexcept {
  for (std::size_t n = position_; n < now_.size(); ++n) waiting_.erase(now_[n]);
  for (const TriangleId t : next_) waiting_.erase(t);
  now_.clear();
  next_.clear();
  position_ = 0;
}

void Slides::forgetGone(const SandSurface& surface) {
  const auto isGone = [&](TriangleId t) {
    if (surface.mesh().isTriangle(t)) return false;
    waiting_.erase(t);
    return true;
  };
  now_.erase(now_.begin(), now_.begin() + static_cast<std::ptrdiff_t>(position_));
  position_ = 0;
  std::erase_if(now_, isGone);
  std::erase_if(next_, isGone);
}

void Slides::forgetLeanedOn(const SandSurface& surface) {
  ChangeList left;
  for (const VertexId v : leanedOn_.ids()) {
    if (surface.isFixed(v)) {
      left.add(v);
    } else {
      addAround(surface, v);
    }
  }
  leanedOn_ = std::move(left);
}

void Slides::takeLeanedOn(const Slides& other, std::span<const VertexId> taken) {
  for (const VertexId v : other.leanedOn_.ids()) leanedOn_.add(taken[v]);
}

/// One that is steeper than it may be and bears something loose.
std::optional<Slides::SteepFace> Slides::steepFace(const SandSurface& surface, TriangleId t) const {
  Face face = surface.unweighedFace(t);
  const double slope = slopeOf(face, surface.step());
  if (!(slope > repose_.start)) return std::nullopt;
  const auto bears = [](const FaceCorner& corner) { return corner.loose > kBareTicks; };
  if (std::none_of(face.begin(), face.end(), bears)) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) face[i].isFixed = surface.isFixed(surface.mesh().corners(t)[i]);
  return SteepFace{face, slope};
}

bool Slides::leansOn(const SandSurface& surface, VertexId fixed, std::int64_t more) const {
  bool leans = false;
  surface.mesh().forEachCorner(fixed, [&](Link at) {
    if (leans) return;
    const std::optional<SteepFace> steep = steepFace(surface, at.triangle());
    const auto bearsMore = [more](const FaceCorner& corner) { return corner.loose > more; };
    leans = steep && teren::leansOn(steep->face, static_cast<std::size_t>(at.side())) &&
            std::ranges::any_of(steep->face, bearsMore);
  });
  return leans;
}

void Slides::look(SandSurface& surface, TriangleId t) {
  std::optional<SteepFace> steep = steepFace(surface, t);
  if (!steep) return;
  Face& face = steep->face;
  const std::array<VertexId, 3> corners = surface.mesh().corners(t);
  for (std::size_t i = 0; i < 3; ++i) {
    // Of what lies around a fixed corner some is outside, and must leave no trace.
    face[i].weight = face[i].isFixed ? orientation(face[0].place, face[1].place, face[2].place)
                                     : surface.weight(corners[i], stars_[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (face[i].isFixed && teren::leansOn(face, i)) leanedOn_.add(corners[i]);
  }
  const auto move = slideFace(face, repose_, surface.step(), surface.ledger());
  if (!move || (steep->slope > repose_.divide && divideEdges(surface, t, face))) return;
  surface.apply(t, face, *move, stars_);
  ++count_.moves;
  for (std::size_t i = 0; i < 3; ++i) {
    if ((*move)[i] == 0) continue;
    for (const TriangleId around : stars_[i]) add(around);
  }
}

/// Divides long edges at the corners that would fall, those above the face's middle height. True where there
/// was one: the face waits again, or is gone.
bool Slides::divideEdges(SandSurface& surface, TriangleId t, const Face& face) {
  const std::array<VertexId, 3> corners = surface.mesh().corners(t);
  const auto [low, high] = std::minmax({face[0].height, face[1].height, face[2].height});
  const std::int64_t half = low + (high - low) / 2;
  bool divided = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool falls = face[i].height > half && face[i].loose > kBareTicks;
    if (falls && divideEdgesAt(surface, corners[i])) divided = true;
  }
  if (divided) add(t);
  return divided;
}

bool Slides::divideEdgesAt(SandSurface& surface, VertexId v) {
  if (!SandSurface::hasRoom(surface.mesh().vertexCount())) return false;
  const double limit = std::max(longestEdge_ / surface.step(), kShortestLimit);
  far_.clear();
  surface.mesh().forEachNeighbour(v, [&](VertexId n) {
    if (squaredLength(surface.mesh().point(v), surface.mesh().point(n)) > limit * limit) far_.push_back(n);
  });
  bool divided = false;
  for (const VertexId n : far_) {
    if (!surface.mesh().isEdge(v, n)) continue;  // flipped away by one divided before
    const auto [a, b] = edgeToDivide(surface, v, n, limit);
    const VertexId between = surface.divide(a, b);
    if (between == kNoVertex) continue;
    surface.settle({&between, 1});
    for (const TriangleChange& change : surface.lastChanges()) add(change.triangle);
    ++count_.splits;
    divided = true;
  }
  return divided;
}

std::size_t Slides::bytes() const noexcept {
  return sizeof(*this) + waiting_.bytes() + leanedOn_.bytes() +
         (now_.capacity() + next_.capacity()) * sizeof(TriangleId) + far_.capacity() * sizeof(VertexId) +
         (stars_[0].capacity() + stars_[1].capacity() + stars_[2].capacity()) * sizeof(TriangleId);
}

double steepestLooseSlope(const SandSurface& surface) {
  double steepest = 0.0;
  for (TriangleId t = 0; t < surface.mesh().triangleSlots(); ++t) {
    if (!surface.mesh().isTriangle(t)) continue;
    const Face face = surface.unweighedFace(t);
    if (isLoose(face)) steepest = std::max(steepest, slopeOf(face, surface.step()));
  }
  return steepest;
}

}  // namespace teren
