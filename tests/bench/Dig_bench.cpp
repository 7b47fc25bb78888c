// What it costs to dig below oneself in flight: a tool pressed 60 times a second into the land that is drawn,
// as `teren flight --path turns --speed 300` flies over it, beside the same flight without a tool. Processor
// time of the thread that flies, presses and takes, after the first second, and of pressing and taking alone;
// how many updates after it was pressed a stamp is seen; and an empty loop of the same budget: what the
// machine adds to all of them. What is taken from a virtual machine counts as its thread's processor time: a
// single long update is of the engine's making only where the empty loops have none as long. At last, a tool
// that is dragged on the spot, a tenth of its size a press: how long all is shown after the last press.
//
//   bench-dig [DEFORMER [SIZE [DEPTH [SECONDS]]]]     crater, 6 m, 1.5 m and 20 s of each flight without
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "teren/Engine.h"
#include "teren/GroundEditor.h"
#include "teren/PluginRegistry.h"
#include "teren/Script.h"
#include "teren/World.h"

#include "tests/bench/Timing.h"

namespace teren {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kUpdatesPerSecond = 60;
constexpr auto kBudget = std::chrono::microseconds(2000);

struct Tool {
  std::string deformer = "crater";
  double size = 6.0, depth = 1.5;  // [m]
};

/// By nearest rank.
double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// A stamp that is not seen yet.
struct Pressed {
  Position place;
  std::optional<double> height;  // of the ground before
  std::int64_t update = 0;
};

class Dig {
 public:
  Dig(std::shared_ptr<const World> world, const EngineOptions& options, const std::optional<Tool>& tool)
      : world_(std::move(world)), tool_(tool) {
    engine_ = Engine::create(world_, options).value();
    Course course;
    course.start = *Position::fromMetres(0.0, 0.0, world_->pitch());
    course.height = world_->query(course.start).drawn + 100.0;
    course.speed = 300.0;
    course.pitch = world_->pitch();
    engine_->add(std::make_unique<ScriptedObject>(turnsScript(course).value(),
                                                  ScriptedObjectOptions{.clearance = 100.0}));
    if (tool_) editor_ = GroundEditor::open(world_, deformersOf(PluginRegistry::standard())).value();
  }

  void fly(int seconds) {
    const auto frame = std::chrono::nanoseconds(std::chrono::seconds(1)) / kUpdatesPerSecond;
    Clock::time_point next = Clock::now();
    for (std::int64_t update = 0; update < std::int64_t{seconds} * kUpdatesPerSecond; ++update) {
      next += frame;
      const double start = processorSeconds();
      if (editor_) press(update);
      const double pressed = processorSeconds();
      engine_->update(1.0 / kUpdatesPerSecond, kBudget);
      if (update >= kUpdatesPerSecond) {
        cpu_.push_back(1e6 * (processorSeconds() - start));
        pressing_.push_back(1e6 * (pressed - start));
      }
      look(update);
      if (Clock::now() + kBudget < next) spin();
      std::this_thread::sleep_until(next);
      next = std::max(next, Clock::now() - frame);
    }
  }

  void print(const char* view, int workers) const {
    const EngineFigures figures = engine_->figures();
    std::printf(
        "%-8s %7d %-7s %8.0f %8.0f %8.0f %8.0f %8.0f %8.0f %8.0f %7lld %5llu %6zu %6.0f %6.0f %7zu %8.1f\n",
        view, workers, tool_ ? tool_->deformer.c_str() : "-", percentile(cpu_, 0.5), percentile(cpu_, 0.99),
        percentile(cpu_, 0.999), percentile(cpu_, 1.0), percentile(pressing_, 0.999),
        percentile(spun_, 0.999), percentile(spun_, 1.0), static_cast<long long>(missing_),
        static_cast<unsigned long long>(figures.lateSlices), delays_.size(), percentile(delays_, 0.5),
        percentile(delays_, 0.99), pressed_.size(), static_cast<double>(figures.peakBytes) / 0x1p20);
    std::fflush(stdout);
  }

 private:
  /// Beside the way, each so far from the latest that it is told from them.
  void press(std::int64_t update) {
    constexpr int kPlaces = 8;
    const double aside = (static_cast<double>(update * 3 % kPlaces) - 3.5) * 4.0 * tool_->size;
    const Motion motion = engine_->object(0).motion();
    const double speed = std::max(1.0, std::hypot(motion.east, motion.north));
    const double n = world_->intervals(), pitch = world_->pitch();
    const auto metres = [&](std::int64_t patch, double share, double way) {
      const double whole = (static_cast<double>(patch) + share) * pitch + aside * way / speed;
      return std::round(whole * n / pitch) * pitch / n;  // at a sample, so that it is seen
    };
    const double x = metres(motion.position.i, motion.position.u, motion.north);
    const double y = metres(motion.position.j, motion.position.v, -motion.east);
    const Position place = *Position::fromMetres(x, y, pitch);
    const auto pressed = editor_->press({tool_->deformer,
                                         x,
                                         y,
                                         motion.height - 100.0,
                                         tool_->size,
                                         tool_->depth,
                                         static_cast<std::uint64_t>(update),
                                         0,
                                         {}});
    if (pressed.ok()) pressed_.push_back({place, engine_->finestHeight(place), update});
    if (std::optional<EditedGround::Snapshot> dug = editor_->take())
      engine_->setEdits(dug->edits, dug->changed);
  }

  void look(std::int64_t update) {
    const auto isSeen = [&](const Pressed& stamp) {
      const std::optional<double> height = engine_->finestHeight(stamp.place);
      if (!height || height == stamp.height) return false;
      if (stamp.height) delays_.push_back(static_cast<double>(update - stamp.update));
      return true;
    };
    std::erase_if(pressed_, isSeen);
    std::erase_if(pressed_, [&](const Pressed& stamp) { return update - stamp.update > 600; });  // flown by
    if (update >= kUpdatesPerSecond && !engine_->finestHeight(engine_->object(0).motion().position))
      ++missing_;
  }

  void spin() {
    const Clock::time_point start = Clock::now();
    const double used = processorSeconds();
    while (Clock::now() - start < kBudget) {
    }
    spun_.push_back(1e6 * (processorSeconds() - used));
  }

  std::shared_ptr<const World> world_;
  std::optional<Tool> tool_;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<GroundEditor> editor_;
  std::vector<double> cpu_, pressing_, spun_, delays_;
  std::deque<Pressed> pressed_;
  std::int64_t missing_ = 0;
};

/// All presses are there at once, as they would come if the hand were faster than the tool.
void drag(const Tool& tool) {
  constexpr int kPresses = 120;
  const std::shared_ptr<const World> world =
      World::create(WorldDescription::standard(), *PluginRegistry::standard()).value();
  const auto editor = GroundEditor::open(world, deformersOf(PluginRegistry::standard())).value();
  const auto press = [&](int k) {
    const double x = 2000.0 + 0.1 * tool.size * k;
    (void)editor->press({tool.deformer, x, 2000.0, 0.0, tool.size, tool.depth, 1, 0, {}}).ok();
  };
  const auto wait = [&] {
    while (editor->unfinished() > 0) {
      (void)editor->take();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  press(0);
  wait();
  const Clock::time_point start = Clock::now();
  for (int k = 1; k <= kPresses; ++k) press(k);
  wait();
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  std::printf("%s dragged, %d presses %.1f m apart: shown after %.0f ms, %.1f ms a press\n",
              tool.deformer.c_str(), kPresses, 0.1 * tool.size, ms, ms / kPresses);
}

void run(const Tool& tool, int seconds) {
  std::printf("updates with a budget of %lld us; times [us] of processor time\n",
              static_cast<long long>(kBudget.count()));
  std::printf("%-8s %7s %-7s %8s %8s %8s %8s %8s %8s %8s %7s %5s %6s %6s %6s %7s %8s\n", "view", "workers",
              "tool", "p50", "p99", "p999", "max", "press999", "empty999", "emptymax", "missing", "late",
              "seen", "after", "p99", "unseen", "peak MiB");
  for (const bool isByError : {false, true}) {
    for (const int workers : {0, 1}) {
      for (const bool digs : {false, true}) {
        const auto world = World::create(WorldDescription::standard(), *PluginRegistry::standard()).value();
        EngineOptions options;
        options.workers = workers;
        options.view = isByError ? ViewSettings{.detail = DetailSettings{}}
                                 : ViewSettings{0, ViewSettings::radiusFor(2560.0, 0, *world)};
        Dig dig(world, options, digs ? std::optional(tool) : std::nullopt);
        dig.fly(seconds);
        dig.print(isByError ? "by error" : "level 0", workers);
      }
    }
  }
  drag(tool);
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  teren::Tool tool;
  if (argc > 1) tool.deformer = argv[1];
  if (argc > 2) tool.size = std::atof(argv[2]);
  if (argc > 3) tool.depth = std::atof(argv[3]);
  teren::run(tool, argc > 4 ? std::atoi(argv[4]) : 20);
}
