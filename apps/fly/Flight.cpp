#include "apps/fly/Flight.h"

#include <algorithm>
#include <array>
#include <cmath>

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
  engine_->update(std::clamp(dt, 0.0, kLongestStep), budget_.next());
  updated_ = threadProcessorTime();
  engineTimes_.add(std::chrono::duration<double, std::micro>(engine_->figures().lastUpdate).count());
}

void Flight::frameDone() {
  budget_.measured(threadProcessorTime() - updated_);
}

void Flight::nextObject() {
  engine_->setActive((active() + 1) % engine_->objectCount());
}

}  // namespace teren
