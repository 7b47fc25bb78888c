#include "world/PluginWork.h"

#include <exception>

#include "teren/Quote.h"

#include "plugin/Thrown.h"

namespace teren {

PluginWork::State PluginWork::step(const Slice& slice) {
  try {
    return stepUnguarded(slice);
  } catch (const std::exception& problem) {
    return fail("threw " + inQuotes(textOf(problem)));
  } catch (...) {
    return fail("threw something that is no std::exception");
  }
}

PluginWork::State PluginWork::stepUnguarded(const Slice& slice) {
  const StepWatch::Start start = StepWatch::start(slice);
  if (!task_) task_ = begin_();
  if (!task_) return fail("began no task");
  const bool done = task_->step(slice);
  if (const auto overrun = layer_->watch(stage_).finish(slice, start))
    layer_->reportOverrun(stage_, *overrun);
  if (done) {
    task_.reset();  // its scratch is of no more use
    return State::done;
  }
  if (++steps_ < mostSteps_) return State::working;
  return fail("is not done after " + std::to_string(steps_) + " steps");
}

PluginWork::State PluginWork::fail(const std::string& what) {
  task_.reset();
  failure_ = "plugin " + inQuotes(layer_->pluginIds()[stage_]) + " " + what;
  return State::failed;
}

}  // namespace teren
