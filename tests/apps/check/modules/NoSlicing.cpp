// Raises what is made in later steps.
#include "tests/apps/check/modules/Sound.h"

namespace {

class Task final : public teren::SlicedTask {
 public:
  Task(teren::HeightView out, std::unique_ptr<teren::SlicedTask> task) : out_(out), task_(std::move(task)) {}
  bool step(const teren::Slice& slice) override {
    ++steps_;
    if (!task_->step(slice)) return false;
    out_(0, 0) += 1e-3f * static_cast<float>(steps_ - 1);
    return true;
  }

 private:
  teren::HeightView out_;
  std::unique_ptr<teren::SlicedTask> task_;
  int steps_ = 0;
};

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    return std::make_unique<Task>(out, Noise::begin(request, out));
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-slicing")
