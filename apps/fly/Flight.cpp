#include "apps/fly/Flight.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "teren/ProcessorTime.h"

namespace teren {
namespace {

constexpr std::array<float, 3> kBlue{0.05F, 0.28F, 0.60F};

AircraftStart passing(const AircraftStart& first, double pitch) {
  AircraftStart start = first;
  start.name = "the second aircraft";
  start.paint = kBlue;
  start.clearance = std::max(Aircraft::kMinClearance, first.clearance - Flight::kLower);
  const double east = std::sin(first.heading), north = std::cos(first.heading);
  const Result<Position> position = first.position.movedBy(
      -Flight::kLeft * north - Flight::kBehind * east, Flight::kLeft * east - Flight::kBehind * north, pitch);
  if (position) start.position = *position;
  const auto script = straightScript({.start = start.position,
                                      .east = east,
                                      .north = north,
                                      .speed = first.speed + Flight::kFaster,
                                      .pitch = pitch});
  if (script) start.script = *script;
  return start;
}

/// Is where another object is, so that the land around it is made before it comes.
class Scout final : public Object {
 public:
  explicit Scout(const Object& object) : object_(object) {}
  void update(double /*dt*/, const Ground& /*ground*/) override {}
  Motion motion() const override { return object_.motion(); }

 private:
  const Object& object_;
};

}  // namespace

Flight::Flight(std::unique_ptr<Engine> engine, const AircraftStart& start) : engine_(std::move(engine)) {
  for (const AircraftStart& each : {start, passing(start, engine_->world().pitch())}) {
    auto aircraft = std::make_unique<Aircraft>(each);
    aircraft_.push_back(aircraft.get());
    engine_->add(std::move(aircraft));
  }
}

void Flight::settle(const std::function<bool(std::size_t done, std::size_t wanted)>& progress) {
  engine_->settle([this, &progress](std::size_t done, std::size_t wanted) {
    for (Aircraft* aircraft : aircraft_) aircraft->update(0.0, engine_->ground());
    return progress(done, wanted);
  });
}

void Flight::advance(double dt) {
  const std::chrono::nanoseconds budget = next_ ? budget_.next() / 2 : budget_.next();
  engine_->update(std::clamp(dt, 0.0, kLongestStep), budget);
  std::chrono::nanoseconds time = engine_->figures().lastUpdate;
  if (next_) {
    workAtNext(budget);
    time += (next_ ? next_ : engine_)->figures().lastUpdate;
  }
  updated_ = threadProcessorTime();
  engineTimes_.add(std::chrono::duration<double, std::micro>(time).count());
}

void Flight::goOverTo(std::unique_ptr<Engine> next) {
  assert(next && next->objectCount() == 0 && next->world().pitch() == engine_->world().pitch());
  next_ = std::move(next);
  const std::optional<DetailSettings>& detail = engine_->options().view.detail;
  // What the next one refuses, for another world perhaps, it does not get: it was made with good ones.
  if (detail && next_->options().view.detail) static_cast<void>(next_->setDetail(*detail));
  for (const Aircraft* aircraft : aircraft_) next_->add(std::make_unique<Scout>(*aircraft));
}

Result<void> Flight::setDetail(const DetailSettings& detail) {
  if (!engine_->options().view.detail) return {};
  if (next_ && next_->options().view.detail) static_cast<void>(next_->setDetail(detail));
  return engine_->setDetail(detail);
}

// Fast flight leaves always some land to be made; the next may lack as much as the present one.
void Flight::workAtNext(std::chrono::nanoseconds budget) {
  next_->setActive(active());
  next_->update(0.0, budget);
  const EngineFigures there = next_->figures();
  if (there.nodes == 0 || there.pending > engine_->figures().pending) return;
  next_->takeObjects();
  const std::size_t index = active();
  for (std::unique_ptr<Object>& object : engine_->takeObjects()) next_->add(std::move(object));
  next_->setActive(index);
  engine_ = std::move(next_);
  ++changes_;
}

void Flight::frameDone() {
  budget_.measured(threadProcessorTime() - updated_);
}

void Flight::nextObject() {
  engine_->setActive((active() + 1) % engine_->objectCount());
}

}  // namespace teren
