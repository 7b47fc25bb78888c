#include "apps/check/deform/DeformTrial.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "teren/Hash.h"
#include "teren/Parameter.h"
#include "teren/Quote.h"

#include "apps/check/Called.h"
#include "apps/check/Counterexample.h"
#include "apps/check/MapMaker.h"

namespace teren::check {
namespace {

/// Beyond what any stamp of these sizes needs.
constexpr std::uint64_t kMostCalls = 4'000'000;

/// A sentence as a person is shown it: one line, not empty, of a length that can be read.
void expectSentence(const std::string& sentence, const std::string& where) {
  constexpr std::size_t kMost = 400;
  if (!sentence.empty() && sentence.size() <= kMost && shortened(sentence, kMost) == sentence) return;
  throw Counterexample{where + ": it refuses with " + inQuotes(sentence) +
                       ", which is not one sentence of 1 to " + std::to_string(kMost) + " bytes"};
}

std::string stampText(const Stamp& stamp, const std::string& setting) {
  return "a stamp with " + setting + ", " + numberText(stamp.size) + " m large and " +
         numberText(stamp.depth) + " m deep, seed " + std::to_string(stamp.seed);
}

struct Press {
  double size, depth, east, north;  // in parts of the spacing; the place from the middle of the region
};

constexpr Press kPresses[] = {{6.0, 1.0, 0.0, 0.0},   {4.0, 0.75, 3.25, 1.5}, {9.0, 1.5, -2.0, 2.75},
                              {3.0, -0.5, 1.5, -4.0}, {6.0, 0.5, 2.0, 2.0},   {2.5, 0.25, -3.125, -1.0}};

}  // namespace

DeformTrial::DeformTrial(const Subject& subject)
    : info_(subject.info()), settings_(subject.settings()), deformer_(subject.deformer()) {}

Result<double> DeformTrial::reach(const Stamp& stamp, const std::string& text) const {
  const auto where = [&] { return "the reach of " + text; };
  Result<double> reach = called(where, [&] { return deformer_->reach(stamp, kSpacing); });
  if (!reach) expectSentence(reach.error().message, where());
  if (reach && !(std::isfinite(*reach) && *reach >= 0.0)) {
    throw Counterexample{where() + " is " + numberText(*reach) + " m"};
  }
  return reach;
}

Result<DeformTask> DeformTrial::taskOf(const Setting& setting) const {
  const std::string name = textOf(setting);
  const auto values = Values::check(info_.parameters, setting, info_.id);
  if (!values) return values.error();
  DeformTask task;
  std::string refusal;
  double most = 0.0;
  for (const Press& press : kPresses) {
    Stamp stamp{.east = press.east * kSpacing,
                .north = press.north * kSpacing,
                .height = 300.0,
                .size = press.size * kSpacing,
                .depth = press.depth * kSpacing,
                .seed = mixBits(task.stamps.size() + 1),
                .values = *values};
    const std::string text = stampText(stamp, name);
    const Result<double> far = reach(stamp, text);
    if (!far) {
      refusal = far.error().message;
      continue;
    }
    most = std::max(most, *far + std::max(std::fabs(stamp.east), std::fabs(stamp.north)));
    task.stamps.push_back({std::move(stamp), *far, text});
  }
  if (task.stamps.empty()) {
    return Error{"no stamp with " + name + " is taken, of " + std::to_string(std::size(kPresses)) +
                 " tried; the last one is refused: " + refusal};
  }
  const double patches = 2.0 * (most / kSpacing + kCollarCells + 1) / kIntervals;
  if (patches > kMostPatches) {
    throw Counterexample{"with " + name + ": a stamp of at most 18 m reaches " + numberText(most) +
                         " m, more than a region of " + std::to_string(kMostPatches) + " patches holds"};
  }
  const int side = static_cast<int>(std::ceil(patches));
  task.region = {
      .i = -3, .j = 70000, .columns = side, .rows = side + 1, .intervals = kIntervals, .spacing = kSpacing};
  for (TriedStamp& tried : task.stamps) {
    tried.stamp.east += 0.5 * kSpacing * (task.region.sampleColumns() - 1);
    tried.stamp.north += 0.5 * kSpacing * (task.region.sampleRows() - 1);
  }
  return task;
}

std::vector<DeformTask> DeformTrial::tasks() const {
  std::vector<DeformTask> tasks;
  for (const Setting& setting : settings_) {
    Result<DeformTask> task = taskOf(setting);
    if (task) tasks.push_back(std::move(*task));
    if (!task && setting.empty()) throw Counterexample{task.error().message};
  }
  if (tasks.size() == 1) return tasks;
  const auto largest = [](const DeformTask& a, const DeformTask& b) {
    return a.region.columns < b.region.columns;
  };
  DeformTask all{std::max_element(tasks.begin(), tasks.end(), largest)->region, {}};
  for (std::size_t n = 0; n < tasks.size(); ++n) {
    TriedStamp tried = tasks[n].stamps[n % tasks[n].stamps.size()];
    // From the middle of its own region to the same place of this one.
    const double shift = 0.5 * kSpacing * kIntervals * (all.region.columns - tasks[n].region.columns);
    tried.stamp.east += shift;
    tried.stamp.north += shift;
    all.stamps.push_back(std::move(tried));
  }
  tasks.push_back(std::move(all));
  return tasks;
}

/// Between random heights of a grid 8 cells wide, the slope is at most 2 * 1.5 m / (8 * 2 m) along an axis;
/// the crease of a cell is as gentle.
HeightMap DeformTrial::hills(const DeformRegion& region) {
  constexpr int kCell = 8;
  const auto number = [](int x, int y) {
    const std::uint64_t hash =
        hashWith(hashWith(7, static_cast<std::uint64_t>(x)), static_cast<std::uint64_t>(y));
    return 1.5 * static_cast<double>(static_cast<std::int64_t>(hash)) * 0x1p-63;
  };
  HeightMap map(region.sampleColumns(), region.sampleRows());
  for (int y = 0; y < map.rows(); ++y) {
    for (int x = 0; x < map.columns(); ++x) {
      const int column = x / kCell, row = y / kCell;
      const double u = static_cast<double>(x % kCell) / kCell, v = static_cast<double>(y % kCell) / kCell;
      const double south = (1.0 - u) * number(column, row) + u * number(column + 1, row);
      const double north = (1.0 - u) * number(column, row + 1) + u * number(column + 1, row + 1);
      map(x, y) = static_cast<float>(300.0 + (1.0 - v) * south + v * north);
    }
  }
  return map;
}

HeightMap DeformTrial::rubble(const DeformRegion& region) {
  HeightMap map(region.sampleColumns(), region.sampleRows());
  RandomSequence random(8);
  for (int y = 0; y < map.rows(); ++y) {
    for (int x = 0; x < map.columns(); ++x)
      map(x, y) = static_cast<float>(static_cast<std::int64_t>(random.next())) * (1000.0F * 0x1p-63F);
  }
  return map;
}

template <class Call>
auto WatchedSurface::watched(const Call& call) const {
  return called([this] { return past(); }, call);
}

WatchedSurface::WatchedSurface(const DeformTrial& trial, const DeformRegion& region, ConstHeightView ground)
    : region_(region) {
  const std::string where = "a surface of " + std::to_string(region.sampleColumns()) + " x " +
                            std::to_string(region.sampleRows()) + " samples";
  auto begun = called([&] { return where; }, [&] { return trial.deformer().begin(region, ground); });
  if (!begun) throw Counterexample{where + " is refused: " + begun.error().message};
  if (*begun == nullptr) throw Counterexample{where + ": it begins none"};
  surface_ = std::move(*begun);
}

void WatchedSurface::apply(const TriedStamp& tried) {
  const std::string sentence = refusal(tried.stamp, tried.text);
  if (sentence.empty()) return;
  throw Counterexample{tried.text + " is refused, though its reach of " + numberText(tried.reach) +
                       " m is in the region: " + sentence};
}

std::string WatchedSurface::refusal(const Stamp& stamp, const std::string& text) {
  const auto where = [&] { return text; };
  const Result<void> applied = called(where, [&] { return surface_->apply(stamp); });
  if (applied) {
    past_ += (past_.empty() ? "after " : " and ") + text;
    return {};
  }
  expectSentence(applied.error().message, text);
  return applied.error().message;
}

bool WatchedSurface::step(const Slice& slice, std::uint64_t upTo) {
  const std::uint64_t before = steps();
  const bool done = watched([&] { return surface_->step(slice, upTo); });
  if (steps() < before || steps() > std::max(upTo, before)) {
    throw Counterexample{past() + ": asked for " + std::to_string(upTo) + " steps it goes from number " +
                         std::to_string(before) + " to " + std::to_string(steps())};
  }
  if (done && !atRest() && steps() < upTo) {
    throw Counterexample{past() + ": it says it is done after " + std::to_string(steps()) + " steps of " +
                         std::to_string(upTo) + ", and it is not at rest"};
  }
  return done;
}

void WatchedSurface::advance(const Slice& slice, std::uint64_t upTo) {
  for (std::uint64_t calls = 0; !step(slice, upTo); ++calls) {
    if (calls < kMostCalls) continue;
    throw Counterexample{past() + ": it does not come to rest, after " + std::to_string(kMostCalls) +
                         " slices and " + std::to_string(steps()) + " steps"};
  }
}

std::string WatchedSurface::grow(const DeformRegion& region, ConstHeightView ground) {
  const Result<void> grown = watched([&] { return surface_->grow(region, ground); });
  if (!grown) {
    expectSentence(grown.error().message, past() + ": asked to grow");
    return grown.error().message;
  }
  region_ = region;
  return {};
}

void WatchedSurface::layLoose(ConstHeightView depths) {
  watched([&] { return surface_->layLoose(depths), true; });
}

bool WatchedSurface::loose(HeightView depths) const {
  return watched([&] { return surface_->loose(depths); });
}

std::uint64_t WatchedSurface::steps() const {
  return watched([&] { return surface_->steps(); });
}

bool WatchedSurface::atRest() const {
  return watched([&] { return surface_->atRest(); });
}

std::size_t WatchedSurface::bytes() const {
  return watched([&] { return surface_->bytes(); });
}

std::shared_ptr<const DeformedGround> WatchedSurface::snapshot() {
  auto taken = watched([&] { return surface_->snapshot(); });
  if (taken == nullptr) throw Counterexample{past() + ": there is no snapshot"};
  return taken;
}

HeightMap WatchedSurface::heights() {
  const auto taken = snapshot();
  return watched([&] { return heightsOf(*taken, region_); });
}

std::string WatchedSurface::past() const {
  return past_.empty() ? "before any stamp" : shortened(past_, 1000);
}

HeightMap heightsOf(const DeformedGround& ground, const DeformRegion& region) {
  HeightMap map(region.sampleColumns(), region.sampleRows());
  std::fill_n(map.view().data(), map.samples().size(), std::numeric_limits<float>::quiet_NaN());
  ground.samples({0, 0, map.columns(), map.rows()}, map.view());
  return map;
}

void expectSame(ConstHeightView a, const std::string& one, ConstHeightView b, const std::string& other,
                const std::string& where) {
  const std::string differs = difference(a, one, b, other);
  if (!differs.empty()) throw Counterexample{where + ": " + differs};
}

}  // namespace teren::check
