#include "apps/check/MapMaker.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "teren/Hash.h"
#include "teren/Quote.h"
#include "teren/StepLimit.h"

#include "apps/check/Called.h"
#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/SourceNoise.h"

namespace teren::check {

MapRequest requestOf(int n, int samples, int level) {
  const int intervals = level < 31 ? (samples - 1) >> level : 0;
  const std::int64_t i = 3 * n - 7, j = (std::int64_t{1} << 40) - n;
  return {.i = i,
          .j = j,
          .seed = mapSeed(42, "contract", i, j),
          .samples = intervals < 2 ? 1 : intervals + 1,
          .level = level,
          .spacing = 2.0 * kPitch / (samples - 1) * static_cast<double>(std::int64_t{1} << level),
          .finestIntervals = samples - 1};
}

/// The plugin's task, watched. It keeps the plugin alive.
class MapMaker::Task final : public SlicedTask {
 public:
  Task(const MapMaker& maker, std::string place, std::int64_t limit, std::unique_ptr<SlicedTask> task)
      : maker_(maker), place_(std::move(place)), limit_(limit), task_(std::move(task)) {}

  bool step(const Slice& slice) override {
    if (++steps_ > limit_) {
      throw Counterexample{place_ + ": it is not done after " + std::to_string(limit_) + " steps"};
    }
    return called([this] { return place_; }, [&] { return task_->step(slice); });
  }

 private:
  const MapMaker maker_;
  const std::string place_;
  const std::int64_t limit_;
  std::unique_ptr<SlicedTask> task_;
  std::int64_t steps_ = 0;
};

std::unique_ptr<SlicedTask> MapMaker::watched(std::string place, std::int64_t limit,
                                              std::unique_ptr<SlicedTask> task) const {
  if (task == nullptr) throw Counterexample{place + ": it begins no task"};
  return std::make_unique<Task>(*this, std::move(place), limit, std::move(task));
}

MapMaker::MapMaker(std::shared_ptr<const Generator> generator, std::string setting)
    : generator_(std::move(generator)), setting_(std::move(setting)) {}

MapMaker::MapMaker(std::shared_ptr<const Filter> filter, std::string setting)
    : generator_(std::make_shared<SourceNoise>()), filter_(std::move(filter)), setting_(std::move(setting)) {}

bool MapMaker::exactLevels() const {
  return !filters() &&
         !called([this] { return "with " + setting_; }, [this] { return generator_->traits(); }).approximate;
}

HeightRange MapMaker::range() const {
  return called([this] { return "with " + setting_ + ", asked for its range"; },
                [this] { return filters() ? filter_->range(generator_->range()) : generator_->range(); });
}

double MapMaker::residual(int level, int samples) const {
  return called([this] { return "with " + setting_ + ", asked for its residual"; },
                [&] { return generator_->residual(level, samples, 2.0 * kPitch / (samples - 1)); });
}

double MapMaker::filteredResidual(double before, int level) const {
  return called([this] { return "with " + setting_ + ", asked for its residual"; },
                [&] { return filter_->residual(before, level); });
}

void MapMaker::prepare(const MapRequest& request, HeightView map) const {
  if (filters()) {
    finish(*generator_->begin(request, map));
    return;
  }
  for (int row = 0; row < map.rows(); ++row) {
    std::fill_n(map.row(row), map.columns(), std::numeric_limits<float>::quiet_NaN());
  }
}

std::unique_ptr<SlicedTask> MapMaker::begin(const MapRequest& request, HeightView map) const {
  std::unique_ptr<SlicedTask> task =
      called([&] { return place(request); },
             [&] { return filters() ? filter_->begin(request, map) : generator_->begin(request, map); });
  return watched(place(request), stepLimit(request.samples, request.samples), std::move(task));
}

const ContinuousGenerator* MapMaker::continuous() const {
  if (filters()) return nullptr;
  return called([this] { return "with " + setting_; }, [this] { return asContinuous(*generator_); });
}

HeightMap MapMaker::field(const FieldRequest& request, const Slice& slice) const {
  HeightMap map(request.columns, request.rows);
  std::unique_ptr<SlicedTask> task =
      called([&] { return place(request); }, [&] { return continuous()->beginField(request, map.view()); });
  finish(*watched(place(request), stepLimit(request.columns, request.rows), std::move(task)), slice);
  return map;
}

HeightMap MapMaker::make(const MapRequest& request, const Slice& slice, std::int64_t* steps) const {
  HeightMap map(request.samples, request.samples);
  prepare(request, map.view());
  const std::int64_t taken = finish(*begin(request, map.view()), slice);
  if (steps != nullptr) *steps = taken;
  return map;
}

HeightMap MapMaker::source(const MapRequest& request) const {
  HeightMap map(request.samples, request.samples);
  finish(*generator_->begin(request, map.view()));
  return map;
}

std::string MapMaker::place(const MapRequest& request) const {
  const std::string side = std::to_string(request.samples);
  return "with " + setting_ + " at lattice point (" + std::to_string(request.i) + ", " +
         std::to_string(request.j) + "), seed " + std::to_string(request.seed) + ", level " +
         std::to_string(request.level) + ", " + side + " x " + side + " samples";
}

std::string MapMaker::place(const FieldRequest& request) const {
  return "with " + setting_ + " at (" + std::to_string(request.i) + " + " + numberText(request.u) + ", " +
         std::to_string(request.j) + " + " + numberText(request.v) + ") pitches, seed " +
         std::to_string(request.seed) + ", level " + std::to_string(request.level) + ", spacing " +
         numberText(request.spacing) + " m, " + std::to_string(request.columns) + " x " +
         std::to_string(request.rows) + " samples";
}

std::int64_t finish(SlicedTask& task, const Slice& slice) {
  std::int64_t steps = 1;
  while (!task.step(slice)) ++steps;
  return steps;
}

std::string difference(ConstHeightView a, const std::string& one, ConstHeightView b,
                       const std::string& other) {
  for (int row = 0; row < a.rows(); ++row) {
    for (int column = 0; column < a.columns(); ++column) {
      if (std::bit_cast<std::uint32_t>(a(column, row)) == std::bit_cast<std::uint32_t>(b(column, row)))
        continue;
      return "sample (" + std::to_string(column) + ", " + std::to_string(row) + ") is " +
             numberText(a(column, row)) + " m " + one + " but " + numberText(b(column, row)) + " m " + other;
    }
  }
  return {};
}

}  // namespace teren::check
