// A task that does what a test tells it.
#pragma once

#include <functional>
#include <utility>

#include "teren/Slice.h"

namespace teren {

/// Its step is any function.
class ToldTask final : public SlicedTask {
 public:
  explicit ToldTask(std::function<bool()> step) : step_(std::move(step)) {}
  bool step(const Slice&) override { return step_(); }

 private:
  std::function<bool()> step_;
};

}  // namespace teren
