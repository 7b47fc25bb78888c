#include "apps/fly/Flight.h"

#include <algorithm>
#include <cmath>

namespace teren {
namespace {

constexpr double kWingmanRight = 34.0, kWingmanBehind = -28.0;  // [m] of the leader
constexpr double kWingmanHigher = 6.0;                          // [m]

AircraftStart wingman(const AircraftStart& leader, double pitch) {
  AircraftStart start = leader;
  const double sine = std::sin(leader.heading), cosine = std::cos(leader.heading);
  const Result<Position> position = leader.position.movedBy(
      kWingmanRight * cosine - kWingmanBehind * sine, -kWingmanRight * sine - kWingmanBehind * cosine, pitch);
  if (position) start.position = *position;
  start.clearance += kWingmanHigher;
  return start;
}

}  // namespace

Flight::Flight(std::unique_ptr<Engine> engine, const AircraftStart& start) : engine_(std::move(engine)) {
  for (const AircraftStart& each : {start, wingman(start, engine_->world().pitch())}) {
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

void Flight::advance(double dt, const AircraftControls& controls) {
  for (std::size_t index = 0; index < aircraft_.size(); ++index) {
    aircraft_[index]->setControls(index == active() ? controls : AircraftControls{});
  }
  engine_->update(std::clamp(dt, 0.0, kLongestStep), kBudget);
  engineTimes_.add(std::chrono::duration<double, std::micro>(engine_->figures().lastUpdate).count());
}

void Flight::nextObject() {
  engine_->setActive((active() + 1) % engine_->objectCount());
}

}  // namespace teren
