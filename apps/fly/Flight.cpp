#include "apps/fly/Flight.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <thread>
#include <utility>

#include "teren/ProcessorTime.h"

namespace teren {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks(2);

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

Flight::Flight(std::unique_ptr<Engine> engine, const AircraftStart& start,
               const std::optional<TruckStart>& truck)
    : engine_(std::move(engine)) {
  for (const AircraftStart& each : {start, passing(start, engine_->world().pitch())}) {
    auto aircraft = std::make_unique<Aircraft>(each);
    aircraft_.push_back(aircraft.get());
    engine_->add(std::move(aircraft));
  }
  if (!truck) return;
  auto vehicle = std::make_unique<Truck>(*truck);
  truck_ = vehicle.get();
  engine_->add(std::move(vehicle));
}

// What the file of the edits holds is applied by a thread of its own while the land is made; then what it has
// changed is made anew.
void Flight::settle(const std::function<bool(std::size_t done, std::size_t wanted)>& progress) {
  if (!settleOnce(progress) || !edits_) return;
  bool isNew = false;
  for (std::size_t left = edits_->unfinished(); left > 0; left = edits_->unfinished()) {
    isNew = handEditsOver() || isNew;
    const std::size_t all = std::max(edits_->edits(), left);
    if (!progress(all - left, all)) return;
    std::this_thread::sleep_for(kBetweenLooks);
  }
  if (isNew) settleOnce(progress);
}

bool Flight::settleOnce(const std::function<bool(std::size_t, std::size_t)>& progress) {
  bool goesOn = true;
  engine_->settle([&](std::size_t done, std::size_t wanted) {
    for (std::size_t index = 0; index < engine_->objectCount(); ++index) {
      engine_->object(index).update(0.0, engine_->ground());
    }
    goesOn = progress(done, wanted);
    return goesOn;
  });
  return goesOn;
}

bool Flight::handEditsOver() {
  if (!edits_) return false;
  const bool isThere = edits_->handTo(next_ ? *next_ : *engine_);
  hasNextEdits_ = hasNextEdits_ || isThere || edits_->unfinished() == 0;
  return isThere;
}

void Flight::pressRuts() {
  if (!truck_) return;
  const World& world = engine_->world();
  const std::vector<Edit> ruts = truck_->takeRuts({world.pitch(), world.pitch() / world.intervals()});
  // One that rolls on by itself leaves none: they would end what can be redone, and nobody asked for them.
  if (ruts.empty() || &activeObject() != truck_ || !canDig()) return;
  if (const std::optional<std::string> why = edits_->missing(ruts.front().kind)) {
    return edits_->tell("the truck leaves no ruts: " + *why);
  }
  for (const Edit& rut : ruts) edits_->press(rut);
}

Result<void> Flight::canDig() const {
  if (!edits_) return Error{"nobody keeps edits of this land"};
  if (!edits_->areOf(engine_->world())) {
    return Error{"another land is being made; it can be dug once it is there"};
  }
  return {};
}

void Flight::advance(double dt) {
  pressRuts();
  handEditsOver();
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

void Flight::goOverTo(std::unique_ptr<Engine> next, std::shared_ptr<const World> world) {
  assert(next && next->objectCount() == 0 && next->world().pitch() == engine_->world().pitch());
  next_ = std::move(next);
  hasNextEdits_ = !edits_;
  if (edits_ && world) edits_->setWorld(std::move(world));
  const std::optional<DetailSettings>& detail = engine_->options().view.detail;
  // What the next one refuses, for another world perhaps, it does not get: it was made with good ones.
  if (detail && next_->options().view.detail) static_cast<void>(next_->setDetail(*detail));
  for (std::size_t index = 0; index < engine_->objectCount(); ++index) {
    next_->add(std::make_unique<Scout>(engine_->object(index)));
  }
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
  if (!hasNextEdits_ || there.nodes == 0 || there.pending > engine_->figures().pending) return;
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
