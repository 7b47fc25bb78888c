// The proof that sections of bytes are the state of a sandbox. In this order: what may be allocated, what may
// be indexed, then the promises of the surface, whose proof relies on both.
#include <cmath>
#include <cstring>
#include <string>

#include "generators/sand/SandState.h"

namespace teren {
namespace {

constexpr double kFarthest = 1e12;                  // [m] the box's corner
constexpr double kFinest = 1e-12, kCoarsest = 1e6;  // [m] the lattice's step
constexpr std::uint32_t kLastId = 0xffff0000;       // what is left is ample for one tool
constexpr std::int64_t kThickest = 4 * kHighestTick;
constexpr SixfoldVolume kMostOwed = SixfoldVolume{1} << 112;  // twice what any surface holds
constexpr SixfoldVolume kMostMoved = SixfoldVolume{1} << 124;

/// An honest table, three quarters full, has runs of some hundred places at most; longer ones would make
/// every search slow.
constexpr std::size_t kLongestRun = 1024;

std::uint32_t idAt(std::span<const std::byte> list, std::size_t i) {
  std::uint32_t id = 0;
  std::memcpy(&id, list.data() + i * sizeof id, sizeof id);
  return id;
}

}  // namespace

Result<void> SandState::checkNumbers(const Numbers& numbers, const Sections&) {
  const LatticeFrame& frame = numbers.frame;
  const bool box = std::fabs(frame.x) <= kFarthest && std::fabs(frame.y) <= kFarthest &&
                   frame.step >= kFinest && frame.step <= kCoarsest && 1 <= frame.width &&
                   frame.width <= kLatticeSide && 1 <= frame.height && frame.height <= kLatticeSide;
  if (!box) return Error{"its box is none that sand can fill"};
  const SandSettings& set = numbers.settings;
  const bool settings = std::isfinite(set.dryAngle) && std::isfinite(set.moisture) &&
                        set.longestEdge >= 0.0 && std::isfinite(set.flatness) && set.flatness >= 0.0 &&
                        set.stamp.fit >= 0.0 && set.stamp.loosening >= 0.0 && set.stamp.bermWidth >= 0.0;
  if (!settings) return Error{"its settings are out of range"};
  const bool account = -kMostOwed <= numbers.owed && numbers.owed <= kMostOwed && 0 <= numbers.moved &&
                       numbers.moved <= kMostMoved;
  if (!account) return Error{"its account of volume cannot be"};
  if (!(0.0 <= numbers.cleanUp.largestError && numbers.cleanUp.largestError <= set.flatness)) {
    return Error{"its clean-up's error cannot be"};
  }
  if (numbers.nextId > kLastId) return Error{"it has had more stamps than there are numbers for"};
  if (numbers.cellShift < 0 || numbers.cellShift > 28) return Error{"its grid of cells cannot be"};
  return {};
}

Result<void> SandState::checkSizes(const Numbers& numbers, const Sections& sections) {
  constexpr std::array<std::size_t, kSections> kElement{sizeof(Numbers),
                                                        sizeof(TriangleMesh::Vertex),
                                                        sizeof(TriangleMesh::Triangle),
                                                        8,
                                                        8,
                                                        sizeof(ConstraintTable::Place),
                                                        4,
                                                        2,
                                                        4,
                                                        4,
                                                        4,
                                                        4,
                                                        4};
  std::array<std::size_t, kSections> count{};
  for (std::size_t i = 0; i < kSections; ++i) {
    if (sections[i].size() % kElement[i] != 0) return Error{"one of its arrays is cut within an element"};
    count[i] = sections[i].size() / kElement[i];
  }
  const auto cells = [&](std::int32_t side) {
    return static_cast<std::size_t>(side >> numbers.cellShift) + 1;
  };
  const std::size_t vertices = count[kVertices], places = count[kConstraints];
  const bool fit = vertices >= 4 && vertices < Link::kOutside && count[kTriangles] < Link::kOutside &&
                   count[kHeights] == vertices && count[kLoose] == vertices && count[kErrors] <= vertices &&
                   numbers.freeVertices <= vertices && numbers.freeTriangles <= count[kTriangles] &&
                   (places & (places - 1)) == 0 && 4 * numbers.constraints <= 3 * places &&
                   count[kCells] == cells(numbers.frame.width) * cells(numbers.frame.height) &&
                   numbers.slidingPosition <= count[kSlidingNow] && numbers.cleaningRound <= count[kToClean];
  if (!fit) return Error{"its arrays' sizes do not fit together"};
  return {};
}

Result<void> SandState::checkLists(const Numbers& numbers, const Sections& sections) {
  const std::size_t vertices = sections[kVertices].size() / sizeof(TriangleMesh::Vertex);
  const std::size_t triangles = sections[kTriangles].size() / sizeof(TriangleMesh::Triangle);
  for (const Section list : {kSlidingNow, kSlidingNext, kToClean, kRims, kInsides}) {
    const std::size_t slots = list == kSlidingNow || list == kSlidingNext ? triangles : vertices;
    for (std::size_t i = 0; i < sections[list].size() / 4; ++i) {
      if (idAt(sections[list], i) >= slots) return Error{"something that is not in it waits"};
    }
  }
  if (numbers.near >= vertices) return Error{"its last stamp was at no vertex"};
  return {};
}

Result<void> SandState::checkVertices(const SandSurface& surface) {
  const Triangulation& mesh = surface.mesh_;
  const LatticeFrame& frame = mesh.frame_;
  const std::array<LatticePoint, 4> corners{
      {{0, 0}, {frame.width, 0}, {frame.width, frame.height}, {0, frame.height}}};
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v) {
    const auto breach = [v](const char* what) { return Error{"vertex " + std::to_string(v) + what}; };
    if (!(std::fabs(mesh.height(v)) <= metresFromTicks(kHighestTick))) return breach(" lies out of range");
    const bool used = mesh.isVertex(v);
    if (v < 4 && !(used && mesh.point(v) == corners[v])) return breach(" is not in its corner of the box");
    if (!used) {
      if (surface.loose_[v] != SandSurface::kNoLoose) return breach(" is free and bears sand");
      continue;
    }
    if (!frame.contains(mesh.point(v))) return breach(" lies outside the box");
    if (surface.loose_[v] < 0 || surface.loose_[v] > kThickest) return breach(" bears what cannot be");
    const Link star = mesh.mesh_.star(v);
    if (star.side() > 2 || star.isBarrier() || star.triangle() >= mesh.triangleSlots()) {
      return breach(" does not know a triangle of its own");
    }
  }
  return {};
}

Result<void> SandState::checkTriangles(const TriangleMesh& mesh) {
  for (TriangleId t = 0; t < mesh.triangleSlots(); ++t) {
    if (!mesh.isTriangle(t)) continue;
    const TriangleMesh::Triangle& here = mesh.triangle(t);
    for (int i = 0; i < 3; ++i) {
      const Link link = here.link[i];
      const bool within = link.triangle() < mesh.triangleSlots() && link.side() <= 2;
      if (here.vertex[i] >= mesh.vertexSlots() || (!within && !(link == Link::outside()))) {
        return Error{"triangle " + std::to_string(t) + " leads to what cannot be"};
      }
    }
  }
  return {};
}

/// Free slots form two chains that have each once and end.
Result<void> SandState::checkFree(const TriangleMesh& mesh) {
  VertexId v = mesh.freeVertex_;
  for (std::size_t left = mesh.freeVertices_; left > 0; --left) {
    if (v >= mesh.vertexSlots() || mesh.isVertex(v)) return Error{"its free vertices are miscounted"};
    v = static_cast<VertexId>(mesh.vertices_[v].point.x);
  }
  TriangleId t = mesh.freeTriangle_;
  for (std::size_t left = mesh.freeTriangles_; left > 0; --left) {
    if (t >= mesh.triangleSlots() || mesh.isTriangle(t)) return Error{"its free triangles are miscounted"};
    t = mesh.triangles_[t].vertex[1];
  }
  if (v != kNoVertex || t != kNoTriangle) return Error{"its free slots form no chain"};
  return {};
}

Result<void> SandState::checkConstraints(const Triangulation& mesh, std::uint32_t nextId) {
  const ConstraintTable& table = mesh.table_;
  std::size_t used = 0, run = 0;
  for (std::size_t i = 0; i < table.places_.size(); ++i) {
    const ConstraintTable::Place& place = table.places_[i];
    if (place.a == ConstraintTable::kEmpty) {
      run = 0;
      continue;
    }
    ++used;
    if (++run > kLongestRun || place.a >= place.b || place.b >= mesh.vertexSlots()) {
      return Error{"its table of constraints is none"};
    }
    if (place.id >= nextId) return Error{"a constraint in it is of a stamp to come"};
  }
  if (used != table.used_) return Error{"its constraints are miscounted"};
  for (std::size_t i = 0; i < table.places_.size(); ++i) {
    const ConstraintTable::Place& place = table.places_[i];
    if (place.a != ConstraintTable::kEmpty && table.find(place.a, place.b) != i) {
      return Error{"its table of constraints has one that cannot be found"};
    }
  }
  return {};
}

Result<void> SandState::checkCells(const Triangulation& mesh) {
  const CompactArray<VertexId>& cells = mesh.grid_.cells_;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] != kNoVertex && cells[i] >= mesh.vertexSlots()) return Error{"its grid of cells cannot be"};
  }
  return {};
}

/// Chains of free slots have the right length and end; that every free slot is in them follows from the
/// surface's own count of what is used.
Result<void> SandState::check(const Sandbox& sandbox) {
  const SandSurface& surface = sandbox.surface_;
  const Triangulation& mesh = surface.mesh_;
  if (const Result<void> fine = checkVertices(surface); !fine) return fine;
  if (const Result<void> fine = checkTriangles(mesh.mesh_); !fine) return fine;
  if (const Result<void> fine = checkFree(mesh.mesh_); !fine) return fine;
  if (const Result<void> fine = checkConstraints(mesh, sandbox.stamper_.nextId()); !fine) return fine;
  if (const Result<void> fine = checkCells(mesh); !fine) return fine;
  return surface.validate();
}

}  // namespace teren
