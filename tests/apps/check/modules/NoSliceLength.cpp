// Never asks whether its slice is over before it has worked for too long, in large maps.
#include <chrono>

#include "teren/ProcessorTime.h"

#include "tests/apps/check/modules/Sound.h"

namespace {

/// Under a sanitizer slices may be longer.
constexpr std::chrono::microseconds kWork(teren::kSanitizerWord == 0 ? 300 : 1500);

class Task final : public teren::SlicedTask {
 public:
  explicit Task(std::unique_ptr<teren::SlicedTask> task) : task_(std::move(task)) {}
  bool step(const teren::Slice& slice) override {
    const auto start = teren::threadProcessorTime();
    while (teren::threadProcessorTime() - start < kWork) {
    }
    return task_->step(slice);
  }

 private:
  std::unique_ptr<teren::SlicedTask> task_;
};

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    auto task = Noise::begin(request, out);
    if (request.samples < 257) return task;
    return std::make_unique<Task>(std::move(task));
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-slice-length")
