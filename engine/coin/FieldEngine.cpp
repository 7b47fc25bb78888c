#include "coin/FieldEngine.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "teren/Position.h"
#include "teren/World.h"

namespace teren {
namespace {

// A viewer that moves its clipping planes makes the same angle from other numbers each time.
constexpr double kSameAngle = 1e-3;

}  // namespace

Result<void> FieldEngine::make(const TerrainFields& fields) {
  Result<std::unique_ptr<Engine>> made = makeEngine(fields);
  if (!made) return made.error();
  engine_ = std::move(*made);
  auto eye = std::make_unique<EyeObject>();
  eye_ = eye.get();
  engine_->add(std::move(eye));
  putEye(point_);
  static_cast<void>(tellPicture());
  return {};
}

void FieldEngine::drop() noexcept {
  eye_ = nullptr;
  engine_.reset();
}

void FieldEngine::putEye(const SbVec3d& point) {
  point_ = point;
  if (!engine_) return;
  const Result<Position> position = Position::fromMetres(point[0], point[1], engine_->world().pitch());
  if (position) eye_->put(*position, point[2]);
}

bool FieldEngine::fitPicture(double lines, double fieldOfView) {
  const bool asBefore = lines == lines_ && std::fabs(fieldOfView - fieldOfView_) <= kSameAngle * fieldOfView_;
  if (!asBefore) {
    lines_ = lines;
    fieldOfView_ = fieldOfView;
  }
  return !asBefore && tellPicture();
}

bool FieldEngine::tellPicture() {
  if (!engine_ || !engine_->options().view.detail) return false;
  DetailSettings detail = *engine_->options().view.detail;
  detail.lines = lines_;
  detail.fieldOfView = fieldOfView_;
  return engine_->setDetail(detail).ok();
}

bool FieldEngine::update(double dt, std::chrono::nanoseconds budget) {
  assert(engine_);
  engine_->update(dt, budget);
  const EngineFigures figures = engine_->figures();
  return figures.pending > 0 || figures.measuring;
}

void FieldEngine::settle() {
  assert(engine_);
  engine_->settle();
}

SbBox3f FieldEngine::expectedBox(const SbVec3d& origin) const {
  SbBox3f box;
  if (!engine_) return box;
  const World& world = engine_->world();
  const double pitch = world.pitch();
  const Position eye = eye_->motion().position;
  const double west = static_cast<double>(eye.i - 1) * pitch - origin[0];
  const double south = static_cast<double>(eye.j - 1) * pitch - origin[1];
  const double middle = world.mean() - origin[2];
  const double half = 3.0 * world.deviation();
  box.setBounds(static_cast<float>(west), static_cast<float>(south), static_cast<float>(middle - half),
                static_cast<float>(west + 3.0 * pitch), static_cast<float>(south + 3.0 * pitch),
                static_cast<float>(middle + half));
  return box;
}

}  // namespace teren
