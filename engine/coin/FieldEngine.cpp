#include "coin/FieldEngine.h"

#include <cassert>
#include <utility>

#include "teren/Position.h"
#include "teren/World.h"

namespace teren {

Result<void> FieldEngine::make(const TerrainFields& fields) {
  Result<std::unique_ptr<Engine>> made = makeEngine(fields);
  if (!made) return made.error();
  engine_ = std::move(*made);
  auto eye = std::make_unique<EyeObject>();
  eye_ = eye.get();
  engine_->add(std::move(eye));
  putEye(point_);
  fitPicture(lines_, fieldOfView_);
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

void FieldEngine::fitPicture(double lines, double fieldOfView) {
  lines_ = lines;
  fieldOfView_ = fieldOfView;
  if (!engine_ || !engine_->options().view.detail) return;
  DetailSettings detail = *engine_->options().view.detail;
  detail.lines = lines;
  detail.fieldOfView = fieldOfView;
  static_cast<void>(engine_->setDetail(detail));
}

bool FieldEngine::update(double dt, std::chrono::nanoseconds budget) {
  assert(engine_);
  engine_->update(dt, budget);
  return engine_->figures().pending > 0;
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
