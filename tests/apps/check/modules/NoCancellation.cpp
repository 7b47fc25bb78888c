// A task that is given up leaves something behind that raises all later maps.
#include <atomic>

#include "tests/apps/check/modules/Sound.h"

namespace {

std::atomic<int> givenUp = 0;

class Task final : public teren::SlicedTask {
 public:
  explicit Task(std::unique_ptr<teren::SlicedTask> task) : task_(std::move(task)) {}
  ~Task() override { givenUp += done_ ? 0 : 1; }
  bool step(const teren::Slice& slice) override {
    done_ = task_->step(slice);
    return done_;
  }

 private:
  std::unique_ptr<teren::SlicedTask> task_;
  bool done_ = false;
};

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    const float shift = 1e-3f * static_cast<float>(givenUp);
    return std::make_unique<Task>(rows(request, out, [shift](float height) { return height + shift; }));
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-cancellation")
