// How long one step of a long piece of work may take. Work asks "is my slice over?" after each small unit,
// so slices are sized by measuring on the machine at hand, never by a fixed count.
#pragma once

#include <chrono>

namespace teren {

/// A deadline on the monotonic clock. Asking costs about 25 ns: ask after units of one to ten microseconds.
class Slice {
 public:
  using Clock = std::chrono::steady_clock;

  /// Never over: the work is done in one step.
  static Slice unlimited() noexcept { return Slice(Clock::time_point::max()); }
  static Slice until(Clock::time_point deadline) noexcept { return Slice(deadline); }
  static Slice lasting(Clock::duration duration) noexcept { return Slice(Clock::now() + duration); }

  bool over() const noexcept { return deadline_ != Clock::time_point::max() && Clock::now() >= deadline_; }
  Clock::time_point deadline() const noexcept { return deadline_; }

 private:
  explicit Slice(Clock::time_point deadline) noexcept : deadline_(deadline) {}
  Clock::time_point deadline_;
};

/// A long piece of work done in steps.
class SlicedTask {
 public:
  virtual ~SlicedTask() = default;

  /// Works until done (returns true) or until the slice is over (returns false), and at least one unit in
  /// either case. What comes out must not depend on how the work was sliced. After the first step it should
  /// not allocate. Called by one thread at a time; destroying an unfinished task cancels it.
  virtual bool step(const Slice& slice) = 0;

 protected:
  SlicedTask() = default;
  SlicedTask(const SlicedTask&) = delete;
  SlicedTask& operator=(const SlicedTask&) = delete;
};

}  // namespace teren
