#include "generators/sand/Sandbox.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "generators/sand/Merging.h"

namespace teren {

Sandbox::Sandbox(SandSurface surface, const SandSettings& settings)
    : settings_(settings),
      surface_(std::move(surface)),
      slides_(reposeOf(settings.dryAngle, settings.moisture), settings.longestEdge),
      cleanUp_(settings.flatness),
      stamper_(settings.stamp) {
  surface_.clearChanges();
}

void Sandbox::setRepose(double dryAngle, double moisture) {
  settings_.dryAngle = dryAngle;
  settings_.moisture = moisture;
  slides_.setRepose(reposeOf(dryAngle, moisture));
  loosenAll();
}

void Sandbox::setReposeOfWhatMoves(double dryAngle, double moisture) {
  settings_.dryAngle = dryAngle;
  settings_.moisture = moisture;
  slides_.setRepose(reposeOf(dryAngle, moisture));
}

void Sandbox::push() noexcept {
  removable_ = surface_.mesh().vertexCount();
  round_ = 0;
  unsettled_ = false;
}

void Sandbox::loosenAll() {
  slides_.addAll(surface_);
  push();
}

/// Passes on what a phase has changed: to the slides, to the clean-up, to whoever draws.
void Sandbox::collectChanges(Phase phase) {
  for (const TriangleId t : surface_.changedTriangles().ids()) {
    changedTriangles_.add(t);
    if (phase == Phase::stamping) slides_.add(t);
  }
  for (const VertexId v : surface_.changedVertices().ids()) {
    changedVertices_.add(v);
    if (phase != Phase::cleaning) cleanUp_.addMoved(v);
  }
  surface_.clearChanges();
}

Result<StampReport> Sandbox::stamp(const ToolShape& tool, const StampPlace& place) {
  const std::uint32_t id = stamper_.nextId();
  for (const VertexId v : stamper_.rim()) cleanUp_.add(v);
  for (const VertexId v : stamper_.inside()) cleanUp_.add(v);
  Result<StampReport> report = stamper_.stamp(surface_, tool, place);
  if (report) {
    keptId_ = id;
    push();
  }
  collectChanges(Phase::stamping);
  return report;
}

void Sandbox::open(ConstHeightView ground, ConstHeightView loose, std::span<const Opening::Cell> cells) {
  slides_.forgetGone(surface_);  // slots that triangles outside may take now
  opening_.enter(surface_, ground, loose, cells);
  surface_.clearChanges();  // nobody has seen it, and it is at rest
  for (const VertexId v : opening_.inside()) cleanUp_.add(v);
  removable_ += opening_.inside().size();
  opening_.join(surface_);
  collectChanges(Phase::stamping);
}

void Sandbox::take(const Sandbox& other, int column, int row) {
  assert(isDone() && other.isDone());
  const std::vector<VertexId> taken = mergeSand(surface_, other.surface_, column, row, stamper_.nextId() - 1);
  surface_.clearChanges();
  slides_.takeLeanedOn(other.slides_, taken);
  cleanUp_.take(other.cleanUp_, taken);
  stamper_.take(other.stamper_, taken);
  removable_ = 0;
}

void Sandbox::pour(double x, double y, double radius, double height) {
  constexpr int kRings = 8;  // vertices this close, in parts of the radius
  const LatticeFrame& frame = surface_.mesh().frame();
  const LatticePoint middle = *frame.snap(x, y);
  const std::int32_t apart = static_cast<std::int32_t>(radius / frame.step) / kRings;
  const auto squaredDistance = [&](LatticePoint p) {
    const double east = (p.x - middle.x) * frame.step, north = (p.y - middle.y) * frame.step;
    return east * east + north * north;
  };
  ChangeList heap;
  VertexId near = surface_.insert(middle);
  for (int row = -kRings; row <= kRings; ++row) {
    for (int column = -kRings; column <= kRings; ++column) {
      const LatticePoint p{middle.x + column * apart, middle.y + row * apart};
      if (!(squaredDistance(p) < radius * radius)) continue;
      near = surface_.insert(p, surface_.mesh().triangleAt(near));
      heap.add(near);
    }
  }
  for (std::size_t n = 0; n < heap.ids().size(); ++n) {
    surface_.mesh().forEachNeighbour(heap.ids()[n], [&](VertexId v) {
      if (squaredDistance(surface_.mesh().point(v)) < radius * radius) heap.add(v);
    });
  }
  surface_.settle(heap.ids());  // what the flips around new vertices took
  for (const VertexId v : heap.ids()) {
    const double part = squaredDistance(surface_.mesh().point(v)) / (radius * radius);
    surface_.pour(v, ticksFromMetres(height * (1.0 - part)));
  }
  push();
  collectChanges(Phase::stamping);
}

bool Sandbox::slide(std::uint64_t steps) {
  const bool atRest = slides_.advance(surface_, steps);
  collectChanges(Phase::sliding);
  return atRest;
}

void Sandbox::clean(std::size_t most) {
  if (!hasToClean()) return;
  if (round_ == 0) round_ = cleanUp_.waiting();
  const bool rested = slides_.atRest();
  const std::uint64_t before = cleanUp_.count().removed;
  const std::size_t looked = std::min(most, round_);
  cleanUp_.run(surface_, slides_, keptId_, looked);
  removable_ -= std::min<std::size_t>(removable_, cleanUp_.count().removed - before);
  unsettled_ = unsettled_ || (rested && !slides_.atRest());
  round_ -= looked;
  if (round_ == 0 && std::exchange(unsettled_, false)) removable_ /= 2;
  collectChanges(Phase::cleaning);
}

bool Sandbox::iterate(std::uint64_t steps) {
  slide(steps);
  clean();
  return slides_.atRest();
}

void Sandbox::forgetChanges() noexcept {
  changedVertices_.clear();
  changedTriangles_.clear();
}

std::size_t Sandbox::bytes() const noexcept {
  constexpr std::size_t kParts = sizeof(surface_) + sizeof(slides_) + sizeof(cleanUp_) + sizeof(stamper_) +
                                 sizeof(opening_);  // each counts itself
  return sizeof(*this) - kParts + surface_.bytes() + slides_.bytes() + cleanUp_.bytes() + stamper_.bytes() +
         opening_.bytes() + changedVertices_.bytes() + changedTriangles_.bytes();
}

}  // namespace teren
