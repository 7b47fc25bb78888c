// One plugin at work on one piece of the land: watched, guarded, and given up where it fails.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "teren/Slice.h"

#include "world/Layer.h"

namespace teren {

/// Steps the task of a plugin of a layer. Whatever the plugin does - throw, begin no task, never be done (see
/// StepLimit.h) - the work comes to an end; one whose steps overrun their slices is named (see StepWatch.h).
class PluginWork {
 public:
  enum class State { working, done, failed };
  using Begin = std::function<std::unique_ptr<SlicedTask>()>;

  /// Work of the plugin of a stage of the layer (0: the generator, k: filter k - 1), which `begin` makes
  /// begin.
  PluginWork(const Layer& layer, std::size_t stage, std::int64_t mostSteps, Begin begin)
      : layer_(&layer), stage_(stage), mostSteps_(mostSteps), begin_(std::move(begin)) {}

  /// Not to be called again once it has returned anything but `working`.
  State step(const Slice& slice);

  /// What the plugin did, a part of a sentence ("plugin "x" threw "y""); once the state is `failed`.
  const std::string& failure() const noexcept { return failure_; }

 private:
  State stepUnguarded(const Slice& slice);
  State fail(const std::string& what);

  const Layer* layer_;
  std::size_t stage_;
  std::int64_t mostSteps_, steps_ = 0;
  Begin begin_;
  std::unique_ptr<SlicedTask> task_;
  std::string failure_;
};

}  // namespace teren
