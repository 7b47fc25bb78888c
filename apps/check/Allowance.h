// How long a check may go on with one setting.
#pragma once

#include <chrono>

#include "teren/ProcessorTime.h"

namespace teren::check {

/// Processor time of the thread that made it.
class Allowance {
 public:
  explicit Allowance(std::chrono::nanoseconds time) : end_(threadProcessorTime() + time) {}
  bool left() const { return threadProcessorTime() < end_; }

 private:
  std::chrono::nanoseconds end_;
};

}  // namespace teren::check
