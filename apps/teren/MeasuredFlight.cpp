#include "apps/teren/MeasuredFlight.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <malloc.h>
#include <thread>
#include <tuple>
#include <unistd.h>
#include <utility>

#include "teren/PixelError.h"
#include "teren/ProcessorTime.h"

#include "apps/teren/PictureAhead.h"

namespace teren {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kStep = 1.0 / static_cast<double>(kUpdatesPerSecond);  // [s]
constexpr double kAsRounded = 1.0 + 1e-6;  // moved vertices come as near to what is wanted as floats let them
constexpr std::int64_t kFirstFrames = 10 * kUpdatesPerSecond;  // whose pixel errors do not count

std::size_t residentBytes() {
  std::size_t program = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> program >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void addHeight(Fnv1a& hash, double height) {
  const auto bits = std::bit_cast<std::uint64_t>(height == 0.0 ? 0.0 : height);
  for (unsigned shift = 0; shift < 64; shift += 8) hash.addByte(static_cast<std::uint8_t>(bits >> shift));
}

/// Place `index` of a square spiral: (0, 0), (1, 0), (1, 1), (0, 1), (-1, 1) ...
std::pair<int, int> spiral(int index) {
  int x = 0, y = 0, stepX = 1, stepY = 0;
  for (int length = 1, gone = 0, sides = 0; index > 0; --index) {
    x += stepX, y += stepY;
    if (++gone < length) continue;
    gone = 0;
    std::tie(stepX, stepY) = std::pair(-stepY, stepX);
    if (++sides % 2 == 0) ++length;
  }
  return {x, y};
}

}  // namespace

MeasuredFlight::MeasuredFlight(std::shared_ptr<const World> world, const FlightPlan& plan,
                               std::unique_ptr<EditedGround> edits)
    : world_(std::move(world)),
      plan_(plan),
      edits_(std::move(edits)),
      cpu_(static_cast<std::size_t>(plan.updates)),
      wall_(static_cast<std::size_t>(plan.updates)),
      spinner_(static_cast<std::size_t>(plan.updates)),
      spinnerCpu_(static_cast<std::size_t>(plan.updates)) {
  result_.memory.reserve(static_cast<std::size_t>(plan.updates / (60 * kUpdatesPerSecond)));
  if (!plan.engine.view.detail) return;
  pixelErrors_.resize(static_cast<std::size_t>(std::max<std::int64_t>(plan.updates - kFirstFrames, 0)));
  pixelErrors_.clear();  // touched, so that the program does not grow by it
}

double MeasuredFlight::drawnHeight(const Position& position) const {
  if (!edits_) return world_->query(position).drawn;
  SurfacePoint point;
  edits_->query({&position, 1}, {&point, 1});
  return point.drawn;
}

Result<std::unique_ptr<Object>> MeasuredFlight::makeObject(int index) const {
  const auto [east, north] = spiral(index);
  const Result<Position> start =
      plan_.start.movedBy(east * kObjectDistance, north * kObjectDistance, world_->pitch());
  if (!start) return start.error();
  Course course;
  course.start = *start;
  course.height = drawnHeight(*start) + kFlightClearance;
  course.speed = plan_.speed;
  course.pitch = world_->pitch();
  const Result<std::shared_ptr<const Script>> script =
      plan_.path == FlightPath::straight ? straightScript(course) : turnsScript(course);
  if (!script) return script.error();
  return std::unique_ptr<Object>(
      std::make_unique<ScriptedObject>(*script, ScriptedObjectOptions{.clearance = kFlightClearance}));
}

Result<std::unique_ptr<MeasuredFlight>> MeasuredFlight::create(std::shared_ptr<const World> world,
                                                               const FlightPlan& plan,
                                                               std::unique_ptr<EditedGround> edits) {
  std::unique_ptr<MeasuredFlight> flight(new MeasuredFlight(world, plan, std::move(edits)));
  Result<std::unique_ptr<Engine>> engine = Engine::create(world, plan.engine);
  if (!engine) return engine.error();
  flight->engine_ = std::move(*engine);
  if (flight->edits_) {
    const EditedGround::Snapshot ground = flight->edits_->snapshot();
    flight->engine_->setEdits(ground.edits, ground.changed);
  }
  for (int index = 0; index < plan.objects; ++index) {
    Result<std::unique_ptr<Object>> object = flight->makeObject(index);
    if (!object) return object.error();
    flight->engine_->add(std::move(*object));
  }
  return flight;
}

FlightResult MeasuredFlight::fly(const std::function<bool(std::int64_t, std::int64_t)>& progress) {
  constexpr std::chrono::nanoseconds kFrame(std::chrono::nanoseconds(std::chrono::seconds(1)) /
                                            kUpdatesPerSecond);
  Clock::time_point next = Clock::now();
  for (std::int64_t done = 0; done < plan_.updates && progress(done, plan_.updates); ++done) {
    next += kFrame;
    update();
    lookAtGround(done);
    lookAtPicture(done);
    if (result_.updates % (60 * kUpdatesPerSecond) == 0) lookAtMemory(result_.updates / kUpdatesPerSecond);
    if (!plan_.paced || done % kUpdatesPerSecond == 0 || Clock::now() + plan_.budget < next) spin();
    if (plan_.paced) {
      std::this_thread::sleep_until(next);
      next = std::max(next, Clock::now() - kFrame);  // what is lost is not made up for by haste
    } else {
      waitForWorkers(next);
      next = Clock::now();
    }
  }
  result_.cpu = cpu_.percentiles();
  result_.wall = wall_.percentiles();
  result_.spinner = spinner_.percentiles();
  result_.spinnerCpu = spinnerCpu_.percentiles();
  if (result_.pixelError) result_.pixelError->seen = percentilesOf(pixelErrors_);
  result_.engine = engine_->figures();
  result_.hash = hash_.value();
  result_.residentBytes = residentBytes();
  return result_;
}

void MeasuredFlight::update() {
  const Clock::time_point start = Clock::now();
  const std::chrono::nanoseconds used = threadProcessorTime();
  engine_->update(kStep, plan_.budget);
  cpu_.add(threadProcessorTime() - used);
  wall_.add(Clock::now() - start);
}

void MeasuredFlight::lookAtGround(std::int64_t update) {
  bool missing = false;
  for (std::size_t index = 0; index < engine_->objectCount(); ++index) {
    const Position position = engine_->object(index).motion().position;
    const std::optional<double> ground = engine_->finestHeight(position);
    missing = missing || !ground;
    addHeight(hash_, ground ? *ground : drawnHeight(position));
  }
  if (missing && update >= kUpdatesPerSecond) ++result_.missing;
  result_.updates = update + 1;
  if (result_.updates == 30 * kUpdatesPerSecond) result_.hashAt30Seconds = hash_.value();
}

void MeasuredFlight::lookAtPicture(std::int64_t update) {
  const std::optional<DetailSettings>& detail = plan_.engine.view.detail;
  if (!detail) return;
  if (!result_.pixelError) result_.pixelError = FlownPixelError{.wanted = detail->pixelError, .seen = {}};
  if (update < kFirstFrames) return;
  ++result_.pixelError->frames;
  const Motion eye = engine_->object(engine_->active()).motion();
  if (!engine_->drawnHeight(eye.position)) return;  // nothing drawn is not nothing wrong
  const double lens = lensPixels(detail->lines, detail->fieldOfView);
  const Scene ahead = PictureAhead(*world_, eye, *detail).of(*engine_->scene());
  const double seen = pixelError(*world_, ahead, {eye.position, eye.height, lens}).max;
  pixelErrors_.push_back(static_cast<float>(seen));
  if (seen <= detail->pixelError * kAsRounded) ++result_.pixelError->reached;
}

void MeasuredFlight::lookAtMemory(std::int64_t seconds) {
  const struct mallinfo2 heap = mallinfo2();
  const HeldMemory held{seconds,
                        residentBytes(),
                        engine_->figures().bytes,
                        world_->queryBytes(),
                        heap.uordblks + heap.hblkhd,
                        heap.fordblks};
  if (result_.memory.empty()) result_.residentAt60Seconds = held.resident;
  result_.memory.push_back(held);
}

void MeasuredFlight::waitForWorkers(Clock::time_point most) const {
  if (plan_.engine.workers == 0) return;
  constexpr std::chrono::microseconds kBetweenLooks(50);
  while (Clock::now() < most && engine_->figures().unfinishedTasks > 0) {
    std::this_thread::sleep_for(kBetweenLooks);
  }
}

void MeasuredFlight::spin() {
  const Clock::time_point start = Clock::now();
  const std::chrono::nanoseconds used = threadProcessorTime();
  Clock::time_point now = start;
  while (now - start < plan_.budget) now = Clock::now();
  spinnerCpu_.add(threadProcessorTime() - used);
  spinner_.add(now - start);
}

}  // namespace teren
