#include "generators/sand/Sandbox.h"

#include <algorithm>
#include <utility>

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

bool Sandbox::slide(std::uint64_t steps) {
  const bool atRest = slides_.advance(surface_, steps);
  collectChanges(Phase::sliding);
  return atRest;
}

void Sandbox::clean() {
  if (removable_ == 0) return;
  const bool rested = slides_.atRest();
  const std::uint64_t before = cleanUp_.count().removed;
  cleanUp_.run(surface_, slides_, keptId_);
  removable_ -= std::min<std::size_t>(removable_, cleanUp_.count().removed - before);
  if (rested && !slides_.atRest()) removable_ /= 2;
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
  constexpr std::size_t kParts =
      sizeof(surface_) + sizeof(slides_) + sizeof(cleanUp_) + sizeof(stamper_);  // each counts itself
  return sizeof(*this) - kParts + surface_.bytes() + slides_.bytes() + cleanUp_.bytes() + stamper_.bytes() +
         changedVertices_.bytes() + changedTriangles_.bytes();
}

}  // namespace teren
